"""One wheel above one rail with parabolic profiles: the gap of Hertz, exactly, for the theories of strips."""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.search import CONTACT_COLUMNS, MAX_MAXIMA, STIFFNESS
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.normal.hertz import HertzPatch, hertz_patch
from hh_exudyn.contact.normal.neighbours import find_patches
from hh_exudyn.contact.normal.non_elliptic import minimum, patch_strips
from hh_exudyn.contact.profiles.spline import uniform_table
from hh_exudyn.contact.tangential.strips import STRIP_COLUMNS
from hh_exudyn.contact.types import SplineTable

RADIUS = 0.46  # m
CURVATURES = [(0.0, 0.8), (0.0, 3.3), (-1.2, 3.3), (10.0, 80.0)]  # lateral, wheel and rail [1/m]
G, NU = STEEL.shear_modulus, STEEL.poisson_ratio


def parabola(curvature: float) -> SplineTable:
    """z = curvature y^2 / 2, 60 mm wide."""
    y = np.arange(-120, 121) * 0.25e-3
    return uniform_table(float(y[0]), 0.25e-3, 0.5 * curvature * y * y, np.full(y.size, curvature))


def parabolic_pair(wheel: float, rail: float, approach: float) -> WheelRailPair:
    """A wheel of lateral curvature `wheel` on a rail of curvature `rail` (convex positive) [1/m]."""
    return wheel_rail_pair(
        parabola(wheel), parabola(-rail), 1.0, 0.75, RADIUS,
        np.array([0.0, -0.75, RADIUS - approach]), np.array([0.0, 1.0, 0.0]),
    )  # fmt: skip


def solve_one(normal: int, pair: WheelRailPair, strips: int) -> tuple[tuple[float, ...], FloatArray]:
    """Force, largest pressure, a and b of the only patch, and its strips."""
    contacts, rows = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS)), np.zeros((strips, STRIP_COLUMNS))
    assert find_patches(normal, pair, contacts, G, NU, rows) == 1
    low = minimum(normal, pair, contacts[0], G, NU)
    return patch_strips(pair, contacts[0], low, contacts[0, STIFFNESS], rows)[:4], rows


def hertz_of(wheel: float, rail: float, normal_force: float) -> HertzPatch:
    """The exact patch under a force."""
    return hertz_patch(normal_force, 0.5 / RADIUS, 0.5 * (wheel + rail))
