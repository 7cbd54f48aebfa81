"""Hertz: the elliptic contact of two smooth bodies of equal material.

H. Hertz 1882; in the form of K.L. Johnson, Contact Mechanics, 1985, equations 3.36-3.39 and 4.24-4.29.
`hertz_patch` is exact (complete elliptic integrals, solved for the ratio of the axes); `normal_contact` is
the kernel for dynamics: from a given approach, by a spline on the ratio of the curvatures made from the same
exact solution.

With the shorter semi-axis s and the longer semi-axis l, k = s/l, m = 1 - k^2 and the complete integrals
K(m) and D(m) = (K - E)/m, the curvatures along the longer and shorter axis are
(p0/E*) k^2 D / s and (p0/E*) (K - D) / s, and the approach is (p0/E*) s K, with E* = G/(1 - nu).
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq
from scipy.special import elliprd, elliprf

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.types import RollingPatch
from hh_exudyn.kernel import inlined_kernel

# Half the sum of the lateral curvatures below which the ellipse would be wider than the profiles have their
# curvature (conformal contact): a relative radius of 2 m, an ellipse about 2.5 times wider than long.
CURVATURE_FLOOR = 0.25  # 1/m

_LARGEST_RATIO = 1e6  # longer over shorter semi-axis that the exact solution looks for [-]
_TABLE_RATIO = 300.0  # the same at the end of the kernel's table, beyond which it is clamped [-]
_INTERVALS = 256


@dataclass(frozen=True)
class HertzPatch:
    """An elliptic contact patch.

    Hertz's result for two elastic bodies of constant curvatures, pressed together.

    Attributes
    ----------
    a, b : float
        Semi-axes in rolling direction and lateral [m].
    max_pressure : float
        Pressure in the middle, 3 N / (2 pi a b) [Pa].
    approach : float
        Elastic approach of distant points of the two bodies [m].
    """

    a: float
    b: float
    max_pressure: float
    approach: float


def _integrals(axis_ratio: FloatArray | float) -> tuple[FloatArray, FloatArray]:
    """Complete elliptic integrals K and D at the modulus of a given shorter over longer axis [-]."""
    square = np.square(axis_ratio)
    return elliprf(0.0, square, 1.0), elliprd(0.0, square, 1.0) / 3.0


def _log_curvature_ratio(log_axis_ratio: float) -> float:
    """ln of (curvature along the longer axis / along the shorter axis) of ln(shorter/longer axis) [-]."""
    k, d = _integrals(math.exp(log_axis_ratio))
    return 2.0 * log_axis_ratio + math.log(d / (k - d))


def _axis_ratio(curvature_ratio: float) -> float:
    """Shorter over longer semi-axis [-] from the smaller over the larger curvature [-]."""
    if curvature_ratio >= 1.0:
        return 1.0
    wanted = math.log(curvature_ratio)
    root = brentq(
        lambda x: _log_curvature_ratio(x) - wanted, -math.log(_LARGEST_RATIO), 0.0, xtol=1e-14, rtol=1e-14
    )
    return math.exp(root)


def hertz_patch(
    normal_force: float, curvature_x: float, curvature_y: float, material: Material = STEEL
) -> HertzPatch:
    """The contact patch under a given normal force, exact.

    Parameters
    ----------
    normal_force : float
        [N], >= 0.
    curvature_x, curvature_y : float
        Half the sum of the two bodies' principal curvatures in rolling direction (A) and lateral (B) [1/m],
        both > 0; their ratio within 1e-10..1e10.
    material : Material
        Of both bodies.

    Returns
    -------
    HertzPatch

    Raises
    ------
    ValueError
        If an argument lies outside its range.
    """
    normal_force = float(normal_force)
    curvature_x, curvature_y = float(curvature_x), float(curvature_y)
    if not (math.isfinite(normal_force) and normal_force >= 0.0):
        raise ValueError(f"normal_force = {normal_force} N; it must be finite and >= 0 N")
    for name, value in (("curvature_x", curvature_x), ("curvature_y", curvature_y)):
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(
                f"{name} = {value} 1/m; it must be finite and > 0 1/m (conformal contact is not Hertzian)"
            )
    ratio = min(curvature_x, curvature_y) / max(curvature_x, curvature_y)
    if ratio < 1e-10:
        raise ValueError(
            f"curvature_x = {curvature_x} 1/m, curvature_y = {curvature_y} 1/m; "
            "their ratio must lie in 1e-10..1e10"
        )
    if normal_force == 0.0:
        return HertzPatch(0.0, 0.0, 0.0, 0.0)
    axis_ratio = _axis_ratio(ratio)
    k, d = _integrals(axis_ratio)
    modulus = material.shear_modulus / (1.0 - material.poisson_ratio)  # E* of two equal bodies
    # A + B = (p0/E*) (k^2 D + K - D) / s with p0 = 3 N k / (2 pi s^2), solved for s^3
    factor = axis_ratio**2 * d + k - d
    shorter = (
        1.5 * normal_force * axis_ratio * factor / (math.pi * modulus * (curvature_x + curvature_y))
    ) ** (1.0 / 3.0)
    longer = shorter / axis_ratio
    max_pressure = 1.5 * normal_force / (math.pi * shorter * longer)
    approach = max_pressure / modulus * shorter * k
    a, b = (longer, shorter) if curvature_x <= curvature_y else (shorter, longer)
    return HertzPatch(float(a), float(b), float(max_pressure), float(approach))


def _spline_table() -> tuple[float, float, FloatArray]:
    """Start, step and cubic coefficients (intervals, 12) of the kernel's three smooth functions.

    The abscissa is t = sqrt(2 min(A, B)/(A + B)) = sqrt(1 - |cos(theta)|), in which slender contacts are
    spread out. Functions: s/sqrt(approach/(A + B)) = sqrt((k^2 D + K - D)/K), k/t and 1/K.
    """
    axis_ratio = np.exp(np.linspace(-math.log(2.0 * _TABLE_RATIO), 0.0, 4000))
    k, d = _integrals(axis_ratio)
    curvature_ratio = axis_ratio**2 * d / (k - d)
    end = float(np.interp(1.0 / _TABLE_RATIO, axis_ratio, curvature_ratio))
    start = math.sqrt(2.0 * end / (1.0 + end))
    t = np.linspace(start, 1.0, _INTERVALS + 1)
    ratios = np.array([_axis_ratio(min(x * x / (2.0 - x * x), 1.0)) for x in t])
    k, d = _integrals(ratios)
    values = np.stack((np.sqrt((ratios**2 * d + k - d) / k), ratios / t, 1.0 / k), axis=1)
    coefficients = CubicSpline(t, values).c  # (4, intervals, 3), highest power first
    return start, float(t[1] - t[0]), np.ascontiguousarray(coefficients.transpose(1, 2, 0)).reshape(-1, 12)


_START, _STEP, _COEFFICIENTS = _spline_table()


@inlined_kernel
def peak_pressure(patch: RollingPatch) -> float:
    """Pressure in the middle of an ellipse [Pa]."""
    return 1.5 * patch.normal_force / (math.pi * patch.a * patch.b)


@inlined_kernel
def normal_contact(
    approach: float, curvature_x: float, curvature_y: float, shear_modulus: float, poisson_ratio: float
) -> tuple[float, float, float, float]:
    """Normal force and patch from the approach (kernel: trusts its input).

    Parameters
    ----------
    approach : float
        Elastic approach [m]; without contact (<= 0) everything is zero.
    curvature_x, curvature_y : float
        Half the sums of the principal curvatures, rolling direction and lateral [1/m], > 0. Axis ratios
        beyond 300 are clamped to it.
    shear_modulus : float
        [Pa].
    poisson_ratio : float
        [-].

    Returns
    -------
    tuple of float
        Normal force [N], semi-axes a (rolling direction) and b (lateral) [m], pressure in the middle [Pa].
    """
    if approach <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    total = curvature_x + curvature_y
    t = math.sqrt(2.0 * min(curvature_x, curvature_y) / total)
    t = min(max(t, _START), 1.0)
    interval = min(int((t - _START) / _STEP), _INTERVALS - 1)
    x = t - (_START + interval * _STEP)
    c = _COEFFICIENTS[interval]
    scale = ((c[0] * x + c[1]) * x + c[2]) * x + c[3]
    axis_ratio = t * (((c[4] * x + c[5]) * x + c[6]) * x + c[7])
    inverse_k = ((c[8] * x + c[9]) * x + c[10]) * x + c[11]
    shorter = scale * math.sqrt(approach / total)
    longer = shorter / axis_ratio
    modulus = shear_modulus / (1.0 - poisson_ratio)
    max_pressure = modulus * approach * inverse_k / shorter
    normal_force = 2.0 / 3.0 * math.pi * shorter * longer * max_pressure
    if curvature_x <= curvature_y:
        return normal_force, longer, shorter, max_pressure
    return normal_force, shorter, longer, max_pressure
