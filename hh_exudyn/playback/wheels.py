"""The contact log by wheel: forces, creepages, fatigue index and places of the patches."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import pyarrow
from scipy.spatial.transform import Rotation

from damage.rcf.surface_index import surface_fatigue_index
from damage.shakedown import working_point
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.geometry.rail_tables import RailCourse
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.playback.frames import Poses, track_frames
from track.course.alignment import Alignment

QUANTITIES: Mapping[str, str] = {
    "Q_kN": "Q vertical wheel force [kN]",
    "Y_kN": "Y lateral wheel force, outwards [kN]",
    "Y_over_Q": "Y/Q [-]",
    "nu_x": "longitudinal creepage [-]",
    "nu_y": "lateral creepage [-]",
    "FI": "surface fatigue index FI [-]",
}


@dataclass(frozen=True)
class WheelRows:
    """The contact log of one wheel, in order of time and patch.

    Attributes
    ----------
    name
        Number of the wheelset and side, such as "1L", with the unit before it for several units, "2.1L".
    side
        +1 left, -1 right.
    patches
        (n,) number of patches at each of the n output times.
    columns
        Columns of the log by name, each with sum(patches) values.
    """

    name: str
    side: int
    patches: IntArray
    columns: Mapping[str, FloatArray]


def wheel_rows(contact: pyarrow.Table, times: FloatArray, vehicle: int) -> Iterator[WheelRows]:
    """The wheels of one vehicle, from the leading one, left before right.

    Parameters
    ----------
    contact
        The contact log.
    times
        (n,) output times of the run, increasing [s].
    vehicle
        Number of the vehicle.

    Raises
    ------
    ValueError
        The log has no row of this vehicle, or a time that is not an output time.
    """
    columns = {name: contact[name].to_numpy() for name in contact.column_names}
    mine = columns["vehicle"] == vehicle
    if not mine.any():
        raise ValueError(f"the contact log has no vehicle {vehicle}; it has {np.unique(columns['vehicle'])}")
    row = np.minimum(np.searchsorted(times, columns["time"]), len(times) - 1)
    strange = times[row] != columns["time"]
    if strange.any():
        raise ValueError(f"the contact log has time {columns['time'][strange][0]} s, the motion log has not")
    prefix = "" if mine.all() else f"{vehicle}."
    for number in np.unique(columns["wheelset"][mine]):
        for side, letter in ((LEFT, "L"), (RIGHT, "R")):
            index = np.flatnonzero(mine & (columns["wheelset"] == number) & (columns["side"] == side))
            index = index[np.lexsort((columns["patch"][index], row[index]))]
            yield WheelRows(
                f"{prefix}{int(number)}{letter}",
                side,
                np.bincount(row[index], minlength=len(times)),
                {name: column[index] for name, column in columns.items()},
            )


def series(wheel: WheelRows, shear_yield: float) -> dict[str, FloatArray]:
    """The plotted quantities of a wheel at every output time, by the keys of `QUANTITIES`.

    A wheel off the rail has Q = Y = 0 and gaps (NaN) elsewhere. Creepages are those of the deepest patch,
    the fatigue index is the largest of the patches.

    Parameters
    ----------
    wheel
        Rows of the wheel.
    shear_yield
        Yield strength in pure shear k [Pa].
    """
    rows, on_rail = wheel.columns, wheel.patches > 0
    first = np.concatenate([[0], np.cumsum(wheel.patches)[:-1]])[on_rail]  # the deepest patch
    index = surface_fatigue_index(
        rows["force_x"], rows["force_y"], rows["normal_force"], rows["a"], rows["b"], shear_yield
    )
    values = {
        "Q_kN": rows["Q"][first] / 1e3,
        "Y_kN": rows["Y"][first] / 1e3,
        "Y_over_Q": np.divide(
            rows["Y"][first], rows["Q"][first], out=np.full(len(first), np.nan), where=rows["Q"][first] != 0.0
        ),
        "nu_x": rows["nu_x"][first],
        "nu_y": rows["nu_y"][first],
        "FI": np.maximum.reduceat(index, first) if len(first) else index,
    }
    result = {}
    for key, value in values.items():
        result[key] = np.full(len(wheel.patches), 0.0 if key in ("Q_kN", "Y_kN") else np.nan)
        result[key][on_rail] = np.where(np.isfinite(value), value, np.nan)
    return result


def diagram_points(wheel: WheelRows, shear_yield: float) -> tuple[FloatArray, FloatArray]:
    """Utilised friction and p0/k of every patch, see `damage.shakedown.working_point`.

    Parameters
    ----------
    wheel
        Rows of the contact log of a wheel.
    shear_yield
        Yield strength in pure shear k [Pa].
    """
    rows = wheel.columns
    return working_point(rows["force_x"], rows["force_y"], rows["normal_force"], rows["p_max"], shear_yield)


def contact_frames(wheel: WheelRows, alignment: Alignment, rail: RailCourse) -> Poses:
    """The contact frames C of every patch in the global frame, their origins in the contact points.

    The rail lies with its gauge point at half the gauge from the centre line; x of C is taken along the
    track (the yaw of the wheel, some milliradians, is left out).

    Parameters
    ----------
    wheel
        Rows of the wheel.
    alignment
        Of the track.
    rail
        Profiles of the rail under this wheel.
    """
    rows = wheel.columns
    track = track_frames(alignment, rows["s"])
    weights, points = rail.weights(rows["s"]), rail.gauge_points()
    from_gauge_point = weights @ points - rows["y_rail"]
    z = np.zeros_like(from_gauge_point)
    for profile, point, weight in zip(rail.profiles, points, weights.T, strict=True):
        z += weight * np.interp(point - from_gauge_point, profile.y, profile.z)
    local = np.column_stack([rows["x_shift"], wheel.side * (0.5 * track.gauge + from_gauge_point), z])
    # the flange lies inside: a positive contact angle leans the normal towards the track centre
    lean = Rotation.from_rotvec(np.outer(wheel.side * rows["contact_angle"], (1.0, 0.0, 0.0)))
    return Poses(track.origin + track.rotation.apply(local), track.rotation * lean)
