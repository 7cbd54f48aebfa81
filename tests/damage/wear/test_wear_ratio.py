"""Wear ratio: what it keeps exactly, and what it tells about the rest."""

from collections.abc import Callable

import numpy as np
import pyarrow
import pytest

from damage.model import DamageModel
from damage.surface.accumulate import accumulate
from damage.wear.batch import WearDepths, wear_depths
from damage.wear.laws import wear_law
from damage.wear.wear_ratio import WearRatio

MakeLog = Callable[..., pyarrow.Table]
ENERGY = np.array([[0.0, 2.0, 4.0, 1.0], [0.0, 1.0, 3.0, 0.0]])
DEPTH = np.array([[0.0, 6.0, 4.0, 2.0], [0.0, 6.0, 10.0, 0.0]])


def test_ratio_of_the_sums_by_hand() -> None:
    """12/3, 14/7 and 2/1 where there was energy."""
    ratio = WearRatio.learn(DEPTH, ENERGY)
    np.testing.assert_array_equal(ratio.ratio, [np.nan, 4.0, 2.0, 2.0])
    assert ratio.mean == 28.0 / 11.0
    np.testing.assert_array_equal(ratio.apply([1.0, 1.0, 10.0, 0.0]), [28.0 / 11.0, 4.0, 20.0, 0.0])
    assert ratio.to_table().column_names == ["depth", "energy", "ratio"]


def test_learnt_steps_keep_their_volume_and_place() -> None:
    ratio = WearRatio.learn(DEPTH, ENERGY)
    error = ratio.error(ENERGY.sum(axis=0), DEPTH.sum(axis=0))
    assert (error.volume, error.misplaced, error.unlearnt) == pytest.approx((0.0, 0.0, 0.0), abs=1e-15)


def test_a_law_linear_in_energy_is_learnt_from_one_step() -> None:
    generator = np.random.default_rng(4)
    first, later = generator.uniform(1.0, 2.0, (2, 30))
    slope = generator.uniform(0.5, 3.0, 30)
    ratio = WearRatio.learn(slope * first, first)
    np.testing.assert_allclose(ratio.apply(later), slope * later, rtol=1e-12)


def test_steps_add_as_if_learnt_together() -> None:
    apart = WearRatio.learn(DEPTH[0], ENERGY[0]) + WearRatio.learn(DEPTH[1], ENERGY[1])
    np.testing.assert_array_equal(apart.ratio, WearRatio.learn(DEPTH, ENERGY).ratio)


def test_error_by_hand() -> None:
    """Ratio 2 everywhere. Energies 1, 3 give depths 2, 6; the full step wears 4, 6: 8/10 of the volume.
    Shares 0.25, 0.75 against 0.4, 0.6: 0.15 in the wrong place."""
    error = WearRatio.learn([2.0, 2.0], [1.0, 1.0]).error([1.0, 3.0], [4.0, 6.0])
    assert error.volume == pytest.approx(-0.2)
    assert error.misplaced == pytest.approx(0.15)
    assert error.unlearnt == 0.0


def test_energy_where_nothing_was_learnt_is_told() -> None:
    ratio = WearRatio.learn([0.0, 3.0], [0.0, 1.0])
    error = ratio.error([1.0, 3.0], [3.0, 9.0])
    assert error.unlearnt == 0.25
    assert error.volume == pytest.approx(0.0)


def test_bad_steps_are_refused() -> None:
    with pytest.raises(ValueError, match=r"depth \(2,\) and energy \(3,\) must have one shape"):
        WearRatio.learn([1.0, 2.0], [1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="energy of the wear ratio must be finite and >= 0"):
        WearRatio.learn([1.0, 2.0], [1.0, -2.0])
    with pytest.raises(ValueError, match="no energy was dissipated"):
        WearRatio.learn([0.0], [0.0])
    ratio = WearRatio.learn([1.0, 2.0], [1.0, 2.0])
    with pytest.raises(ValueError, match=r"energy \(3,\) must end in the ratio's 2 positions"):
        ratio.apply([1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="energy must be finite"):
        ratio.apply([1.0, np.nan])
    with pytest.raises(ValueError, match=r"needs wear \(sum of depths 0\.0\)"):
        ratio.error([1.0, 1.0], [0.0, 0.0])
    with pytest.raises(ValueError, match="on 2 and 1 positions"):
        ratio + WearRatio.learn([1.0], [1.0])


def test_a_wheel_surface_is_learnt_from_as_it_is(make_log: MakeLog) -> None:
    """Depth (W, B) and energy per area (W, B) of the sums have one shape: the learnt
    ratio gives back the depths."""
    surface = accumulate(make_log(a=6e-3, b=5e-3, normal_force=100e3, nu_x=2e-3), DamageModel())
    ratio = WearRatio.learn(surface.depth, surface.energy_density.sum(axis=1))
    np.testing.assert_allclose(
        ratio.apply(surface.energy_density.sum(axis=1)).sum(axis=0), surface.depth.sum(axis=0), rtol=1e-12
    )


def strips(friction: float) -> WearDepths:
    state = {"a": 6e-3, "b": 5e-3, "normal_force": 100e3, "nu_x": 1e-3, "nu_y": 5e-4, "phi": 0.1}
    return wear_depths(
        wear_law("archard"), state | {"friction": friction, "speed": 10.0, "rolling_radius": 0.46}
    )


def test_the_ratio_holds_for_one_friction() -> None:
    """Slipping cells have |q| = mu p, so Archard's depth is k/(H mu) times the energy of the strip over its
    width; learnt at 0.35 and used at 0.5 it is 0.5/0.35 - 1 too much. Over energy/friction it is not."""
    learnt, full = strips(0.35), strips(0.5)
    ratio = WearRatio.learn(learnt.depth, learnt.energy)
    expected = 5.5e-4 / 2.65e9 / 0.35 / learnt.width[0]
    np.testing.assert_allclose(ratio.ratio, expected, rtol=1e-9)
    error = ratio.error(full.energy, full.depth)
    assert (error.volume, error.misplaced) == pytest.approx((0.5 / 0.35 - 1.0, 0.0), abs=1e-9)
    over_friction = WearRatio.learn(learnt.depth, learnt.energy / 0.35)
    assert over_friction.error(full.energy / 0.5, full.depth).volume == pytest.approx(0.0, abs=1e-9)
