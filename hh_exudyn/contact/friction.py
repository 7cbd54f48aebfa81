"""The friction coefficient of a patch by place on the track, wheel, zone of the wheel and slip speed
(kernel).

`track.friction` describes friction by climate, treatment and coefficients, and makes the `FrictionTable`.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel

FILMS = ("dry", "lubricated", "greased")
"""Films of lubricant on a surface: in a table of films, their numbers stand in place of the coefficients."""


class FrictionTable(NamedTuple):
    """Friction of a run, for the kernel. Angles in rad, lengths in m.

    A surface is one state of wheel and rail along the whole track: lubricated wheelsets have another surface
    than the others.
    """

    begin: FloatArray  # (n,) where the change to section i begins; the first is not used
    ramp: float  # length of a change
    friction: FloatArray  # (surfaces, n, 2, 3) at rest: surface, section, left and right, zone
    surface: NDArray[np.int64]  # (wheelsets,) the surface of every wheelset
    corner_from: float  # contact angles at the ends of the passage from tread to gauge corner
    corner_to: float
    flange_from: float  # and from gauge corner to flange
    flange_to: float
    ratio: float  # A: friction at infinite slip speed over that at rest [-]
    decrease: float  # B [s/m]


def constant_friction(friction: ArrayLike) -> FrictionTable:
    """Friction that depends on the wheel only, not on place or slip speed.

    Parameters
    ----------
    friction : (wheelsets, 2) left and right wheel [-], >= 0
    """
    wheels = np.asarray(friction, dtype=np.float64)
    return FrictionTable(
        begin=np.zeros(1),
        ramp=1.0,
        friction=np.repeat(wheels[:, None, :, None], 3, axis=3),
        surface=np.arange(len(wheels)),
        corner_from=0.0,
        corner_to=1.0,
        flange_from=0.0,
        flange_to=1.0,
        ratio=1.0,
        decrease=0.0,
    )


@inlined_kernel
def depends_on_wheel_alone(table: FrictionTable, wheelset: int) -> bool:
    """Whether friction of a wheelset's wheels depends on neither place, contact angle nor slip speed.

    Parameters
    ----------
    table, wheelset : as of `friction_at`
    """
    zones = table.friction[table.surface[wheelset], 0]
    same = table.begin.shape[0] == 1 and (table.decrease == 0.0 or table.ratio == 1.0)
    for side in range(2):
        same &= zones[side, 0] == zones[side, 1] and zones[side, 0] == zones[side, 2]
    return same


@inlined_kernel
def friction_at(
    table: FrictionTable, wheelset: int, side: int, s: float, contact_angle: float, slip_speed: float
) -> float:
    """Friction coefficient of one patch [-].

    Parameters
    ----------
    table : from `track.friction.Friction.table` or `constant_friction`
    wheelset : its number, from 0
    side : side index, 0 left, 1 right
    s : arc length of the patch along the track [m]; the first and last section are unbounded
    contact_angle : positive towards the flange [rad]; a patch on the field side belongs to the tread
    slip_speed : magnitude of the slip velocity, creepage times speed, >= 0 [m/s]

    Returns
    -------
    float
        Continuous over s, contact angle and slip speed, with continuous slopes over the first two.
    """
    corner = _smooth_step((contact_angle - table.corner_from) / (table.corner_to - table.corner_from))
    flange = _smooth_step((contact_angle - table.flange_from) / (table.flange_to - table.flange_from))
    surface = table.surface[wheelset]

    low, high = 0, table.begin.shape[0]  # the last section with a change that begins before s
    while high - low > 1:
        middle = (low + high) // 2
        if s >= table.begin[middle]:
            low = middle
        else:
            high = middle
    friction = _of_zones(table.friction, surface, low, side, corner, flange)
    if low > 0 and s < table.begin[low] + table.ramp:
        before = _of_zones(table.friction, surface, low - 1, side, corner, flange)
        friction = before + _smooth_step((s - table.begin[low]) / table.ramp) * (friction - before)
    # Polach 2005: mu = mu0 ((1 - A) exp(-B v) + A)
    return friction * ((1.0 - table.ratio) * math.exp(-table.decrease * slip_speed) + table.ratio)


@inlined_kernel
def _of_zones(
    friction: FloatArray, surface: int, section: int, side: int, corner: float, flange: float
) -> float:
    """Friction from the three zones; `corner`, `flange`: progress 0..1 into gauge corner and into flange."""
    tread = friction[surface, section, side, 0]
    gauge_corner = friction[surface, section, side, 1]
    return (
        tread
        + corner * (gauge_corner - tread)
        + flange * (friction[surface, section, side, 2] - gauge_corner)
    )


@inlined_kernel
def _smooth_step(x: float) -> float:
    """From 0 at x <= 0 to 1 at x >= 1, value and slope continuous."""
    t = min(max(x, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)
