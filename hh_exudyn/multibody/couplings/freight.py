"""Couplings of European freight wagons: Lenoir suspension of the Y25 bogie, UIC double link.

A law is a kernel of the numbers `p` of its family, the `motion` of body B relative to A, and the `condition`
of the coupling; it returns force and moment on B in the axes of A, new sliders, and the powers (`family`).
"""

import math
from typing import NamedTuple

from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.couplings.family import Condition, Family, Motion, Reaction
from vehicles.force_laws import clearance_stop, dry_friction, two_stage_spring
from vehicles.freight_couplings import DoubleLink, LenoirSuspension


class LenoirNumbers(NamedTuple):
    """Numbers of a `LenoirSuspension`."""

    direction: float
    first_stiffness: float
    second_stiffness: float
    second_from: float
    horizontal_stiffness: float
    link_share: float
    tangent: float  # of the link's angle
    guide_stiffness: float
    friction: float
    stick_stiffness: float
    stick_damping: float
    longitudinal_damping: float
    longitudinal_clearance: float
    lateral_clearance: float
    stop_stiffness: float
    compression: float


@inlined_kernel
def lenoir(p: LenoirNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Spring groups, one of them on the link; plunger and guide, whose forces bound the friction.

    For the equilibrium there is no vertical friction, and the box sticks laterally.

    Arguments: see the head of this file.
    """
    d, v, slider = motion.displacement, motion.rate, condition.slider
    off_guide = p.direction * d[0]
    rise = p.compression + d[2]
    plain = (1.0 - p.link_share) * two_stage_spring(
        rise, p.first_stiffness, p.second_stiffness, p.second_from
    )
    hung = p.link_share * two_stage_spring(
        rise + p.tangent * off_guide, p.first_stiffness, p.second_stiffness, p.second_from
    )
    plunger = p.tangent * hung
    guide = p.guide_stiffness * max(-off_guide, 0.0)
    stop = p.stop_stiffness * max(off_guide - p.longitudinal_clearance, 0.0)
    if condition.settle:
        across, along = -p.stick_stiffness * (d[1] - slider[0]), 0.0
        slider_across, slider_along = slider[0], d[2]
    else:
        across, along, slider_across, slider_along = dry_friction(
            d[1],
            d[2],
            slider[0],
            slider[1],
            v[1],
            v[2],
            p.stick_stiffness,
            p.stick_stiffness,
            p.stick_damping,
            p.stick_damping,
            p.friction * (plunger + guide),
        )
    force_x = p.direction * (guide - plunger - stop) - p.horizontal_stiffness * d[0]
    force_y = clearance_stop(d[1], p.lateral_clearance, p.stop_stiffness) - p.horizontal_stiffness * d[1]
    return Reaction(
        (force_x - p.longitudinal_damping * v[0], force_y + across, along - plain - hung),
        (0.0, 0.0, 0.0),
        (slider_across, slider_along, *slider[2:]),
        condition.friction_power - (across * v[1] + along * v[2]),
        condition.damper_power + p.longitudinal_damping * v[0] ** 2,
    )


class LinkNumbers(NamedTuple):
    """Numbers of a `DoubleLink`."""

    first_stiffness: float
    second_stiffness: float
    second_from: float
    leaf_friction: float
    leaf_stick_stiffness: float
    longitudinal_length: float
    lateral_length: float
    longitudinal_friction: float
    lateral_friction: float
    link_stick_stiffness: float
    stick_damping: float
    longitudinal_clearance: float
    lateral_clearance: float
    stop_stiffness: float
    compression: float


@inlined_kernel
def rub(
    way: float, slider: float, rate: float, stiffness: float, damping: float, bound: float
) -> tuple[float, float]:
    """Dry friction in one direction: force [N] and slider [m]. Arguments: those of `dry_friction`."""
    force, _, slider, _ = dry_friction(
        way, 0.0, slider, 0.0, rate, 0.0, stiffness, stiffness, damping, damping, bound
    )
    return force, slider


@inlined_kernel
def double_link(p: LinkNumbers, motion: Motion, condition: Condition) -> Reaction:
    """Leaf spring with its friction; pendulums with the friction of their joints; axle guards.

    The spring's compression is that of the axle's rise and of the frame's, x^2 / 2L, as the links swing.
    For the equilibrium the leaves have no friction, and the links stick.

    Arguments: see the head of this file.
    """
    d, v, slider = motion.displacement, motion.rate, condition.slider
    x, y = d[0] / p.longitudinal_length, d[1] / p.lateral_length
    rise = p.compression + d[2] + 0.5 * (x * d[0] + y * d[1])
    load = two_stage_spring(rise, p.first_stiffness, p.second_stiffness, p.second_from)
    bound_x, bound_y, bound_z = (
        p.longitudinal_friction * load,
        p.lateral_friction * load,
        p.leaf_friction * load,
    )
    if condition.settle:
        bound_x, bound_y, bound_z = math.inf, math.inf, 0.0
    along, slider_x = rub(d[0], slider[0], v[0], p.link_stick_stiffness, p.stick_damping, bound_x)
    across, slider_y = rub(d[1], slider[1], v[1], p.link_stick_stiffness, p.stick_damping, bound_y)
    leaves, slider_z = rub(d[2], slider[2], v[2], p.leaf_stick_stiffness, p.stick_damping, bound_z)
    return Reaction(
        (
            along - load * x + clearance_stop(d[0], p.longitudinal_clearance, p.stop_stiffness),
            across - load * y + clearance_stop(d[1], p.lateral_clearance, p.stop_stiffness),
            leaves - load,
        ),
        (0.0, 0.0, 0.0),
        (slider_x, slider_y, slider_z, *slider[3:]),
        condition.friction_power - (along * v[0] + across * v[1] + leaves * v[2]),
        condition.damper_power,
    )


FAMILIES = (
    Family("lenoir", LenoirSuspension, LenoirNumbers, lenoir, lambda c: {"tangent": math.tan(c.link_angle)}),
    Family("double_link", DoubleLink, LinkNumbers, double_link),
)
