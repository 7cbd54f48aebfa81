"""From the points of a file to a line z(y): order, duplicates, loops, overhangs.

A scan of a wheel or rail is a curve: it has overhangs at the flange back and below a rail's head, and the
probe sometimes moves back. Contact needs one height at every y. So the points are followed from the running
circle (or the rail top) outwards on either side: a step back is a loop, and left out, if the curve passes its
beginning again within 2 mm; otherwise it is an overhang, and the profile ends before it.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray, IndexArray

DUPLICATE = 1e-6  # m, nearer points are one point: below the resolution of instruments
LONGEST_LOOP = 2e-3  # m of arc length
_SHUFFLED = 2.0  # length of the line through the points over that through the points sorted by y


def arc_length(y: FloatArray, z: FloatArray) -> FloatArray:
    """Length along the points from the first one [m].

    Parameters
    ----------
    y, z : FloatArray
        (n,) points in order [m].
    """
    return np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])


def file_order(y: FloatArray, z: FloatArray) -> IndexArray:
    """Indices that put points in the order of the curve.

    Points are normally in the order of the curve, which may overhang, so their order is unchanged; unless the
    line through them is twice as long as sorted by y: then the lines of the file were shuffled.

    Parameters
    ----------
    y, z : FloatArray
        (n,) points in the order of the file [m].
    """
    by_y = np.argsort(y, kind="stable")
    shuffled = arc_length(y, z)[-1] > _SHUFFLED * arc_length(y[by_y], z[by_y])[-1]
    return by_y if shuffled else np.arange(len(y))


def distinct(y: FloatArray, z: FloatArray) -> IndexArray:
    """Indices of the points that lie at least `DUPLICATE` from the last such point.

    Parameters
    ----------
    y, z : FloatArray
        (n,) points in order [m].
    """
    indices = [0]
    for i in range(1, len(y)):
        if np.hypot(y[i] - y[indices[-1]], z[i] - z[indices[-1]]) >= DUPLICATE:
            indices.append(i)
    return np.array(indices)


def single_valued(y: FloatArray, z: FloatArray, anchor: int) -> tuple[IndexArray, int, int]:
    """Indices of the points that are a function z(y) around the point `anchor`.

    Parameters
    ----------
    y, z : FloatArray
        The curve, in order, with y rising on the whole [m].
    anchor : int
        Point to start from: running circle or rail top.

    Returns
    -------
    indices : IndexArray
        Indices, y strictly increasing.
    loops, overhangs : int
        Numbers of points left out inside, and removed at the ends.
    """
    length = arc_length(y, z)
    after, loops_after, cut_after = _outwards(y[anchor:], length[anchor:])
    before, loops_before, cut_before = _outwards(-y[anchor::-1], -length[anchor::-1])
    indices = np.concatenate([anchor - before[:0:-1], anchor + after])
    return indices, loops_after + loops_before, cut_after + cut_before


def _outwards(y: FloatArray, length: FloatArray) -> tuple[IndexArray, int, int]:
    """Indices of the single-valued line from the first point on; numbers of points in loops and cut off."""
    indices = [0]
    for i in range(1, len(y)):
        if y[i] > y[indices[-1]]:
            indices.append(i)
        elif not np.any((y[i:] > y[indices[-1]]) & (length[i:] - length[indices[-1]] <= LONGEST_LOOP)):
            break
    return np.array(indices), indices[-1] + 1 - len(indices), len(y) - 1 - indices[-1]
