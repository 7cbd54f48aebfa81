"""Couplings of a three-piece bogie: spring nest, wedge, centre plate, side bearer.

A law is a kernel of the numbers `p` of its family, the `motion` of body B relative to A, and the `condition`
of the coupling; it returns force and moment on B in the axes of A, new sliders, and the powers (`family`).
"""

import math
from typing import NamedTuple

import numpy as np

from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.couplings.family import Condition, Family, Motion, Reaction, angle_of, turn_of
from hh_exudyn.multibody.couplings.general import shear_friction
from vehicles import force_laws
from vehicles.couplings import CentrePlate, SideBearer, SpringNest, Wedge
from vehicles.force_laws import clearance_stop, dry_friction, two_stage_spring

RING_POINTS = 8
_RING_X = np.cos(2.0 * np.pi * (np.arange(RING_POINTS) + 0.5) / RING_POINTS)
_RING_Y = np.sin(2.0 * np.pi * (np.arange(RING_POINTS) + 0.5) / RING_POINTS)


class NestNumbers(NamedTuple):
    """Numbers of a `SpringNest`."""

    first_stiffness: float
    second_stiffness: float
    second_from: float
    longitudinal_stiffness: float
    lateral_stiffness: float
    roll_stiffness: float
    pitch_stiffness: float
    warp_stiffness: float
    shear_damping: float
    vertical_damping: float
    roll_damping: float
    pitch_damping: float
    warp_damping: float
    stop_clearance: float
    stop_stiffness: float


@inlined_kernel
def nest(p: NestNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Two-stage springs with shear, rotational stiffness and lateral stops.

    Arguments: see the head of this file.
    """
    d, v, angle, turn = motion.displacement, motion.rate, angle_of(motion), turn_of(motion)
    power = condition.damper_power
    power += p.shear_damping * (v[0] ** 2 + v[1] ** 2) + p.vertical_damping * v[2] ** 2
    power += p.roll_damping * turn[0] ** 2 + p.pitch_damping * turn[1] ** 2
    power += p.warp_damping * turn[2] ** 2
    spring = two_stage_spring(-d[2], p.first_stiffness, p.second_stiffness, p.second_from)
    stop = clearance_stop(d[1], p.stop_clearance, p.stop_stiffness)
    return Reaction(
        (
            -p.longitudinal_stiffness * d[0] - p.shear_damping * v[0],
            -p.lateral_stiffness * d[1] - p.shear_damping * v[1] + stop,
            spring - p.vertical_damping * v[2],
        ),
        (
            -p.roll_stiffness * angle[0] - p.roll_damping * turn[0],
            -p.pitch_stiffness * angle[1] - p.pitch_damping * turn[1],
            -p.warp_stiffness * angle[2] - p.warp_damping * turn[2],
        ),
        condition.slider,
        condition.friction_power,
        power,
    )


class WedgeNumbers(NamedTuple):
    """Numbers of a `Wedge`."""

    direction: float
    spring_stiffness: float
    spring_share: float
    compression: float
    tan_face: float
    toe: float
    tan_force: float
    tan_slope: float
    friction: float
    stick_stiffness: float
    stick_damping: float
    width: float


def _wedge_slopes(wedge: Wedge) -> dict[str, float]:
    """Tangents of a wedge's face and of the direction of the force on it."""
    return {"tan_face": math.tan(wedge.slope), "tan_force": math.tan(wedge.force_slope)}


@inlined_kernel
def wedge(p: WedgeNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Wedge on two lines: each moves down with the bolster, and when the bolster approaches the column.

    Its travel follows slope and toe of the faces, its force the slope with the friction of the face; half of
    spring and friction belongs to each line (sliders: compression and lateral of the first, of the second).

    Arguments: see the head of this file.
    """
    d, v, angle, turn = motion.displacement, motion.rate, angle_of(motion), turn_of(motion)
    (down_0, across_0, down_1, across_1), settle = condition.slider, condition.settle
    power = condition.friction_power
    direction, tan_face = p.direction, p.tan_face
    stiffness, stick_stiffness, stick_damping = (
        0.5 * p.spring_stiffness,
        0.5 * p.stick_stiffness,
        0.5 * p.stick_damping,
    )
    tan_toe, cos_toe = math.tan(p.toe), math.cos(p.toe)
    force_x, force_y, force_z = 0.0, 0.0, 0.0
    moment_x, moment_z = 0.0, 0.0
    for line in range(2):
        y = p.width * (0.5 - line)  # from the wedge's middle
        ahead, ahead_rate = d[0] - angle[2] * y, v[0] - turn[2] * y
        up, up_rate = d[2] + angle[0] * y, v[2] + turn[0] * y
        along = (direction * ahead - up * tan_face) / (tan_face - tan_toe)
        compression = p.compression + along
        compression_rate = (direction * ahead_rate - up_rate * tan_face) / (tan_face - tan_toe)
        down = down_0 if line == 0 else down_1
        across = across_0 if line == 0 else across_1
        column, rub, lateral, down, across = force_laws.wedge(
            compression / cos_toe,
            d[1],
            compression / cos_toe if settle else down,
            across,
            compression_rate / cos_toe,
            v[1],
            stiffness * p.spring_share * cos_toe,
            p.tan_slope,
            math.inf if settle else p.friction,
            stick_stiffness,
            0.0 if settle else stick_damping,  # else a wedge in fast upward motion would pull
        )
        push = column * cos_toe - rub * math.sin(p.toe)  # of the wedge, from the column onto the bolster
        lift = push * p.tan_force
        force_x -= direction * push
        force_y += lateral
        force_z += lift
        moment_x += lift * y
        moment_z += direction * push * y
        taken = direction * push * ahead_rate - lateral * v[1] - lift * up_rate
        power += taken - stiffness * max(compression, 0.0) * compression_rate
        if line == 0:
            down_0, across_0 = down, across
        else:
            down_1, across_1 = down, across
    return Reaction(
        (force_x, force_y, force_z),
        (moment_x, 0.0, moment_z),
        (down_0, across_0, down_1, across_1),
        power,
        condition.damper_power,
    )


class PlateNumbers(NamedTuple):
    """Numbers of a `CentrePlate`."""

    radius: float
    stiffness: float
    damping: float
    friction: float
    stick_stiffness: float
    stick_damping: float
    rim_clearance: float
    rim_stiffness: float


@inlined_kernel
def plate(p: PlateNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Centre plate: a ring of one-sided contacts, dry friction in shear and yaw, and the rim.

    The bounds of shear (mu N) and yaw (2/3 mu N radius) are independent: sliding in yaw does not
    reduce the resistance to shear, of little effect within the rim's clearance.

    Arguments: see the head of this file.
    """
    d, v, angle, turn = motion.displacement, motion.rate, angle_of(motion), turn_of(motion)
    slider, settle, power = condition.slider, condition.settle, condition.damper_power
    radius, stiffness, damping = p.radius, p.stiffness / RING_POINTS, p.damping / RING_POINTS
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
            power += (force - stiffness * compression) * compression_rate
            load += force
            moment_x += force * y
            moment_y -= force * x
    force_x, force_y, slider_x, slider_y = shear_friction(
        motion,
        (p.stick_stiffness, p.stick_stiffness),
        (p.stick_damping, p.stick_damping),
        p.friction * load,
        condition,
    )
    # two thirds of the radius: friction torque of a uniformly loaded flat disc
    arm = 2.0 / 3.0 * radius
    torque, _, slider_yaw, _ = dry_friction(
        angle[2],
        0.0,
        slider[2],
        0.0,
        turn[2],
        0.0,
        p.stick_stiffness * arm**2,
        p.stick_stiffness * arm**2,
        p.stick_damping * arm**2,
        p.stick_damping * arm**2,
        math.inf if settle else p.friction * load * arm,
    )
    friction_power = condition.friction_power - (force_x * v[0] + force_y * v[1] + torque * turn[2])
    shear = math.hypot(d[0], d[1])
    if shear > p.rim_clearance:
        rim = -p.rim_stiffness * (shear - p.rim_clearance) / shear
        force_x += rim * d[0]
        force_y += rim * d[1]
    return Reaction(
        (force_x, force_y, load),
        (moment_x, moment_y, torque),
        (slider_x, slider_y, slider_yaw, slider[3]),
        friction_power,
        power,
    )


class SideBearerNumbers(NamedTuple):
    """Numbers of a `SideBearer`."""

    preload: float
    stiffness: float
    damping: float
    stop_clearance: float
    stop_stiffness: float
    friction: float
    stick_stiffness: float
    stick_damping: float


@inlined_kernel
def side_bearer(p: SideBearerNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Constant-contact side bearer with its solid stop and the friction of its face.

    Arguments: see the head of this file.
    """
    d, v, power = motion.displacement, motion.rate, condition.damper_power
    compression = p.preload / p.stiffness - d[2]
    load = 0.0
    if compression > 0.0:
        spring = p.stiffness * compression + p.stop_stiffness * max(-d[2] - p.stop_clearance, 0.0)
        load = max(spring - p.damping * v[2], 0.0)
        power -= (load - spring) * v[2]
    force_x, force_y, slider_x, slider_y = shear_friction(
        motion,
        (p.stick_stiffness, p.stick_stiffness),
        (p.stick_damping, p.stick_damping),
        p.friction * load,
        condition,
    )
    return Reaction(
        (force_x, force_y, load),
        (0.0, 0.0, 0.0),
        (slider_x, slider_y, condition.slider[2], condition.slider[3]),
        condition.friction_power - (force_x * v[0] + force_y * v[1]),
        power,
    )


FAMILIES = (
    Family("spring_nest", SpringNest, NestNumbers, nest),
    Family("wedge", Wedge, WedgeNumbers, wedge, _wedge_slopes),
    Family("centre_plate", CentrePlate, PlateNumbers, plate),
    Family("side_bearer", SideBearer, SideBearerNumbers, side_bearer),
)
