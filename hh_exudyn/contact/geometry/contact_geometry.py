"""Rigid contact of wheels on rails over the lateral displacement: the contact geometry functions.

The wheels neither sink into the rails nor lift off. For a wheel these are the functions that GENSYS's KPF
tabulates (contact positions on wheel and rail, rolling radius, contact angle, wheel lift, lateral
curvatures); for a wheelset also the roll at which both wheels touch.

The displacement is that of the wheelset to the left, y of the track frame.
"""

from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.rigid import (
    COLUMNS,
    CONTACT_ANGLE,
    LIFT,
    RADIUS,
    RAIL_CURVATURE,
    WHEEL_CURVATURE,
    Y_RAIL,
    Y_WHEEL,
    StandingWheel,
    wheel_contacts,
    wheelset_rolls,
)
from hh_exudyn.contact.profile import Profile, gauge_point
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.contact.types import SplineTable
from hh_exudyn.conventions import (
    BACK_TO_BACK,
    FLANGE_BACK_TO_RUNNING_CIRCLE,
    LEFT,
    NOMINAL_GAUGE,
    RIGHT,
)

TAPE_DISTANCE = BACK_TO_BACK + 2.0 * FLANGE_BACK_TO_RUNNING_CIRCLE  # m, nominal
SMOOTHING = 0.5e-3  # m, of the profiles' curvature: as in a run (`wheel_rail.wheel_rail_model`)
MAX_LATERAL = 0.03  # m

_STEP = 0.1e-3  # m, nodes of the tables that are searched
_MAX_ROLL = 0.1  # rad


@dataclass(frozen=True)
class ContactFunctions:
    """How one wheel touches its rail, over the lateral displacement of the wheelset; all arrays (n,).

    NaN where the wheel has no contact inside the profiles.

    Attributes
    ----------
    side : int
        `LEFT` or `RIGHT`.
    lateral : FloatArray
        Displacement of the wheelset to the left [m].
    y_wheel, y_rail : FloatArray
        Contact position on the wheel and on the rail profile, side coordinates [m].
    rolling_radius : FloatArray
        [m].
    contact_angle : FloatArray
        Positive towards the flange [rad].
    wheel_lift : FloatArray
        Height of the wheelset's centre over the rail top that this wheel asks for, less its nominal radius
        [m].
    wheel_curvature, rail_curvature : FloatArray
        Lateral, in the normal section, convex positive [1/m].
    """

    side: int
    lateral: FloatArray
    y_wheel: FloatArray
    y_rail: FloatArray
    rolling_radius: FloatArray
    contact_angle: FloatArray
    wheel_lift: FloatArray
    wheel_curvature: FloatArray
    rail_curvature: FloatArray

    @property
    def lateral_curvature(self) -> FloatArray:
        """Sum of the lateral curvatures of wheel and rail [1/m]; small where the contact is conformal."""
        return self.wheel_curvature + self.rail_curvature


@dataclass(frozen=True)
class WheelsetFunctions:
    """How a wheelset stands on two rails, over its lateral displacement; all arrays (n,).

    Attributes
    ----------
    lateral : FloatArray
        Displacement of the wheelset to the left [m].
    roll : FloatArray
        About the track's x axis, positive where the left wheel is higher [rad].
    left, right : ContactFunctions
        Of the two wheels. Their lifts agree (but for different nominal radii) where the roll was solved.
    """

    lateral: FloatArray
    roll: FloatArray
    left: ContactFunctions
    right: ContactFunctions

    @property
    def radius_difference(self) -> FloatArray:
        """Rolling radius difference left - right [m]: positive at positive `lateral` steers back."""
        return self.left.rolling_radius - self.right.rolling_radius

    @property
    def contact_angle_difference(self) -> FloatArray:
        """Tangent of the contact angle, left - right [-] (EN 15302's delta tan gamma function)."""
        return np.tan(self.left.contact_angle) - np.tan(self.right.contact_angle)


def contact_functions(
    wheel: Profile,
    rail: Profile,
    *,
    lateral: FloatArray,
    radius: float,
    side: int = LEFT,
    gauge: float = NOMINAL_GAUGE,
    tape_distance: float = TAPE_DISTANCE,
    roll: FloatArray | float = 0.0,
    smoothing: float = SMOOTHING,
) -> ContactFunctions:
    """Contact geometry functions of one wheel on its rail, the roll of the wheelset given.

    Nine arguments: two profiles, and by keyword the lengths and angles that callers vary one by one.

    Parameters
    ----------
    wheel, rail : Profile
        The rail includes its inclination.
    lateral : FloatArray
        (n,) displacements of the wheelset to the left [m], -30 .. 30 mm.
    radius : float
        Wheel radius at the running circle [m], 0.1 .. 2.
    side : int
        `LEFT` or `RIGHT`.
    gauge : float
        Track gauge, 14 mm below the rail top [m], 0.3 .. 3.
    tape_distance : float
        Lateral distance of the two running circles [m], 0.3 .. 3.
    roll : FloatArray or float
        (n,) or one for all [rad], -0.1 .. 0.1.
    smoothing : float
        Length over which the profiles' curvature is blurred (`spline.spline_table`) [m].

    Raises
    ------
    ValueError
        A profile of the wrong kind or a number out of its range.
    """
    displacements = _displacements(lateral)
    if side not in (LEFT, RIGHT):
        raise ValueError(f"side = {side}, allowed {LEFT} (left) and {RIGHT} (right)")
    _check_lengths(gauge, tape_distance, radius)
    standing = StandingWheel(
        *_tables(wheel, rail, smoothing),
        side=float(side),
        distance=0.5 * tape_distance,
        radius=radius,
        rail_y=side * (0.5 * gauge + gauge_point(rail)),
    )
    return _one_side(standing, displacements, _rolls(roll, displacements))


def wheelset_functions(
    wheel_left: Profile,
    rail_left: Profile,
    wheel_right: Profile,
    rail_right: Profile,
    *,
    lateral: FloatArray,
    radius_left: float,
    radius_right: float,
    gauge: float = NOMINAL_GAUGE,
    tape_distance: float = TAPE_DISTANCE,
    roll: FloatArray | float | None = None,
    smoothing: float = SMOOTHING,
) -> WheelsetFunctions:
    """Contact geometry functions of a wheelset.

    Eleven arguments: four profiles, and by keyword the lengths and angles that callers vary one by one.

    Parameters
    ----------
    wheel_left, rail_left, wheel_right, rail_right : Profile
        The rails include their inclination.
    lateral : FloatArray
        (n,) displacements of the wheelset to the left [m], -30 .. 30 mm.
    radius_left, radius_right : float
        Wheel radii at the running circles [m], 0.1 .. 2.
    gauge : float
        Track gauge, 14 mm below the rail tops [m], 0.3 .. 3.
    tape_distance : float
        Lateral distance of the two running circles [m], 0.3 .. 3.
    roll : FloatArray, float or None
        None: the roll at which both wheels touch. Otherwise given, (n,) or one for all [rad], -0.1 .. 0.1.
    smoothing : float
        As for `contact_functions`, and so are the errors.
    """
    displacements = _displacements(lateral)
    _check_lengths(gauge, tape_distance, radius_left, radius_right)
    half = 0.5 * tape_distance
    left = StandingWheel(
        *_tables(wheel_left, rail_left, smoothing),
        side=1.0,
        distance=half,
        radius=radius_left,
        rail_y=0.5 * gauge + gauge_point(rail_left),
    )
    right = StandingWheel(
        *_tables(wheel_right, rail_right, smoothing),
        side=-1.0,
        distance=half,
        radius=radius_right,
        rail_y=-0.5 * gauge - gauge_point(rail_right),
    )
    if roll is None:
        rolls = np.empty(len(displacements))
        wheelset_rolls(left, right, displacements, rolls)
    else:
        rolls = _rolls(roll, displacements)
    return WheelsetFunctions(
        lateral=displacements,
        roll=rolls,
        left=_one_side(left, displacements, rolls),
        right=_one_side(right, displacements, rolls),
    )


def _one_side(standing: StandingWheel, lateral: FloatArray, rolls: FloatArray) -> ContactFunctions:
    rows = np.empty((len(lateral), COLUMNS))
    wheel_contacts(standing, lateral, rolls, rows)
    return ContactFunctions(
        side=int(standing.side),
        lateral=lateral,
        y_wheel=rows[:, Y_WHEEL],
        y_rail=rows[:, Y_RAIL],
        rolling_radius=rows[:, RADIUS],
        contact_angle=rows[:, CONTACT_ANGLE],
        wheel_lift=rows[:, LIFT],
        wheel_curvature=rows[:, WHEEL_CURVATURE],
        rail_curvature=rows[:, RAIL_CURVATURE],
    )


def _tables(wheel: Profile, rail: Profile, smoothing: float) -> tuple[SplineTable, SplineTable]:
    """Both profiles as fine tables."""
    for profile, kind in ((wheel, "wheel"), (rail, "rail")):
        if profile.kind != kind:
            raise ValueError(f"profile {profile.name!r} is of kind {profile.kind!r}, needed: {kind!r}")
    return spline_table(wheel, _STEP, smoothing), spline_table(rail, _STEP, smoothing)


def _displacements(lateral: FloatArray) -> FloatArray:
    values = np.ascontiguousarray(np.atleast_1d(lateral), dtype=np.float64)
    if values.ndim != 1 or not (np.abs(values) <= MAX_LATERAL).all():
        raise ValueError(f"lateral: (n,) finite numbers within +-{MAX_LATERAL} m needed")
    return values


def _rolls(roll: FloatArray | float, lateral: FloatArray) -> FloatArray:
    rolls = np.asarray(roll, dtype=np.float64)
    if rolls.ndim > 0 and rolls.shape != lateral.shape:
        raise ValueError(f"roll: shape {rolls.shape}, needed {lateral.shape} as lateral, or one number")
    if not (np.abs(rolls) <= _MAX_ROLL).all():
        raise ValueError(f"roll: allowed -{_MAX_ROLL} .. {_MAX_ROLL} rad")
    return np.ascontiguousarray(np.broadcast_to(rolls, lateral.shape))


def _check_lengths(gauge: float, tape_distance: float, *radii: float) -> None:
    for name, value, low, high in (
        ("gauge", gauge, 0.3, 3.0),
        ("tape_distance", tape_distance, 0.3, 3.0),
        *(("radius", radius, 0.1, 2.0) for radius in radii),
    ):
        if not low <= value <= high:
            raise ValueError(f"{name} = {value} m, allowed {low} .. {high} m")
