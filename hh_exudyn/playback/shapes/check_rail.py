"""Check rails as outlines in track frames, flared at their ends."""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.check_rail.table import CheckRail

HEAD_WIDTH, DEPTH = 0.040, 0.090  # m, about 33C1 (EN 13674-3)
_CORNER_POINTS, _FLARE_STATIONS = 5, 7


def places(check: CheckRail, stretch: tuple[int, float, float], s: FloatArray) -> FloatArray:
    """The arc lengths at which a check rail is drawn [m]: those of its running rail, and more in its flares.

    Parameters
    ----------
    check : CheckRail
        The check rails.
    stretch : tuple
        One of theirs.
    s : FloatArray
        Of the running rail; beyond them nothing is drawn.
    """
    _, start, end = stretch
    first, last = start - check.flare_length, end + check.flare_length
    flares = [np.linspace(first, start, _FLARE_STATIONS), np.linspace(end, last, _FLARE_STATIONS)]
    every = np.union1d(s, np.concatenate(flares))
    return every[(every >= max(first, s[0])) & (every <= min(last, s[-1]))]


def outlines(
    check: CheckRail, stretch: tuple[int, float, float], s: FloatArray, gauge: FloatArray
) -> FloatArray:
    """(n, m, 3) outlines of a check rail in n track frames [m].

    Parameters
    ----------
    check, stretch : CheckRail, tuple
        The check rails, and one of their stretches.
    s : FloatArray
        (n,) arc lengths [m].
    gauge : FloatArray
        (n,) gauge there [m].
    """
    side, start, end = stretch
    angle = np.linspace(0.0, 0.5 * np.pi, _CORNER_POINTS)
    radius = check.corner_radius
    corner = np.column_stack([radius * (1.0 - np.cos(angle)), check.height - radius * (1.0 - np.sin(angle))])
    back = [(HEAD_WIDTH, check.height), (HEAD_WIDTH, check.height - DEPTH), (0.0, check.height - DEPTH)]
    section = np.concatenate([corner, back])
    beyond = np.maximum(np.maximum(start - s, s - end), 0.0) / check.flare_length
    face = 0.5 * gauge - check.flangeway - check.flare_opening * beyond**2
    outline = np.zeros((len(s), len(section), 3))
    outline[:, :, 1] = side * (face[:, None] - section[:, 0])
    outline[:, :, 2] = section[:, 1]
    return outline
