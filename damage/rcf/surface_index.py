"""Surface-initiated rolling contact fatigue: indices of a contact state, and of their course over time.

Ekberg, Kabo and Andersson (2002); Hossein-Nia (2018), equation 3.16 and figures 3-14 to 3-17. Both indices
measure how far the working point (Q/P, p0/k) lies beyond the surface branch p0/k = 1/(Q/P) of the shakedown
diagram of full slip: along the axis of Q/P, or by the shortest distance.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from damage.bounds import check_above_zero

FLANGE_CONTACT_ANGLE = math.radians(15.0)
"""Contact angle above which a contact counts as flange contact, flange root included [rad]. Treads stay
below 10 degrees; S1002 reaches 15 degrees 27 mm from the running circle, at the root of the flange. Flange
cracks hold no fluid and do not grow, so the flange is reported apart. The value is this project's choice."""

_BISECTIONS, _NEWTON_STEPS = 12, 5  # for the nearest point of the limit curve, to rounding


def surface_fatigue_index(
    force_x: ArrayLike,
    force_y: ArrayLike,
    normal_force: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    shear_yield: float,
) -> NDArray[np.float64]:
    """Surface fatigue index FI_surf [-]: horizontal distance of the working point to the surface limit.

    Above zero the working point lies beyond shakedown (ratchetting). A contact without normal force has
    index -infinity, the limit of the formula for a vanishing load.

    Parameters
    ----------
    force_x, force_y
        Creep forces [N].
    normal_force
        Normal force [N], >= 0.
    a, b
        Semi-axes of the patch [m].
    shear_yield
        Yield strength in pure shear k [Pa], > 0.

    Raises
    ------
    ValueError
        Values outside these ranges.
    """
    tangential, normal = _checked_load(force_x, force_y, normal_force, shear_yield)
    bearing = 2.0 / 3.0 * math.pi * np.asarray(a, dtype=np.float64) * np.asarray(b, dtype=np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        index = (tangential - bearing * shear_yield) / normal  # (3.16)
    return np.where(normal > 0.0, index, -np.inf)


def shortest_distance_index(
    force_x: ArrayLike,
    force_y: ArrayLike,
    normal_force: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    shear_yield: float,
) -> NDArray[np.float64]:
    """Fatigue index FI_ssurf [-]: shortest distance of the working point to the surface limit.

    Spangenberg, Froehling and Els (2016), Hossein-Nia (2018), section 3.1.4. The distance is that of plane
    geometry with Q/P as the horizontal and p0/k as the vertical coordinate, to the curve p0/k = 1/(Q/P),
    with the sign of `surface_fatigue_index` and never farther from zero. It avoids that index's weakness at
    high traction and low load, where k/p0, and so the horizontal distance, grows without bound. A contact
    without normal force has index -infinity.

    Parameters and errors are those of `surface_fatigue_index`; the semi-axes must be above zero where there
    is a normal force.
    """
    tangential, normal, area = np.broadcast_arrays(
        *_checked_load(force_x, force_y, normal_force, shear_yield),
        math.pi * np.asarray(a, dtype=np.float64) * np.asarray(b, dtype=np.float64),
    )
    loaded = normal > 0.0
    if not np.all(area[loaded] > 0.0):
        raise ValueError("semi-axes a and b must be > 0 m where normal_force is > 0 N")
    index = np.full(normal.shape, -np.inf)
    pressure = 1.5 * normal[loaded] / (area[loaded] * shear_yield)  # p0/k
    index[loaded] = _distance_beyond_hyperbola(tangential[loaded] / normal[loaded], pressure)
    return index


def _distance_beyond_hyperbola(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Shortest distance of (x, y), both >= 0, to the curve x y = 1; positive where x y > 1.

    The curve is its own mirror image in the line x = y, so the nearest point (t, 1/t) lies on the point's
    side of it: with x <= y, t is the only root in 0..1 of t^4 - x t^3 + y t - 1, where the line to it is
    normal to the curve. (Three roots below 1 would need a fourth above -1 by the missing t^2 and below -1 by
    the product of the four.) The function is -1 at t = 0 and y - x >= 0 at t = 1: it is bisected, and
    Newton's method finishes within the bracket. Where that is slow, near a centre of curvature, the distance
    does not depend on t.
    """
    near, far = np.minimum(x, y), np.maximum(x, y)
    low, high = np.zeros_like(near), np.ones_like(near)
    for _ in range(_BISECTIONS):
        t = 0.5 * (low + high)
        beyond = ((t - near) * t * t + far) * t > 1.0
        low, high = np.where(beyond, low, t), np.where(beyond, t, high)
    t = high
    for _ in range(_NEWTON_STEPS):
        slope = (4.0 * t - 3.0 * near) * t * t + far
        with np.errstate(divide="ignore", invalid="ignore"):
            step = (((t - near) * t * t + far) * t - 1.0) / slope
        t = np.clip(np.where(slope > 0.0, t - step, t), low, high)
    distance: NDArray[np.float64] = np.copysign(np.hypot(near - t, far - 1.0 / t), x * y - 1.0)
    return distance


def fatigue_area_index(index: ArrayLike, interval: ArrayLike, friction: ArrayLike) -> float:
    """Area below the positive fatigue index over time, over the largest possible one [-] (figure 3-14).

    Q/P cannot exceed the friction, and so neither can FI_surf. Figure 3-15 compares runs of different
    friction by the largest area at 0.75: give 0.75 for that. Of whole logs, per wheel, tread and flange:
    `WheelSurface.fatigue_area_index`.

    Parameters
    ----------
    index
        FI_surf over time [-]; -infinity for no contact.
    interval
        Time interval of each value [s], >= 0.
    friction
        Friction coefficient [-], >= 0.

    Returns
    -------
    float
        0..1; 0 where there is no time.

    Raises
    ------
    ValueError
        An index that is NaN, a negative interval or friction.
    """
    values, time, most = np.broadcast_arrays(
        *_checked_series(index, interval), _from_zero("friction", friction)
    )
    largest = float(np.sum(most * time))
    return float(np.sum(np.maximum(values, 0.0) * time)) / largest if largest > 0.0 else 0.0


def fatigue_probability(index: ArrayLike, interval: ArrayLike = 1.0) -> float:
    """Share of the working points with a fatigue index above zero [-] (figure 3-16).

    Parameters
    ----------
    index
        FI_surf or FI_ssurf of the working points [-].
    interval
        Weight of each, such as its time interval, >= 0; equal weights by default.

    Result and errors are those of `fatigue_area_index`.
    """
    values, time = np.broadcast_arrays(*_checked_series(index, interval))
    whole = float(np.sum(time))
    return float(np.sum(time[values > 0.0])) / whole if whole > 0.0 else 0.0


def _checked_load(
    force_x: ArrayLike, force_y: ArrayLike, normal_force: ArrayLike, shear_yield: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Creep force and normal force as arrays, once the normal force and the shear yield are in range."""
    check_above_zero("shear_yield", shear_yield, "Pa")
    normal = np.asarray(normal_force, dtype=np.float64)
    if not np.all(normal >= 0.0):  # also catches NaN
        raise ValueError(f"normal_force must be >= 0 N; {np.count_nonzero(~(normal >= 0.0))} values are not")
    return np.hypot(np.asarray(force_x, np.float64), np.asarray(force_y, np.float64)), normal


def _checked_series(index: ArrayLike, interval: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Index and interval as arrays, once they are in range."""
    values = np.asarray(index, dtype=np.float64)
    if np.any(np.isnan(values)):
        raise ValueError(f"index is NaN {np.count_nonzero(np.isnan(values))} times")
    return values, _from_zero("interval", interval)


def _from_zero(name: str, given: ArrayLike) -> NDArray[np.float64]:
    values = np.asarray(given, dtype=np.float64)
    if not np.all(values >= 0.0):
        raise ValueError(f"{name} must be >= 0; {np.count_nonzero(~(values >= 0.0))} values are not")
    return values
