"""Summary of the last part of a run: forces, position and damage drivers of every wheelset.

The means are over time, over the output times of a window; a wheel off the rail counts with zero force.
"""

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

STEADY_SHARE = 0.2  # of the run time: the demo's last 50 m of 250 m, a curve entered 100 m earlier

_WEAR = ("force_x", "force_y", "moment_z", "nu_x", "nu_y", "phi")
_COLUMNS = (
    *("time", "vehicle", "wheelset", "side", "normal_force", "a", "b", "p_max"),
    *("Q", "Y", "angle_of_attack", "y_wheelset"),
    *_WEAR,
)

Pair = tuple[float, float]


@dataclass(frozen=True)
class WheelsetSummary:
    """One wheelset over a window of time. Pairs are (left wheel, right wheel).

    Attributes
    ----------
    vehicle, wheelset
        From 1, the wheelset from the leading end.
    Q, Y
        Mean vertical force and mean lateral force outwards, on the rail [N].
    y_over_q
        Ratio of these means [-]; NaN without vertical force.
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
    angle_of_attack: float
    lateral: float
    p_max: Pair
    wear_number: Pair
    fatigue_share: Pair


def steady_window(run: Run) -> Pair:
    """First and last time of the last fifth of a run [s].

    Raises
    ------
    FileNotFoundError, ValueError
        The run has no contact log, or an empty one.
    """
    times = [(chunk["time"].min(), chunk["time"].max()) for chunk in contact_chunks(run, ("time",))]
    if not times:
        raise ValueError(f"{run.directory}: the contact log has no rows")
    first, last = float(min(low for low, _ in times)), float(max(high for _, high in times))
    return last - STEADY_SHARE * (last - first), last


def wheelset_summary(run: Run, window: Pair) -> list[WheelsetSummary]:
    """Summary of every wheelset over a window of time, from the contact log alone.

    Parameters
    ----------
    run
        The run on disk.
    window
        First and last time [s], both included.

    Raises
    ------
    FileNotFoundError, ValueError
        The run has no contact log; the window holds no row of it.
    """
    rows = _rows(run, window)
    count = np.unique(rows["time"]).size
    wheelsets = np.unique(np.column_stack([rows["vehicle"], rows["wheelset"]]), axis=0).astype(int)
    rows["wear_number"] = wear_number(*(rows[name] for name in _WEAR))
    index = surface_fatigue_index(
        rows["force_x"], rows["force_y"], rows["normal_force"], rows["a"], rows["b"], ER7.shear_yield
    )
    rows["fatigue"] = (index > 0.0).astype(np.float64)
    return [_summary(rows, int(vehicle), int(wheelset), count) for vehicle, wheelset in wheelsets]


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


def _rows(run: Run, window: Pair) -> dict[str, NDArray[np.float64]]:
    """The rows of the window, column by column."""
    parts: list[dict[str, NDArray[np.float64]]] = []
    for chunk in contact_chunks(run, _COLUMNS):
        inside = (chunk["time"] >= window[0]) & (chunk["time"] <= window[1])
        parts.append({name: values[inside] for name, values in chunk.items()})
    rows = {name: np.concatenate([chunk[name] for chunk in parts]) for name in _COLUMNS} if parts else {}
    if not rows or rows["time"].size == 0:
        raise ValueError(f"{run.directory}: no contact between {window[0]:g} and {window[1]:g} s")
    return rows


def _summary(
    rows: dict[str, NDArray[np.float64]], vehicle: int, wheelset: int, count: int
) -> WheelsetSummary:
    """Means of one wheelset over `count` output times."""
    mine = (rows["vehicle"] == vehicle) & (rows["wheelset"] == wheelset)
    both = {name: values[mine] for name, values in rows.items()}
    _, first = np.unique(both["time"], return_index=True)  # values repeated on both wheels and all patches
    wheels = [
        _wheel({name: values[both["side"] == side] for name, values in both.items()})
        for side in (LEFT, RIGHT)
    ]

    def mean(name: str) -> Pair:
        left, right = (float(wheel[name].sum()) / count for wheel in wheels)
        return left, right

    Q, Y = mean("Q"), mean("Y")
    return WheelsetSummary(
        vehicle=vehicle,
        wheelset=wheelset,
        Q=Q,
        Y=Y,
        y_over_q=(_ratio(Y[0], Q[0]), _ratio(Y[1], Q[1])),
        angle_of_attack=float(both["angle_of_attack"][first].mean()),
        lateral=float(both["y_wheelset"][first].mean()),
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
