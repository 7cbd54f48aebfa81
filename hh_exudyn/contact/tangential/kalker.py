"""Kalker's creepage and spin coefficients C11, C22, C23, C33 of an elliptic contact.

Table E.3 of J.J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, Kluwer 1990 (first in his
thesis, Delft 1967), interpolated linearly in g = min(a/b, b/a) and by an inverse quadratic polynomial in
Poisson's ratio; beyond the table his asymptotes for slender ellipses (ibid., appendix E). The asymptotes
miss the table's last row by up to 5 %, so between g = 0.1 and 0.07 one is blended into the other, since
creep forces must not jump when the shape of a patch changes.
"""

import math

import numpy as np

from hh_exudyn.kernel import kernel

# a/b, then C11, C22, C23, C33, each for Poisson's ratio 0, 1/4, 1/2
_A_SHORTER = np.array(
    [  # a/b = 0.1, 0.2 ... 1
        [2.51, 3.31, 4.85, 2.51, 2.52, 2.53, 0.334, 0.473, 0.731, 6.42, 8.28, 11.7],
        [2.59, 3.37, 4.81, 2.59, 2.63, 2.66, 0.483, 0.603, 0.809, 3.46, 4.27, 5.66],
        [2.68, 3.44, 4.80, 2.68, 2.75, 2.81, 0.607, 0.715, 0.889, 2.49, 2.96, 3.72],
        [2.78, 3.53, 4.82, 2.78, 2.88, 2.98, 0.720, 0.823, 0.977, 2.02, 2.32, 2.77],
        [2.88, 3.62, 4.83, 2.88, 3.01, 3.14, 0.827, 0.929, 1.07, 1.74, 1.93, 2.22],
        [2.98, 3.72, 4.91, 2.98, 3.14, 3.31, 0.930, 1.03, 1.18, 1.56, 1.68, 1.86],
        [3.09, 3.81, 4.97, 3.09, 3.28, 3.48, 1.03, 1.14, 1.29, 1.43, 1.50, 1.60],
        [3.19, 3.91, 5.05, 3.19, 3.41, 3.65, 1.13, 1.25, 1.40, 1.34, 1.37, 1.42],
        [3.29, 4.01, 5.12, 3.29, 3.54, 3.82, 1.23, 1.36, 1.51, 1.27, 1.27, 1.27],
        [3.40, 4.12, 5.20, 3.40, 3.67, 3.98, 1.33, 1.47, 1.63, 1.21, 1.19, 1.16],
    ]
)
_A_LONGER = np.array(
    [  # b/a = 0.1, 0.2 ... 1
        [10.7, 11.7, 12.9, 10.7, 12.8, 16.0, 12.2, 14.6, 18.0, 0.795, 0.526, 0.228],
        [6.96, 7.78, 8.82, 6.96, 8.14, 9.79, 5.72, 6.63, 7.89, 0.828, 0.601, 0.341],
        [5.57, 6.34, 7.34, 5.57, 6.40, 7.51, 3.79, 4.32, 5.01, 0.868, 0.674, 0.446],
        [4.84, 5.57, 6.57, 4.84, 5.48, 6.31, 2.88, 3.24, 3.70, 0.912, 0.747, 0.549],
        [4.37, 5.10, 6.11, 4.37, 4.90, 5.56, 2.35, 2.62, 2.96, 0.958, 0.819, 0.650],
        [4.06, 4.78, 5.80, 4.06, 4.50, 5.04, 2.01, 2.23, 2.50, 1.01, 0.892, 0.751],
        [3.82, 4.54, 5.58, 3.82, 4.21, 4.67, 1.76, 1.95, 2.18, 1.05, 0.965, 0.852],
        [3.65, 4.36, 5.42, 3.65, 3.99, 4.39, 1.58, 1.75, 1.94, 1.10, 1.04, 0.954],
        [3.51, 4.22, 5.30, 3.51, 3.81, 4.16, 1.44, 1.59, 1.77, 1.16, 1.11, 1.06],
        [3.40, 4.12, 5.20, 3.40, 3.67, 3.98, 1.33, 1.47, 1.63, 1.21, 1.19, 1.16],
    ]
)
_TABLE = np.stack((_A_SHORTER, _A_LONGER))
_TABLE_END = 0.1  # the table's smallest ratio of the semi-axes [-]
_ASYMPTOTE_START = 0.07  # below it the asymptotes alone hold [-]
_LN4 = math.log(4.0)
_SMALLEST_RATIO = 1e-6  # below it the logarithm of the asymptotes would be infinite [-]


@kernel
def _inverse_quadratic(at_0: float, at_quarter: float, at_half: float, poisson_ratio: float) -> float:
    """1/C as the parabola through its values at Poisson's ratio 0, 1/4 and 1/2."""
    nu = poisson_ratio
    weight_0 = 8.0 * (nu - 0.25) * (nu - 0.5)
    weight_quarter = -16.0 * nu * (nu - 0.5)
    weight_half = 8.0 * nu * (nu - 0.25)
    return 1.0 / (weight_0 / at_0 + weight_quarter / at_quarter + weight_half / at_half)


@kernel
def _asymptotes(g: float, a_is_shorter: bool, poisson_ratio: float) -> tuple[float, float, float, float]:
    """Kalker's asymptotes for a slender ellipse, g = shorter over longer semi-axis (1990, appendix E)."""
    nu = poisson_ratio
    big_lambda = math.log(16.0 / (g * g))
    if a_is_shorter:
        c11 = 0.25 * math.pi**2 / (1.0 - nu)
        c22 = 0.25 * math.pi**2
        c23 = math.pi * math.sqrt(g) / (3.0 * (1.0 - nu)) * (1.0 + nu * (0.5 * big_lambda + _LN4 - 5.0))
        c33 = math.pi**2 / (16.0 * (1.0 - nu) * g)
        return c11, c22, c23, c33
    for_11 = big_lambda - 2.0 * nu
    for_22 = (1.0 - nu) * big_lambda + 2.0 * nu
    for_23 = (1.0 - nu) * big_lambda - 2.0 + 4.0 * nu
    c11 = 2.0 * math.pi / (g * for_11) * (1.0 + (3.0 - _LN4) / for_11)
    c22 = 2.0 * math.pi / (g * for_22) * (1.0 + (1.0 - nu) * (3.0 - _LN4) / for_22)
    c23 = 2.0 * math.pi / (3.0 * g * math.sqrt(g) * for_23)
    c33 = 0.25 * math.pi * (1.0 - nu * (big_lambda - 2.0) / for_23)
    return c11, c22, c23, c33


@kernel
def _between_rows(half: int, row: int, first: int, upper: float, poisson_ratio: float) -> float:
    """The coefficient of three columns from `first` on, a share `upper` of the way from a row to the next."""
    low, high = _TABLE[half, row], _TABLE[half, row + 1]
    lower = 1.0 - upper
    return _inverse_quadratic(
        lower * low[first] + upper * high[first],
        lower * low[first + 1] + upper * high[first + 1],
        lower * low[first + 2] + upper * high[first + 2],
        poisson_ratio,
    )


@kernel
def _from_table(g: float, half: int, poisson_ratio: float) -> tuple[float, float, float, float]:
    """Table E.3 at g in 0.1..1; half 0: a/b = g, half 1: b/a = g."""
    row = min(int(10.0 * g) - 1, 8)
    row = max(row, 0)
    upper = 10.0 * g - (row + 1)
    return (
        _between_rows(half, row, 0, upper, poisson_ratio),
        _between_rows(half, row, 3, upper, poisson_ratio),
        _between_rows(half, row, 6, upper, poisson_ratio),
        _between_rows(half, row, 9, upper, poisson_ratio),
    )


@kernel
def coefficients(a_over_b: float, poisson_ratio: float) -> tuple[float, float, float, float]:
    """`kalker_coefficients` of the same arguments (kernel: trusts its input)."""
    a_is_shorter = a_over_b <= 1.0
    g = a_over_b if a_is_shorter else 1.0 / a_over_b
    half = 0 if a_is_shorter else 1
    if g >= _TABLE_END:
        return _from_table(g, half, poisson_ratio)
    far = _asymptotes(max(g, _SMALLEST_RATIO), a_is_shorter, poisson_ratio)
    if g <= _ASYMPTOTE_START:
        return far
    weight = (g - _ASYMPTOTE_START) / (_TABLE_END - _ASYMPTOTE_START)
    end = _from_table(_TABLE_END, half, poisson_ratio)
    near = _asymptotes(_TABLE_END, a_is_shorter, poisson_ratio)
    # the asymptote, scaled to the table's last row at its end; the scaling decreases to 1
    return (
        far[0] * (1.0 + weight * (end[0] / near[0] - 1.0)),
        far[1] * (1.0 + weight * (end[1] / near[1] - 1.0)),
        far[2] * (1.0 + weight * (end[2] / near[2] - 1.0)),
        far[3] * (1.0 + weight * (end[3] / near[3] - 1.0)),
    )


def kalker_coefficients(a_over_b: float, poisson_ratio: float) -> tuple[float, float, float, float]:
    """Kalker's coefficients C11, C22, C23, C33.

    With forces on the wheel and creepages of the wheel relative to the rail, c^2 = a b:
    F_x = -C11 G c^2 nu_x, F_y = -C22 G c^2 nu_y - C23 G c^3 phi, M_z = C23 G c^3 nu_y - C33 G c^4 phi.

    Parameters
    ----------
    a_over_b : float
        Semi-axis in rolling direction over lateral semi-axis [-], > 0.
    poisson_ratio : float
        Poisson's ratio [-], 0..0.5.

    Returns
    -------
    tuple of float
        C11 (longitudinal), C22 (lateral), C23 (spin and lateral force), C33 (spin moment) [-].

    Raises
    ------
    ValueError
        If an argument lies outside its range.
    """
    a_over_b, poisson_ratio = float(a_over_b), float(poisson_ratio)
    if not (math.isfinite(a_over_b) and a_over_b > 0.0):
        raise ValueError(f"a_over_b = {a_over_b} [-]; it must be finite and > 0")
    if not 0.0 <= poisson_ratio <= 0.5:
        raise ValueError(f"poisson_ratio = {poisson_ratio} [-]; it must lie in 0..0.5")
    c11, c22, c23, c33 = coefficients(a_over_b, poisson_ratio)
    return float(c11), float(c22), float(c23), float(c33)
