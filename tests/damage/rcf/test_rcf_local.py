"""Local fatigue indices: full slip by hand, the largest over cells, the global index as their limit."""

import numpy as np
import pytest

from damage.log_input.states import LOAD_COLUMNS
from damage.material import ER7
from damage.rcf.local import distributed_index, local_indices, strip_fatigue
from damage.rcf.surface_index import surface_fatigue_index
from hh_exudyn.contact.tangential.api import traction_field
from hh_exudyn.contact.tangential.registry import THEORIES, field_kernel
from hh_exudyn.contact.types import Fields, RollingPatch

K = ER7.shear_yield
TIGHT = {"a": 7.5e-3, "b": 2.9e-3, "normal_force": 142668.0}  # first row of table 3-2
FULL_SLIP = {"nu_x": 0.0, "nu_y": 0.2, "phi": 0.0, "friction": 0.37}
PEAK = 1.5 * TIGHT["normal_force"] / (np.pi * TIGHT["a"] * TIGHT["b"])


@pytest.mark.parametrize(
    ("theory", "cells"),
    [("fastrip", (40, 30)), ("fastsim", (64, 9)), ("fastsim_elliptic", (147, 11)), ("strip", (3, 4))],
)
def test_indices_are_the_largest_over_the_cells_of_a_strip(theory: str, cells: tuple[int, int]) -> None:
    creepages = {"nu_x": 1e-3, "nu_y": -2e-3, "phi": 0.5, "friction": 0.37}
    found = local_indices(TIGHT | creepages, ER7, theory, cells)
    field = traction_field(theory, **TIGHT, **creepages, cells=cells)
    stress = np.hypot(field.q_x, field.q_y)
    np.testing.assert_allclose(found.stress_index[0], stress.max(axis=1) - K, rtol=1e-12)
    index = ((stress - K) / field.pressure).max(axis=1)
    np.testing.assert_allclose(found.fatigue_index[0], index, rtol=1e-12)
    np.testing.assert_allclose(found.y[0], field.y[:, 0], rtol=1e-14)
    assert found.width[0] * cells[1] == pytest.approx(2.0 * TIGHT["b"])


def test_the_order_of_figure_3_20() -> None:
    """The leading outer wheel of the demo in its curve of 450 m (Q/P = .38): global < FaStrip < FASTSIM."""
    patch = {"a": 10.739e-3, "b": 1.8924e-3, "normal_force": 137519.0}
    creepages = {"nu_x": -3.8115e-3, "nu_y": 0.8078e-3, "phi": 0.7989, "friction": 0.4}
    spread = distributed_index(36262.0, -37772.0, 137519.0, patch["a"], patch["b"], K)
    fastrip, fastsim = (local_indices(patch | creepages, ER7, theory) for theory in ("fastrip", "fastsim"))
    # measured: .288, .307, .330
    assert 0.28 < spread.max() < fastrip.fatigue_index.max() - 0.01 < fastsim.fatigue_index.max() - 0.02 < 0.4


def test_full_slip_by_hand() -> None:
    """In full slip |q| = mu p everywhere, so FI = mu - k/p and SI = mu p - k, both largest at x = 0."""
    found = local_indices(TIGHT | FULL_SLIP, ER7, cells=(51, 51))
    pressure = PEAK * np.sqrt(1.0 - (found.y[0] / TIGHT["b"]) ** 2)
    np.testing.assert_allclose(found.stress_index[0], 0.37 * pressure - K, rtol=1e-9)
    np.testing.assert_allclose(found.fatigue_index[0], 0.37 - K / pressure, rtol=1e-9)
    # in numbers: p0 = 1.5 * 142668 N / (pi 7.5 mm 2.9 mm) = 3131.9 MPa, k = 300.2 MPa
    assert found.stress_index[0].max() == pytest.approx(0.37 * 3131.9e6 - 300.2e6, rel=1e-4)
    assert found.fatigue_index[0].max() == pytest.approx(0.37 - 300.2 / 3131.9, rel=1e-4)


def test_in_full_slip_the_global_index_is_the_local_one() -> None:
    """There q = (Q/P) p in every cell, which is what the global index assumes."""
    local = local_indices(TIGHT | FULL_SLIP, ER7, cells=(51, 51))
    force = 0.37 * TIGHT["normal_force"]
    spread = distributed_index(0.0, force, TIGHT["normal_force"], TIGHT["a"], TIGHT["b"], K, strips=51)
    np.testing.assert_allclose(local.fatigue_index, spread, rtol=1e-9)
    middle = surface_fatigue_index(0.0, force, TIGHT["normal_force"], TIGHT["a"], TIGHT["b"], K)
    assert spread[0, 25] == pytest.approx(float(middle), rel=1e-12)


def test_a_patch_without_creepage_or_force_has_no_fatigue() -> None:
    at_rest = local_indices(TIGHT | FULL_SLIP | {"nu_y": 0.0}, ER7)
    np.testing.assert_array_equal(at_rest.stress_index, -K)
    assert np.all(at_rest.fatigue_index < 0.0)
    unloaded = local_indices(
        dict(zip(LOAD_COLUMNS, (1e-3, 1e-3, 0.0, 1e-3, 0.0, 0.0, 0.4), strict=True)), ER7
    )
    np.testing.assert_array_equal(unloaded.fatigue_index, -np.inf)
    np.testing.assert_array_equal(unloaded.stress_index, -K)


def test_a_batch_is_its_states_one_by_one_and_a_mirrored_patch_is_the_mirror() -> None:
    nu_y = np.array([-3e-3, 1e-3, 4e-3])
    state = TIGHT | {"nu_x": 5e-4, "friction": 0.4, "phi": 0.8}
    batch = local_indices(state | {"nu_y": nu_y}, ER7)
    for row, value in enumerate(nu_y):
        alone = local_indices(state | {"nu_y": value}, ER7)
        np.testing.assert_array_equal(alone.fatigue_index[0], batch.fatigue_index[row])
    mirror = local_indices(state | {"nu_y": -nu_y, "phi": -0.8}, ER7)
    np.testing.assert_allclose(mirror.fatigue_index, batch.fatigue_index[:, ::-1], rtol=1e-9)
    assert batch.to_table().num_rows == 3 * 50


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"nu_x": [0.0, np.nan]}, r"nu_x = nan \[-\] in row 1 must be finite \(1 such rows among 2\)"),
        ({"normal_force": -5.0}, r"normal_force = -5 N in row 0 must be finite and >= 0 N"),
        ({"theory": "polach"}, r"theory = 'polach'; theories with a stress field: "),
        ({"cells": (0, 5)}, r"cells = \(0, 5\) must be at least 1"),
    ],
)
def test_bad_input(change: dict, message: str) -> None:
    state = TIGHT | {name: value for name, value in (FULL_SLIP | change).items() if name in LOAD_COLUMNS}
    how = {name: value for name, value in change.items() if name not in LOAD_COLUMNS}
    with pytest.raises(ValueError, match=message):
        local_indices(state, ER7, **how)
    with pytest.raises(ValueError, match="normal_force must be > 0 N; 1 values are not"):
        distributed_index(0.0, 1.0, 0.0, 1e-3, 1e-3, K)


@pytest.mark.parametrize("theory", ["fastrip", "fastsim", "fastsim_elliptic"])
@pytest.mark.parametrize("cells", [(50, 50), (7, 9)])
def test_the_loop_finds_the_same_indices_above_zero(theory: str, cells: tuple[int, int]) -> None:
    """`strip_fatigue` passes over strips and cells by bounds; the batch looks at every cell."""
    generator = np.random.default_rng(5)
    rows = 60
    a, b = generator.uniform(4e-3, 8e-3, (2, rows))
    load, friction = generator.uniform(40e3, 160e3, rows), generator.uniform(0.1, 0.6, rows)
    nu_x, nu_y, phi = generator.normal(0.0, 1.0, (3, rows)) * [[1e-3], [2e-3], [0.4]]
    states = dict(zip(LOAD_COLUMNS, (a, b, load, nu_x, nu_y, phi, friction), strict=True))
    every = local_indices(states, ER7, theory, cells)
    fields, found = Fields(*np.zeros((5, cells[1], cells[0]))), np.zeros((rows, cells[1]))
    for i in range(rows):
        patch = RollingPatch(
            a[i], b[i], load[i], nu_x[i], nu_y[i], phi[i], friction[i],
            ER7.elastic.shear_modulus, ER7.elastic.poisson_ratio,
        )  # fmt: skip
        field_kernel(THEORIES[theory], patch, fields)
        strip_fatigue(fields, ER7.shear_yield, friction[i], found[i])
    np.testing.assert_allclose(found, np.maximum(every.fatigue_index, 0.0), rtol=1e-11, atol=1e-13)
    np.testing.assert_array_equal(found > 0.0, every.stress_index > 0.0)
    assert 0.1 < np.mean(found > 0.0) < 0.9
