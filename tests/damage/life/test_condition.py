"""A condition is a value: steps add up, and it is stored and goes on with the same bytes."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from damage.evolution.history import WearStep
from damage.life.condition import WheelCondition, between, on_grid
from damage.life.forecast import life_from_rates
from damage.life.limits import WheelLimits
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates
from damage.rcf.wear_and_cracks import CrackLayer
from damage.surface.lateral_grid import LateralGrid
from damage.surface.stored import BrokenFile
from hh_exudyn.contact.profile import Profile


def rolled(wheels: WheelCondition, distance: float) -> WearStep:
    """The same wheel, farther on."""
    return replace(wheels.step, distance=wheels.step.distance + distance)


def stepped(wheels: WheelCondition, damage: float, worn: float, count: int = 1) -> WheelCondition:
    """Damage and wear alike in all bins, in `count` equal steps of a kilometre in all."""
    bins = np.ones(wheels.grid.count)
    for _ in range(count):
        share = bins / count
        wheels = wheels.after(
            rolled(wheels, 1e3 / count), dict.fromkeys(wheels.cracks, damage * share), worn * share
        )
    return wheels


def test_damage_adds_up(wheels: WheelCondition) -> None:
    layer = stepped(stepped(wheels, 0.2, 0.0), 0.3, 0.0).cracks["global"]
    np.testing.assert_allclose(layer.damage, 0.5, rtol=1e-15)
    np.testing.assert_allclose(layer.depth, 2.5e-3, rtol=1e-15)


def test_wear_at_the_rate_of_growth_keeps_the_depth(wheels: WheelCondition) -> None:
    """h_f dD = dw: 0.1 of a life is 0.5 mm of growth."""
    cracked = stepped(wheels, 0.4, 0.0)
    after = stepped(cracked, 0.1, 0.5e-3, 5).cracks["global"]
    np.testing.assert_allclose(after.damage, 0.4, rtol=1e-14)
    np.testing.assert_allclose(after.damage_without_wear, 0.5, rtol=1e-14)
    np.testing.assert_allclose(after.worn, 0.5e-3, rtol=1e-14)


@pytest.mark.parametrize("worn", [0.1e-3, 2e-3, 20e-3])  # cracks grow, shrink, are worn off in the step
def test_half_steps_give_the_same(wheels: WheelCondition, worn: float) -> None:
    cracked = stepped(wheels, 0.5, 0.0)
    one, two, many = (stepped(cracked, 0.1, worn, count) for count in (1, 2, 64))
    for other in (two, many):
        np.testing.assert_allclose(other.cracks["local"].damage, one.cracks["local"].damage, atol=1e-14)
    assert (one.cracks["local"].damage[0] == 0.0) == (worn == 20e-3)


def test_stored_with_the_same_bytes(wheels: WheelCondition, tmp_path: Path) -> None:
    """NaN (pressure, conicity) and the bits of all numbers are kept; equal values are equal bytes."""
    after = replace(stepped(wheels, 0.1, 1e-5, 3), turned_at=100.0, turnings=2)
    rate = np.linspace(0.0, 1e-11, after.step.profile.y.size)
    step = replace(after.step, pressure=1.1e9, next_distance=np.nan, sensitivity=0.4, next_rate=rate)
    after = replace(after, step=step)
    after.save(tmp_path / "a.npz")
    back = WheelCondition.load(tmp_path / "a.npz")
    assert back.to_bytes() == after.to_bytes() == (tmp_path / "a.npz").read_bytes()
    assert (back.group, back.turnings, back.turned_at) == ("leading outer", 2, 100.0)
    assert back.step.distance == after.step.distance
    assert np.isnan(back.step.next_distance)
    assert back.step.next_rate is not None
    assert np.array_equal(back.step.next_rate, rate)
    assert np.array_equal(back.cracks["global"].damage, after.cracks["global"].damage)
    assert wheels.to_bytes() != after.to_bytes()


def test_stored_on_bins_along_a_profile(wp4: Profile) -> None:
    grid = LateralGrid.along(wp4)
    one = WheelCondition.new("a", wp4, 0.6, 5e-3, grid, ("global",))
    back = WheelCondition.from_bytes(one.to_bytes(), "file")
    assert back.grid == grid
    assert tuple(back.cracks) == ("global",)
    assert back.to_bytes() == one.to_bytes()


def test_a_life_that_is_stored_goes_on_with_the_same_bytes(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    def on(condition: WheelCondition) -> WheelCondition:
        return life_from_rates(condition, rates, limits, places, longest=7e6).condition

    through, stored = on(on(on(wheels))), wheels
    for _ in range(3):
        stored = WheelCondition.from_bytes(on(stored).to_bytes(), "file")
    assert stored.step.distance == 21e6
    assert stored.to_bytes() == through.to_bytes()


def test_a_changed_file_is_refused(wheels: WheelCondition) -> None:
    content = wheels.to_bytes()
    with pytest.raises(BrokenFile, match=r"wheels\.npz"):
        WheelCondition.from_bytes(content[:-50], "wheels.npz")
    flipped = bytearray(content)
    flipped[len(content) // 2] ^= 1
    with pytest.raises(BrokenFile, match=r"wheels\.npz"):
        WheelCondition.from_bytes(bytes(flipped), "wheels.npz")


def test_between_is_in_proportion(wheels: WheelCondition, rates: LifeRates, limits: WheelLimits,
                                  places: WheelPlaces) -> None:  # fmt: skip
    after = life_from_rates(wheels, rates, limits, places, longest=4e6).condition
    assert between(wheels, after, 0.0).cracks["global"].damage.max() == 0.0
    assert between(wheels, after, 4e6).to_bytes() == after.to_bytes()
    half = between(wheels, after, 2e6)
    assert half.cracks["local"].damage.max() == pytest.approx(0.5 * after.cracks["local"].damage.max())
    assert half.step.radius == pytest.approx(0.5 * (wheels.step.radius + after.step.radius), rel=1e-15)
    real = life_from_rates(wheels, rates, limits, places, longest=2e6).condition
    np.testing.assert_allclose(half.step.profile.z, real.step.profile.z, atol=1e-9)
    with pytest.raises(ValueError, match=r"distance = 5000000\.0 m must lie within 0\.0 \.\. 4000000"):
        between(wheels, after, 5e6)


def test_onto_another_grid(wp4: Profile) -> None:
    lateral, along = LateralGrid(), LateralGrid.along(wp4)
    values = np.interp(lateral.lateral, [-0.03, 0.0, 0.03], [0.0, 1.0, 0.0])
    there = on_grid(values, lateral, along)
    np.testing.assert_allclose(there, np.interp(along.lateral, lateral.lateral, values, 0.0, 0.0))
    assert np.array_equal(on_grid(values, lateral, lateral), values)


def test_bad_conditions(wheels: WheelCondition) -> None:
    bins = np.zeros(wheels.grid.count)
    with pytest.raises(ValueError, match=r"damage by \['global'\]; .* cracks by \['global', 'local'\]"):
        wheels.after(wheels.step, {"global": bins}, bins)
    with pytest.raises(ValueError, match=r"a step of wheels 'leading outer' from 1000\.0 m ends at 0\.0 m"):
        stepped(wheels, 0.0, 0.0).after(wheels.step, {"global": bins, "local": bins}, bins)
    with pytest.raises(ValueError, match="different grids"):
        replace(wheels, cracks=wheels.cracks | {"local": CrackLayer.new(LateralGrid(count=10), 1e-3)})
    with pytest.raises(ValueError, match="need a layer of cracks"):
        replace(wheels, cracks={})
    with pytest.raises(ValueError, match="0 <= turned_at <= distance"):
        replace(wheels, turned_at=1.0)
    with pytest.raises(ValueError, match="turnings = -1"):
        replace(wheels, turnings=-1)
