"""The smallest circle around points of the plane, with its centre free, on the first axis or at the origin.

An active set after J. Elzinga and D.W. Hearn (The minimum covering sphere problem, Management Science 19,
1972): the smallest circle around a few points grows by the point that lies farthest outside until none does.
The radius grows with every round and the sets of points are finite in number, so that it ends with the
smallest circle; ten rounds or so are enough for a hundred thousand points.
"""

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_ROUNDING = 1e-12  # relative to the size of the points: tolerance of "inside"

FIXED, ON_AXIS, FREE = 0, 1, 2
"""Free coordinates of the centre: none (it is the origin), the first one, both."""


@dataclass(frozen=True)
class Circle:
    """A circle and the points that determine it.

    Attributes
    ----------
    centre
        (2,) its centre.
    radius
        Its radius, >= 0.
    support
        Indices of the one to three points that determine the circle.
    """

    centre: NDArray[np.float64]
    radius: float
    support: tuple[int, ...]


def smallest_circle(points: NDArray[np.float64], freedom: int = FREE, start: tuple[int, ...] = ()) -> Circle:
    """The smallest circle that encloses points.

    Parameters
    ----------
    points
        (n, 2) points, finite, one at least.
    freedom
        `FIXED`: the centre is the origin; `ON_AXIS`: it may move along the first axis; `FREE`.
    start
        Indices of one to three points for the first circle, such as the support of another one.

    Raises
    ------
    ValueError
        No point, or points that are not finite.
    """
    if points.ndim != 2 or points.shape[1] != 2 or points.shape[0] == 0 or not np.all(np.isfinite(points)):
        raise ValueError(f"points of shape {points.shape}: allowed are (n, 2) finite numbers, n at least 1")
    outside = float(np.abs(points).max()) * _ROUNDING
    circle = _around(points, start or (int(np.argmax(np.hypot(*points.T))),), freedom, outside)
    while True:
        distance = np.hypot(points[:, 0] - circle.centre[0], points[:, 1] - circle.centre[1])
        farthest = int(np.argmax(distance))
        if distance[farthest] <= circle.radius + outside or farthest in circle.support:
            return circle
        circle = _around(points, (*circle.support, farthest), freedom, outside)


def _around(points: NDArray[np.float64], chosen: tuple[int, ...], freedom: int, rounding: float) -> Circle:
    """The smallest circle around at most four points: the smallest through some of them that encloses all."""
    found = []
    for count in range(1, freedom + 2):
        for support in itertools.combinations(chosen, count):
            centre = _centre(points[list(support)], freedom)
            if centre is None:
                continue
            radius = float(np.hypot(*(points[list(support)] - centre).T).max())
            inside = np.hypot(*(points[list(chosen)] - centre).T) <= radius + rounding
            if np.all(inside):
                found.append(Circle(centre, radius, support))
    return min(found, key=lambda circle: circle.radius)


def _centre(points: NDArray[np.float64], freedom: int) -> NDArray[np.float64] | None:
    """Centre of the smallest circle through one to three points; None if that freedom allows none."""
    if freedom == FIXED:
        return np.zeros(2)
    if len(points) == 1:
        return points[0] * np.array([1.0, freedom == FREE])
    if freedom == FREE and len(points) == 2:
        middle: NDArray[np.float64] = points.mean(axis=0)
        return middle
    # as far from the first as from the others: 2 (p_i - p_0) . c = |p_i|^2 - |p_0|^2
    across = 2.0 * (points[1:] - points[0])[:, :freedom]
    square = np.sum(points**2, axis=1)
    if abs(np.linalg.det(across)) <= np.finfo(np.float64).eps * float(np.abs(across).max()) ** freedom:
        return None  # collinear points
    centre = np.zeros(2)
    centre[:freedom] = np.linalg.solve(across, square[1:] - square[0])
    return centre
