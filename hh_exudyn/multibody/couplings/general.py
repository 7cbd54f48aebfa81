"""General couplings: axle-box pad, axle box, bushing, rod, bump stop.

A law is a kernel of the numbers `p` of its family, the `motion` of body B relative to A, and the `condition`
of the coupling; it returns force and moment on B in the axes of A, new sliders, and the powers (`family`).
"""

import math
from typing import Annotated, NamedTuple

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.couplings.family import (
    Condition,
    Family,
    Motion,
    Reaction,
    angle_of,
    axle_of,
    turn_of,
)
from vehicles.couplings import LARGEST_TABLE, AxleBox, AxleBoxPad, BumpStop, Bushing, Rod, Vector
from vehicles.force_laws import clearance_stop, dry_friction, tabulated_stop


class PadNumbers(NamedTuple):
    """Numbers of an `AxleBoxPad`."""

    stiffness: Vector
    damping: Vector
    roll_stiffness: float
    yaw_stiffness: float
    preload: Vector


@inlined_kernel
def pad(p: PadNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Linear pad; roll and yaw are those of the axle, as the wheelset spins.

    Arguments: see the head of this file.
    """
    d, v = motion.displacement, motion.rate
    stiffness = p.stiffness[0] * condition.stiffness
    power = p.damping[0] * v[0] ** 2 + p.damping[1] * v[1] ** 2 + p.damping[2] * v[2] ** 2
    axle = axle_of(motion)
    return Reaction(
        (
            p.preload[0] - stiffness * d[0] - p.damping[0] * v[0],
            p.preload[1] - p.stiffness[1] * d[1] - p.damping[1] * v[1],
            p.preload[2] - p.stiffness[2] * d[2] - p.damping[2] * v[2],
        ),
        (-p.roll_stiffness * axle[2], 0.0, p.yaw_stiffness * axle[0]),
        condition.slider,
        condition.friction_power,
        condition.damper_power + power,
    )


@inlined_kernel
def shear_friction(
    motion: Motion,
    stiffness: tuple[float, float],
    damping: tuple[float, float],
    bound: float,
    condition: Condition,
) -> tuple[float, float, float, float]:
    """Dry friction (`vehicles.force_laws.dry_friction`) of two horizontal faces on each other, in x and y.

    Parameters
    ----------
    motion : displacement and rate are read
    stiffness, damping : of the sticking faces in x and y [N/m], [N s/m]
    bound : friction coefficient times load [N]
    condition : the first two sliders are read; with `settle` the faces stick under any load

    Returns
    -------
    Forces in x and y [N], and the two sliders [m].
    """
    slider = condition.slider
    return dry_friction(
        motion.displacement[0],
        motion.displacement[1],
        slider[0],
        slider[1],
        motion.rate[0],
        motion.rate[1],
        stiffness[0],
        stiffness[1],
        damping[0],
        damping[1],
        math.inf if condition.settle else bound,
    )


class AxleBoxNumbers(NamedTuple):
    """Numbers of an `AxleBox`."""

    stiffness: Vector
    damping: Vector
    roll_stiffness: float
    yaw_stiffness: float
    friction: float
    longitudinal_clearance: float
    lateral_clearance: float
    stop_stiffness: float
    compression: float


@inlined_kernel
def axle_box(p: AxleBoxNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Pad that shears until its seat slides, and the pedestal's stops; moments as those of `pad`.

    Arguments: see the head of this file.
    """
    d, v = motion.displacement, motion.rate
    compression = p.compression + d[2]
    spring = p.stiffness[2] * max(compression, 0.0)
    load = max(spring + p.damping[2] * v[2], 0.0) if compression > 0.0 else 0.0
    force_x, force_y, slider_x, slider_y = shear_friction(
        motion,
        (p.stiffness[0], p.stiffness[1]),
        (p.damping[0], p.damping[1]),
        p.friction * load,
        condition,
    )
    axle = axle_of(motion)
    return Reaction(
        (
            force_x + clearance_stop(d[0], p.longitudinal_clearance, p.stop_stiffness),
            force_y + clearance_stop(d[1], p.lateral_clearance, p.stop_stiffness),
            -load,
        ),
        (-p.roll_stiffness * axle[2], 0.0, p.yaw_stiffness * axle[0]),
        (slider_x, slider_y, *condition.slider[2:]),
        condition.friction_power - (force_x * v[0] + force_y * v[1]),
        condition.damper_power + (load - spring) * v[2],
    )


class BushingNumbers(NamedTuple):
    """Numbers of a `Bushing`."""

    stiffness: Vector
    damping: Vector
    rotational_stiffness: Vector
    rotational_damping: Vector
    preload: Vector


@inlined_kernel
def bushing(p: BushingNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Linear in all six directions, with its preload on the drawing.

    Arguments: see the head of this file.
    """
    d, v, angle, turn = motion.displacement, motion.rate, angle_of(motion), turn_of(motion)
    stiffness, damping, twist, swing = p.stiffness, p.damping, p.rotational_stiffness, p.rotational_damping
    power = condition.damper_power
    power += damping[0] * v[0] ** 2 + damping[1] * v[1] ** 2 + damping[2] * v[2] ** 2
    power += swing[0] * turn[0] ** 2 + swing[1] * turn[1] ** 2 + swing[2] * turn[2] ** 2
    return Reaction(
        (
            p.preload[0] - stiffness[0] * d[0] - damping[0] * v[0],
            p.preload[1] - stiffness[1] * d[1] - damping[1] * v[1],
            p.preload[2] - stiffness[2] * d[2] - damping[2] * v[2],
        ),
        (
            -twist[0] * angle[0] - swing[0] * turn[0],
            -twist[1] * angle[1] - swing[1] * turn[1],
            -twist[2] * angle[2] - swing[2] * turn[2],
        ),
        condition.slider,
        condition.friction_power,
        power,
    )


class RodNumbers(NamedTuple):
    """Numbers of a `Rod`."""

    length: float
    stiffness: float
    damping: float
    preload: float


@inlined_kernel
def rod(p: RodNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Force along the line from end A to end B, which balances its reaction without a moment.

    Arguments: see the head of this file.
    """
    d, v = motion.displacement, motion.rate
    length = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
    rate = (d[0] * v[0] + d[1] * v[1] + d[2] * v[2]) / length
    pull = (p.preload + p.stiffness * (length - p.length) + p.damping * rate) / length
    return Reaction(
        (-pull * d[0], -pull * d[1], -pull * d[2]),
        (0.0, 0.0, 0.0),
        condition.slider,
        condition.friction_power,
        condition.damper_power + p.damping * rate * rate,
    )


class BumpStopNumbers(NamedTuple):
    """Numbers of a `BumpStop`."""

    axis: Vector
    preload: float
    odd: float  # 1 with a table for both directions, else 0
    points: float  # of the table
    flat_table: Annotated[FloatArray, 2 * LARGEST_TABLE]  # displacement [m], force [N], ...; zeros


def _bump_stop_table(stop: BumpStop) -> dict[str, float | list[float]]:
    """The table of a bump stop as one row of numbers, and their number."""
    values = [value for point in stop.table for value in point]
    missing = 2 * LARGEST_TABLE - len(values)
    return {"points": float(len(stop.table)), "flat_table": values + [0.0] * missing}


@inlined_kernel
def bump_stop(p: BumpStopNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Along its axis only: the table of `tabulated_stop`, on one side or, when odd, on both.

    Arguments: see the head of this file.
    """
    d, axis = motion.displacement, p.axis
    along = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]
    if p.odd > 0.5 and along < 0.0:
        force = tabulated_stop(-along, p.flat_table, int(p.points))
    else:
        force = -tabulated_stop(along, p.flat_table, int(p.points))
    force += p.preload
    return Reaction(
        (force * axis[0], force * axis[1], force * axis[2]),
        (0.0, 0.0, 0.0),
        condition.slider,
        condition.friction_power,
        condition.damper_power,
    )


FAMILIES = (
    Family("axle_box_pad", AxleBoxPad, PadNumbers, pad),
    Family("axle_box", AxleBox, AxleBoxNumbers, axle_box),
    Family("bushing", Bushing, BushingNumbers, bushing),
    Family("rod", Rod, RodNumbers, rod),
    Family("bump_stop", BumpStop, BumpStopNumbers, bump_stop, _bump_stop_table),
)
