"""Strips of a contact patch on the wheel: what every law, index and count needs beside stress and slip.

A patch is a row of strips along the rolling direction, each with a row of equal cells. An equivalent ellipse
has equal strips in one plane; the strips of a run lie where they lie on the wheel's profile, each with its
own width, length, slip and part of the wheel.
"""

import math
from typing import NamedTuple

import numpy as np

from damage.cells import cell_middle
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import inlined_kernel, kernel

TREAD, FLANGE = 0, 1  # parts of the wheel


class PatchStrips(NamedTuple):
    """Strips of one patch, (n,) each, in the order of the rows of its `Fields`."""

    position: FloatArray  # of the middle, in the coordinate of the grid on the wheel [m]
    covered: FloatArray  # width in that coordinate [m]
    width: FloatArray  # [m]
    half_length: FloatArray  # of the row of cells [m]
    contact_length: FloatArray  # of the part under pressure: twice the half length where all cells are [m]
    nu_x: FloatArray  # rigid slip in the middle of the row of cells [-]
    nu_y: FloatArray
    phi: FloatArray  # spin creepage there [1/m]
    wear_factor: FloatArray  # wear there over that of dry steel [-], `damage.wear.films`
    part: IntArray  # TREAD or FLANGE


def strips_space(count: int) -> PatchStrips:
    """Memory for `count` strips."""
    return PatchStrips._make([*np.zeros((8, count)), np.ones(count), np.zeros(count, dtype=np.int64)])


@kernel
def first_strips(strips: PatchStrips, fields: Fields, count: int) -> tuple[PatchStrips, Fields]:
    """The first `count` strips and their fields: views, no copies (kernel).

    Parameters
    ----------
    strips
        (n,) strips.
    fields
        (n, nx) fields.
    count
        0 to n.
    """
    return (
        PatchStrips(
            strips.position[:count], strips.covered[:count], strips.width[:count], strips.half_length[:count],
            strips.contact_length[:count], strips.nu_x[:count], strips.nu_y[:count], strips.phi[:count],
            strips.wear_factor[:count], strips.part[:count],
        ),
        Fields(
            fields.pressure[:count], fields.q_x[:count], fields.q_y[:count],
            fields.slip_x[:count], fields.slip_y[:count],
        ),
    )  # fmt: skip


@kernel
def ellipse_strips(patch: RollingPatch, strips: PatchStrips) -> float:
    """Fill the strips of an ellipse; returns its area [m^2] (kernel).

    Their places on the grid are left to `place_strips`.

    Parameters
    ----------
    patch
        The ellipse.
    strips
        (n,) result: equal strips from -b to b.
    """
    count = strips.width.size
    for j in range(count):
        lateral = cell_middle(j, count)
        half_length = patch.a * math.sqrt(1.0 - lateral * lateral)
        strips.width[j] = 2.0 * patch.b / count
        strips.half_length[j], strips.contact_length[j] = half_length, 2.0 * half_length
        strips.nu_x[j] = patch.nu_x - patch.phi * patch.b * lateral
        strips.nu_y[j], strips.phi[j] = patch.nu_y, patch.phi
    return math.pi * patch.a * patch.b


@inlined_kernel
def place_strips(b: float, position: float, across: float, part: int, strips: PatchStrips) -> None:
    """Place the strips of an ellipse on the grid (kernel).

    Parameters
    ----------
    b
        Lateral semi-axis [m].
    position
        Of its middle in the grid's coordinate [m].
    across
        Of a metre to the left across the patch, in that coordinate [-].
    part
        TREAD or FLANGE.
    strips
        (n,) result.
    """
    count = strips.width.size
    for j in range(count):
        strips.position[j] = position + across * b * cell_middle(j, count)
        strips.covered[j] = strips.width[j] * abs(across)
        strips.part[j] = part
