"""Middles of the cells of a contact patch, over its half width or half length."""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel


@inlined_kernel
def cell_middle(index: int, count: int) -> float:
    """Middle of cell `index` of `count` equal cells between -1 and +1 [-].

    Parameters
    ----------
    index, count
        Number of the cell from 0, and of all cells [-].
    """
    return -1.0 + (2 * index + 1) / count


def cell_middles(count: int) -> FloatArray:
    """(count,) middles of equal cells between -1 and +1 [-]."""
    middles: FloatArray = -1.0 + (2.0 * np.arange(count) + 1.0) / count
    return middles
