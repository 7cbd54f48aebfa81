"""Twist test after EN 14363: a vehicle crawls over twisted track, straight and in a curve of 150 m.

The twists of the test are, in per mille,

    bogie  g+ = 7 - 5 / 2a+,    body  g* = 2 + 15 / 2a*,    both at most 7,

for the wheelbase 2a+ and the distance 2a* of the bogies in m; a vehicle without bogies has that of the body.
All of this is from memory (`data/assessment.toml`). Here the track has both at once: ahead of level track the
cross-level changes so that, with the trailing bogie still on the level, the leading one stands on a twist of
g+ and the middles of both differ by g* 2a*. The trailing bogie then passes the same twist. On straight track
the cross-level goes from half of it on one side to half on the other, or the vehicle would lean.

* On straight track the largest unloading dQ/Q0 of any wheel is judged, limit 0.6 (its method 2 and 3).
* In a left-hand curve of 150 m the cant falls by the same twist, which unloads the leading outer wheel; the
  largest Y/Q of an outer wheel, mean over 2 m, is judged, limit 1.2, and its lift, limit 5 mm (its method 1).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.assessment.findings import History
from hh_exudyn.assessment.guiding_forces import sliding, wheel_names
from hh_exudyn.assessment.limits import Limit, data
from hh_exudyn.case import Case
from hh_exudyn.log.store import Run
from hh_exudyn.log.wheel_forces import WheelForces, wheel_forces
from hh_exudyn.sourced import load_parameters
from vehicles.description import Vehicle

_AHEAD = 8.0  # m of straight track beside the vehicle
_GENTLE = 0.002  # slope of the ramp ahead: less than a third of the largest twist of the test
_LEVEL = 1e-9  # mm, cross-level that is none
_STEP_SHARE = 0.75  # of the other case's time step: creep forces are stiffer at crawling speed
_STEPS_LOGGED = 10  # steps of an output interval
_HELD = 1.0  # m of the full twist under a vehicle without bogies
_CLEAR = 2.0  # m of level track that the whole vehicle has more before and behind the twist


@dataclass(frozen=True)
class Twist:
    """Twists of the test for one vehicle.

    Attributes
    ----------
    wheelbase : float
        2a+ of its leading bogie [m]; 0 without bogies.
    distance : float
        2a* between its first and last bogie, or wheelset [m].
    of_bogie, of_body : float
        g+ and g* [-].
    """

    wheelbase: float
    distance: float
    of_bogie: float
    of_body: float

    @property
    def height(self) -> float:
        """Change of the cross-level over the whole twist [m]."""
        return self.of_body * self.distance + 0.5 * self.of_bogie * self.wheelbase


@dataclass(frozen=True)
class TwistResult:
    """What a run over twisted track shows of every wheel.

    Attributes
    ----------
    wheels : tuple of str
        "wheel 1L", ...
    unloading : (wheels,) array
        Largest 1 - Q / Q0, below 20 Hz [-]; Q0 is half the load of the wheelset at the start.
    y_over_q : (wheels,) array
        Largest Y/Q, mean over 2 m [-].
    """

    wheels: tuple[str, ...]
    unloading: FloatArray
    y_over_q: FloatArray


def twist_of(vehicle: Vehicle) -> Twist:
    """The twists of the test for the first unit of a vehicle.

    Raises
    ------
    ValueError
        A vehicle with one wheelset.
    """
    bogies: dict[int, list[float]] = {}
    for wheelset in vehicle.wheelsets:
        if wheelset.unit == vehicle.wheelsets[0].unit:
            bogies.setdefault(wheelset.bogie, []).append(vehicle.body(wheelset.body).position[0])
    middles = [float(np.mean(places)) for places in bogies.values()]
    wheelbase = max(max(places) - min(places) for places in bogies.values())
    distance = max(middles) - min(middles)
    if not distance > 0.0:
        raise ValueError(f"vehicle {vehicle.name} has one bogie or wheelset: a twist test needs two")
    row = data()["twist_test"]
    body = min(row["body_constant"] + row["body_over_base_m"] / distance, row["largest"])
    bogie = 0.0
    if wheelbase > 0.0:
        bogie = min(max(row["bogie_constant"] + row["bogie_over_base_m"] / wheelbase, 0.0), row["largest"])
    return Twist(wheelbase, distance, 1e-3 * bogie, 1e-3 * body)


def twist_case(base: Case, curve: bool, described: Vehicle | None = None) -> Case:
    """The case of a twist test with vehicle, friction, profiles, rails and contact of another one.

    Parameters
    ----------
    base : Case
        Its track, irregularity and speed are not used.
    curve : bool
        Whether in the curve of 150 m, else on straight track.
    described : Vehicle or None
        The vehicle that will run; None for that of the case.

    Raises
    ------
    ValueError
        As `twist_of`; a `CaseError` where the vehicle does not fit into the curve.
    """
    row = data()["twist_test"]
    vehicle = described or base.described_vehicle()
    twist = twist_of(vehicle)
    heads = [point[0] for point in vehicle.coupler.points]
    length = max(heads) - min(heads)
    gauge = base.track.nominal_gauge_mm
    sections = (_in_curve if curve else _on_straight)(twist, length, gauge, row)
    track = {
        "sections": sections, "alignment": None, "centre_line": None, "alignment_mirrored": False,
        "grades": (), "irregularity": "none", "sleeper_passing": False,
    }  # fmt: skip
    step = _STEP_SHARE * base.integration.step_ms
    place = "curve" if curve else "straight"
    return base.with_changes(
        name=f"{base.name}, twist test, {place}",
        speed_km_h=row["speed_km_h"],
        track=track,
        start_m=None,
        integration={"step_ms": step, "output_interval_ms": _STEPS_LOGGED * step},
    )


def _parts(twist: Twist) -> list[tuple[float, float]]:
    """Length [m] and change of the cross-level [mm] of the two parts of the twist."""
    if twist.wheelbase == 0.0:  # both wheelsets stay on the twist for a while
        length = twist.distance + _HELD
        return [(length, 1e3 * twist.of_body * length)]
    gap = twist.distance - twist.wheelbase  # between the facing wheelsets of both bogies
    steep = twist.of_bogie * twist.wheelbase
    return [(gap, 1e3 * (twist.height - steep)), (twist.wheelbase, 1e3 * steep)]


def _on_straight(twist: Twist, length: float, gauge: float, row: dict[str, float]) -> list[dict[str, Any]]:
    """The twist from a low to a high right rail: with its middle in the twist the vehicle does not lean."""
    sections: list[dict[str, Any]] = [{"kind": "straight", "length_m": length + _AHEAD, "gauge_mm": gauge}]
    changes = _parts(twist)
    half = 0.5 * sum(change for _, change in changes)
    height = 0.0
    gentle = (1e-3 * half / _GENTLE, -half)
    for part, change in [gentle, (length + _CLEAR, 0.0), *changes, (length + _CLEAR, 0.0)]:
        for share in _split_at_level(height, change):
            after = height + share * change
            sections.append(
                {"kind": "ramp", "length_m": share * part, "radius_m": (0.0, 0.0),
                 "hand": "left" if height + after > 0.0 else "right",
                 "cant_mm": (abs(height), abs(after)), "gauge_mm": (gauge, gauge)}
            )  # fmt: skip
            height = after if abs(after) > _LEVEL else 0.0
    return sections


def _split_at_level(height: float, change: float) -> tuple[float, ...]:
    """Shares of a part before and behind its zero; a ramp of a case has the cant of one hand."""
    if height * (height + change) >= -_LEVEL:
        return (1.0,)
    return -height / change, 1.0 + height / change


def _in_curve(twist: Twist, length: float, gauge: float, row: dict[str, float]) -> list[dict[str, Any]]:
    """Straight, transition, curve with cant, the twist downwards, curve without cant."""
    radius, wide = row["radius_m"], gauge + row["widening_mm"]
    height = sum(change for _, change in _parts(twist))
    sections: list[dict[str, Any]] = [
        {"kind": "straight", "length_m": length + _AHEAD, "gauge_mm": gauge},
        {"kind": "ramp", "length_m": max(1e-3 * height / _GENTLE, length), "radius_m": (0.0, radius),
         "cant_mm": (0.0, height), "gauge_mm": (gauge, wide)},
    ]  # fmt: skip
    for part, change in [(length + _CLEAR, 0.0), *_parts(twist), (length + _CLEAR, 0.0)]:
        lower = max(height - change, 0.0)
        sections.append(
            {"kind": "ramp", "length_m": part, "radius_m": (radius, radius),
             "cant_mm": (height, lower), "gauge_mm": (wide, wide)}
        )  # fmt: skip
        height = lower
    return sections


def twist_result(run: Run) -> TwistResult:
    """Unloading and Y/Q of the wheels of a run over twisted track.

    Parameters
    ----------
    run : Run
        Of a `twist_case`.
    """
    forces = wheel_forces(run).filtered(data()["processing"]["low_pass_Hz"])
    start = 0.5 * forces.Q[0].sum(axis=1, keepdims=True)  # (wheelsets, 1)
    unloading = 1.0 - forces.Q / start
    return TwistResult(
        wheel_names(forces), unloading.max(axis=0).reshape(-1), _ratios(forces).values.max(axis=0)
    )


def _ratios(forces: WheelForces) -> History:
    """Y/Q of all wheels, mean over 2 m; an unloaded wheel counts with a hundredth of its load."""
    Q, Y = (force.reshape(len(forces.time), -1) for force in (forces.Q, forces.Y))
    ratio = Y / np.maximum(Q, 0.01 * Q[0])
    covered = float(forces.s[0].max()), float(forces.s[-1].min())
    return sliding(History(wheel_names(forces), np.repeat(forces.s, 2, axis=1), ratio), covered)


def twist_limits() -> dict[str, Limit]:
    """Limits of `unloading` and `y_over_q` [-] and `lift` [m] in the test."""
    sourced = load_parameters("hh_exudyn", "assessment")
    names = {
        "unloading": ("limit.unloading_quasi_static.share", 1.0),
        "y_over_q": ("twist_test.ratio", 1.0),
        "lift": ("twist_test.lift_mm", 1e-3),
    }
    found = {}
    for name, (key, factor) in names.items():
        number = sourced.parameter(key)
        found[name] = Limit(factor * number.value, number.confirmed, number.source)
    return found
