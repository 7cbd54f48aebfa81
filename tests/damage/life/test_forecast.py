"""Lives from constant rates: distances by hand, whole lives to the least diameter, their table."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet
import pytest

from damage.life.condition import WheelCondition
from damage.life.decision import Inspection
from damage.life.forecast import first_turnings, life_from_rates, whole_life
from damage.life.life_table import distance_quantiles, life_table, write_life
from damage.life.limits import WheelLimits
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates, rates_of
from damage.life.turning import TurningRule
from damage.patch_strips import FLANGE, TREAD
from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.contact.profile import Profile

GROWTH = 5e-3 / 50e3  # m of crack per kilometre
WEAR = 8.9e-9


def test_a_crack_is_deep_enough_where_growth_less_wear_makes_it(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    """d = h / (growth - wear) in the bin where that is largest."""
    forecast = life_from_rates(wheels, rates, limits, places)
    at = wheels.grid.lateral
    net = 5e-3 * rates.damage_per_km["global"] - rates.wear.at(at)
    assert forecast.crossings[0].reason.measure == "crack_depth"
    assert forecast.distance == pytest.approx(1e3 * 5e-3 / net.max(), rel=1e-9)
    assert 50e6 < forecast.distance < 1e3 * 5e-3 / (GROWTH - WEAR)
    assert forecast.condition.step.distance == forecast.distance
    local = life_from_rates(wheels, rates, limits, places, Inspection("local"))
    assert local.distance > 2.0 * forecast.distance


def test_wear_of_table_1_8(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    """150,000 km: Sh +1.34 and Sd -0.11 mm need 0.92 mm off the flange face, 6.1 um per 1000 km and not 0.7.

    Sd is measured 10 mm below the tread: the tread's wear alone makes it 1.1 mm larger.
    """
    new = wheels.step.measures
    for factor, change in ((1.0, -0.11e-3), (0.0, 1.11e-3)):
        tread = np.where(rates.wear.y < 0.035, rates.wear.depth_per_km, factor * rates.wear.depth_per_km)
        only = replace(rates.scaled(damage=0.0), wear=replace(rates.wear, depth_per_km=tread))
        worn = life_from_rates(wheels, only, limits, places, longest=150e6).condition.step.measures
        assert worn.flange_height - new.flange_height == pytest.approx(1.34e-3, abs=0.02e-3)
        assert worn.flange_thickness - new.flange_thickness == pytest.approx(change, abs=0.04e-3)


def test_all_rates_doubled_is_half_the_distance(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    for one in (rates, rates.scaled(damage=0.0)):
        whole = life_from_rates(wheels, one, limits, places).distance
        half = life_from_rates(wheels, one.scaled(2.0, 2.0), limits, places).distance
        assert half == pytest.approx(0.5 * whole, rel=1e-9)


def test_wear_alone_ends_in_a_hollow_whatever_the_step(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    alone = rates.scaled(damage=0.0)
    coarse, fine = (
        life_from_rates(wheels, alone, limits, places, step_depth=depth).distance
        for depth in (0.2e-3, 0.02e-3)
    )
    assert coarse == pytest.approx(fine, rel=1e-3)
    assert life_from_rates(wheels, alone, limits, places).crossings[0].reason.measure == "hollow"
    assert 200e6 < fine < 500e6  # some 2 mm at 8.9 um per 1000 km


def test_all_limits_in_order(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    every = life_from_rates(wheels, rates, limits, places, longest=1200e6, all_limits=True)
    distances = [one.distance for one in every.crossings]
    assert distances == sorted(distances)
    assert {one.reason.measure for one in every.crossings} >= {"crack_depth", "crack_length", "hollow"}
    first = life_from_rates(wheels, rates, limits, places)
    assert every.distance == first.distance
    assert every.condition.to_bytes() == first.condition.to_bytes()


def test_no_rates_no_limit(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    still = life_from_rates(wheels, rates.scaled(0.0, 0.0), limits, places)
    assert still.crossings == ()
    assert still.distance == np.inf
    assert whole_life(wheels, rates.scaled(0.0, 0.0), limits, TurningRule([wheels.step.profile])) == ()


def test_lives_to_the_least_diameter(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, wp4: Profile
) -> None:
    """Every millimetre of the diameter is wear, cut, or left at the end; the wheel never goes below it."""
    turnings = whole_life(wheels, rates, limits, TurningRule([wp4]))
    assert [one.life for one in turnings] == list(range(1, len(turnings) + 1))
    assert all(one.condition is not None for one in turnings[:-1])
    assert turnings[-1].condition is None
    assert all(one.diameter >= limits.least_diameter for one in turnings)
    before = limits.new_diameter
    for one in turnings[:-1]:
        assert one.worn_diameter < before
        assert one.worn_diameter - one.diameter == pytest.approx(2.0 * one.cut, rel=1e-9)
        before = one.diameter
    assert turnings[-1].worn_diameter - 2.0 * turnings[-1].cut < limits.least_diameter
    intervals = [one.since_turning for one in turnings]
    np.testing.assert_allclose(intervals, intervals[0], rtol=1e-3)  # the same rates, the same profile
    assert sum(intervals) == pytest.approx(turnings[-1].distance, rel=1e-12)
    assert 400e6 < turnings[-1].distance < 600e6  # IORE: 400,000 km (thesis), 594,700 km (LTU)


def test_lives_as_a_table(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, wp4: Profile, tmp_path: Path
) -> None:
    small = replace(limits, least_diameter=1.235)
    turnings = whole_life(wheels, rates, small, TurningRule([wp4]))
    table = pyarrow.parquet.read_table(write_life(tmp_path, turnings))
    assert table.equals(life_table(turnings))
    first, last = table.to_pylist()[0], table.to_pylist()[-1]
    assert (first["group"], first["life"], first["cause"], first["measure"], first["end"]) == (
        "leading outer", 1, "cracks", "crack_depth", False,
    )  # fmt: skip
    assert first["limit_mm"] == pytest.approx(5.0)
    assert first["reasons"] == "crack_depth"
    assert last["end"]
    assert last["diameter_mm"] == last["worn_diameter_mm"]
    assert life_table([]).schema == table.schema


def test_a_limit_that_turning_does_not_cure_is_named(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, wp4: Profile
) -> None:
    thick = replace(limits, least_flange_thickness=28e-3)
    with pytest.raises(
        ValueError, match=r"due by flange_thickness as soon as they are turned: 26\.89 mm, limit"
    ):
        whole_life(wheels, rates, thick, TurningRule([wp4]))


def test_distribution_over_samples(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    factors = (0.5, 1.0, 2.0)
    distances = first_turnings(wheels, [rates.scaled(damage=one) for one in factors], limits, places)
    assert (np.diff(distances) < 0.0).all()
    found = distance_quantiles(distances, quantiles=(0.0, 0.5, 1.0))
    assert list(found.values()) == sorted(distances)


def test_quantiles_by_hand() -> None:
    """Two samples of weights 3 and 1 have their middles at 3/8 and 7/8."""
    assert distance_quantiles([10.0, 20.0], [3.0, 1.0], (0.375, 0.625, 0.875)) == {
        0.375: 10.0, 0.625: pytest.approx(15.0), 0.875: 20.0,
    }  # fmt: skip
    endless = distance_quantiles([10.0, np.inf], quantiles=(0.1, 0.25, 0.5, 0.9))
    assert endless == {0.1: 10.0, 0.25: 10.0, 0.5: np.inf, 0.9: np.inf}
    with pytest.raises(ValueError, match="0 distances"):
        distance_quantiles([])
    with pytest.raises(ValueError, match="weights of 1 samples must be 2 numbers > 0"):
        distance_quantiles([1.0, 2.0], [1.0])
    with pytest.raises(ValueError, match=r"quantiles = \(1\.5,\)"):
        distance_quantiles([1.0], quantiles=(1.5,))


def test_bad_forecasts(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> None:
    with pytest.raises(ValueError, match=r"longest = 0\.0 m of a forecast must be finite and > 0 m"):
        life_from_rates(wheels, rates, limits, places, longest=0.0)
    short = LifeRates(rates.wear, {"global": np.zeros(3), "local": np.zeros(3)})
    with pytest.raises(ValueError, match=r"shape \(3,\)"):
        life_from_rates(wheels, short, limits, places)


def test_rates_of_a_surface(wp4: Profile, wheels: WheelCondition) -> None:
    """The mean of two wheels per kilometre, tread and flange together, brought to the wheels' bins."""
    grid = LateralGrid.along(wp4)
    surface = WheelSurface.zero((Wheel(1, 1, 1, -1), Wheel(1, 1, 1, 1)), grid)
    shape = np.interp(grid.lateral, [-0.03, 0.0, 0.04], [0.0, 1.0, 0.0])
    for part, share in ((TREAD, 0.75), (FLANGE, 0.25)):
        surface.global_crack_damage[1, part] = 4e-5 * share * shape
        surface.depth_by_part[:, part] = 1e-8 * share * shape
    found = rates_of(replace(surface, distance=2e3), wheels.grid)
    expected = 1e-5 * np.interp(wheels.grid.lateral, grid.lateral, shape)
    np.testing.assert_allclose(found.damage_per_km["global"], expected, rtol=1e-12)
    assert found.damage_per_km["local"].max() == 0.0
    np.testing.assert_allclose(found.wear.at(grid.lateral), 5e-9 * shape, rtol=1e-6, atol=1e-15)
    assert found.damage(500e3)["global"] == pytest.approx(500.0 * found.damage_per_km["global"])
    with pytest.raises(ValueError, match=r"no crack damage by \['energy'\]; it has global, local"):
        rates_of(replace(surface, distance=2e3), wheels.grid, ("energy",))
