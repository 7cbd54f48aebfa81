"""Wear and cracks together: without wear, with faster wear, in balance, and against Burstow's way."""

from dataclasses import replace

import numpy as np
import pytest

from damage.patch_strips import FLANGE, TREAD
from damage.rcf.wear_and_cracks import CrackLayer, counts_after_wear, remaining_share
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.wheel_surface import Wheel, WheelSurface

GRID = LateralGrid(start=-0.002, step=0.001, count=4)
FAILURE_DEPTH = 2e-3  # m


def run(layer: CrackLayer, damage: float, worn: float, steps: int) -> CrackLayer:
    """Equal steps with damage and wear in all bins; both are of all steps together."""
    for _ in range(steps):
        layer = layer.after(np.full(GRID.count, damage / steps), np.full(GRID.count, worn / steps))
    return layer


def test_without_wear_cracks_grow_as_miners_sum() -> None:
    layer = run(CrackLayer.new(GRID, FAILURE_DEPTH), damage=0.8, worn=0.0, steps=7)
    np.testing.assert_allclose(layer.depth, 0.8 * FAILURE_DEPTH, rtol=1e-12)
    np.testing.assert_allclose(layer.depth, layer.depth_without_wear, rtol=1e-12)


@pytest.mark.parametrize("steps", [1, 3, 50])
def test_slower_wear_leaves_the_difference(steps: int) -> None:
    """The published rule: depth without wear less the depth worn off, however it is cut into steps."""
    layer = run(CrackLayer.new(GRID, FAILURE_DEPTH), damage=0.8, worn=0.6e-3, steps=steps)
    np.testing.assert_allclose(layer.depth, 0.8 * FAILURE_DEPTH - 0.6e-3, rtol=1e-12)
    np.testing.assert_allclose(layer.depth_without_wear, 0.8 * FAILURE_DEPTH, rtol=1e-12)
    np.testing.assert_allclose(layer.worn, 0.6e-3, rtol=1e-12)


def test_faster_wear_leaves_no_cracks() -> None:
    layer = run(CrackLayer.new(GRID, FAILURE_DEPTH), damage=0.8, worn=1.7e-3, steps=20)
    np.testing.assert_array_equal(layer.depth, 0.0)
    assert layer.depth_without_wear.min() > 1.5e-3


def test_wear_as_fast_as_growth_holds_the_cracks_and_faster_ends_them_in_time() -> None:
    """Cracks of 1 mm: held by wear at the rate of growth; with 0.25 mm more per step gone after 4 steps."""
    start = run(CrackLayer.new(GRID, FAILURE_DEPTH), damage=0.5, worn=0.0, steps=1)
    held = run(start, damage=5.0, worn=5.0 * FAILURE_DEPTH, steps=100)
    np.testing.assert_allclose(held.depth, 1e-3, rtol=1e-9)
    damage, worn = 0.25, 0.25 * FAILURE_DEPTH + 0.25e-3
    almost = run(start, 3.9 * damage, 3.9 * worn, steps=39)
    np.testing.assert_allclose(almost.depth, 0.1 * 0.25e-3, rtol=1e-9)
    np.testing.assert_allclose(run(start, 4.0 * damage, 4.0 * worn, steps=40).depth, 0.0, atol=1e-15)


def test_cracks_begin_anew_when_wear_stops() -> None:
    """What wore off in excess is not held against later cracks: bins do not go below no crack."""
    gone = run(CrackLayer.new(GRID, FAILURE_DEPTH), damage=0.1, worn=1e-3, steps=1)
    again = run(gone, damage=0.3, worn=0.0, steps=1)
    np.testing.assert_allclose(again.depth, 0.3 * FAILURE_DEPTH, rtol=1e-12)
    assert again.to_table().column_names == [
        "y_m", "damage", "damage_without_wear", "depth_m", "depth_without_wear_m", "worn_m",
    ]  # fmt: skip


def surface() -> WheelSurface:
    """One wheel, 4 bins: cracks of 0.4 mm on tread and flange together, worn by 0, 0.1, 0.4 and 0.5 mm."""
    zero = WheelSurface.zero((Wheel(1, 1, 1, 1),), GRID, PatchGrid(-0.001, 0.001, 2))
    damage, counts = np.zeros((1, 2, 4)), np.zeros((1, 2, 4, 2))
    damage[0, TREAD], damage[0, FLANGE] = 0.15, 0.05
    counts[0, TREAD], counts[0, FLANGE] = 1000.0, 10.0
    return replace(
        zero, distance=1.0, crack_damage=damage, rcf_number=counts, corrected_rcf_number=0.3 * counts,
        depth_by_part=np.array([[[0.0, 0.1e-3, 0.4e-3, 0.5e-3], [0.0] * 4]]),
    )  # fmt: skip


def test_counts_after_wear_by_every_approach() -> None:
    worn = surface()
    np.testing.assert_allclose(remaining_share(worn, FAILURE_DEPTH), [[1.0, 0.75, 0.0, 0.0]], atol=1e-12)
    left = counts_after_wear(worn, "geometric", FAILURE_DEPTH)
    for part in (TREAD, FLANGE):
        expected = worn.rcf_number[0, part] * np.array([[1.0], [0.75], [0.0], [0.0]])
        np.testing.assert_allclose(left[0, part], expected, atol=1e-9)
    np.testing.assert_array_equal(counts_after_wear(worn, "burstow"), worn.corrected_rcf_number)
    np.testing.assert_array_equal(counts_after_wear(worn, "none"), worn.rcf_number)


def test_the_share_does_not_depend_on_the_distance() -> None:
    np.testing.assert_allclose(
        remaining_share(surface().scaled(50e6), FAILURE_DEPTH), remaining_share(surface(), FAILURE_DEPTH)
    )


def test_bad_input() -> None:
    worn, layer = surface(), CrackLayer.new(GRID, FAILURE_DEPTH)
    with pytest.raises(ValueError, match="approach = 'dirks', allowed are 'none', 'burstow', 'geometric'"):
        counts_after_wear(worn, "dirks")
    with pytest.raises(ValueError, match="'geometric' needs failure_depth: no value is published"):
        counts_after_wear(worn, "geometric")
    with pytest.raises(ValueError, match=r"failure_depth = 0\.001 m has no use with approach = 'burstow'"):
        counts_after_wear(worn, "burstow", 1e-3)
    with pytest.raises(ValueError, match=r"failure_depth = 0\.0 m of a crack must be finite and > 0 m"):
        CrackLayer.new(GRID, 0.0)
    with pytest.raises(ValueError, match=r"worn has shape \(3,\), needed \(4,\): one value per bin"):
        layer.after(np.zeros(4), np.zeros(3))
    with pytest.raises(ValueError, match="damage must be finite and >= 0 in all bins"):
        layer.after(np.full(4, -0.1), np.zeros(4))
