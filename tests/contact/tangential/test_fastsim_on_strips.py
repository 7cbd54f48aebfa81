"""FASTSIM on strips: those of an ellipse give the ellipse's force; a patch of any shape saturates at mu N."""

import math

import numpy as np
import pytest

from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.normal.hertz import peak_pressure
from hh_exudyn.contact.tangential.registry import (
    FASTSIM,
    FASTSIM_ELLIPTIC,
    FASTSIM_SINGLE,
    force_kernel,
    strips_kernel,
)
from hh_exudyn.contact.tangential.strips import HALF_LENGTH, PRESSURE, STRIP_COLUMNS, WIDTH, Y
from hh_exudyn.contact.types import RollingPatch

COUNT = 20
THEORIES = (FASTSIM, FASTSIM_SINGLE, FASTSIM_ELLIPTIC)


def patch(nu_x: float = 2e-3, nu_y: float = -3e-3, phi: float = 0.4) -> RollingPatch:
    return RollingPatch(7e-3, 4e-3, 80e3, nu_x, nu_y, phi, 0.3, STEEL.shear_modulus, STEEL.poisson_ratio)


def strips_of(ellipse: RollingPatch) -> np.ndarray:
    lateral = -1.0 + (2.0 * np.arange(COUNT) + 1.0) / COUNT
    cosine = np.sqrt(1.0 - lateral**2)
    rows = np.zeros((COUNT, STRIP_COLUMNS))
    rows[:, Y], rows[:, WIDTH] = ellipse.b * lateral, 2.0 * ellipse.b / COUNT
    rows[:, HALF_LENGTH], rows[:, PRESSURE] = ellipse.a * cosine, peak_pressure(ellipse) * cosine
    return rows


@pytest.mark.parametrize("theory", THEORIES)
@pytest.mark.parametrize("creepages", [(2e-3, -3e-3, 0.4), (1e-4, 0.0, 0.0), (0.0, 5e-4, -1.2)])
def test_strips_of_an_ellipse_are_the_ellipse(theory: int, creepages: tuple[float, float, float]) -> None:
    ellipse = patch(*creepages)
    even = force_kernel(theory, ellipse, 24, COUNT)
    assert strips_kernel(theory, strips_of(ellipse), ellipse, 24) == pytest.approx(even, rel=1e-12, abs=1e-8)


@pytest.mark.parametrize("theory", THEORIES)
def test_a_patch_of_any_shape_slides_with_its_whole_friction(theory: int) -> None:
    sliding = patch(0.3, -0.4, 0.0)
    rows = strips_of(sliding)
    rows[:, HALF_LENGTH] *= np.linspace(0.5, 1.5, COUNT)
    rows[:3, HALF_LENGTH] = 0.0
    x, y, _ = strips_kernel(theory, rows, sliding, 40)
    assert math.hypot(x, y) == pytest.approx(sliding.friction * sliding.normal_force, rel=2e-3)
    if theory == FASTSIM_SINGLE:  # three flexibilities turn the slip
        assert x / y == pytest.approx(-0.75, rel=2e-3)


def test_nothing_slides_without_creepage_or_load() -> None:
    rolling = patch(0.0, 0.0, 0.0)
    assert strips_kernel(FASTSIM, strips_of(rolling), rolling, 20) == (0.0, 0.0, 0.0)
    assert strips_kernel(FASTSIM, np.zeros((COUNT, STRIP_COLUMNS)), patch(), 20) == (0.0, 0.0, 0.0)
