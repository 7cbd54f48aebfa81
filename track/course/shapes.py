"""Shapes of transitions: the share of the change of curvature and cant over the length (EN 13803).

With t = 0 to 1 of the length, the share is

==========  ==========================================================================================
clothoid    t
helmert     2 t^2, and mirrored from the middle on
bloss       3 t^2 - 2 t^3
cosine      (1 - cos pi t) / 2
sine        t - sin(2 pi t) / (2 pi) (Klein)
viennese    f = 35 t^4 - 84 t^5 + 70 t^6 - 20 t^7, of the cant; the curvature has -h d(roll) f'' / L^2
            besides, so that a point at the height h over the track runs on the smooth curve (Hasslinger's
            Wiener Bogen)
cubic       that of the cubic parabola y = a x^3 whose arc length is L and whose last curvature is that of
            the curve; its cant is linear. It begins or ends straight and turns by less than 0.35 rad.
==========  ==========================================================================================
"""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import fsolve
from scipy.special import hyp2f1

from hh_exudyn.arrays import FloatArray

SHAPES = ("clothoid", "helmert", "bloss", "cosine", "sine", "viennese", "cubic")
CLOTHOID, HELMERT, BLOSS, COSINE, SINE, VIENNESE, CUBIC = range(len(SHAPES))
LARGEST_TURN = 0.35  # rad, curvature times length of a cubic parabola; near 0.5 its curvature has a maximum


def share(shape: NDArray[np.int64], t: FloatArray, turn: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Share of the change reached at t = 0 to 1 of the length, and its derivative by t.

    Parameters
    ----------
    shape : (n,) index into `SHAPES`
    t : (n,) part of the length
    turn : (n,) of a cubic parabola: curvature at its curved end times its length [rad], negative where it
    ends
        straight; of no meaning for the others
    """
    choices = [shape == kind for kind in (HELMERT, BLOSS, COSINE, SINE, VIENNESE)]
    late = t > 0.5
    part = [
        np.where(late, 1.0 - 2.0 * (1.0 - t) ** 2, 2.0 * t**2),
        t**2 * (3.0 - 2.0 * t),
        0.5 - 0.5 * np.cos(np.pi * t),
        t - np.sin(2.0 * np.pi * t) / (2.0 * np.pi),
        t**4 * (35.0 + t * (-84.0 + t * (70.0 - 20.0 * t))),
    ]
    slope = [
        np.where(late, 4.0 - 4.0 * t, 4.0 * t),
        6.0 * t * (1.0 - t),
        0.5 * np.pi * np.sin(np.pi * t),
        1.0 - np.cos(2.0 * np.pi * t),
        140.0 * (t * (1.0 - t)) ** 3,
    ]
    found, rate = np.select(choices, part, t), np.select(choices, slope, np.ones_like(t))
    for one in np.unique(turn[shape == CUBIC]):
        at = (shape == CUBIC) & (turn == one)
        if one > 0.0:
            found[at], rate[at] = _cubic(t[at], float(one))
        else:
            before, rate[at] = _cubic(1.0 - t[at], -float(one))
            found[at] = 1.0 - before
    return found, rate


def roll_bend(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Second and third derivative by t of the share of a Viennese bend.

    Parameters
    ----------
    t : (n,) part of the length
    """
    u = t * (1.0 - t)
    return 420.0 * u**2 * (1.0 - 2.0 * t), 840.0 * u * (1.0 - 5.0 * u)


def _cubic(t: FloatArray, turn: float) -> tuple[FloatArray, FloatArray]:
    """Share and derivative of the curvature of a cubic parabola with x in lengths: y = alpha x^3."""

    def length(x: "FloatArray | float", alpha: float) -> FloatArray:
        return np.asarray(x * hyp2f1(-0.5, 0.25, 1.25, -9.0 * alpha**2 * np.asarray(x) ** 4))

    def curvature(x: "FloatArray | float", alpha: float) -> FloatArray:
        return np.asarray(6.0 * alpha * x / (1.0 + 9.0 * alpha**2 * np.asarray(x) ** 4) ** 1.5)

    def ends(unknown: FloatArray) -> list[float]:
        alpha, x = unknown
        return [float(length(x, alpha)) - 1.0, float(curvature(x, alpha)) / turn - 1.0]

    alpha, _ = fsolve(ends, [turn / 6.0, 1.0], xtol=1e-14)
    x = t.copy()
    for _ in range(_NEWTON_STEPS):
        x -= (length(x, alpha) - t) / np.sqrt(1.0 + 9.0 * alpha**2 * x**4)
    square = 9.0 * alpha**2 * x**4
    rate = 6.0 * alpha * (1.0 - 5.0 * square) / (1.0 + square) ** 3
    return curvature(x, alpha) / turn, rate / turn


_NEWTON_STEPS = 6  # from x = t; the error after one is below 1e-3
