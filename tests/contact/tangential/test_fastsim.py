"""FASTSIM: Kalker's slopes, his published values, another implementation's forces, and the energy balance."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.tangential.api import cell_areas, creep_force, traction_field
from hh_exudyn.contact.tangential.fastsim_march import stiffnesses
from hh_exudyn.contact.tangential.kalker import kalker_coefficients

VARIANTS = ("fastsim", "fastsim_single", "fastsim_elliptic")
REFERENCE = Path(__file__).parents[3] / "hh_exudyn" / "data" / "validation" / "creep_forces.csv"


def cases() -> list[dict[str, str]]:
    with REFERENCE.open() as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def arguments(case: dict[str, str]) -> tuple[float, ...]:
    """a, b, N, nu_x, nu_y, phi, mu in SI units."""
    a, b, force, friction = (float(case[name]) for name in ("a", "b", "N", "mu"))
    nu_x, nu_y, phi = (float(case[name]) for name in ("cksi", "ceta", "cphi"))
    assert (float(case["G"]) * 1e6, float(case["nu"])) == (STEEL.shear_modulus, STEEL.poisson_ratio)
    return a * 1e-3, b * 1e-3, force, nu_x, nu_y, phi * 1e3, friction


def kalker_1982(
    u_x: float, u_y: float, f_x: float, f_y: float, along: int, across: int, tolerance: float
) -> tuple[float, float]:
    """Kalker's own program of 1982, written anew: scaled forces (T_x, T_y) of his scaled creepages.

    First order, on the unit circle with bound 1 - x^2 - y^2. Where the spin pole u_x = f_x y can lie in the
    ellipse the strips are fitted to it and halved towards it down to the tolerance.
    """

    def row(y: float, width: float) -> tuple[float, float]:
        edge = math.sqrt(1.0 - y * y)
        step = 2.0 * edge / along
        p_x = p_y = t_x = t_y = 0.0
        last = edge
        for k in range(along):
            x = edge - (k + 0.5) * step
            p_x -= (u_x - y * f_x) * (last - x)
            p_y -= (u_y + f_y * 0.5 * (last + x)) * (last - x)
            ratio = math.hypot(p_x, p_y) / (1.0 - y * y - x * x)
            if ratio > 1.0:
                p_x, p_y = p_x / ratio, p_y / ratio
            t_x, t_y, last = t_x + p_x * step * width, t_y + p_y * step * width, x
        return t_x, t_y

    pole = abs(u_x) <= abs(f_x) and abs(u_y) <= abs(f_y)
    rows: list[tuple[float, float]] = []  # y, width
    for side in (1.0, -1.0) if pole else (1.0,):
        end = u_x / f_x * side if pole else -1.0
        width = (1.0 - end) / (math.floor((1.0 - end) * across / 2.0) + 1.0) if pole else 2.0 / across
        y = 1.0 - 0.5 * width
        while y > end + width:
            rows.append((side * y, width))
            y -= width
        while pole and tolerance < 0.5 * width:  # the strip next to the pole, halved
            width *= 0.5
            rows.append((side * (y + 0.5 * width), width))
            y -= 0.5 * width
        rows.append((side * y, width))
    total = np.sum([row(y, width) for y, width in rows], axis=0) * 2.0 / math.pi
    return -float(total[0]), float(total[1])  # his signs


def scaled(u_x: float, u_y: float, f_x: float, f_y: float, cells: int) -> tuple[float, float]:
    """The same through the library: an ellipse of a/b = f_y/f_x."""
    a, force, friction = 5e-3, 1e5, 0.3
    b = a * f_x / f_y
    c11, c22, c23, _ = kalker_coefficients(a / b, STEEL.poisson_ratio)
    stiff_x, stiff_y, stiff_phi = stiffnesses(a, b, STEEL.shear_modulus, c11, c22, c23)
    unit = friction * 2.0 * force / (math.pi * a * b) / a
    found = creep_force(
        "fastsim",
        a,
        b,
        force,
        u_x * unit / stiff_x,
        u_y * unit / stiff_y,
        f_y / a * unit / stiff_phi,
        friction,
        cells=(cells, cells),
    )
    return -found.x / (friction * force), found.y / (friction * force)


@pytest.mark.parametrize(
    ("creepage", "tolerance", "published"),
    [
        ((0.0, -2.0, 2.0, 4.0), 3.0, (0.0, 0.1843)),
        ((0.0, -2.0, 2.0, 4.0), 0.09, (0.0, 0.1850)),
        ((1.0, -2.0, 2.0, 4.0), 0.09, (0.5720, 0.1838)),
        ((1.0, -2.0, 2.0, 4.0), 3.0, (0.5684, 0.1857)),
        ((1.0, -2.0, 2.0, 1.0), 0.09, (0.4530, 0.8299)),
    ],
)
def test_kalker_1982(
    creepage: tuple[float, float, float, float], tolerance: float, published: tuple[float, float]
) -> None:
    # his values belong to his grid of 5 x 5: his program, written anew, gives them there, and on a fine grid
    # it gives what the library gives
    assert kalker_1982(*creepage, 5, 5, tolerance) == pytest.approx(published, rel=0.005, abs=1e-6)
    fine = kalker_1982(*creepage, 200, 100, 1.0)
    assert scaled(*creepage, 60) == pytest.approx(fine, abs=0.002)


def slope_errors(theory: str, ratio: float, cells: tuple[int, int]) -> list[float]:
    """Slopes at zero creepage over Kalker's, less 1: longitudinal, lateral, spin's lateral force."""
    a, b = 5e-3 * math.sqrt(ratio), 5e-3 / math.sqrt(ratio)
    c11, c22, c23, _ = kalker_coefficients(ratio, STEEL.poisson_ratio)
    stiff, small = STEEL.shear_modulus * a * b, 1e-7
    slope_x = creep_force(theory, a, b, 1e5, small, 0.0, 0.0, 0.3, cells=cells).x / small
    slope_y = creep_force(theory, a, b, 1e5, 0.0, small, 0.0, 0.3, cells=cells).y / small
    slope_phi = creep_force(theory, a, b, 1e5, 0.0, 0.0, small, 0.3, cells=cells).y / small
    wanted = (c11 * stiff, c22 * stiff, c23 * stiff * math.sqrt(a * b))
    return [
        -slope / kalker - 1.0 for slope, kalker in zip((slope_x, slope_y, slope_phi), wanted, strict=True)
    ]


@pytest.mark.parametrize("theory", VARIANTS)
@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0])
def test_the_slopes_at_zero_creepage_are_kalkers(theory: str, ratio: float) -> None:
    assert slope_errors(theory, ratio, (20, 20)) == pytest.approx([0.0] * 3, abs=0.01)
    assert slope_errors(theory, ratio, (200, 200)) == pytest.approx([0.0] * 3, abs=5e-4)


@pytest.mark.parametrize(("theory", "order"), [("fastsim", 2.0), ("fastsim_elliptic", 1.5)])
def test_the_slopes_converge(theory: str, order: float) -> None:
    """The last cell costs no order; the elliptic bound's root at the leading edge does."""
    coarse, fine = (slope_errors(theory, 1.0, (cells, 300))[0] for cells in (30, 60))
    assert math.log2(coarse / fine) == pytest.approx(order, abs=0.1)


@pytest.mark.parametrize("theory", VARIANTS)
def test_the_field_carries_the_force_of_small_creepage(theory: str) -> None:
    """Where all cells stick, the last one too: the traction grows to the trailing edge."""
    a, b, creepage = 5e-3, 4e-3, (1e-7, -2e-7, 3e-5)
    field = traction_field(theory, a, b, 1e5, *creepage, 0.3, cells=(40, 40))
    force = creep_force(theory, a, b, 1e5, *creepage, 0.3, cells=(40, 40))
    areas = cell_areas(a, b, 40, 40)
    assert np.sum(field.q_x * areas) == pytest.approx(force.x, rel=5e-3)
    assert np.sum(field.q_y * areas) == pytest.approx(force.y, rel=5e-3)
    assert np.all(np.diff(np.abs(field.q_x), axis=1) < 0.0)


@pytest.mark.parametrize("theory", VARIANTS)
def test_the_last_cell_makes_no_jump(theory: str) -> None:
    """Creepages from stick of the last cell to its full slip: small steps of the force, Coulomb's law."""
    last = None
    for share in np.linspace(0.0, 1.0, 200):
        creepage = (1e-3 * share, -1.5e-3 * share, 0.6 - 1.2 * share)
        force = creep_force(theory, 5e-3, 4e-3, 1e5, *creepage, 0.3, cells=(8, 6))
        now = np.array([force.x, force.y]) / 3e4
        assert math.hypot(*now) <= 1.0
        assert last is None or np.abs(now - last).max() < 0.02
        last = now
    field = traction_field(theory, 5e-3, 4e-3, 1e5, 4e-4, -2e-4, 0.3, 0.3, cells=(8, 6))
    assert np.all(np.hypot(field.q_x, field.q_y) <= 0.3 * field.pressure)


def test_the_forces_are_those_of_another_fastsim() -> None:
    # CONTACT's classical FASTSIM on 200 x 200 cells, first order
    for case in cases():
        a, b, force, *_, friction = arguments(case)
        found = creep_force("fastsim", *arguments(case), cells=(50, 50))
        unit = friction * force
        other = [float(case[f"fastsim3_220_{name}"]) for name in ("fx", "fy", "mz")]
        assert found.x / unit == pytest.approx(other[0], abs=0.01), case["id"]
        assert found.y / unit == pytest.approx(other[1], abs=0.01), case["id"]
        assert found.moment / (unit * math.sqrt(a * b)) == pytest.approx(other[2], abs=0.01), case["id"]


@pytest.mark.parametrize("theory", VARIANTS)
def test_friction_dissipates_the_power_of_the_creepages(theory: str) -> None:
    for case in cases()[::7]:
        a, b, _, nu_x, nu_y, phi, _ = arguments(case)
        field = traction_field(theory, *arguments(case), cells=(31, 30))
        areas = cell_areas(a, b, 30, 31)
        force_x, force_y = np.sum(field.q_x * areas), np.sum(field.q_y * areas)
        moment = np.sum((field.x * field.q_y - field.y * field.q_x) * areas)
        dissipated = np.sum((field.q_x * field.slip_x + field.q_y * field.slip_y) * areas)
        assert dissipated == pytest.approx(force_x * nu_x + force_y * nu_y + moment * phi, rel=1e-6)


@pytest.mark.parametrize("nu_x", [1e-3, 3e-3, 1e-2])
def test_without_spin_slip_is_the_rigid_slip_less_the_strain(nu_x: float) -> None:
    """With one creepage alone the flexibility that balances the energy is Kalker's L_x."""
    a, b = 6e-3, 4e-3
    field = traction_field("fastsim", a, b, 1e5, nu_x, 0.0, 0.0, 0.3, cells=(40, 20))
    c11, *_ = kalker_coefficients(a / b, STEEL.poisson_ratio)
    flexibility = 8.0 * a / (3.0 * STEEL.shear_modulus * c11)
    # in cells behind one another, both whole in slip: mean over the two of nu_x - L dq/dx
    step = np.diff(field.x, axis=1)
    strain = flexibility * np.diff(field.q_x, axis=1) / step
    mean = 0.5 * (field.slip_x[:, 1:] + field.slip_x[:, :-1])
    inner = (field.slip_x[:, 1:] > 0.0) & (field.slip_x[:, :-1] > 0.0)
    inner[:, :-1] &= field.slip_x[:, 2:] > 0.0  # not the cell in which slip begins
    assert inner.any()
    assert mean[inner] == pytest.approx((nu_x - strain)[inner], rel=1e-3, abs=1e-3 * nu_x)
