"""Nonlinear force laws of the suspension: two-stage springs, stops, dry friction, wedges.

Kernels of plain numbers, shared by the multibody model and by tests; no bodies, no Exudyn.

Dry friction has memory: an elastic spring in series with a Coulomb slider, and a damper beside both. The
slider's position is that of the last accepted step; within a step it slips by the distance that brings the
spring's force back to the friction bound, and its new position is committed once the step is accepted. The
damper's force never stretches the spring: it is limited to the margin between spring force and bound. There
is no sign() of a velocity, and no creep at rest.

No path generates energy, with steps of any length. Let e be the spring's stretch, g = K e its force and
E = e.Ke/2 its energy at the end of a step, s the slip of the slider in the step, w = de + s = v dt the
displacement of the body and c D v the part of the damper's force that acts. With the forces at the end of the
step the work on the element is

    (g + c D v).w = g.de + g.s + c dt v.Dv >= E - E(before).

g.de is at least the rise of E, which is convex; g.s >= 0, since of each component of the trial stretch e + s
slip leaves a share from 0 to 1; and c >= 0. The bound does not appear: it may vary freely. (Return
mapping: J. J. Moreau's catching-up scheme, J. Differential Equations 26, 1977; J. C. Simo and
T. J. R. Hughes, Computational Inelasticity, 1998, chapters 1 and 3. The inequality is derived here.)

The two friction laws are inlined at their calls. Left to the compiler, whose choice changes with any line of
them, all couplings of the wagon take 2 to 3 times as long.
"""

import math

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.kernel import inlined_kernel, kernel

_NEWTON_STEPS = 30
_NEWTON_TOLERANCE = 1e-12  # of the friction bound
_NO_BOUND = 1e-100  # of the trial force; a bound below it counts as zero, lest Newton's method underflow


@kernel
def two_stage_spring(
    compression: float, first_stiffness: float, second_stiffness: float, second_from: float
) -> float:
    """Force [N] of a spring nest whose inner coils touch at the compression `second_from` [m].

    Up to there the outer coils carry alone with `first_stiffness` [N/m], beyond it the nest has
    `second_stiffness` [N/m]. The nest cannot pull.

    Parameters
    ----------
    compression : [m]
    first_stiffness, second_stiffness : of the outer coils, and of the nest with all coils in contact [N/m]
    second_from : compression at contact of the inner coils [m]
    """
    if compression <= 0.0:
        return 0.0
    if compression <= second_from:
        return first_stiffness * compression
    return first_stiffness * second_from + second_stiffness * (compression - second_from)


@kernel
def clearance_stop(displacement: float, clearance: float, stiffness: float) -> float:
    """Restoring force [N] of a two-sided stop: zero within +-`clearance` [m], linear beyond.

    Parameters
    ----------
    displacement : [m]
    clearance : to either side [m]
    stiffness : [N/m]
    """
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

    Before the first point the force is that of the first, beyond the last it is extrapolated.
    """
    if displacement <= table[0]:
        return table[1]
    k = 0
    while k < points - 2 and displacement > table[2 * k + 2]:
        k += 1
    start, end = table[2 * k], table[2 * k + 2]
    low, high = table[2 * k + 1], table[2 * k + 3]
    return low + (high - low) * (displacement - start) / (end - start)


@inlined_kernel
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
    """Two-dimensional Coulomb friction with an elastic spring before the slider and a damper beside both.

    Eleven arguments: plain numbers, since programs outside of the toolkit call it.

    Parameters
    ----------
    u, w : displacement of the sliding body [m] (or [rad] with a torque bound)
    slider_u, slider_w : committed slider position [m]
    rate_u, rate_w : velocity of the sliding body [m/s]
    stiffness_u, stiffness_w, damping_u, damping_w : of the sticking contact [N/m, N s/m]
    bound : friction coefficient times normal force [N]; below zero it counts as zero, infinite it sticks

    Returns
    -------
    (force_u, force_w, new_slider_u, new_slider_w) : force on the sliding body [N] and the slider position
    [m] to commit when the step is accepted.

    The force never exceeds the bound. While the spring's force alone is within it the slider rests,
    whatever the damper's force. Otherwise the slider slips in the direction of the remaining spring force:
    Coulomb's law, for any ratio of the stiffnesses, and the slip of largest loss (closest point to the trial
    force in the norm of the spring's energy). The damper then acts with the largest share of its force, 0 to
    1, that keeps the sum within the bound. No path gains energy from the element: see the head of this file.
    """
    bound = max(bound, 0.0)
    spring_u = stiffness_u * (u - slider_u)
    spring_w = stiffness_w * (w - slider_w)
    if spring_u * spring_u + spring_w * spring_w > bound * bound:
        left_u, left_w = _left_of_stretch(spring_u, spring_w, stiffness_u, stiffness_w, bound)
        spring_u *= left_u
        spring_w *= left_w
        slider_u = u - left_u * (u - slider_u)
        slider_w = w - left_w * (w - slider_w)
    damper_u = damping_u * rate_u
    damper_w = damping_w * rate_w
    whole_u, whole_w = spring_u + damper_u, spring_w + damper_w
    if whole_u * whole_u + whole_w * whole_w > bound * bound:
        share = _damper_share(spring_u, spring_w, damper_u, damper_w, bound, 0.0)
        damper_u *= share
        damper_w *= share
    return -spring_u - damper_u, -spring_w - damper_w, slider_u, slider_w


@kernel
def _left_of_stretch(
    spring_u: float, spring_w: float, stiffness_u: float, stiffness_w: float, bound: float
) -> tuple[float, float]:
    """Shares 0..1 of the stretch in u and w that remain after slip, where the spring's force exceeds the
    bound.

    With a slip of a times the remaining force, that force is spring / (1 + a stiffness), and a follows from
    its magnitude, the bound. Newton's method for 1 / magnitude comes up to a from below in a handful of steps
    (A. R. Conn, N. I. M. Gould and P. L. Toint, Trust-Region Methods, 2000, 7.3); with a single stiffness the
    share is bound / magnitude.
    """
    magnitude = math.hypot(spring_u, spring_w)
    if stiffness_u == stiffness_w or not bound > _NO_BOUND * magnitude:
        return bound / magnitude, bound / magnitude
    slip = 0.0  # over force [m/N]
    left_u, left_w = 1.0, 1.0
    for _ in range(_NEWTON_STEPS):
        part_u, part_w = left_u * spring_u / magnitude, left_w * spring_w / magnitude
        fall = stiffness_u * left_u * part_u * part_u + stiffness_w * left_w * part_w * part_w
        slip += (magnitude / bound - 1.0) / fall
        left_u = 1.0 / (1.0 + slip * stiffness_u)
        left_w = 1.0 / (1.0 + slip * stiffness_w)
        magnitude = math.hypot(left_u * spring_u, left_w * spring_w)
        if not magnitude > bound * (1.0 + _NEWTON_TOLERANCE):
            break
    rest = min(bound / magnitude, 1.0)  # exactly onto the bound, with a loss like all shares
    return left_u * rest, left_w * rest


@kernel
def _damper_share(
    spring_u: float, spring_w: float, damper_u: float, damper_w: float, bound: float, growth: float
) -> float:
    """Largest share 0..1 of the damper's force that keeps the sum with the spring's within its bound.

    The larger root of |spring + share damper| = bound + share growth damper_u.

    Parameters
    ----------
    spring_u, spring_w : force of the spring, within the bound [N]
    damper_u, damper_w : the whole force of the damper, with which the sum exceeds the bound [N]
    bound : [N], at the spring's force alone
    growth : of the bound per force of the damper in u, -1 < growth < 1
    """
    square = damper_u * damper_u * (1.0 - growth * growth) + damper_w * damper_w
    half = spring_u * damper_u + spring_w * damper_w - bound * growth * damper_u
    room = max(bound * bound - spring_u * spring_u - spring_w * spring_w, 0.0)
    root = math.sqrt(half * half + square * room)
    if half > 0.0:
        return min(room / (half + root), 1.0)
    return min((root - half) / square, 1.0) if square > 0.0 else 0.0


@inlined_kernel
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
    when it comes up. `tan_slope` must exceed `friction`, else the wedge jams, which
    `vehicles.couplings.Wedge` refuses. Eleven arguments: those of `dry_friction` and the wedge's own.

    Spring, slider and damper of the sticking face are those of `dry_friction`, with this cone for the bound:
    slip returns to it in the direction of the friction, as Coulomb's law demands, and the damper acts within
    the remaining margin. For any course of the control spring's force the face returns no more energy than
    it stored.

    Parameters
    ----------
    compression, lateral : of the control spring, and displacement across the column [m]
    slider_compression, slider_lateral : committed slider position [m]
    compression_rate, lateral_rate : [m/s]
    spring_stiffness : of the control spring [N/m]
    tan_slope : tan(a) of the slope against the column [-], > `friction`
    friction : coefficient mu of the column [-]
    stick_stiffness, stick_damping : of the sticking face [N/m, N s/m]

    Returns
    -------
    (column, along, lateral_force, new_slider_compression, new_slider_lateral) : normal force N2 of the
    column, friction T_v along it and across it [N]; the first two act on the wedge (away from the column and
    upwards), lateral_force on wedge and bolster.
    """
    spring = spring_stiffness * compression
    if spring <= 0.0:
        return 0.0, 0.0, 0.0, compression, lateral
    up = stick_stiffness * (compression - slider_compression)
    side = -stick_stiffness * (lateral - slider_lateral)
    held = math.hypot(up, side)
    if held * tan_slope > friction * (spring + up):
        left = friction * spring / (held * tan_slope - friction * up)
        up *= left
        side *= left
        slider_compression = compression - left * (compression - slider_compression)
        slider_lateral = lateral - left * (lateral - slider_lateral)
    damper_up = stick_damping * compression_rate
    damper_side = -stick_damping * lateral_rate
    if math.hypot(up + damper_up, side + damper_side) * tan_slope > friction * (spring + up + damper_up):
        cone = friction / tan_slope
        share = _damper_share(up, side, damper_up, damper_side, cone * (spring + up), cone)
        damper_up *= share
        damper_side *= share
    up += damper_up
    return (spring + up) / tan_slope, up, side + damper_side, slider_compression, slider_lateral
