"""Accelerations of points of a vehicle from its motion log, like those of an accelerometer on the body.

The lateral acceleration includes the component of gravity by cant and roll; the vertical one is 0 at rest.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.log.store import Run
from vehicles.description import Vehicle

CAR_BODY, WHEELSET = "car_body", "wheelset"
FRAMES = ("side_frame", "bogie_frame")  # kinds of bodies; motors on wheelsets are left out
_COLUMNS = ("time", "body", "s", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz")


@dataclass(frozen=True)
class Place:
    """A point of a body.

    Attributes
    ----------
    name : str
        "car_body over bogie 1".
    body : str
        Name of the body.
    offset : (3,) array
        From the centre of mass, in the axes of the body [m].
    """

    name: str
    body: str
    offset: FloatArray


@dataclass(frozen=True, eq=False)
class PointAccelerations:
    """Accelerations of places over time.

    Attributes
    ----------
    places : tuple of str
        Their names.
    time : (n,) array
        [s].
    s : (n, places) array
        Arc length of each [m].
    longitudinal, lateral, vertical : (n, places) arrays
        In the axes of the body, forward, to the left and up [m/s^2].
    """

    places: tuple[str, ...]
    time: FloatArray
    s: FloatArray
    longitudinal: FloatArray
    lateral: FloatArray
    vertical: FloatArray

    @property
    def interval(self) -> float:
        """Time from one value to the next [s]."""
        return float(self.time[1] - self.time[0])


def body_places(vehicle: Vehicle, unit: int = 1) -> list[Place]:
    """Points of the car bodies of a unit over each bogie: the middle of the couplings to that bogie.

    Parameters
    ----------
    vehicle : Vehicle
        Description of the vehicle.
    unit : int
        Number of the unit, from 1.
    """
    kind = {body.name: body.kind for body in vehicle.bodies}
    middles: dict[int, list[float]] = {}
    for wheelset in (one for one in vehicle.wheelsets if one.unit == unit):
        middles.setdefault(wheelset.bogie, []).append(vehicle.body(wheelset.body).position[0])
    middle = {bogie: float(np.mean(places)) for bogie, places in middles.items()}
    points: dict[tuple[str, int], list[tuple[float, ...]]] = {}
    for body_a, body_b, point in _coupled(vehicle, unit):
        if (kind[body_a] == CAR_BODY) == (kind[body_b] == CAR_BODY):
            continue
        body = body_a if kind[body_a] == CAR_BODY else body_b
        bogie = min(middle, key=lambda number: abs(middle[number] - point[0]))
        points.setdefault((body, bogie), []).append(point)
    return [
        Place(f"{body} over bogie {bogie}", body, np.mean(own, axis=0) - vehicle.body(body).position)
        for (body, bogie), own in sorted(points.items(), key=lambda item: item[0][1])
    ]


def bogie_places(vehicle: Vehicle, unit: int = 1) -> list[Place]:
    """Points of the side frames, or bogie frames, of a unit over their wheelsets.

    Arguments as in `body_places`.
    """
    kind = {body.name: body.kind for body in vehicle.bodies}
    points: dict[tuple[str, str], list[tuple[float, ...]]] = {}
    for body_a, body_b, point in _coupled(vehicle, unit):
        for body, wheelset in ((body_a, body_b), (body_b, body_a)):
            if kind[body] in FRAMES and kind[wheelset] == WHEELSET:
                points.setdefault((body, wheelset), []).append(point)
    return [
        Place(f"{body} over {wheelset}", body, np.mean(own, axis=0) - vehicle.body(body).position)
        for (body, wheelset), own in points.items()
    ]


def _coupled(vehicle: Vehicle, unit: int) -> Iterator[tuple[str, str, tuple[float, ...]]]:
    """Both bodies and the point of every coupling of a unit that acts at one point."""
    for coupling in vehicle.couplings:
        point = getattr(coupling, "point", None)  # a rod has two
        if point is not None and vehicle.unit_of(coupling.body_a) == unit:
            yield coupling.body_a, coupling.body_b, point


def point_accelerations(run: Run, places: list[Place]) -> PointAccelerations:
    """Accelerations of points of bodies of a run: derivatives of splines through the logged velocities.

    Parameters
    ----------
    run : Run
        The run on disk.
    places : list of Place
        Points of its bodies.

    Raises
    ------
    FileNotFoundError, ValueError
        The run has no motion log, fewer than 4 output times, or no such body.
    """
    table = run.read("motion", _COLUMNS)
    names = np.asarray(table["body"].to_pylist())
    rows = {name: np.asarray(table[name], dtype=np.float64) for name in _COLUMNS if name != "body"}
    time = np.unique(rows["time"])
    if time.size < 4:
        raise ValueError(
            f"{run.directory}: the motion log has {time.size} output times, at least 4 are needed"
        )
    shape = (time.size, len(places))
    s, felt_there = np.empty(shape), np.empty((3, *shape))
    for i, place in enumerate(places):
        own = {name: values[names == place.body] for name, values in rows.items()}
        if own["time"].size != time.size:
            raise ValueError(
                f"{run.directory}: body {place.body} is not at all {time.size} times of the motion log"
            )
        turned = Rotation.from_quat(np.column_stack([own[name] for name in ("qx", "qy", "qz", "qw")]))
        spin = np.column_stack([own[name] for name in ("wx", "wy", "wz")])
        velocity = np.column_stack([own[name] for name in ("vx", "vy", "vz")])
        velocity = velocity + turned.apply(np.cross(spin, place.offset))
        felt = CubicSpline(time, velocity).derivative()(time) + np.array([0.0, 0.0, GRAVITY])
        felt = turned.inv().apply(felt)
        s[:, i] = own["s"] + place.offset[0]
        felt_there[:, :, i] = felt.T - GRAVITY * np.array([[0.0], [0.0], [1.0]])
    return PointAccelerations(tuple(place.name for place in places), time, s, *felt_there)
