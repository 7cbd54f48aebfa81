"""A few points in a product of axes with a weight each: fewer than any axis has levels.

An `hh_exudyn.campaign.collective.design.overlay` keeps every share in some twenty cells; a loop that
evaluates all of them a hundred times cannot pay for that. `stratified` draws as many points as are paid for:

* the leading axis, on which most depends, has its levels in the order of a severity. It is divided into
  strata of equal share x severity, with a point in each: narrow ones where much damage is done, as is best
  for one point a stratum (W_h s_h alike with s_h in proportion to the mean; W. G. Cochran, Sampling
  Techniques, 3rd edition, Wiley 1977, section 5A.7). The weight of a point is the share of its stratum.
* every other axis, a circle, is divided into stretches of the same lengths in another order, turned by a
  random angle: one stretch a point, as in a Latin hypercube (M. D. McKay, R. J. Beckman, W. J. Conover,
  Technometrics 21 (1979) 239-245).

The weights sum to 1 exactly. The expected share of a cell is the product of its levels' shares, so that
weighted sums are unbiased; several sets of points give their error. A level that is rarer than a point's
weight is in some sets and not in others.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple, Self

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.campaign.collective.design import Cell, uniform


class Draws(NamedTuple):
    """Uniform random numbers, 0 to 1, for up to so many points: the first ones of each axis are taken.

    `within` a point's stretch, `keys` for the order of the stretches, both (axes, points); `turn` (axes,).
    """

    within: FloatArray
    keys: FloatArray
    turn: FloatArray

    @classmethod
    def of_group(cls, text: str, axes: int, points: int, group: int, groups: int) -> Self:
        """Draws of one of several groups, that lie evenly between those of the others.

        For each group alone they are independent and uniform. Together they are the same numbers turned by
        one of `groups` equal angles, each group by another: so that all groups together have the levels of
        every axis more evenly than by chance.

        Parameters
        ----------
        text : str
            What the numbers are made of: the same on every machine.
        axes, points : int
            Of the product, and the most points of any group.
        group, groups : int
            Index of this group, and number of groups.
        """
        count = axes * (2 * points + 1)
        turns = np.argsort(uniform(f"{text};turns", count * groups).reshape(count, groups), axis=1)
        values = ((uniform(text, count) + turns[:, group] / groups) % 1.0).reshape(axes, 2 * points + 1)
        return cls(values[:, :points], values[:, points:-1], values[:, -1])


def stratified(
    shares: Sequence[Sequence[float]], leading: int, severity: Sequence[float], count: int, draws: Draws
) -> Iterator[Cell]:
    """Cells of `count` points, with their weights; equal cells are one.

    Parameters
    ----------
    shares : sequence of sequences of float
        For each axis, shares that sum to 1.
    leading : int
        Index of the axis that is divided by severity.
    severity : sequence of float
        Of every level of the leading axis, > 0; only ratios count.
    count : int
        Number of points, 1 or more.
    draws : Draws
        For as many points or more.
    """
    order = np.argsort(severity, kind="stable")
    edges = _edges(np.asarray(shares[leading])[order], np.asarray(severity, dtype=np.float64)[order], count)
    widths = np.diff(edges)
    levels = np.empty((count, len(shares)), dtype=np.int64)
    for a, axis in enumerate(shares):
        within = draws.within[a, :count] * widths
        if a == leading:
            levels[:, a] = order[_level(np.asarray(axis)[order], edges[:-1] + within)]
            continue
        sequence = np.argsort(draws.keys[a, :count], kind="stable")
        starts = np.empty(count)
        starts[sequence] = np.concatenate([[0.0], np.cumsum(widths[sequence])[:-1]])
        levels[:, a] = _level(np.asarray(axis), (starts + within + draws.turn[a]) % 1.0)
    cells: dict[tuple[int, ...], float] = {}
    for point, width in zip(levels, widths, strict=True):
        cell = tuple(int(level) for level in point)
        cells[cell] = cells.get(cell, 0.0) + float(width)
    yield from cells.items()


def _edges(shares: FloatArray, severity: FloatArray, count: int) -> FloatArray:
    """Ends of `count` intervals of equal share x severity, on the scale of the cumulated share."""
    at = np.concatenate([[0.0], np.cumsum(shares)])
    done = np.concatenate([[0.0], np.cumsum(shares * severity)])
    edges: FloatArray = np.interp(np.linspace(0.0, done[-1], count + 1), done, at)
    edges[0], edges[-1] = 0.0, 1.0
    return edges


def _level(shares: FloatArray, places: FloatArray) -> IntArray:
    """Level at each place, 0 to 1, on the scale of the cumulated share; never one without share."""
    ends = np.cumsum(shares)
    last = int(np.flatnonzero(shares > 0.0)[-1])
    found: IntArray = np.minimum(np.searchsorted(ends, places, side="right"), last)
    return found
