"""Couplings of passenger bogies: axle-box arm, damper, damper in series with a spring.

A law is a kernel of the numbers `p` of its family, the `motion` of body B relative to A, and the `condition`
of the coupling; it returns force and moment on B in the axes of A, new sliders, and the powers (`family`).
"""

import math
from typing import Annotated, NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.couplings.family import Condition, Family, Motion, Reaction, axle_of, turn_of
from hh_exudyn.multibody.vectors import cross, dot
from vehicles.dampers import damper_force, series_damper_force
from vehicles.passenger_bogie import LARGEST_DAMPER_TABLE, AxleBoxArm, Damper, SeriesDamper, Vector


class ArmNumbers(NamedTuple):
    """Numbers of an `AxleBoxArm`."""

    arm: Vector
    length: float  # of the arm
    along_stiffness: float
    lateral_stiffness: float
    along_damping: float
    lateral_damping: float
    preload: float


def _arm_numbers(arm: AxleBoxArm) -> dict[str, float]:
    """The arm's length, and its springs and dampers along the arm and across."""
    x, _, z = arm.arm
    return {
        "length": math.hypot(x, z),
        "lateral_stiffness": arm.stiffness[1],
        "along_damping": arm.damping[0],
        "lateral_damping": arm.damping[1],
    }


@inlined_kernel
def arm(p: ArmNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Along the line from axle to bushing, and along the axle; no moment about it (`AxleBoxArm`).

    With e the axle's direction, p the vector from the axle to the bushing, p = l u + s e, the forces are the
    derivatives of k (l - L)^2/2 + K s^2/2 for l and s, on the wheelset at the bushing's place: p x F about
    the axle's own. Arguments: see the head of this file.
    """
    d, v = motion.displacement, motion.rate
    axle = axle_of(motion)
    arm_x, arm_y, arm_z = p.arm
    place = (arm_x - d[0], arm_y - d[1], arm_z - d[2])
    swing = cross(turn_of(motion), axle)
    aside = dot(place, axle)
    aside_rate = dot(place, swing) - dot(v, axle)
    level = (place[0] - aside * axle[0], place[1] - aside * axle[1], place[2] - aside * axle[2])
    length = math.sqrt(dot(level, level))
    ahead = (level[0] / length, level[1] / length, level[2] / length)
    length_rate = -dot(v, ahead) - aside * dot(swing, ahead)
    pull = p.preload + p.along_stiffness * (length - p.length) + p.along_damping * length_rate
    side = p.lateral_stiffness * aside + p.lateral_damping * aside_rate
    force = (
        pull * ahead[0] + side * axle[0],
        pull * ahead[1] + side * axle[1],
        pull * ahead[2] + side * axle[2],
    )
    lost = p.along_damping * length_rate * length_rate + p.lateral_damping * aside_rate * aside_rate
    return Reaction(
        force,
        cross(place, force),
        condition.slider,
        condition.friction_power,
        condition.damper_power + lost,
    )


class DamperNumbers(NamedTuple):
    """Numbers of a `Damper`."""

    axis: Vector
    preload: float
    points: float  # of the table
    flat_table: Annotated[FloatArray, 2 * LARGEST_DAMPER_TABLE]  # speed [m/s], force [N], ...; zeros


class SeriesDamperNumbers(NamedTuple):
    """Numbers of a `SeriesDamper`."""

    axis: Vector
    preload: float
    points: float  # of the table
    flat_table: Annotated[FloatArray, 2 * LARGEST_DAMPER_TABLE]  # speed [m/s], force [N], ...; zeros
    series_stiffness: float


def _damper_table(damper: Damper | SeriesDamper) -> dict[str, float | list[float]]:
    """The table of a damper as one row of numbers, and their number."""
    values = [value for point in damper.table for value in point]
    missing = 2 * LARGEST_DAMPER_TABLE - len(values)
    return {"points": float(len(damper.table)), "flat_table": values + [0.0] * missing}


@inlined_kernel
def damper(p: DamperNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Along its axis only, by its table.

    Arguments: see the head of this file.
    """
    speed = dot(motion.rate, p.axis)
    force = damper_force(speed, p.flat_table, int(p.points))
    on_b = p.preload - force
    return Reaction(
        (on_b * p.axis[0], on_b * p.axis[1], on_b * p.axis[2]),
        (0.0, 0.0, 0.0),
        condition.slider,
        condition.friction_power,
        condition.damper_power + force * speed,
    )


@inlined_kernel
def series_damper(p: SeriesDamperNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Along its axis only; its sliders are force, displacement and time of the last accepted step.

    At rest in the equilibrium the force is zero, and the time there infinite: until the first step is
    accepted, and in linear analyses, which know no states of couplings, the damper acts alone. Arguments: see
    the head of this file.
    """
    way, speed = dot(motion.displacement, p.axis), dot(motion.rate, p.axis)
    force, own_speed, time = 0.0, 0.0, math.inf
    if not condition.settle:
        time = condition.time
        force, own_speed = series_damper_force(
            condition.slider[0],
            way - condition.slider[1],
            time - condition.slider[2],
            speed,
            p.series_stiffness,
            p.flat_table,
            int(p.points),
        )
    on_b = p.preload - force
    return Reaction(
        (on_b * p.axis[0], on_b * p.axis[1], on_b * p.axis[2]),
        (0.0, 0.0, 0.0),
        (force, way, time, 0.0, 0.0, 0.0),
        condition.friction_power,
        condition.damper_power + force * own_speed,
    )


FAMILIES = (
    Family("axle_box_arm", AxleBoxArm, ArmNumbers, arm, _arm_numbers),
    Family("damper", Damper, DamperNumbers, damper, _damper_table),
    Family("series_damper", SeriesDamper, SeriesDamperNumbers, series_damper, _damper_table),
)
