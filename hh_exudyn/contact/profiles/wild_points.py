"""Wild points: a probe that lost its wheel for a moment, a digit mistyped.

The place of a point follows from its neighbours: a cubic through two on either side. Its distance from there
is its error, which for a smooth line in noise has the noise's size. The rule:

* A point is wild if its error exceeds `ALLOWED` = 0.05 mm (with the square of the distance of its two
  neighbours over 2 mm, where that is more: between few points nothing is known) and five times the noise (the
  median error of the forty points around it, as a standard deviation), and if without it the errors of its
  neighbours fall to a quarter of its own: so the corner of a rim or of a lip, whose neighbours keep their
  errors, is none. Of two wild points in a row each hides the other, so pairs are tried as well.
* Up to three, or 1 % of the points if that is more, are left out and named. More are an error: then the scan
  is bad.

The four outermost points at both ends of a scan have not enough such neighbours, and stay.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray

ALLOWED = 0.05e-3  # m

_USUAL_REACH = 2e-3  # m between the neighbours of a point
_SIGMAS = 5.0
_TO_SIGMA = 1.4826  # from a median of absolute values to a standard deviation
_AROUND = 20  # points on either side, for the noise
_LEFT = 0.25  # of the error: what its neighbours may keep without it
_MOST, _SHARE = 3, 0.01
_END = 4
_LONGEST = 2  # wild points in a row


_Four = tuple[IntArray, IntArray, IntArray, IntArray]


def wild_points(y: FloatArray, z: FloatArray) -> list[int]:
    """Indices of the wild points of a curve, in the order of their errors.

    Parameters
    ----------
    y, z : FloatArray
        (n,) points in the order of the curve, without duplicates [m].
    """
    found: list[int] = []
    kept = np.arange(len(y))
    for _ in range(_most(len(y)) + 1):
        worst = _worst(y[kept], z[kept])
        if not worst:
            break
        found += [int(kept[i]) for i in worst]
        kept = np.delete(kept, worst)
    return found


def too_many(count: int, points: int) -> bool:
    """Whether so many wild points of that many points mean a bad scan."""
    return count > _most(points)


def _most(points: int) -> int:
    return max(_MOST, round(_SHARE * points))


def _worst(y: FloatArray, z: FloatArray) -> list[int]:
    """The point, or the points in a row, with the largest error that are wild; empty without any."""
    if len(y) < 2 * _AROUND:
        return []
    error = _errors(y, z)
    noise = _noise(error)
    reach = np.zeros(len(y))
    reach[1:-1] = np.hypot(y[2:] - y[:-2], z[2:] - z[:-2]) / _USUAL_REACH
    limit = np.maximum(ALLOWED * np.maximum(1.0, reach**2), _SIGMAS * noise)
    for i in np.argsort(error)[::-1][: 4 * _LONGEST]:
        if error[i] <= limit[i]:
            continue
        for run in _runs(int(i), len(y)):
            rest = np.delete(np.arange(len(y)), run)
            near = np.arange(max(0, run[0] - 3), min(len(rest), run[0] + 3))
            left = _errors(y[rest], z[rest])
            own = _off_curve(y, z, run)
            if own > limit[i] and left[near].max() < _LEFT * own:
                return run
    return []


def _runs(i: int, count: int) -> list[list[int]]:
    """The runs of up to `_LONGEST` points around point i, single ones first, ends left out."""
    runs = [
        list(range(first, first + n)) for n in range(1, _LONGEST + 1) for first in range(i - n + 1, i + 1)
    ]
    return [run for run in runs if run[0] >= _END and run[-1] < count - _END]


def _off_curve(y: FloatArray, z: FloatArray, run: list[int]) -> float:
    """The least distance of the points of a run from the cubic through two points on either side [m]."""
    inside = np.array(run)
    four = [np.full(len(run), k) for k in (run[0] - 2, run[0] - 1, run[-1] + 1, run[-1] + 2)]
    return float(_distance(y, z, (four[0], four[1], four[2], four[3]), inside).min())


def _errors(y: FloatArray, z: FloatArray) -> FloatArray:
    """Distance of every point from the cubic through two neighbours on either side [m]; 0 at the ends."""
    error = np.zeros(len(y))
    i = np.arange(2, len(y) - 2)
    error[2:-2] = _distance(y, z, (i - 2, i - 1, i + 1, i + 2), i)
    return error


def _distance(y: FloatArray, z: FloatArray, four: _Four, i: IntArray) -> FloatArray:
    """Distance of points i from the cubics through points `four`, over the chord's length [m]."""
    a, b, c, d = four
    step = [np.maximum(np.hypot(y[q] - y[p], z[q] - z[p]), 1e-9) for p, q in ((a, b), (b, c), (c, d))]
    at = [-step[0], 0.0 * step[0], step[1], step[1] + step[2]]
    along = ((y[i] - y[b]) * (y[c] - y[b]) + (z[i] - z[b]) * (z[c] - z[b])) / step[1]
    t = np.clip(along, 0.0, step[1])
    weight = []
    for k in range(4):
        w = 1.0
        for j in range(4):
            if j != k:
                w = w * (t - at[j]) / (at[k] - at[j])
        weight.append(w)
    place_y, place_z = np.zeros_like(t), np.zeros_like(t)
    for w, q in zip(weight, four, strict=True):
        place_y, place_z = place_y + w * y[q], place_z + w * z[q]
    return np.hypot(y[i] - place_y, z[i] - place_z)


def _noise(error: FloatArray) -> FloatArray:
    """Standard deviation of the errors around every point, from their median."""
    padded = np.pad(error, _AROUND, mode="reflect")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * _AROUND + 1)
    return _TO_SIGMA * np.median(windows, axis=1)
