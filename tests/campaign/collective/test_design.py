"""Cells of a product of axes: shares of levels, and expectation over turns."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hh_exudyn.campaign.collective.design import full_product, overlay

AXES = [[0.6, 0.4], [0.3, 0.5, 0.2], [0.1, 0.9]]


def marginal(cells: list[tuple[tuple[int, ...], float]], axis: int, level: int) -> float:
    return math.fsum(share for levels, share in cells if levels[axis] == level)


axis = st.lists(st.floats(0.01, 1.0), min_size=1, max_size=6).map(lambda x: [v / math.fsum(x) for v in x])


@settings(max_examples=50, deadline=None)
@given(st.lists(axis, min_size=1, max_size=6), st.integers(0, 10**6))
def test_an_overlay_keeps_every_share_with_few_cells(axes: list[list[float]], seed: int) -> None:
    cells = list(overlay(axes, np.random.default_rng(seed).random(len(axes))))
    for a, shares in enumerate(axes):
        for level, share in enumerate(shares):
            assert marginal(cells, a, level) == pytest.approx(share, abs=1e-11)
    assert len(cells) <= sum(map(len, axes)) + 1


def test_axes_without_turn_are_cut_as_in_the_picture() -> None:
    cells = dict(overlay([[0.6, 0.4], [0.3, 0.7]], np.zeros(2)))
    assert cells == pytest.approx({(0, 0): 0.3, (0, 1): 0.3, (1, 1): 0.4})


def test_the_expected_share_of_a_cell_is_the_product() -> None:
    rng = np.random.default_rng(3)
    wanted = dict(full_product(AXES))
    many = 4000
    found: dict[tuple[int, ...], list[float]] = {levels: [] for levels in wanted}
    for _ in range(many):
        cells = dict(overlay(AXES, rng.random(3)))
        for levels in wanted:
            found[levels].append(cells.get(levels, 0.0))
    for levels, share in wanted.items():
        error = np.std(found[levels]) / math.sqrt(many)
        assert np.mean(found[levels]) == pytest.approx(share, abs=4.0 * error)


def test_what_is_additive_in_the_axes_has_no_error() -> None:
    rng = np.random.default_rng(4)
    values = [rng.normal(size=len(shares)) for shares in AXES]

    def of(levels: tuple[int, ...]) -> float:
        return math.fsum(value[level] for value, level in zip(values, levels, strict=True))

    exact = math.fsum(share * of(levels) for levels, share in full_product(AXES))
    for _ in range(20):
        mine = math.fsum(share * of(levels) for levels, share in overlay(AXES, rng.random(3)))
        assert mine == pytest.approx(exact, abs=1e-12)


def test_the_full_product_leaves_out_cells_without_share() -> None:
    assert dict(full_product([[1.0, 0.0], [0.25, 0.75]])) == {(0, 0): 0.25, (0, 1): 0.75}
