"""Coupled strips against numbers from outside, as a table: Hertz's ellipses and CONTACT's conformal poses."""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.comparison import Comparison
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.halfspace.validation import conformal_poses
from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.normal.hertz import hertz_patch
from hh_exudyn.contact.profiles.spline import uniform_table
from hh_exudyn.contact.strips.normal import normal_rows
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row, wheel_strips
from hh_exudyn.contact.types import WheelStrips

_MODULUS = STEEL.shear_modulus / (1.0 - STEEL.poisson_ratio)
_RADIUS, _LOAD = 0.46, 100e3  # m, N of the ellipses
_CURVATURES = (0.2, 0.4, 1.5, 6.0, 25.0)  # 1/m, half the lateral one: a/b from 0.33 to 7.5
_ROOT_END = 11.25  # mm of y_out, where root and flange begin to be one contact


def strips_table() -> list[Comparison]:
    """All comparisons; a second."""
    return [*_ellipses(), *_conformal()]


def _solved(pair: WheelRailPair, strips: WheelStrips, refined: bool) -> FloatArray:
    """(ROWS, strips with overlap) of a pose."""
    rows = np.zeros((ROWS, CAPACITY))
    count = normal_rows(pair, strips, _MODULUS, refined, rows)
    if count < 0:
        raise ArithmeticError("the loads of the strips were not found")
    return rows[:, :count]


def _ellipses() -> list[Comparison]:
    """Cylinders on crowned rails: force at Hertz's approach, and pressure under that force."""
    y = np.arange(-120, 121) * 0.25e-3
    comparisons = []
    for curvature in _CURVATURES:
        exact = hertz_patch(_LOAD, 0.5 / _RADIUS, curvature)
        wheel = uniform_table(float(y[0]), 0.25e-3, np.zeros(y.size), np.zeros(y.size))
        rail = uniform_table(float(y[0]), 0.25e-3, -curvature * y * y, np.full(y.size, -2.0 * curvature))
        centre = np.array([0.0, -0.75, _RADIUS - exact.approach])
        pair = wheel_rail_pair(wheel, rail, 1.0, 0.75, _RADIUS, centre, np.array([0.0, 1.0, 0.0]))
        strips = wheel_strips(wheel, 0.5e-3, 0.5e-3)
        force = float(_solved(pair, strips, False)[Row.LOAD].sum())
        pressure = float(_solved(pair, strips, True)[Row.PRESSURE].max())
        under = hertz_patch(force, 0.5 / _RADIUS, curvature).max_pressure
        shape = f"a/b = {exact.a / exact.b:.2f}"
        comparisons += [
            Comparison(f"force at a given height [kN], {shape}", "Hertz", 1e-3 * force, 1e-3 * _LOAD, 0.06),
            Comparison(f"p_max at its load [MPa], {shape}", "Hertz", 1e-6 * pressure, 1e-6 * under, 0.05),
        ]
    return comparisons


def _conformal() -> list[Comparison]:
    """Worst force and 90th percentile of the pressure's error over poses from tread to flange."""
    force: list[float] = []
    root: list[float] = []
    flange: list[float] = []
    for pair, v, _ in conformal_poses():
        strips = wheel_strips(pair.wheel)
        rows = _solved(pair, strips, False)
        vertical, lateral = rows[Row.LOAD] @ rows[Row.COSINE], rows[Row.LOAD] @ rows[Row.SINE]
        whole = math.hypot(v["Fz"], v["Fy"])
        force += [abs(vertical / v["Fz"] - 1.0), abs(lateral - v["Fy"]) / whole]
        pressure = abs(_solved(pair, strips, True)[Row.PRESSURE].max() * 1e-6 / v["p_max"] - 1.0)
        (root if v["y_out"] < _ROOT_END else flange).append(pressure)
    source = "CONTACT rev 2707, conformal"
    return [
        Comparison(f"S1002 on 60E1, forces, {len(force)}", source, max(force), 0.0, 0.06),
        Comparison(f"tread and root, p_max, 90 % of {len(root)}", source, _most(root), 0.0, 0.10),
        Comparison(f"root to flange, p_max, 90 % of {len(flange)}", source, _most(flange), 0.0, 0.16),
    ]


def _most(errors: list[float]) -> float:
    """90th percentile."""
    return float(np.quantile(errors, 0.9))
