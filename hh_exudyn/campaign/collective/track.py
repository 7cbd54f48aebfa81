"""The track of a stratum, and the parts of it that are evaluated.

A case runs straight - transition - curve - transition - straight. The straights serve as a start without
transients and to let all wheels leave the curve; they are not evaluated, as straight track has cases of its
own. Part by part the damage per metre rolled is averaged; a part stands for its share of the class:

    transitions  L_t / L_curve each,   full curve  1 - 2 L_t / L_curve

with L_curve the mean length of the line's curves including transitions. The shares of classes
(Hossein-Nia 2018, Table 1-3) are taken as of curves including transitions; the thesis does not say.
"""

from dataclasses import dataclass
from typing import Any

from hh_exudyn.campaign.collective.plan import TrackLengths
from hh_exudyn.campaign.collective.strata import Stratum

PARTS = ("transition_in", "body", "transition_out")
_LEAST_BODY = 0.1  # of a curve: a shorter one would have transitions that meet


@dataclass(frozen=True)
class EvaluatedPart:
    """A stretch of a case's track from `start` to `end` [m] that stands for `share` of the case's weight."""

    name: str  # one of `PARTS`
    start: float
    end: float
    share: float


def part_shares(stratum: Stratum, lengths: TrackLengths) -> dict[str, float]:
    """Share of each part in a stratum's weight; they sum to 1.

    Parameters
    ----------
    stratum : Stratum
        With the length of its transition.
    lengths : TrackLengths
        With the mean length of a curve.
    """
    if stratum.straight:
        return {"body": 1.0}
    ramp = min(stratum.transition_m / lengths.whole_curve, 0.5 * (1.0 - _LEAST_BODY))
    return {"transition_in": ramp, "body": 1.0 - 2.0 * ramp, "transition_out": ramp}


def evaluated_parts(stratum: Stratum, lengths: TrackLengths) -> tuple[EvaluatedPart, ...]:
    """The parts of a case that are evaluated, by arc length.

    Parameters
    ----------
    stratum, lengths
        As `part_shares`.
    """
    shares = part_shares(stratum, lengths)
    found, s = [], lengths.approach
    for name, share in shares.items():
        length = lengths.body if name == "body" else stratum.transition_m
        found.append(EvaluatedPart(name, s, s + length, share))
        s += length
    return tuple(found)


def track_length(stratum: Stratum, lengths: TrackLengths) -> float:
    """Length of a case's track [m].

    Parameters
    ----------
    stratum, lengths
        As `part_shares`.
    """
    ramps = 0.0 if stratum.straight else 2.0 * stratum.transition_m
    return lengths.approach + ramps + lengths.body + lengths.run_out


def track_sections(stratum: Stratum, lengths: TrackLengths) -> list[dict[str, Any]]:
    """The sections of a case file.

    Parameters
    ----------
    stratum, lengths
        As `part_shares`.
    """
    rails = {"rail_left": stratum.rail_high, "rail_right": stratum.rail_low}
    if stratum.straight:
        whole = track_length(stratum, lengths)
        return [{"kind": "straight", "length_m": whole, "gauge_mm": stratum.gauge_mm} | rails]
    if stratum.run_hand == "left":
        rails = {"rail_left": stratum.rail_low, "rail_right": stratum.rail_high}
    transition = {"kind": "transition", "length_m": stratum.transition_m}
    curve = {
        "kind": "curve", "length_m": lengths.body, "radius_m": stratum.radius_m, "hand": stratum.run_hand,
        "cant_mm": stratum.cant_mm, "gauge_mm": stratum.gauge_mm,
        "rail_high": stratum.rail_high, "rail_low": stratum.rail_low,
    }  # fmt: skip
    ends = (
        {"kind": "straight", "length_m": length, "gauge_mm": stratum.straight_gauge_mm} | rails
        for length in (lengths.approach, lengths.run_out)
    )
    ahead, behind = ends
    return [ahead, transition, curve, dict(transition), behind]
