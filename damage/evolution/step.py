"""A step of wear in time: the pair of Euler and Heun, with the diffusion of curvature implicit.

Wear diffuses curvature: convex bumps are pressed harder and wear faster. The surface u = -depth over the arc
s, worn at the rate r [m/m] with the diffusivity D = d(rate)/d(convex curvature) [m], obeys for small waves

    d(depth)/dt = r = r0 - D d2u/ds2,    du/dt = -r0 + D d2u/ds2

with t the distance rolled, the heat equation. A wave exp(iks) decays as exp(-D k^2 t). An explicit step T
multiplies it by

    Euler   1 - z,    Heun   1 - z + z^2/2,    z = D k^2 T

both stable to z = 2: on points a spacing h apart (k = pi/h) to T = 2 h^2 / (pi^2 D), far below a step of use.
A Gaussian filter of length l on the increment makes z = D k^2 T exp(-k^2 l^2 / 2), largest at k = sqrt(2)/l:
T <= e l^2 / D. It blurs by the same l for the smallest step, and a D that was measured too small diverges.

Here the increment is filtered by the step itself (a Helmholtz filter of length sqrt(g D T)):

    (1 - g D T d2/ds2) k1 = T r(u)
    (1 - g D T d2/ds2) k2 = T r(u - k1) - 2 k1
    Euler  k1,    Heun  3/2 k1 + 1/2 k2

This is ROS2 (J.G. Verwer, E.J. Spee, J.G. Blom, W. Hundsdorfer, A second-order Rosenbrock method applied to
photochemical dispersion problems, SIAM J. Sci. Comput. 20 (1999) 1456-1480): of order 2 for any D, so its
measured value decides about stability, not about the result; with D = 0 exactly Euler and Heun. With
g = 1 + 1/sqrt(2) all waves keep their sign and the shortest vanish (L-stable). Euler alone is stable for
g D of at least half the true diffusivity.

r(u) need not be evaluated: the rate on Euler's profile of the step before stands for it. That profile lies
(k1 + k2)/2 = O(T^2) from the end of its step, so the order stays 2, for one evaluation a step instead of two.
For small waves it is stable for any T from D of 0.3 of the true diffusivity on; of the shortest waves a step
leaves 0.77 at half of it, 0.54 at D itself, 0.38 at twice. A decay to 1/e in 10 steps is off by 0.15, 0.05,
0.2 and 1.5 % of the wave for 0, 0.5, 1 and 2 times the true D (with two evaluations a step by 0.07, 0.01, 0.4
and 1.8 %): half of the measured D is best. More than the true D blurs the front of the worn band, which the
difference of Euler and Heun does not show.

D is no number but a field: where little wears, little changes with curvature. Pressure and with it the rate
change by a share, so D(s) = C r(s), with C = d ln(rate)/d(convex curvature) [m] of the size of the relative
radius of curvature. One D for the whole arc carried wear of the tread some 20 mm into the flange.

Ends without flux (natural boundaries of the tridiagonal system, in finite volumes over the arc) keep the worn
area to rounding. The inverse of the matrix has no negative element and rows that sum to 1: Euler's increment
has no maximum above that of the wear and no depth below zero; Heun's may undershoot beside wear that ends
abruptly, is cut at zero there and scaled back to the worn area.
"""

import math

import numpy as np
from scipy.linalg import solve_banded

from hh_exudyn.arrays import FloatArray

GAMMA = 1.0 + 1.0 / math.sqrt(2.0)
"""Share g of the implicit diffusion of ROS2: L-stable, and every wave keeps its sign."""


def volumes(s: FloatArray) -> FloatArray:
    """(n,) length of arc of each point: half of the distances to its neighbours (trapezoidal rule) [m].

    Parameters
    ----------
    s
        (n,) arc length, increasing [m].
    """
    half = 0.5 * np.diff(s)
    return np.asarray(np.append(half, 0.0) + np.insert(half, 0, 0.0), dtype=np.float64)


def diffused(s: FloatArray, depth: FloatArray, area: float | FloatArray) -> FloatArray:
    """(n,) solution of (1 - d/ds area d/ds) x = depth, without flux at the ends; keeps the area over the arc.

    Parameters
    ----------
    s
        (n,) arc length, increasing [m].
    depth
        (n,) over it.
    area
        Square of the filter length, one or (n,) over the arc [m^2], >= 0.
    """
    areas = np.broadcast_to(area, s.shape)
    flow, volume = 0.5 * (areas[1:] + areas[:-1]) / np.diff(s), volumes(s)
    bands = np.zeros((3, s.size))
    bands[0, 1:], bands[2, :-1], bands[1] = -flow, -flow, volume
    bands[1, :-1] += flow
    bands[1, 1:] += flow
    return np.asarray(solve_banded((1, 1), bands, volume * depth), dtype=np.float64)


def euler_increment(
    s: FloatArray, rate: FloatArray, distance: float, diffusivity: float | FloatArray
) -> FloatArray:
    """(n,) depth k1 of Euler's step: of order 1 [m].

    Parameters
    ----------
    s
        (n,) arc length [m].
    rate
        (n,) wear depth per distance at the start of the step [m/m].
    distance
        Of the step [m].
    diffusivity
        D, one or (n,) over the arc; 0 for the explicit step [m].
    """
    return diffused(s, distance * rate, GAMMA * diffusivity * distance)


def heun_increment(
    s: FloatArray, euler: FloatArray, rate_after: FloatArray, distance: float, diffusivity: float | FloatArray
) -> FloatArray:
    """(n,) depth 3/2 k1 + 1/2 k2 of Heun's step: of order 2 [m]; not yet cut at zero (`not_below_zero`).

    Parameters
    ----------
    s, distance, diffusivity
        As `euler_increment`.
    euler
        (n,) its result.
    rate_after
        (n,) wear depth per distance at the same points, on the profile worn by `euler` [m/m].
    """
    second = diffused(s, distance * rate_after - 2.0 * euler, GAMMA * diffusivity * distance)
    return 1.5 * euler + 0.5 * second


def not_below_zero(s: FloatArray, depth: FloatArray) -> FloatArray:
    """(n,) depth without growth of the wheel, and with the same worn area.

    Parameters
    ----------
    s, depth
        (n,) arc length and depth [m]; its area is >= 0.
    """
    area, kept = float(np.trapezoid(depth, s)), np.maximum(depth, 0.0)
    total = float(np.trapezoid(kept, s))
    return kept * (max(area, 0.0) / total) if total > 0.0 else kept


def measured_sensitivity(
    s: FloatArray, worn: FloatArray, rate: FloatArray, rate_after: FloatArray, length: float
) -> float:
    """C = d ln(rate)/d(convex curvature), by least squares, at least 0 [m].

    For a worn depth d the curvature changes by d2(d)/ds2, and the rate by C times it and the rate.

    Parameters
    ----------
    s, worn
        (n,) arc length, and the depth worn between the two rates [m].
    rate, rate_after
        (n,) wear depth per distance [m/m].
    length
        Of the filter by which depth and change are smoothed first [m].
    """
    curvature = np.gradient(np.gradient(diffused(s, worn, length**2), s), s)
    change = diffused(s, rate_after - rate, length**2)
    bent = rate * curvature
    square = float(np.trapezoid(bent**2, s))
    return max(float(np.trapezoid(change * bent, s)) / square, 0.0) if square > 0.0 else 0.0
