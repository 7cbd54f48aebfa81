"""Influence of stresses on the surface: closed forms against quadrature, transforms against sums."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from hh_exudyn.contact.halfspace.influence import Grid, Influence, rectangle_integrals
from hh_exudyn.contact.material import STEEL

GRID = Grid(12, 9, 0.3e-3, 0.2e-3)


def pairs(shift: float) -> np.ndarray:
    """The four integrals of every element at every element's centre, moved along x: (4, n, n)."""
    x, y = (part.ravel() for part in np.meshgrid(GRID.x, GRID.y))
    across, along = y[:, None] - y[None, :], x[:, None] + shift - x[None, :]
    return rectangle_integrals(along, across, 0.5 * GRID.dx, 0.5 * GRID.dy)


@pytest.mark.parametrize("place", [(2.0, 0.7), (-1.4, 0.9), (0.3, -2.0)])
def test_closed_forms_are_the_integrals(place: tuple[float, float]) -> None:
    x, y = place
    kernels = (
        lambda r, a, b: 1.0 / r,
        lambda r, a, b: a * a / r**3,
        lambda r, a, b: b * b / r**3,
        lambda r, a, b: a * b / r**3,
    )
    for found, kernel in zip(rectangle_integrals(x, y, 1.0, 0.5), kernels, strict=True):
        wanted = dblquad(
            lambda v, u, f=kernel: f(np.hypot(x - u, y - v), x - u, y - v), -1.0, 1.0, -0.5, 0.5
        )[0]
        assert found == pytest.approx(wanted, rel=1e-7)


def test_displacement_below_the_middle_of_a_square() -> None:
    """Johnson 3.26: a square of side 2 a under p sinks by 4.5 (1 - nu^2) p a/(pi E) ln... = 2.24 p a / E*."""
    influence = Influence(Grid(1, 1, 2e-3, 2e-3), STEEL)
    modulus = STEEL.young_modulus / (1.0 - STEEL.poisson_ratio**2)  # of one body; two sink twice as much
    sunk = influence.normal(np.full((1, 1), 1e6))[0, 0]
    assert sunk == pytest.approx(2.0 * 2.244 * 1e6 * 1e-3 / modulus, rel=1e-3)


def test_transforms_are_the_sums() -> None:
    influence, nu = Influence(GRID, STEEL), STEEL.poisson_ratio
    q = np.random.default_rng(0).normal(size=(2, *GRID.shape))
    flat = q.reshape(2, -1)
    here, ahead = pairs(0.0), pairs(GRID.dx)
    scale = influence.flexibility
    sunk = scale * (1.0 - nu) * here[0] @ flat[0]
    assert influence.normal(q[0]).ravel() == pytest.approx(sunk, abs=1e-12 * np.abs(sunk).max())

    def displacement(parts: np.ndarray) -> np.ndarray:
        of_x = ((1.0 - nu) * parts[0] + nu * parts[1]) @ flat[0] + nu * parts[3] @ flat[1]
        of_y = ((1.0 - nu) * parts[0] + nu * parts[2]) @ flat[1] + nu * parts[3] @ flat[0]
        return scale * np.stack([of_x, of_y])

    slip = (displacement(here) - displacement(ahead)) / GRID.dx
    assert influence.slip(q).reshape(2, -1) == pytest.approx(slip, abs=1e-12 * np.abs(slip).max())


def test_own_slip_is_the_slip_of_one_element() -> None:
    influence = Influence(GRID, STEEL)
    for k in range(2):
        q = np.zeros((2, *GRID.shape))
        q[k, 4, 6] = 1.0
        assert influence.slip(q)[k, 4, 6] == pytest.approx(influence.own_slip[k], rel=1e-12)


def test_rolling_takes_energy_whatever_the_traction() -> None:
    """q.Cq >= 0: what makes the solution of rolling unique."""
    influence = Influence(GRID, STEEL)
    rng = np.random.default_rng(1)
    for _ in range(20):
        q = rng.normal(size=(2, *GRID.shape))
        assert np.sum(q * influence.slip(q)) > 0.0


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ((0, 5, 1e-3, 1e-3), "nx = 0"),
        ((5, 5000, 1e-3, 1e-3), "ny = 5000"),
        ((5, 5, -1e-3, 1e-3), "dx = -0.001 m"),
        ((5, 5, 1e-3, float("inf")), "dy = inf m"),
        ((5, 5, 1e-3, 2.0), "dx/dy"),
    ],
)
def test_bad_grids_are_named(numbers: tuple[int, int, float, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Grid(*numbers)
