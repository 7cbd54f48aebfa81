"""FaStrip on a patch given as strips: the ellipse is one such patch; empty and shifted strips."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.tangential import fastrip
from hh_exudyn.contact.tangential.api import creep_force, traction_field
from hh_exudyn.contact.tangential.strips import HALF_LENGTH, PRESSURE, STRIP_COLUMNS, WIDTH, Y
from hh_exudyn.contact.types import Fields, RollingPatch

A, B, N, MU = 4e-3, 7e-3, 1e5, 0.3
P_MAX = 1.5 * N / (math.pi * A * B)
CREEPAGES = [
    (1e-3, 0.0, 0.0),
    (1e-3, -8e-4, 0.2),
    (2e-4, 1e-4, 0.02),
    (0.0, 0.0, 2.5),
    (-4e-3, 6e-3, 3.0),
]


def rolling(creepage: tuple[float, float, float]) -> RollingPatch:
    """The patch in rolling."""
    return RollingPatch(A, B, N, *creepage, MU, STEEL.shear_modulus, STEEL.poisson_ratio)


def ellipse(count: int) -> NDArray[np.float64]:
    """An ellipse as strips."""
    lateral = -1.0 + (2.0 * np.arange(count) + 1.0) / count
    cosine = np.sqrt(1.0 - lateral**2)
    strips = np.zeros((count, STRIP_COLUMNS))
    strips[:, Y], strips[:, WIDTH] = B * lateral, 2.0 * B / count
    strips[:, HALF_LENGTH], strips[:, PRESSURE] = A * cosine, P_MAX * cosine
    return strips


def force(strips: NDArray[np.float64], creepage: tuple[float, float, float], cells: int = 30) -> np.ndarray:
    return np.array(fastrip.force_on_strips(strips, len(strips), rolling(creepage), cells))


@pytest.mark.parametrize("creepage", CREEPAGES)
@pytest.mark.parametrize("count", [1, 7, 8, 20, 63, 64, 65, 130])
def test_an_ellipse_as_strips_is_the_ellipse(creepage: tuple[float, float, float], count: int) -> None:
    strips = ellipse(count)
    exact = creep_force("fastrip", A, B, N, *creepage, MU, cells=(30, count))
    assert force(strips, creepage) == pytest.approx(
        [exact.x, exact.y, exact.moment], rel=1e-12, abs=1e-12 * MU * N
    )
    exact_field = traction_field("fastrip", A, B, N, *creepage, MU, cells=(30, count))
    fields = Fields(*np.full((5, count + 1, 30), 7.0))  # one row more than needed, which stays
    fastrip.field_on_strips(strips, count, rolling(creepage), fields)
    for name, array in fields._asdict().items():
        wanted = getattr(exact_field, name)
        assert array[:count] == pytest.approx(wanted, rel=1e-12, abs=1e-12 * abs(wanted).max()), name
        assert np.all(array[count:] == 7.0)


@pytest.mark.parametrize("creepage", CREEPAGES)
def test_empty_strips_change_nothing(creepage: tuple[float, float, float]) -> None:
    strips = ellipse(20)
    padded = np.zeros((29, STRIP_COLUMNS))
    rows = [i for i in range(29) if i not in (0, 1, 5, 9, 10, 11, 12, 20, 28)]
    padded[rows] = strips
    padded[5, Y], padded[5, WIDTH] = 1e-3, 1e-3
    assert force(padded, creepage) == pytest.approx(force(strips, creepage), rel=1e-12, abs=1e-12 * MU * N)
    fields = Fields(*np.full((5, 29, 12), np.nan))
    fastrip.field_on_strips(padded, 29, rolling(creepage), fields)
    assert np.all(np.isfinite(fields))
    assert not fields.pressure[5].any()
    assert not fields.q_x[5].any()
    assert not np.any(force(np.zeros((5, STRIP_COLUMNS)), creepage))


@pytest.mark.parametrize("creepage", CREEPAGES)
def test_without_spin_a_shifted_patch_has_only_another_lever(creepage: tuple[float, float, float]) -> None:
    shift = 3e-3
    creepage = (creepage[0], creepage[1], 0.0)
    strips = ellipse(25)
    here = force(strips, creepage)
    strips[:, Y] += shift
    there = force(strips, creepage)
    assert there[:2] == pytest.approx(here[:2], rel=1e-12, abs=1e-12 * MU * N)
    assert there[2] == pytest.approx(here[2] - shift * here[0], rel=1e-9, abs=1e-12 * MU * N)


@pytest.mark.parametrize("creepage", CREEPAGES)
def test_two_halves_of_a_strip_are_the_strip(creepage: tuple[float, float, float]) -> None:
    """Strips of any width: unequal widths converge to the same force."""
    edges = -np.cos(np.linspace(0.0, math.pi, 81)) * B  # narrow at the rims
    middle = 0.5 * (edges[1:] + edges[:-1])
    cosine = np.sqrt(1.0 - (middle / B) ** 2)
    strips = np.zeros((80, STRIP_COLUMNS))
    strips[:, Y], strips[:, WIDTH] = middle, np.diff(edges)
    strips[:, HALF_LENGTH], strips[:, PRESSURE] = A * cosine, P_MAX * cosine
    fine = creep_force("fastrip", A, B, N, *creepage, MU, cells=(30, 400))
    assert force(strips, creepage)[:2] == pytest.approx([fine.x, fine.y], abs=2e-3 * MU * N)


def test_a_strip_that_carries_more_slips_less() -> None:
    """A patch of two humps: full slip in the light one, stick in the heavy one; Coulomb holds in both."""
    strips = np.array([[-6e-3, 2e-3, 2e-3, 2e8], [6e-3, 2e-3, 5e-3, 1.5e9]])
    fields = Fields(*np.zeros((5, 2, 40)))
    patch = rolling((2e-3, 0.0, 0.0))._replace(a=4e-3, b=2e-3, normal_force=2.5e4)
    fastrip.field_on_strips(strips, 2, patch, fields)
    pressure, q_x, q_y, slip_x, slip_y = fields
    assert pressure.max(axis=1) == pytest.approx([2e8, 1.5e9], rel=1e-3)
    assert np.hypot(q_x, q_y)[0] == pytest.approx(MU * pressure[0], rel=1e-12)
    assert np.all(np.hypot(q_x, q_y) <= MU * pressure * (1.0 + 1e-9))
    assert np.any((slip_x[1] == 0.0) & (q_x[1] < 0.0))
    assert not slip_y.any()
