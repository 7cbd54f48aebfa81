"""Stresses below the surface: point loads summed, equilibrium, limits at the surface, Johnson's values."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from hh_exudyn.contact.halfspace.influence import Grid
from hh_exudyn.contact.halfspace.subsurface import stress_below
from hh_exudyn.contact.halfspace.validation import deepest_shear
from hh_exudyn.contact.material import Material
from hh_exudyn.contact.normal.subsurface import line_contact_stress

NU = 0.28
MATERIAL = Material(82e9, NU)
NAMES = ("sigma_x", "sigma_y", "sigma_z", "tau_xy", "tau_xz", "tau_yz")


def of_normal_point(x: float, y: float, z: float) -> tuple[float, ...]:
    """2 pi times the stresses by a unit force into the body (Johnson 1985, equations 3.20)."""
    r2, rho, k = x * x + y * y, np.sqrt(x * x + y * y + z * z), 1.0 - 2.0 * NU
    return (
        k / r2 * ((1.0 - z / rho) * (x * x - y * y) / r2 + z * y * y / rho**3) - 3.0 * z * x * x / rho**5,
        k / r2 * ((1.0 - z / rho) * (y * y - x * x) / r2 + z * x * x / rho**3) - 3.0 * z * y * y / rho**5,
        -3.0 * z**3 / rho**5,
        k / r2 * ((1.0 - z / rho) * 2.0 * x * y / r2 - x * y * z / rho**3) - 3.0 * x * y * z / rho**5,
        -3.0 * x * z * z / rho**5,
        -3.0 * y * z * z / rho**5,
    )


def of_tangential_point(x: float, y: float, z: float) -> tuple[float, ...]:
    """The same by a unit force along x (Johnson 1985, equations 3.76)."""
    rho, k = np.sqrt(x * x + y * y + z * z), 1.0 - 2.0 * NU
    deep = rho + z
    of_cubes = 1.0 / (rho**3 * deep**2) + 2.0 / (rho**2 * deep**3)
    return (
        -3.0 * x**3 / rho**5 + k * (x / rho**3 - 3.0 * x / (rho * deep**2) + x**3 * of_cubes),
        -3.0 * x * y * y / rho**5 + k * (x / rho**3 - x / (rho * deep**2) + x * y * y * of_cubes),
        -3.0 * x * z * z / rho**5,
        -3.0 * x * x * y / rho**5 + k * (-y / (rho * deep**2) + x * x * y * of_cubes),
        -3.0 * x * x * z / rho**5,
        -3.0 * x * y * z / rho**5,
    )


@pytest.mark.parametrize("load", ["pressure", "traction_x", "traction_y"])
def test_an_element_is_many_point_loads(load: str) -> None:
    grid, depth = Grid(5, 5, 1.0, 0.7), 0.4
    pressure, traction = np.zeros((5, 5)), np.zeros((2, 5, 5))
    if load == "pressure":
        pressure[2, 2] = 1.0
    else:
        traction[int(load == "traction_y"), 2, 2] = 1.0
    found = stress_below(grid, np.array([depth]), pressure, traction, MATERIAL)
    place = (3, 4)  # one element across, two along from the loaded one
    x, y = grid.x[4], grid.y[3]
    for k, name in enumerate(NAMES):
        if load == "traction_y":  # x and y exchanged
            turned = [1, 0, 2, 3, 5, 4][k]
            value = dblquad(
                lambda v, u, k=turned: of_tangential_point(y - v, x - u, depth)[k], -0.5, 0.5, -0.35, 0.35
            )[0]
        else:
            kernel = of_normal_point if load == "pressure" else of_tangential_point
            value = dblquad(lambda v, u, k=k, f=kernel: f(x - u, y - v, depth)[k], -0.5, 0.5, -0.35, 0.35)[0]
        assert getattr(found, name)[(0, *place)] == pytest.approx(value / (2.0 * np.pi), rel=1e-7), name


def test_just_below_the_surface() -> None:
    """sigma_z = -p, tau_xz = -q."""
    grid = Grid(9, 9, 1e-3, 1e-3)
    rng = np.random.default_rng(0)
    pressure, traction = rng.uniform(1e8, 2e8, (9, 9)), rng.normal(size=(2, 9, 9)) * 1e8
    found = stress_below(grid, np.array([1e-8]), pressure, traction)
    assert found.sigma_z[0] == pytest.approx(-pressure, rel=1e-3)
    assert found.tau_xz[0] == pytest.approx(-traction[0], abs=1e5)
    assert found.tau_yz[0] == pytest.approx(-traction[1], abs=1e5)


def test_every_depth_carries_the_load() -> None:
    """A wide plane below a small loaded square carries P and Q."""
    grid = Grid(121, 121, 1e-3, 1e-3)
    pressure, traction = np.zeros((121, 121)), np.zeros((2, 121, 121))
    pressure[60, 60], traction[0, 60, 60] = 1e9, 3e8
    found = stress_below(grid, np.array([1e-3, 3e-3]), pressure, traction)
    for k in range(2):
        assert found.sigma_z[k].sum() == pytest.approx(-1e9, rel=0.02)
        assert found.tau_xz[k].sum() == pytest.approx(-3e8, rel=0.08)


def test_a_long_patch_is_the_line_contact() -> None:
    """Against the closed forms in plane strain of `normal.subsurface`, with friction."""
    a, p0, mu = 1.0, 1.0, 0.3
    grid = Grid(80, 101, 2.0 * a / 80, 2.0 * a)
    pressure = np.tile(p0 * np.sqrt(1.0 - (grid.x / a) ** 2), (grid.ny, 1))
    depth = np.array([0.3, 0.8])
    found = stress_below(grid, depth, pressure, np.stack([mu * pressure, 0.0 * pressure]), MATERIAL)
    wanted = line_contact_stress(grid.x, depth[:, None], a, p0, mu, poisson_ratio=NU)
    for name in ("sigma_x", "sigma_y", "sigma_z", "tau_xz"):
        assert getattr(found, name)[:, 50] == pytest.approx(getattr(wanted, name), abs=4e-3), name
    assert found.max_shear[:, 50] == pytest.approx(wanted.max_shear, abs=4e-3)
    assert found.von_mises[:, 50] == pytest.approx(wanted.von_mises, abs=4e-3)


def test_johnsons_circle() -> None:
    grid = Grid(45, 45, 2.2 / 45, 2.2 / 45)
    pressure = np.sqrt(np.maximum(1.0 - grid.x**2 - grid.y[:, None] ** 2, 0.0))
    largest, depth = deepest_shear(pressure, grid, np.arange(0.4, 0.56, 0.01), 0.3)
    assert largest == pytest.approx(0.31, abs=2e-3)
    assert depth == pytest.approx(0.48, abs=0.015)


def test_bad_input_is_named() -> None:
    grid = Grid(4, 3, 1e-3, 1e-3)
    with pytest.raises(ValueError, match="depth"):
        stress_below(grid, np.array([0.0]), np.zeros((3, 4)))
    with pytest.raises(ValueError, match="shape"):
        stress_below(grid, np.array([1e-3]), np.zeros((4, 3)))
