"""Summary of stretches of track: forces, position and damage drivers of every wheelset.

A stretch is an element of the track, a curve or a straight, and counts for every wheelset while it runs there
itself. Means are over the output times; a wheel off the rail counts with zero force. Peaks are of forces
below 20 Hz, of the logged ones where the log is coarser than 10 ms.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from damage.log_input.contact_states import contact_chunks
from damage.material import ER7
from damage.model import DamageModel
from damage.rcf.surface_index import surface_fatigue_index
from damage.wear.energy import wear_number
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.log.store import Run
from hh_exudyn.signals import low_pass

PEAK_CUTOFF = 20.0  # Hz, as EN 14363 and the thesis (section 1.2.1) filter forces
_LARGEST_INTERVAL = 0.0101  # s, five values in a period of it; the log's times are rounded
_LEAST_LOAD = 0.01  # of the mean Q: divisor of Y in peaks, where a wheel is unloaded

_WEAR = ("force_x", "force_y", "moment_z", "nu_x", "nu_y", "phi")
_SOLVED = (*_WEAR, "normal_force", "a", "b")
_COLUMNS = (
    *("time", "s", "vehicle", "wheelset", "side", "p_max", "Q", "Y", "angle_of_attack", "y_wheelset"),
    *_SOLVED,
)

Pair = tuple[float, float]
_Rows = dict[str, NDArray[np.float64]]


@dataclass(frozen=True)
class WheelsetSummary:
    """One wheelset on a stretch of track. Pairs are (left wheel, right wheel).

    Attributes
    ----------
    vehicle, wheelset
        From 1, the wheelset from the leading end.
    Q, Y
        Mean vertical force and mean lateral force outwards, on the rail [N].
    y_over_q
        Ratio of these means [-]; NaN without vertical force.
    Q_peak, Y_peak, y_over_q_peak
        The largest of each [N], [-].
    Q_least
        The least vertical force [N].
    angle_of_attack
        Mean yaw to the rails, positive to the left [rad].
    lateral
        Mean lateral position, positive to the left [m].
    p_max
        Mean of the highest Hertz pressure among the patches of the wheel [Pa].
    wear_number
        Mean energy lost per distance rolled, all patches of the wheel together [N].
    fatigue_share
        Share of the output times in which FI_surf of any patch of the wheel exceeds zero (ER7) [-].
    """

    vehicle: int
    wheelset: int
    Q: Pair
    Y: Pair
    y_over_q: Pair
    Q_peak: Pair
    Y_peak: Pair
    y_over_q_peak: Pair
    Q_least: Pair
    angle_of_attack: float
    lateral: float
    p_max: Pair
    wear_number: Pair
    fatigue_share: Pair


@dataclass(frozen=True, eq=False)
class _Course:
    """A wheelset at all output times: arc length (n,), Q and Y (n, 2), and the same below 20 Hz."""

    s: NDArray[np.float64]
    Q: NDArray[np.float64]
    Y: NDArray[np.float64]


def wheelset_summary(run: Run, stretch: Pair) -> list[WheelsetSummary]:
    """Summary of every wheelset on one stretch of track, from the contact log alone.

    Parameters
    ----------
    run
        The run on disk.
    stretch
        First and last arc length [m], both included.

    Raises
    ------
    FileNotFoundError, ValueError
        The run has no contact log; no wheelset has contact on the stretch.
    """
    (found,) = stretch_summaries(run, [stretch])
    if not found:
        raise ValueError(f"{run.directory}: no contact between s = {stretch[0]:g} and {stretch[1]:g} m")
    return found


def stretch_summaries(run: Run, stretches: Sequence[Pair]) -> list[list[WheelsetSummary]]:
    """Summaries of several stretches; a wheelset that has no contact on a stretch is not in its list.

    Parameters
    ----------
    run
        The run on disk.
    stretches
        First and last arc lengths [m].

    Raises
    ------
    FileNotFoundError, ValueError
        The run has no contact log, or one without rows.
    """
    chunks = [_drivers(chunk) for chunk in contact_chunks(run, _COLUMNS)]
    if not chunks:
        raise ValueError(f"{run.directory}: the contact log has no rows")
    rows = {name: np.concatenate([chunk[name] for chunk in chunks]) for name in chunks[0]}
    times = np.unique(rows["time"])
    wheelsets = np.unique(np.column_stack([rows["vehicle"], rows["wheelset"]]), axis=0).astype(int)
    found: list[list[WheelsetSummary]] = [[] for _ in stretches]
    for vehicle, wheelset in wheelsets:
        mine = (rows["vehicle"] == vehicle) & (rows["wheelset"] == wheelset)
        own = {name: values[mine] for name, values in rows.items()}
        course = _course(own, times)
        for place, (first, last) in zip(found, stretches, strict=True):
            there = (own["s"] >= first) & (own["s"] <= last)
            if there.any():
                during = (course.s >= first) & (course.s <= last)
                on_it = {name: values[there] for name, values in own.items()}
                place.append(_summary(on_it, course, during, (int(vehicle), int(wheelset))))
    return found


def seizure_shares(run: Run) -> dict[str, float]:
    """Of every wheel ("1L"; of several vehicles counted through), the share of the output times with a patch
    above the pressure of seizure, 0.8 of the hardness (ER7) [-].

    Parameters
    ----------
    run
        The run on disk.

    Raises
    ------
    FileNotFoundError, ValueError
        The run has no contact log.
    """
    limit = DamageModel(material=ER7).seizure_pressure
    seized: dict[tuple[int, int, int], set[float]] = {}
    times: set[float] = set()
    for chunk in contact_chunks(run, ("time", "vehicle", "wheelset", "side", "p_max")):
        times.update(np.unique(chunk["time"]).tolist())
        wheels = np.column_stack([chunk[name] for name in ("vehicle", "wheelset", "side")]).astype(int)
        for wheel in np.unique(wheels, axis=0):
            mine = (wheels == wheel).all(axis=1) & (chunk["p_max"] > limit)
            key = int(wheel[0]), int(wheel[1]), int(wheel[2])
            seized.setdefault(key, set()).update(chunk["time"][mine].tolist())
    wheelsets = sorted({key[:2] for key in seized})
    return {
        f"{wheelsets.index(key[:2]) + 1}{'L' if key[2] == LEFT else 'R'}": len(own) / len(times)
        for key, own in seized.items()
    }


def _drivers(chunk: _Rows) -> _Rows:
    """Rows of the log with wear number and fatigue in place of what they are computed from."""
    index = surface_fatigue_index(
        chunk["force_x"], chunk["force_y"], chunk["normal_force"], chunk["a"], chunk["b"], ER7.shear_yield
    )
    kept = {name: values for name, values in chunk.items() if name not in _SOLVED}
    kept["wear_number"] = wear_number(*(chunk[name] for name in _WEAR))
    kept["fatigue"] = (index > 0.0).astype(np.float64)
    return kept


def _course(own: _Rows, times: NDArray[np.float64]) -> _Course:
    """A wheelset over all output times; forces are zero in the air and below 20 Hz where the log is fine."""
    _, first = np.unique(own["time"], return_index=True)
    s = np.interp(times, own["time"][first], own["s"][first])
    Q, Y = np.zeros((times.size, 2)), np.zeros((times.size, 2))
    for i, side in enumerate((LEFT, RIGHT)):
        of_wheel = own["side"] == side
        at = np.searchsorted(times, own["time"][of_wheel])
        Q[at, i], Y[at, i] = own["Q"][of_wheel], own["Y"][of_wheel]
    steps = np.diff(times)
    if steps.size and np.ptp(steps) < 1e-6 and steps[0] < _LARGEST_INTERVAL:
        Q, Y = (low_pass(force, float(steps[0]), PEAK_CUTOFF) for force in (Q, Y))
    return _Course(s, Q, Y)


def _summary(
    rows: _Rows, course: _Course, during: NDArray[np.bool_], number: tuple[int, int]
) -> WheelsetSummary:
    """One wheelset on a stretch: its rows there, and the output times `during` which it is there."""
    _, first = np.unique(rows["time"], return_index=True)  # values repeated on both wheels and all patches
    wheels = [
        _wheel({name: values[rows["side"] == side] for name, values in rows.items()})
        for side in (LEFT, RIGHT)
    ]
    count = int(during.sum())

    def mean(name: str) -> Pair:
        left, right = (float(wheel[name].sum()) / count for wheel in wheels)
        return left, right

    Q, Y = mean("Q"), mean("Y")
    load, guiding = course.Q[during], course.Y[during]
    ratio = guiding / np.maximum(load, np.maximum(_LEAST_LOAD * load.mean(axis=0), 1e-9))
    return WheelsetSummary(
        vehicle=number[0],
        wheelset=number[1],
        Q=Q,
        Y=Y,
        y_over_q=(_ratio(Y[0], Q[0]), _ratio(Y[1], Q[1])),
        Q_peak=_pair(load.max(axis=0)),
        Y_peak=_pair(guiding.max(axis=0)),
        y_over_q_peak=_pair(ratio.max(axis=0)),
        Q_least=_pair(load.min(axis=0)),
        angle_of_attack=float(rows["angle_of_attack"][first].mean()),
        lateral=float(rows["y_wheelset"][first].mean()),
        p_max=mean("p_max"),
        wear_number=mean("wear_number"),
        fatigue_share=mean("fatigue"),
    )


def _wheel(rows: dict[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """One value per output time from the patches of one wheel."""
    times, first, place = np.unique(rows["time"], return_index=True, return_inverse=True)
    highest = {name: np.zeros(times.size) for name in ("p_max", "fatigue")}
    for name, values in highest.items():
        np.maximum.at(values, place, rows[name])
    total: NDArray[np.float64] = np.bincount(place, rows["wear_number"], minlength=times.size).astype(
        np.float64
    )
    return {"Q": rows["Q"][first], "Y": rows["Y"][first], "wear_number": total, **highest}


def _ratio(part: float, whole: float) -> float:
    return part / whole if whole != 0.0 else float("nan")


def _pair(values: NDArray[np.float64]) -> Pair:
    return float(values[0]), float(values[1])
