"""Normal equilibrium of a wheel or a wheelset on its rails: the height (and roll) under given loads.

The pose of the wheelset is given except for its height (and, for `wheelset_equilibrium`, its roll); it rolls
steadily, and contact and creep forces are included. This is the task of the Manchester contact benchmark
(P. Shackleton, S. Iwnicki, Comparison of wheel-rail contact codes for railway vehicle simulation, Vehicle
System Dynamics 46 (2008) 129-149), whose case A-2.2 prescribes roll and pitch rate and solves each wheel's
height alone.

Frame and signs are those of `hh_exudyn.conventions`: x forward, y to the left, z up; roll, pitch and yaw are
right-hand rotations about them.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.contact.geometry.rail_tables import gauge_point_at
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.state import PATCH_COLUMNS, ContactState, Patch, contact_state
from hh_exudyn.contact.strips.table import CAPACITY
from hh_exudyn.contact.types import (
    MAX_PATCHES,
    ContactForces,
    RailMotion,
    RailTables,
    WheelRailModel,
    WheelsetMotion,
)
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model
from hh_exudyn.conventions import BACK_TO_BACK, LEFT, NOMINAL_GAUGE, RIGHT

_ABOVE, _BELOW = 0.035, 0.025  # m, range of the search above and below the height on cones
_STEP = 0.2e-3  # m, of the search downwards: the load is met within the first step that has contact
_HEIGHT_TOLERANCE = 1e-12  # m
_LARGEST_ROLL = 0.08  # rad, of an equilibrium
_ROLL_TOLERANCE = 1e-13  # rad
_RAIL_REMOVED = -1.0  # m, height of the other rail while one wheel is solved


@dataclass(frozen=True)
class WheelOnRail:
    """A wheel that carries its load.

    Attributes
    ----------
    height : float
        Of the wheelset's centre above the running plane [m].
    contacts : tuple of ContactState
        Its patches, deepest first.
    """

    height: float
    contacts: tuple[ContactState, ...]


@dataclass(frozen=True)
class WheelsetOnRails:
    """A wheelset that carries its loads.

    Attributes
    ----------
    height, roll : float
        Of its centre above the running plane [m]; right-hand about x [rad].
    left, right : WheelOnRail
        The wheels, at the same height.
    """

    height: float
    roll: float
    left: WheelOnRail
    right: WheelOnRail


@dataclass(frozen=True)
class _Pose:
    """The given part of a wheelset's pose and motion, checked."""

    lateral: float
    yaw: float
    gauge: float
    speed: float
    pitch_rate: float
    friction: float


def wheel_on_rail(
    wheel: Profile,
    rail: Profile,
    side: int,
    *,
    lateral: float,
    yaw: float,
    roll: float,
    load: float,
    gauge: float = NOMINAL_GAUGE,
    radius: float,
    back_to_back: float = BACK_TO_BACK,
    speed: float,
    pitch_rate: float,
    friction: float,
    normal: str = "hertz",
    theory: str = "fastrip",
    material: Material = STEEL,
    cells: tuple[int, int] = (30, 30),
) -> WheelOnRail:
    """The height at which one wheel, in a given pose of its wheelset, carries a vertical load.

    Seventeen arguments: the inputs of the Manchester benchmark one by one, by keyword.

    Parameters
    ----------
    wheel, rail : Profile
        The rail includes its inclination.
    side : int
        `LEFT` or `RIGHT`; only this wheel counts.
    lateral : float
        Displacement of the wheelset's centre, positive to the left [m], -0.1 .. 0.1.
    yaw, roll : float
        Right-hand rotations about z and x [rad], -0.1 .. 0.1.
    load : float
        Vertical force of the wheel on the rail, creep forces included [N], 1 .. 1e6.
    gauge : float
        14 mm below the running plane [m], 0.5 .. 2.
    radius : float
        At the running circle [m], 0.2 .. 1.
    back_to_back : float
        Distance of the flange backs [m], 0.5 .. 2.
    speed : float
        Forward [m/s], 0.1 .. 200.
    pitch_rate : float
        Angular velocity about the axle, positive for rolling forward [rad/s], -1000 .. 1000.
    friction : float
        [-], 0 .. 1.
    normal, theory : str
        Names of `normal.registry.NORMAL_THEORIES` and `tangential.THEORIES`.
    material : Material
        Of wheel and rail.
    cells : tuple of int
        Of the patch, along and across [-], 3 .. 200 each.

    Returns
    -------
    WheelOnRail

    Raises
    ------
    ValueError
        A number out of its range, an unknown name, or a load that no height carries: the wheel is not
        above its rail, or friction on a steep flange carries the load.
    """
    if side not in (LEFT, RIGHT):
        raise ValueError(f"side = {side}, allowed {LEFT} (left) or {RIGHT} (right)")
    pose = _checked_pose(lateral, yaw, gauge, speed, pitch_rate, friction)
    _check("roll", roll, -0.1, 0.1, "rad")
    _check("load", load, 1.0, 1e6, "N")
    model = wheel_rail_model(
        wheel, wheel, rail, rail,
        nominal_radius=radius, back_to_back=back_to_back,
        material=material, normal=normal, theory=theory, cells=cells,
    )  # fmt: skip
    return _wheel_at_rest(model, side, pose, float(roll), float(load))


def wheelset_equilibrium(
    wheel_left: Profile,
    rail_left: Profile,
    wheel_right: Profile,
    rail_right: Profile,
    *,
    lateral: float,
    yaw: float,
    load: float | Sequence[float],
    gauge: float = NOMINAL_GAUGE,
    radius: float,
    back_to_back: float = BACK_TO_BACK,
    speed: float,
    pitch_rate: float,
    friction: float,
    normal: str = "hertz",
    theory: str = "fastrip",
    material: Material = STEEL,
    cells: tuple[int, int] = (30, 30),
) -> WheelsetOnRails:
    """The height and the roll at which both wheels of a wheelset carry their loads.

    Seventeen arguments: those of `wheel_on_rail` but for side and roll, and the profiles of two wheels.

    Parameters
    ----------
    wheel_left, rail_left, wheel_right, rail_right : Profile
        The rails include their inclination.
    load : float or sequence of float
        Axle load, of which each wheel carries half, or the vertical forces of the left and right wheel on
        their rails [N], 1 .. 1e6 each.
    lateral, yaw, gauge, radius, back_to_back, speed, pitch_rate, friction, normal, theory, material, cells
        As `wheel_on_rail`.

    Returns
    -------
    WheelsetOnRails

    Raises
    ------
    ValueError
        As `wheel_on_rail`; also where no roll within 80 mrad brings both wheels to the same height.
    """
    pose = _checked_pose(lateral, yaw, gauge, speed, pitch_rate, friction)
    given = np.asarray(load, dtype=np.float64)
    if given.shape not in ((), (2,)):
        raise ValueError(f"load = {load} N, allowed one number or two, of the left and the right wheel")
    loads = [float(given[0]), float(given[1])] if given.ndim else [0.5 * float(given)] * 2
    for name, value in zip(("load of the left wheel", "load of the right wheel"), loads, strict=True):
        _check(name, value, 1.0, 1e6, "N")
    model = wheel_rail_model(
        wheel_left, wheel_right, rail_left, rail_right,
        nominal_radius=radius, back_to_back=back_to_back,
        material=material, normal=normal, theory=theory, cells=cells,
    )  # fmt: skip

    def wheels(roll: float) -> tuple[WheelOnRail, WheelOnRail]:
        return (
            _wheel_at_rest(model, LEFT, pose, roll, loads[0]),
            _wheel_at_rest(model, RIGHT, pose, roll, loads[1]),
        )

    def difference(roll: float) -> float:
        left, right = wheels(roll)
        return left.height - right.height

    roll = _roll_of_zero(difference, model.running_circle_distance)
    left, right = wheels(roll)
    return WheelsetOnRails(0.5 * (left.height + right.height), roll, left, right)


def _roll_of_zero(difference: Callable[[float], float], half_distance: float) -> float:
    """The roll at which the two wheels carry their loads at equal heights.

    A wheelset that rolls to the right (positive) lifts its left wheel, so the left height falls.
    """
    low = high = 0.0
    value = difference(0.0)
    reach = 1e-4
    while value != 0.0:
        other = math.copysign(1.0, value) * (abs(value) / half_distance + reach)
        if abs(other) > _LARGEST_ROLL:
            raise ValueError(
                f"no roll between -{_LARGEST_ROLL} and {_LARGEST_ROLL} rad brings both wheels to their rails"
            )
        if difference(other) * value <= 0.0:
            low, high = min(0.0, other), max(0.0, other)
            break
        reach += abs(other)
    if low == high:
        return 0.0
    return float(brentq(difference, low, high, xtol=_ROLL_TOLERANCE, rtol=1e-14))


def _wheel_at_rest(model: WheelRailModel, side: int, pose: _Pose, roll: float, load: float) -> WheelOnRail:
    """Search downwards until the wheel carries more than the load, then solve for the height of equality."""

    def excess(height: float) -> float:
        return _solve(model, side, pose, roll, height)[0] - load

    lever = side * model.running_circle_distance * math.sin(roll)
    middle = model.nominal_radius - lever
    high = middle + _ABOVE
    above = excess(high)
    while high > middle - _BELOW:
        low = high - _STEP
        below = excess(low)
        if below >= 0.0 > above:
            height = float(brentq(excess, low, high, xtol=_HEIGHT_TOLERANCE, rtol=1e-14))
            return WheelOnRail(height, _solve(model, side, pose, roll, height)[1])
        high, above = low, below
    raise ValueError(
        f"load = {load:g} N: no height between {middle - _BELOW:.4f} and {middle + _ABOVE:.4f} m carries it "
        f"(wheelset {pose.lateral * 1e3:g} mm to the left, side {side:+d}, gauge {pose.gauge * 1e3:g} mm)"
    )


def _solve(
    model: WheelRailModel, side: int, pose: _Pose, roll: float, height: float
) -> tuple[float, tuple[ContactState, ...]]:
    """Vertical force of one wheel on its rail [N], and its patches; the other rail is removed."""
    index = 0 if side == LEFT else 1
    axle = np.array(
        [[-math.sin(pose.yaw) * math.cos(roll), math.cos(pose.yaw) * math.cos(roll), math.sin(roll)]]
    )
    still = np.zeros((1, 2, 2))
    positions = np.zeros((1, 2, 2))
    positions[0, index, 0] = side * (0.5 * pose.gauge + gauge_point_at(_rails(model, side), 0.0))
    positions[0, 1 - index, 1] = _RAIL_REMOVED
    wheelset = WheelsetMotion(
        position=np.array([[0.0, pose.lateral, height]]),
        axle=axle,
        velocity=np.array([[pose.speed, 0.0, 0.0]]),
        angular_velocity=pose.pitch_rate * axle,
        creep_lag=still,
    )
    rails = RailMotion(
        arc_length=np.zeros(1),
        position=positions,
        rotation=np.tile(np.eye(3), (1, 2, 1, 1)),
        turn=np.zeros((1, 3)),
        velocity=still,
    )
    forces = ContactForces(
        wrench=np.zeros((1, 6)),
        rail_force=np.zeros((1, 2, 2)),
        patches=np.zeros((1, 2, MAX_PATCHES, PATCH_COLUMNS)),
        in_contact=np.zeros((1, 2, CAPACITY)),
        refine=np.ones(1),
    )
    friction = constant_friction([[pose.friction, pose.friction]])
    status = wheel_rail_forces(model, wheelset, rails, friction, forces)
    if status != 0:
        raise ValueError(f"the contact at height {height:.6f} m has no finite solution")
    load = forces.rail_force[0, index]
    vertical, outwards = float(-load[1]), float(side * load[0])
    states = tuple(
        contact_state(
            row,
            side=side,
            speed=pose.speed,
            Q=vertical,
            Y=outwards,
            angle_of_attack=pose.yaw,
            y_wheelset=pose.lateral,
            roll=roll,
            s=0.0,
        )
        for row in forces.patches[0, index]
        if row[Patch.NORMAL_FORCE] > 0.0
    )
    return vertical, states


def _rails(model: WheelRailModel, side: int) -> RailTables:
    return model.rails_left if side == LEFT else model.rails_right


def _checked_pose(
    lateral: float, yaw: float, gauge: float, speed: float, pitch_rate: float, friction: float
) -> _Pose:
    """The given part of a pose; ValueError for a number out of its range."""
    _check("lateral", lateral, -0.1, 0.1, "m")
    _check("yaw", yaw, -0.1, 0.1, "rad")
    _check("gauge", gauge, 0.5, 2.0, "m")
    _check("speed", speed, 0.1, 200.0, "m/s")
    _check("pitch_rate", pitch_rate, -1000.0, 1000.0, "rad/s")
    _check("friction", friction, 0.0, 1.0, "-")
    return _Pose(*(float(value) for value in (lateral, yaw, gauge, speed, pitch_rate, friction)))


def _check(name: str, value: float, low: float, high: float, unit: str) -> None:
    """Raise ValueError where a number is not in low .. high, or NaN."""
    if not low <= value <= high:
        raise ValueError(f"{name} = {value} {unit}, allowed {low:g} .. {high:g} {unit}")
