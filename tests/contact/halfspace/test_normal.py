"""Normal contact of half-spaces: Hertz, any gap, bounds, loads and approaches."""

import math

import numpy as np
import pytest

from hh_exudyn.contact.halfspace.influence import Grid, Influence
from hh_exudyn.contact.halfspace.normal import NormalSolution, normal_contact, quadratic_overlap
from hh_exudyn.contact.hertz import hertz_patch
from hh_exudyn.contact.material import STEEL

LOAD = 1e5


def ellipsoid(along: float, across: float, cells: int = 45) -> tuple[Influence, np.ndarray, object]:
    """Grid around Hertz's ellipse, overlap at approach zero, and the ellipse itself."""
    patch = hertz_patch(LOAD, along, across, STEEL)
    influence = Influence(Grid(cells, cells, 2.2 * patch.a / cells, 2.2 * patch.b / cells), STEEL)
    return influence, quadratic_overlap(influence.grid, along, across), patch


def conditions(influence: Influence, overlap: np.ndarray, found: NormalSolution, limit: float) -> float:
    """Largest violation of a condition for the gap, over the largest displacement."""
    displacement = influence.normal(found.pressure)
    gap = displacement - overlap - found.approach
    p = found.pressure
    assert np.all((p >= 0.0) & (p <= limit))
    free, none, most = (p > 0.0) & (p < limit), p == 0.0, p >= limit
    parts = (np.abs(gap[free]), -gap[none], gap[most])
    return max(float(part.max(initial=0.0)) for part in parts) / float(displacement.max())


@pytest.mark.parametrize("curvatures", [(1.0, 1.0), (1.0, 3.0), (1.0, 0.2), (0.8, 12.0)])
def test_hertz(curvatures: tuple[float, float]) -> None:
    influence, overlap, patch = ellipsoid(*curvatures)
    found = normal_contact(influence, overlap, load=LOAD)
    assert found.load == pytest.approx(LOAD, rel=1e-12)
    assert found.approach == pytest.approx(patch.approach, rel=2e-3)
    assert found.pressure.max() == pytest.approx(1.5 * LOAD / (math.pi * patch.a * patch.b), rel=3e-3)
    area = np.count_nonzero(found.pressure) * influence.grid.area
    assert area == pytest.approx(math.pi * patch.a * patch.b, rel=0.02)
    assert conditions(influence, overlap, found, math.inf) <= 1.1e-5
    again = normal_contact(influence, overlap, approach=patch.approach)
    assert again.load == pytest.approx(LOAD, rel=3e-3)
    assert conditions(influence, overlap, again, math.inf) <= 1.1e-5


def test_pressure_converges_to_hertz() -> None:
    errors = []
    for cells in (15, 30, 60):
        influence, overlap, patch = ellipsoid(1.0, 1.0, cells)
        grid = influence.grid
        hertz = np.sqrt(np.maximum(1.0 - (grid.x / patch.a) ** 2 - (grid.y[:, None] / patch.b) ** 2, 0.0))
        hertz *= 1.5 * LOAD / (math.pi * patch.a * patch.b)
        found = normal_contact(influence, overlap, load=LOAD).pressure
        errors.append(np.abs(found - hertz).sum() / hertz.sum())
    assert errors[1] < 0.6 * errors[0]
    assert errors[2] < 0.6 * errors[1]
    assert errors[2] < 0.01


def test_a_flat_punch() -> None:
    """A rigid square: P = 2 beta E* delta sqrt(A/pi), beta = 1.012 (King, Int. J. Solids Structures 1987)."""
    influence = Influence(Grid(60, 60, 1e-4, 1e-4), STEEL)
    found = normal_contact(influence, np.zeros((60, 60)), load=1e4)
    modulus = STEEL.young_modulus / (2.0 * (1.0 - STEEL.poisson_ratio**2))
    assert np.all(found.pressure > 0.0)
    assert found.approach == pytest.approx(
        1e4 / (2.0 * 1.012 * modulus * 6e-3 / math.sqrt(math.pi)), rel=0.01
    )


def test_mirrored_and_scaled() -> None:
    influence, overlap, _ = ellipsoid(1.0, 3.0)
    rng = np.random.default_rng(0)
    rough = overlap + 1e-6 * rng.normal(size=overlap.shape)
    found = normal_contact(influence, rough, load=LOAD, tolerance=1e-8)
    mirrored = normal_contact(influence, rough[::-1, ::-1], load=LOAD, tolerance=1e-8)
    assert mirrored.pressure[::-1, ::-1] == pytest.approx(found.pressure, abs=1e-4 * found.pressure.max())
    twice = normal_contact(influence, 2.0 * rough, load=2.0 * LOAD, tolerance=1e-8)
    assert twice.pressure == pytest.approx(2.0 * found.pressure, abs=1e-4 * found.pressure.max())


@pytest.mark.parametrize("share", [0.9, 0.7, 0.5, 0.4])
def test_a_limit_of_pressure_keeps_the_load(share: float) -> None:
    _, _, patch = ellipsoid(1.0, 1.0)
    wide = Influence(Grid(45, 45, 3.2 * patch.a / 45, 3.2 * patch.b / 45), STEEL)
    overlap = quadratic_overlap(wide.grid, 1.0, 1.0)
    free = normal_contact(wide, overlap, load=LOAD)
    limit = share * free.pressure.max()
    found = normal_contact(wide, overlap, load=LOAD, limit=limit)
    assert found.load == pytest.approx(LOAD, rel=1e-4)
    assert found.pressure.max() == pytest.approx(limit)
    assert np.count_nonzero(found.pressure) >= np.count_nonzero(free.pressure)
    assert found.approach > free.approach
    assert conditions(wide, overlap, found, limit) <= 1.1e-5
    assert normal_contact(wide, overlap, load=LOAD, limit=2.0 * limit / share).load == pytest.approx(LOAD)


def test_weights_are_shares_of_the_load() -> None:
    """A plane patch inclined by g: the load is N cos g, and the approach along the normal delta cos g."""
    influence, overlap, _ = ellipsoid(1.0, 1.0)
    cosine = math.cos(0.5)
    plane = normal_contact(influence, overlap, load=LOAD)
    inclined = normal_contact(influence, overlap, load=LOAD * cosine, weight=np.full(overlap.shape, cosine))
    assert inclined.pressure == pytest.approx(plane.pressure, abs=1e-4 * plane.pressure.max())
    assert inclined.approach * cosine == pytest.approx(plane.approach, rel=1e-4)


def test_a_start_saves_iterations_and_changes_nothing() -> None:
    influence, overlap, _ = ellipsoid(1.0, 3.0)
    cold = normal_contact(influence, overlap, load=LOAD)
    other = normal_contact(influence, 1.02 * overlap, load=1.01 * LOAD)
    warm = normal_contact(influence, overlap, load=LOAD, start=other.pressure)
    assert warm.iterations < cold.iterations
    assert warm.pressure == pytest.approx(cold.pressure, abs=3e-3 * cold.pressure.max())


def test_bodies_apart_have_no_pressure() -> None:
    influence, overlap, _ = ellipsoid(1.0, 1.0)
    found = normal_contact(influence, overlap - 1e-3, approach=0.0)
    assert not found.pressure.any()
    assert found.load == 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({}, "one of both"),
        ({"load": 1.0, "approach": 0.0}, "one of both"),
        ({"load": -1.0}, "load = -1.0 N"),
        ({"load": 1e9, "limit": 1e9}, "what the grid carries"),
        ({"approach": math.nan}, "approach = nan m"),
        ({"load": 1.0, "limit": 0.0}, "limit = 0.0 Pa"),
        ({"load": 1.0, "start": np.zeros((2, 2))}, "start"),
        ({"load": 1.0, "weight": np.zeros((9, 9))}, "weight > 0"),
    ],
)
def test_bad_input_is_named(change: dict, message: str) -> None:
    influence = Influence(Grid(9, 9, 1e-4, 1e-4), STEEL)
    with pytest.raises(ValueError, match=message):
        normal_contact(influence, np.zeros((9, 9)), **change)
    with pytest.raises(ValueError, match="shape"):
        normal_contact(influence, np.zeros((9, 8)), load=1.0)
    with pytest.raises(ValueError, match="finite"):
        normal_contact(influence, np.full((9, 9), np.nan), load=1.0)
