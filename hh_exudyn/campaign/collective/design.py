"""Which cells of a product of axes are run, and with which shares.

Every axis is a list of shares that sum to 1. `full_product` has every combination. `overlay` lays the axes as
divided circles over each other, each turned by an angle of its own, and cuts where any of them is divided:

    axis 1   |    0.6    |  0.4  |
    axis 2   | 0.3 |    0.7      |
    cells    | 0.3 | 0.3 |  0.4  |     (1,1) (1,2) (2,2)

The cells of every level sum to exactly its share, with as many cells as levels of all axes together instead
of their product: what is additive in the axes is summed without error, as by Latin hypercube sampling
(M. Stein, Technometrics 29 (1987) 143-151), of which this is a form for axes with few levels. With
independent turns, uniform over the circle, the expected share of a cell is the product of its levels' shares:
results are unbiased, and their spread over several overlays is the sampling error.
"""

import hashlib
import math
from collections.abc import Iterator, Sequence
from itertools import pairwise, product

import numpy as np

from hh_exudyn.arrays import FloatArray

Cell = tuple[tuple[int, ...], float]
"""Level of each axis, and share of the cell."""

_SLIVER = 1e-12  # of the circle: rounding of divisions that coincide


def full_product(shares: Sequence[Sequence[float]]) -> Iterator[Cell]:
    """Every combination of levels with a share, the last axis fastest.

    Parameters
    ----------
    shares : sequence of sequences of float
        For each axis, shares that sum to 1.
    """
    for levels in product(*(range(len(axis)) for axis in shares)):
        share = math.prod(axis[level] for axis, level in zip(shares, levels, strict=True))
        if share > 0.0:
            yield levels, share


def overlay(shares: Sequence[Sequence[float]], turns: FloatArray) -> Iterator[Cell]:
    """Cells of an overlay of circles.

    Parameters
    ----------
    shares : sequence of sequences of float
        For each axis, shares that sum to 1.
    turns : (axes,) array
        Turn of each circle [of a revolution], 0 to 1.
    """
    divisions = [np.concatenate([[0.0], np.cumsum(axis)]) for axis in shares]
    cuts = np.concatenate([(ends[:-1] + turn) % 1.0 for ends, turn in zip(divisions, turns, strict=True)])
    cuts = np.unique(np.concatenate([[0.0], cuts, [1.0]]))
    cells: dict[tuple[int, ...], float] = {}
    for low, high in pairwise(cuts):
        if high - low > _SLIVER:
            places = (0.5 * (low + high) - turns) % 1.0
            levels = tuple(
                min(int(np.searchsorted(ends, place, side="right")) - 1, len(ends) - 2)
                for ends, place in zip(divisions, places, strict=True)
            )
            cells[levels] = cells.get(levels, 0.0) + float(high - low)
    yield from cells.items()


def uniform(text: str, count: int) -> FloatArray:
    """Uniform random numbers from a text, 0 to 1: the same on every machine.

    Parameters
    ----------
    text : str
        What makes them differ.
    count : int
        How many.
    """
    seed = int.from_bytes(hashlib.sha256(text.encode()).digest()[:8], "big")
    bits = np.random.PCG64(seed).random_raw(count)
    found: FloatArray = (bits >> np.uint64(11)).astype(np.float64) * 2.0**-53
    return found
