"""Cases on the sections of a line (`track.line.line`), with their geometry, gauge, rails and speed.

    base = read_case("base.toml")
    for section in load_sections(read_line("malmbanan"), base.vehicle):
        run = simulate(case_on(base, section), folder / section_name(section))
        ... weighted with section.weight

Vehicle, friction, contact, foundation and irregularities are those of the base case. A line has the quality
class of its sections (`TrackSection.quality`); the choice of an ``irregularity`` for it is the user's.
"""

import math
from pathlib import Path
from typing import Any

from hh_exudyn.case.case import Case
from track.line.line import TrackSection


def track_table(section: TrackSection, *, length: float = 200.0, approach: float = 50.0) -> dict[str, Any]:
    """The ``[track]`` keys that follow from a section of a line, for `Case.with_changes`.

    A straight and a transition precede a curve; the straight has the line's gauge of straight track and the
    rails of the case.

    Parameters
    ----------
    section : TrackSection
        From `track.line.line.load_sections`.
    length : float
        Of the curve; of straight track including the approach [m].
    approach : float
        Straight track in front of the transition [m].
    """
    table: dict[str, Any] = {"inclination": section.rail_inclination}
    if math.isinf(section.radius):
        rails = section.rails
        straight = {"kind": "straight", "length_m": length, "gauge_mm": 1000.0 * section.gauge}
        return table | {"sections": [straight | {"rail_left": rails.left, "rail_right": rails.right}]}
    return table | {
        "sections": [
            {"kind": "straight", "length_m": approach, "gauge_mm": 1000.0 * section.straight_gauge},
            {"kind": "transition", "length_m": section.transition},
            {
                "kind": "curve",
                "length_m": length,
                "radius_m": section.radius,
                "hand": section.hand,
                "cant_mm": 1000.0 * section.cant,
                "gauge_mm": 1000.0 * section.gauge,
                "rail_high": section.pair.high,
                "rail_low": section.pair.low,
            },
        ]
    }


def section_name(section: TrackSection) -> str:
    """A name of a section, unique in its line and valid as a file name."""
    parts = (
        section.country,
        section.name.replace(":", "-"),
        section.hand,
        section.quality.replace(">", "above_"),
        Path(section.pair.high).stem,
    )
    return "_".join(dict.fromkeys(parts))  # "straight" is both class and hand of straight track


def case_on(base: Case, section: TrackSection, *, length: float = 200.0, approach: float = 50.0) -> Case:
    """The base case on a section of a line, at the section's speed; see `track_table`.

    Parameters
    ----------
    base : Case
        Vehicle, friction, contact, foundation and irregularities.
    section : TrackSection
        Geometry, gauge, rails and speed.
    length, approach : float
        As `track_table` [m].

    Raises
    ------
    CaseError
        A number of the section out of the range of a case, such as a speed below 5 km/h.
    """
    return base.with_changes(
        name=f"{base.name} {section_name(section)}",
        speed_km_h=3.6 * section.speed,
        track=track_table(section, length=length, approach=approach),
    )
