"""From the points of a file to a line z(y): order, duplicates, loops, overhangs.

A scan of a wheel or rail is a curve: it has overhangs at the flange back and below a rail's head, and the
probe sometimes moves back. Contact needs one height at every y. So the points are followed from the running
circle (or the rail top) outwards on either side: a step back is a loop, and left out, if the curve passes its
beginning again within 2 mm; otherwise it is an overhang, and the profile ends before it.

Below a lip on the gauge side of a rail (plastic flow), no wheel can touch: an upright face below its widest
point takes the place of the hollow there (`upright_face`).
"""

import numpy as np

from hh_exudyn.arrays import FloatArray, IndexArray
from hh_exudyn.conventions import GAUGE_MEASURING_DEPTH

DUPLICATE = 1e-6  # m, nearer points are one point: below the resolution of instruments
LONGEST_LOOP = 2e-3  # m of arc length
FACE_BELOW = 2e-3  # m, of an upright face below the depth at which the gauge is measured

_FACE_STEP = 0.5e-3  # m
_FACE_SLANT = 1e-8  # m of y for each step: y of a profile increases
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


def upright_face(y: FloatArray, z: FloatArray, last: int) -> tuple[FloatArray, FloatArray] | None:
    """An upright face below the lip of a rail, in place of the hollow below it; None without a lip.

    Parameters
    ----------
    y, z : FloatArray
        The whole curve of a rail, the gauge side last [m].
    last : int
        Index of its last point before the overhang.

    Returns
    -------
    y, z : FloatArray
        Points from below the lip to 2 mm below the gauge point's usual depth, y rising by nanometres [m].
    """
    bottom = z.max() - GAUGE_MEASURING_DEPTH
    if z[last] <= bottom or z[last:].min() > bottom:  # deep enough, or the file ends before
        return None
    count = int(np.ceil((z[last] - bottom + FACE_BELOW) / _FACE_STEP))
    steps = np.arange(1, count + 1)
    return y[last] + _FACE_SLANT * steps, z[last] - _FACE_STEP * steps


def _outwards(y: FloatArray, length: FloatArray) -> tuple[IndexArray, int, int]:
    """Indices of the single-valued line from the first point on; numbers of points in loops and cut off."""
    indices = [0]
    for i in range(1, len(y)):
        if y[i] > y[indices[-1]]:
            indices.append(i)
        elif not np.any((y[i:] > y[indices[-1]]) & (length[i:] - length[indices[-1]] <= LONGEST_LOOP)):
            break
    return np.array(indices), indices[-1] + 1 - len(indices), len(y) - 1 - indices[-1]
