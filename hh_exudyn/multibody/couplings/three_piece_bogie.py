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
from vehicles.couplings import CentrePlate, SideBearer, SpringNest, Vector, Wedge
from vehicles.force_laws import (
    FacesInYaw,
    WedgeFaces,
    WedgeForces,
    clearance_stop,
    shear_and_yaw_friction,
    two_stage_spring,
)

# contacts of a centre plate of radius 1, half of them on either ring: two-point Gauss integration over r dr
_RING_POINTS = 6
_INNER, _OUTER = math.sqrt(0.5 - math.sqrt(1 / 12)), math.sqrt(0.5 + math.sqrt(1 / 12))
_AROUND = 2.0 * np.pi * (np.arange(_RING_POINTS) + 0.5) / _RING_POINTS
RING_RADIUS = np.repeat([_INNER, _OUTER], _RING_POINTS)
RING_X = RING_RADIUS * np.tile(np.cos(_AROUND), 2)
RING_Y = RING_RADIUS * np.tile(np.sin(_AROUND), 2)


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
    rotation_clearance: float
    rotation_stop_stiffness: float
    compression: float


@inlined_kernel
def nest(p: NestNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Two-stage springs with shear, rotational stiffness, lateral and rotation stops.

    Arguments: see the head of this file.
    """
    d, v, angle, turn = motion.displacement, motion.rate, angle_of(motion), turn_of(motion)
    power = condition.damper_power
    power += p.shear_damping * (v[0] ** 2 + v[1] ** 2) + p.vertical_damping * v[2] ** 2
    power += p.roll_damping * turn[0] ** 2 + p.pitch_damping * turn[1] ** 2
    power += p.warp_damping * turn[2] ** 2
    spring = two_stage_spring(p.compression - d[2], p.first_stiffness, p.second_stiffness, p.second_from)
    stop = clearance_stop(d[1], p.stop_clearance, p.stop_stiffness)
    lug = clearance_stop(angle[2], p.rotation_clearance, p.rotation_stop_stiffness)
    return Reaction(
        (
            -p.longitudinal_stiffness * d[0] - p.shear_damping * v[0],
            -p.lateral_stiffness * d[1] - p.shear_damping * v[1] + stop,
            spring - p.vertical_damping * v[2],
        ),
        (
            -p.roll_stiffness * angle[0] - p.roll_damping * turn[0],
            -p.pitch_stiffness * angle[1] - p.pitch_damping * turn[1],
            -p.warp_stiffness * angle[2] - p.warp_damping * turn[2] + lug,
        ),
        condition.slider,
        condition.friction_power,
        power,
    )


class WedgeNumbers(NamedTuple):
    """Numbers of a `Wedge`; ways, as of `Wedge.ways`: down the column, on the slope, of the spring."""

    direction: float
    towards: Vector  # ways per way of the bolster towards the column
    down: Vector  # ways per way of the bolster down
    spring_stiffness: float
    compression: float
    sine: float
    cosine: float
    slope_cosine: float
    toe_cosine: float
    friction: float
    slope_friction: float
    stick_stiffness: float
    stick_damping: float
    width: float


def _wedge_geometry(wedge: Wedge) -> dict[str, float | Vector]:
    """Ways of a wedge, and the angles of its faces."""
    towards, down = wedge.ways
    angle = wedge.slope - wedge.toe
    return {
        "towards": towards,
        "down": down,
        "sine": math.sin(angle),
        "cosine": math.cos(angle),
        "slope_cosine": math.cos(wedge.slope),
        "toe_cosine": math.cos(wedge.toe),
    }


@inlined_kernel
def wedge(p: WedgeNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Wedge on two lines: each moves down with the bolster, and when the bolster approaches the column.

    Half of spring and friction belongs to each line (sliders: down, across, slope of the first, of the
    second). Forces on the bolster follow from the ways by virtual work. For the equilibrium the wedge has no
    friction but across its column.

    Arguments: see the head of this file.
    """
    d, v, angle, turn = motion.displacement, motion.rate, angle_of(motion), turn_of(motion)
    slider, settle, power = condition.slider, condition.settle, condition.friction_power
    faces = WedgeFaces(
        p.sine,
        p.cosine,
        p.slope_cosine,
        p.toe_cosine,
        p.friction,
        p.slope_friction,
        0.5 * p.stick_stiffness,
        0.5 * p.stick_damping,
    )
    stiffness = 0.5 * p.spring_stiffness
    force_x, force_y, force_z = 0.0, 0.0, 0.0
    moment_x, moment_z = 0.0, 0.0
    first, second = slider[:3], slider[3:]
    for line in range(2):
        y = p.width * (0.5 - line)  # from the wedge's middle
        ahead, ahead_rate = p.direction * (d[0] - angle[2] * y), p.direction * (v[0] - turn[2] * y)
        drop, drop_rate = -d[2] - angle[0] * y, -v[2] - turn[0] * y
        way = (p.towards[0] * ahead + p.down[0] * drop, d[1], p.towards[1] * ahead + p.down[1] * drop)
        rate = (
            p.towards[0] * ahead_rate + p.down[0] * drop_rate,
            v[1],
            p.towards[1] * ahead_rate + p.down[1] * drop_rate,
        )
        spring = stiffness * (p.compression + p.towards[2] * ahead + p.down[2] * drop)
        before = first if line == 0 else second
        if settle and spring > 0.0:
            across = faces.stick_stiffness * (way[1] - before[1]) + faces.stick_damping * rate[1]
            rub = WedgeForces(0.0, across, 0.0, (way[0], before[1], way[2]))
        else:
            rub = force_laws.wedge(way, before, rate, spring, faces)
        spring = max(spring, 0.0)
        push = -p.direction * (spring * p.towards[2] + rub.down * p.towards[0] + rub.slope * p.towards[1])
        lift = spring * p.down[2] + rub.down * p.down[0] + rub.slope * p.down[1]
        force_x += push
        force_y -= rub.across
        force_z += lift
        moment_x += lift * y
        moment_z -= push * y
        power += rub.down * rate[0] + rub.across * rate[1] + rub.slope * rate[2]
        if line == 0:
            first = rub.slider
        else:
            second = rub.slider
    return Reaction(
        (force_x, force_y, force_z),
        (moment_x, 0.0, moment_z),
        (*first, *second),
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
    yaw_stiffness: float
    yaw_damping: float
    rim_clearance: float
    rim_stiffness: float
    spherical: float  # 1 or 0
    compression: float


@inlined_kernel
def plate(p: PlateNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Centre plate: two rings of one-sided contacts, dry friction in shear and yaw, and the rim.

    Shear and yaw share one bound, (force / mu N)^2 + (torque / mu N arm)^2 <= 1, the ellipsoid near the limit
    surface of a pressed face (S. Goyal, A. Ruina and J. Papadopoulos, Wear 143, 1991; R. D. Howe and
    M. R. Cutkosky, Int. J. Robotics Research 15, 1996), with the arm of the loads that stand on the rings.

    Arguments: see the head of this file.
    """
    d, v, angle, turn = motion.displacement, motion.rate, angle_of(motion), turn_of(motion)
    slider, power = condition.slider, condition.damper_power
    stiffness, damping = p.stiffness / RING_X.size, p.damping / RING_X.size
    reach = 0.0 if p.spherical > 0.5 else p.radius  # of the contacts, in tilting
    load = 0.0
    arm = 0.0
    moment_x = 0.0
    moment_y = 0.0
    for k in range(RING_X.size):
        x = reach * RING_X[k]
        y = reach * RING_Y[k]
        compression = p.compression - (d[2] + angle[0] * y - angle[1] * x)
        if compression > 0.0:
            compression_rate = -(v[2] + turn[0] * y - turn[1] * x)
            force = max(stiffness * compression + damping * compression_rate, 0.0)
            power += (force - stiffness * compression) * compression_rate
            load += force
            arm += force * p.radius * RING_RADIUS[k]
            moment_x += force * y
            moment_y -= force * x
    arm = arm / load if load > 0.0 else p.radius
    rub_x, rub_y, rub_yaw, sliders = shear_and_yaw_friction(
        (d[0], d[1], angle[2]),
        (slider[0], slider[1], slider[2]),
        (v[0], v[1], turn[2]),
        FacesInYaw(p.stick_stiffness, p.yaw_stiffness, p.stick_damping, p.yaw_damping),
        math.inf if condition.settle else p.friction * load,
        arm,
    )
    friction_power = condition.friction_power - (rub_x * v[0] + rub_y * v[1] + rub_yaw * turn[2])
    shear = math.hypot(d[0], d[1])
    if shear > p.rim_clearance:
        rim = -p.rim_stiffness * (shear - p.rim_clearance) / shear
        rub_x += rim * d[0]
        rub_y += rim * d[1]
    return Reaction(
        (rub_x, rub_y, load),
        (moment_x, moment_y, rub_yaw),
        (*sliders, *slider[3:]),
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
        (slider_x, slider_y, *condition.slider[2:]),
        condition.friction_power - (force_x * v[0] + force_y * v[1]),
        power,
    )


FAMILIES = (
    Family("spring_nest", SpringNest, NestNumbers, nest),
    Family("wedge", Wedge, WedgeNumbers, wedge, _wedge_geometry),
    Family("centre_plate", CentrePlate, PlateNumbers, plate),
    Family("side_bearer", SideBearer, SideBearerNumbers, side_bearer),
)
