"""Creep force over one creepage."""

import math

import numpy as np
import pytest

from hh_exudyn.contact.tangential.api import creep_force
from hh_exudyn.contact.tangential.curves import CREEPAGES, CurvePatch, creep_curve

PATCH = CurvePatch(5e-3, 3e-3, 8e4, 0.3)


@pytest.mark.parametrize(("creepage", "column"), [*zip(CREEPAGES, (0, 1, 1), strict=True)])
def test_the_linear_theory_is_at_the_limit_at_the_unit(creepage: str, column: int) -> None:
    curve = creep_curve(PATCH, creepage, ("linear",), reach=2.0, points=3)
    assert curve.values == pytest.approx([0.0, PATCH.unit(creepage), 2.0 * PATCH.unit(creepage)])
    assert curve.forces["linear"][:, column] == pytest.approx([0.0, -1.0, -2.0])


def test_other_creepages_stay() -> None:
    patch = CurvePatch(5e-3, 3e-3, 8e4, 0.3, nu_x=1e-3, nu_y=2e-3, phi=0.1)
    curve = creep_curve(patch, "lateral", ("fastrip", "halfspace"), points=3, cells=12)
    for theory, forces in curve.forces.items():
        found = creep_force(theory, 5e-3, 3e-3, 8e4, 1e-3, float(curve.values[1]), 0.1, 0.3, cells=(12, 12))
        wanted = (found.x / 24e3, found.y / 24e3, found.moment / (24e3 * math.sqrt(15e-6)))
        assert forces[1] == pytest.approx(wanted, rel=1e-12)
    off = np.abs(curve.forces["fastrip"] - curve.forces["halfspace"])[:, :2]
    assert 0.0 < curve.error("fastrip") <= math.sqrt(2.0) * off.max()
    assert curve.error("halfspace") == 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"creepage": "vertical"}, "creepage = 'vertical'; allowed: longitudinal"),
        ({"reach": 0.0}, "reach = 0.0"),
        ({"points": 1}, "points = 1"),
        ({"theories": ("contact",)}, "theory = 'contact'"),
    ],
)
def test_bad_input_is_named(change: dict, message: str) -> None:
    arguments = {"creepage": "spin", "theories": ("fastrip",)} | change
    with pytest.raises(ValueError, match=message):
        creep_curve(PATCH, **arguments)
