"""Forces of what a three-piece bogie is made of: spring nest, wedge, centre plate, side bearer.

Each takes displacement and velocity of body B relative to A in the axes of A (see `couplings`), adds what is
lost to the ledger, and returns the force on B, and a moment where it has one.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.couplings.general import shear_friction
from hh_exudyn.multibody.model import Ledger, Workspace
from hh_exudyn.multibody.vectors import Triple
from vehicles import force_laws
from vehicles.force_laws import clearance_stop, dry_friction, two_stage_spring

_FRICTION = int(Ledger.FRICTION_POWER)
_DAMPER = int(Ledger.DAMPER_POWER)

RING_POINTS = 8
_RING_X = np.cos(2.0 * np.pi * (np.arange(RING_POINTS) + 0.5) / RING_POINTS)
_RING_Y = np.sin(2.0 * np.pi * (np.arange(RING_POINTS) + 0.5) / RING_POINTS)


@inlined_kernel
def nest(
    p: FloatArray, d: Triple, v: Triple, angle: Triple, turn: Triple, work: Workspace
) -> tuple[Triple, Triple]:
    """Two-stage springs with shear, rotational stiffness and lateral stops."""
    first_stiffness, second_stiffness, second_from = p[0], p[1], p[2]
    longitudinal, lateral = p[3], p[4]
    roll, pitch, warp = p[5], p[6], p[7]
    shear_damping, vertical_damping = p[8], p[9]
    roll_damping, pitch_damping, warp_damping = p[10], p[11], p[12]
    stop_clearance, stop_stiffness = p[13], p[14]
    work.ledger[_DAMPER] += shear_damping * (v[0] ** 2 + v[1] ** 2) + vertical_damping * v[2] ** 2
    work.ledger[_DAMPER] += roll_damping * turn[0] ** 2 + pitch_damping * turn[1] ** 2
    work.ledger[_DAMPER] += warp_damping * turn[2] ** 2
    spring = two_stage_spring(-d[2], first_stiffness, second_stiffness, second_from)
    stop = clearance_stop(d[1], stop_clearance, stop_stiffness)
    return (
        (
            -longitudinal * d[0] - shear_damping * v[0],
            -lateral * d[1] - shear_damping * v[1] + stop,
            spring - vertical_damping * v[2],
        ),
        (
            -roll * angle[0] - roll_damping * turn[0],
            -pitch * angle[1] - pitch_damping * turn[1],
            -warp * angle[2] - warp_damping * turn[2],
        ),
    )


@inlined_kernel
def wedge(
    p: FloatArray,
    d: Triple,
    v: Triple,
    angle: Triple,
    turn: Triple,
    slider: FloatArray,
    settle: bool,
    new_slider: FloatArray,
    work: Workspace,
) -> tuple[Triple, Triple]:
    """Wedge on two lines: each goes down with the bolster there, and when that comes towards the column.

    Its way follows slope and toe of the faces, its force the slope with the friction of the face; half of
    spring and friction belongs to each line (sliders: compression and lateral of the first, of the second).
    """
    direction, stiffness, spring_share, drawing_compression = p[0], 0.5 * p[1], p[2], p[3]
    tan_face, toe, tan_force, tan_slope = p[4], p[5], p[6], p[7]
    friction, stick_stiffness, stick_damping = p[8], 0.5 * p[9], 0.5 * p[10]
    tan_toe, cos_toe = math.tan(toe), math.cos(toe)
    force_x, force_y, force_z = 0.0, 0.0, 0.0
    moment_x, moment_z = 0.0, 0.0
    for line in range(2):
        y = p[11] * (0.5 - line)  # from the wedge's middle
        ahead, ahead_rate = d[0] - angle[2] * y, v[0] - turn[2] * y
        up, up_rate = d[2] + angle[0] * y, v[2] + turn[0] * y
        along = (direction * ahead - up * tan_face) / (tan_face - tan_toe)
        compression = drawing_compression + along
        compression_rate = (direction * ahead_rate - up_rate * tan_face) / (tan_face - tan_toe)
        slid = compression / cos_toe if settle else slider[2 * line]
        column, rub, lateral, new_slider[2 * line], new_slider[2 * line + 1] = force_laws.wedge(
            compression / cos_toe,
            d[1],
            slid,
            slider[2 * line + 1],
            compression_rate / cos_toe,
            v[1],
            stiffness * spring_share * cos_toe,
            tan_slope,
            math.inf if settle else friction,
            stick_stiffness,
            0.0 if settle else stick_damping,  # a wedge that comes up fast would pull, at infinite friction
        )
        push = column * cos_toe - rub * math.sin(toe)  # of the wedge, from the column onto the bolster
        lift = push * tan_force
        force_x -= direction * push
        force_y += lateral
        force_z += lift
        moment_x += lift * y
        moment_z += direction * push * y
        taken = direction * push * ahead_rate - lateral * v[1] - lift * up_rate
        work.ledger[_FRICTION] += taken - stiffness * max(compression, 0.0) * compression_rate
    return (force_x, force_y, force_z), (moment_x, 0.0, moment_z)


@inlined_kernel
def plate(
    p: FloatArray,
    d: Triple,
    v: Triple,
    angle: Triple,
    turn: Triple,
    slider: FloatArray,
    settle: bool,
    new_slider: FloatArray,
    work: Workspace,
) -> tuple[Triple, Triple]:
    """Centre plate: a ring of one-sided contacts, dry friction in shear and yaw, and the rim.

    The bounds of shear (mu N) and yaw (2/3 mu N radius) are kept apart: a plate that slides in yaw holds
    against shear as if it did not, which the rim's clearance makes of little effect.
    """
    radius, stiffness, damping = p[0], p[1] / RING_POINTS, p[2] / RING_POINTS
    friction, stick_stiffness, stick_damping = p[3], p[4], p[5]
    rim_clearance, rim_stiffness = p[6], p[7]
    load = 0.0
    moment_x = 0.0
    moment_y = 0.0
    for k in range(RING_POINTS):
        x = radius * _RING_X[k]
        y = radius * _RING_Y[k]
        compression = -(d[2] + angle[0] * y - angle[1] * x)
        if compression > 0.0:
            compression_rate = -(v[2] + turn[0] * y - turn[1] * x)
            force = max(stiffness * compression + damping * compression_rate, 0.0)
            work.ledger[_DAMPER] += (force - stiffness * compression) * compression_rate
            load += force
            moment_x += force * y
            moment_y -= force * x
    force_x, force_y = shear_friction(
        d,
        v,
        (stick_stiffness, stick_stiffness, 0.0),
        (stick_damping, stick_damping, 0.0),
        friction * load,
        slider,
        settle,
        new_slider,
        work,
    )
    # two thirds of the radius: friction torque of a uniformly loaded flat disc
    arm = 2.0 / 3.0 * radius
    torque, _, new_slider[2], _ = dry_friction(
        angle[2],
        0.0,
        slider[2],
        0.0,
        turn[2],
        0.0,
        stick_stiffness * arm**2,
        stick_stiffness * arm**2,
        stick_damping * arm**2,
        stick_damping * arm**2,
        math.inf if settle else friction * load * arm,
    )
    work.ledger[_FRICTION] -= torque * turn[2]
    shear = math.hypot(d[0], d[1])
    if shear > rim_clearance:
        rim = -rim_stiffness * (shear - rim_clearance) / shear
        force_x += rim * d[0]
        force_y += rim * d[1]
    return (force_x, force_y, load), (moment_x, moment_y, torque)


@inlined_kernel
def side_bearer(
    p: FloatArray,
    d: Triple,
    v: Triple,
    slider: FloatArray,
    settle: bool,
    new_slider: FloatArray,
    work: Workspace,
) -> Triple:
    """Constant-contact side bearer with its solid stop and the friction of its face."""
    preload, stiffness, damping, stop_clearance, stop_stiffness = p[0], p[1], p[2], p[3], p[4]
    friction, stick_stiffness, stick_damping = p[5], p[6], p[7]
    compression = preload / stiffness - d[2]
    load = 0.0
    if compression > 0.0:
        spring = stiffness * compression + stop_stiffness * max(-d[2] - stop_clearance, 0.0)
        load = max(spring - damping * v[2], 0.0)
        work.ledger[_DAMPER] -= (load - spring) * v[2]
    force_x, force_y = shear_friction(
        d,
        v,
        (stick_stiffness, stick_stiffness, 0.0),
        (stick_damping, stick_damping, 0.0),
        friction * load,
        slider,
        settle,
        new_slider,
        work,
    )
    return force_x, force_y, load
