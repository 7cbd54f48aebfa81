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
from typing import NamedTuple

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


class FacesInYaw(NamedTuple):
    """Two flat faces that stick on each other."""

    stiffness: float  # in shear [N/m]
    yaw_stiffness: float  # [N m/rad]
    damping: float  # in shear [N s/m]
    yaw_damping: float  # [N m s/rad]


@inlined_kernel
def shear_and_yaw_friction(
    way: tuple[float, float, float],
    slider: tuple[float, float, float],
    rate: tuple[float, float, float],
    faces: FacesInYaw,
    bound: float,
    arm: float,
) -> tuple[float, float, float, tuple[float, float, float]]:
    """Dry friction of a face that shears and yaws, as `dry_friction`: one bound for force and torque / arm.

    Returns the forces in x and y [N] and the torque [N m] on the sliding body, and the sliders to commit.

    Parameters
    ----------
    way : displacement in x and y [m], yaw [rad]
    slider : committed, of the same [m, m, rad]
    rate : of `way`
    faces : stiffness and damping while they stick
    bound : friction coefficient times normal force [N]; infinite it sticks
    arm : of the friction torque, > 0: torque over force when either acts alone [m]
    """
    x, y = faces.stiffness * (way[0] - slider[0]), faces.stiffness * (way[1] - slider[1])
    turn = faces.yaw_stiffness * (way[2] - slider[2]) / arm
    shear = math.hypot(x, y)
    if math.hypot(shear, turn) > bound:
        left, left_turn = _left_of_stretch(shear, turn, faces.stiffness, faces.yaw_stiffness / arm**2, bound)
        x, y, turn = left * x, left * y, left_turn * turn
        slider = (
            way[0] - left * (way[0] - slider[0]),
            way[1] - left * (way[1] - slider[1]),
            way[2] - left_turn * (way[2] - slider[2]),
        )
    by_x, by_y, by_turn = faces.damping * rate[0], faces.damping * rate[1], faces.yaw_damping * rate[2] / arm
    size = math.sqrt(by_x * by_x + by_y * by_y + by_turn * by_turn)
    if size > 0.0 and (x + by_x) ** 2 + (y + by_y) ** 2 + (turn + by_turn) ** 2 > bound * bound:
        # along the damper's force and across it: two components suffice
        along = (x * by_x + y * by_y + turn * by_turn) / size
        across = math.sqrt(max(x * x + y * y + turn * turn - along * along, 0.0))
        share = _damper_share(along, across, size, 0.0, bound, 0.0)
        by_x, by_y, by_turn = share * by_x, share * by_y, share * by_turn
    return -x - by_x, -y - by_y, -(turn + by_turn) * arm, slider


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
    spring_u: float, spring_w: float, damper_u: float, damper_w: float, bound: float, gain: float
) -> float:
    """Largest share 0..1 of the damper's force that keeps the sum with the spring's within its bound.

    |spring + share damper| <= bound + share gain is convex in the share and holds at 0: where it does not at
    1, the share is the root in between.

    Parameters
    ----------
    spring_u, spring_w : force of the spring, within the bound [N]
    damper_u, damper_w : the whole force of the damper [N]
    bound : [N], at the spring's force alone
    gain : of the bound by the whole force of the damper [N]
    """
    if math.hypot(spring_u + damper_u, spring_w + damper_w) <= bound + gain:
        return 1.0
    square = damper_u * damper_u + damper_w * damper_w - gain * gain
    half = spring_u * damper_u + spring_w * damper_w - bound * gain
    room = max(bound * bound - spring_u * spring_u - spring_w * spring_w, 0.0)
    root = math.sqrt(max(half * half + square * room, 0.0))
    if half > 0.0:
        return min(room / (half + root), 1.0)
    return min((root - half) / square, 1.0) if square > 0.0 else 0.0


class WedgeFaces(NamedTuple):
    """Faces of a wedge, of the slope a and the toe t from the vertical; its angle is a - t."""

    sine: float  # of its angle
    cosine: float  # of its angle
    slope_cosine: float  # cos a
    toe_cosine: float  # cos t
    friction: float  # of the column
    slope_friction: float
    stick_stiffness: float  # of either sticking face [N/m]
    stick_damping: float  # [N s/m]


class WedgeForces(NamedTuple):
    """Friction of a wedge against its motion, and its sliders."""

    down: float  # of the column, against the wedge's way down it [N]
    across: float  # of the column, against its way across [N]
    slope: float  # against the bolster's slip on the wedge [N]
    slider: tuple[float, float, float]  # down, across, slope [m]


@inlined_kernel
def wedge(
    way: tuple[float, float, float],
    slider: tuple[float, float, float],
    rate: tuple[float, float, float],
    spring: float,
    faces: WedgeFaces,
) -> WedgeForces:
    """Dry friction of a massless wedge on both its faces: the side frame's column and the bolster's slope.

    The wedge goes down the column by one part of `way` and across it by another; the bolster slips on its
    slope by the third, towards the column. With the frictions T2 (down), T3 (across) and T1 (slope) against
    these ways and d = a - t, the equilibrium of the wedge on its control spring's force Fs gives the normal
    forces of column and slope

        N2 = (Fs cos a + T2 cos d + T1) / sin d,    |T2, T3| <= mu N2,
        N1 = (Fs cos t + T2 + T1 cos d) / sin d,    |T1| <= mu1 N1.

    A bolster that goes down or up slips on the column alone (but for the toe). One that warps, or comes
    nearer to the column, squeezes the wedge: it slips on both, and each friction presses the other face. A
    wedge of an angle below atan(mu) + atan(mu1) then jams: it holds by the stiffness of its faces.

    Spring, slider and damper of each sticking face are those of `dry_friction`, with these two cones for the
    bounds: slip leaves of every spring's force the largest share with which both hold, and the damper acts
    within the remaining margin. For any course of the control spring's force the faces return no more energy
    than they stored.

    Parameters
    ----------
    way : of the wedge down the column and across it, and of the bolster on the slope [m]
    slider : committed, in the same directions [m]
    rate : of `way` [m/s]
    spring : control spring's force Fs, vertical; a wedge without it is loose and holds nothing [N]
    faces : angles, friction and stiffness
    """
    if spring <= 0.0:
        return WedgeForces(0.0, 0.0, 0.0, way)
    k, damping = faces.stick_stiffness, faces.stick_damping
    mu, mu_slope, sine, cosine = faces.friction, faces.slope_friction, faces.sine, faces.cosine
    down, across, slope = k * (way[0] - slider[0]), k * (way[1] - slider[1]), k * (way[2] - slider[2])
    for_column, for_slope = mu * spring * faces.slope_cosine, mu_slope * spring * faces.toe_cosine
    held = math.hypot(down, across) * sine - mu * cosine * down
    held_slope = abs(slope) * sine - mu_slope * cosine * slope
    if held - mu * slope > for_column or held_slope - mu_slope * down > for_slope:
        left, left_slope = _shares_left(
            held, held_slope, -mu * slope, -mu_slope * down, for_column, for_slope
        )
        down, across, slope = left * down, left * across, left_slope * slope
        slider = (
            way[0] - left * (way[0] - slider[0]),
            way[1] - left * (way[1] - slider[1]),
            way[2] - left_slope * (way[2] - slider[2]),
        )
    to_down, to_across, to_slope = damping * rate[0], damping * rate[1], damping * rate[2]
    bound = (for_column + mu * (down * cosine + slope)) / sine
    bound_slope = (for_slope + mu_slope * (down + slope * cosine)) / sine
    share = min(
        _damper_share(down, across, to_down, to_across, bound, mu * (to_down * cosine + to_slope) / sine),
        _damper_share(
            slope,
            0.0,
            to_slope,
            0.0,
            bound_slope,
            mu_slope * (to_down + to_slope * cosine) / sine,
        ),
    )
    return WedgeForces(down + share * to_down, across + share * to_across, slope + share * to_slope, slider)


@kernel
def _shares_left(
    own: float, own_slope: float, other: float, other_slope: float, bound: float, bound_slope: float
) -> tuple[float, float]:
    """Shares 0..1 of the spring's forces of column and slope that remain after slip.

    The largest l2, l1 with own l2 + other l1 <= bound, own_slope l1 + other_slope l2 <= bound_slope, each
    below 1 only where its row is reached: a linear complementarity problem of two rows. It has one solution
    where the wedge does not jam; where it does, this one leaves most.

    Parameters
    ----------
    own, own_slope : what each face's force takes of its own bound [N]
    other, other_slope : what the force of the other face takes of it, or adds to it if negative [N]
    bound, bound_slope : of the control spring alone [N]
    """
    if own > 0.0:
        left = (bound - other) / own
        if 0.0 <= left <= 1.0 and own_slope + other_slope * left <= bound_slope:
            return left, 1.0
    if own_slope > 0.0:
        left_slope = (bound_slope - other_slope) / own_slope
        if 0.0 <= left_slope <= 1.0 and own + other * left_slope <= bound:
            return 1.0, left_slope
    determinant = own * own_slope - other * other_slope
    if not determinant > 0.0:
        return 0.0, 0.0
    left = (bound * own_slope - bound_slope * other) / determinant
    left_slope = (bound_slope * own - bound * other_slope) / determinant
    return min(max(left, 0.0), 1.0), min(max(left_slope, 0.0), 1.0)
