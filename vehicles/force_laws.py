"""Force laws of the suspension that are not linear: two-stage springs, stops, dry friction, wedges.

Kernels of plain numbers, shared by the multibody model and by tests; no bodies, no Exudyn.

Dry friction has memory: an elastic spring in series with a Coulomb slider. The slider's position is that of
the last accepted step; within a step the force is return-mapped onto the friction bound, and the position
it implies is committed once the step is accepted. There is no sign() of a velocity, and no creep at rest.
"""

import math

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.kernel import kernel


@kernel
def two_stage_spring(
    compression: float, first_stiffness: float, second_stiffness: float, second_from: float
) -> float:
    """Force [N] of a spring nest whose inner coils touch at the compression `second_from` [m].

    Up to there the outer coils carry alone with `first_stiffness` [N/m], beyond it the nest has
    `second_stiffness` [N/m]. The nest cannot pull.
    """
    if compression <= 0.0:
        return 0.0
    if compression <= second_from:
        return first_stiffness * compression
    return first_stiffness * second_from + second_stiffness * (compression - second_from)


@kernel
def clearance_stop(displacement: float, clearance: float, stiffness: float) -> float:
    """Restoring force [N] of a two-sided stop: zero within +-`clearance` [m], linear beyond."""
    if displacement > clearance:
        return -stiffness * (displacement - clearance)
    if displacement < -clearance:
        return -stiffness * (displacement + clearance)
    return 0.0


@kernel
def tabulated_stop(displacement: float, table: NDArray[np.float64], points: int) -> float:
    """Force [N] against a displacement [m] from a table, linear between its points.

    Parameters
    ----------
    displacement : into the stop [m]
    table : (2 or more x points,) displacement [m], force [N], displacement, force, ...; displacements rise
    points : number of points, 2 or more

    Before the first point the force is that of the first, beyond the last it goes on as between the last two.
    """
    if displacement <= table[0]:
        return table[1]
    k = 0
    while k < points - 2 and displacement > table[2 * k + 2]:
        k += 1
    start, end = table[2 * k], table[2 * k + 2]
    low, high = table[2 * k + 1], table[2 * k + 3]
    return low + (high - low) * (displacement - start) / (end - start)


@kernel
def dry_friction(
    u: float,
    w: float,
    slider_u: float,
    slider_w: float,
    rate_u: float,
    rate_w: float,
    stiffness_u: float,
    stiffness_w: float,
    damping_u: float,
    damping_w: float,
    bound: float,
) -> tuple[float, float, float, float]:
    """Two-dimensional Coulomb friction with an elastic spring before the slider.

    Parameters
    ----------
    u, w : displacement of the sliding body [m] (or [rad] with a torque bound)
    slider_u, slider_w : committed slider position [m]
    rate_u, rate_w : velocity of the sliding body [m/s]
    stiffness_u, stiffness_w, damping_u, damping_w : of the sticking contact [N/m, N s/m]
    bound : friction coefficient times normal force [N]

    Returns
    -------
    (force_u, force_w, new_slider_u, new_slider_w) : force on the sliding body [N] and the slider position
    [m] to commit when the step is accepted. The force never exceeds the bound.
    """
    force_u = -stiffness_u * (u - slider_u) - damping_u * rate_u
    force_w = -stiffness_w * (w - slider_w) - damping_w * rate_w
    magnitude = math.hypot(force_u, force_w)
    if magnitude <= bound:
        return force_u, force_w, slider_u, slider_w
    scale = max(bound, 0.0) / magnitude
    force_u *= scale
    force_w *= scale
    return force_u, force_w, u + force_u / stiffness_u, w + force_w / stiffness_w


@kernel
def wedge(
    compression: float,
    lateral: float,
    slider_compression: float,
    slider_lateral: float,
    compression_rate: float,
    lateral_rate: float,
    spring_stiffness: float,
    tan_slope: float,
    friction: float,
    stick_stiffness: float,
    stick_damping: float,
) -> tuple[float, float, float, float, float]:
    """Massless load-sensitive friction wedge between the bolster's slope and the side frame's column.

    The wedge stands on its control spring, which stands on the side frame: it goes down with the bolster
    by `compression` [m], slides on the column along its face by the same amount and laterally by `lateral`.
    With the spring force Fs, the column's friction T on the wedge (T_v upwards) and a slope at the angle a
    from the column (friction of the slope within `tan_slope`), its equilibrium gives the column force

        N2 = (Fs + T_v) / tan(a),        |T| <= mu N2,

    so that in sliding |T| = mu Fs / (tan(a) - mu T_v/|T|): more when the bolster goes down (T_v > 0) than
    when it comes up. `tan_slope` must exceed `friction`, else the wedge jams (`description.Wedge` checks).

    Returns
    -------
    (column, along, lateral_force, new_slider_compression, new_slider_lateral) : normal force N2 of the
    column, friction T_v along it and across it [N]; the first two act on the wedge (away from the column and
    upwards), lateral_force on wedge and bolster.
    """
    spring = spring_stiffness * compression
    if spring <= 0.0:
        return 0.0, 0.0, 0.0, compression, lateral
    up = stick_stiffness * (compression - slider_compression) + stick_damping * compression_rate
    side = -stick_stiffness * (lateral - slider_lateral) - stick_damping * lateral_rate
    magnitude = math.hypot(up, side)
    if magnitude * tan_slope <= friction * (spring + up):
        return (spring + up) / tan_slope, up, side, slider_compression, slider_lateral
    scale = friction * spring / (tan_slope - friction * up / magnitude) / magnitude
    up *= scale
    side *= scale
    column = (spring + up) / tan_slope
    return column, up, side, compression - up / stick_stiffness, lateral + side / stick_stiffness
