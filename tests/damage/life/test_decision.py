"""A limit that is reached is a reason, and a step is cut where it was."""

from dataclasses import replace

import numpy as np
import pytest

from damage.life.condition import WheelCondition, between
from damage.life.decision import MEASURES, Inspection, crack_depths, crossings, due, measured
from damage.life.limits import WheelLimits
from damage.life.places import WheelPlaces

LIMITS = {
    "flange_thickness": "least_flange_thickness",
    "flange_height": "largest_flange_height",
    "flange_steepness": "least_flange_steepness",
    "hollow": "largest_hollow",
}


def cracked(wheels: WheelCondition, y: float, damage: float, index: str = "global") -> WheelCondition:
    """A crack in the bin at a place."""
    at = int(np.argmin(np.abs(wheels.grid.lateral - y)))
    layer = wheels.cracks[index]
    values = layer.damage.copy()
    values[at] = damage
    return replace(wheels, cracks=wheels.cracks | {index: replace(layer, damage=values)})


def worn(wheels: WheelCondition, distance: float = 0.0, **measures: float) -> WheelCondition:
    step = replace(wheels.step, distance=distance, measures=replace(wheels.step.measures, **measures))
    return replace(wheels, step=step)


def test_a_new_wheel_runs_on(wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces) -> None:
    assert due(wheels, limits, places) == ()
    assert crossings(wheels, worn(wheels, 1e6), limits, places) == ()
    assert tuple(measured(wheels, limits, places)) == MEASURES


@pytest.mark.parametrize("measure", LIMITS)
def test_every_limit_is_a_reason(
    wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces, measure: str
) -> None:
    value = getattr(limits, LIMITS[measure])
    beyond = 1e-6 if LIMITS[measure].startswith("largest") else -1e-6
    assert due(worn(wheels, **{measure: value - beyond}), limits, places) == ()
    (reason,) = due(worn(wheels, **{measure: value + beyond}), limits, places)
    assert reason == (measure, value + beyond, value, "m", "wear")


def test_a_flange_that_grew_thick_is_due(
    wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces
) -> None:
    """Tread wear alone thickens the flange 10 mm below it."""
    (reason,) = due(worn(wheels, flange_thickness=33.1e-3), limits, places)
    assert (reason.measure, reason.limit) == ("flange_thickness", limits.largest_flange_thickness)


def test_the_end_of_the_diameter(wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces) -> None:
    (reason,) = due(replace(wheels, step=replace(wheels.step, radius=0.5749)), limits, places)
    assert (reason.measure, reason.cause, reason.limit) == ("diameter", "diameter", 1.15)


def test_cracks_decide_by_place_and_index(
    wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces
) -> None:
    """Failure depth 5 mm, limit 5 mm: Miner's sum of 1. The root decides where it is asked."""
    tread = cracked(wheels, -35.5e-3, 1.01)
    (reason,) = due(tread, limits, places)
    assert (reason.measure, reason.cause) == ("crack_depth", "cracks")
    assert reason.value == pytest.approx(5.05e-3)
    root = cracked(wheels, 30.5e-3, 3.0)
    assert due(root, limits, places) == ()
    assert crack_depths(root, places)["global"]["root"] == pytest.approx(15e-3)
    assert crack_depths(root, places)["global"]["tread"] == 0.0
    assert due(root, limits, places, Inspection(places=("tread", "root")))
    local = cracked(wheels, -35.5e-3, 1.01, "local")
    assert due(local, limits, places) == ()
    assert due(local, limits, places, Inspection("local"))
    bands = crack_depths(tread, places)["global"]
    assert bands["field_band"] > 0.0
    assert bands["middle_band"] == 0.0


def test_a_long_crack_is_due(wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces) -> None:
    """A mouth of 10 times the depth: 40 mm at 4 mm of depth."""
    long = replace(limits, length_over_depth=10.0)
    (reason,) = due(cracked(wheels, -0.0355, 0.81), long, places)
    assert reason.measure == "crack_length"
    assert reason.value == pytest.approx(40.5e-3)


def test_crossings_by_hand(wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces) -> None:
    """A hollow of 1 to 3 mm reaches 2 mm halfway, a crack from 0 to 6.25 mm reaches 5 mm at 0.8."""
    before = worn(wheels, 10e6, hollow=1e-3)
    after = cracked(worn(wheels, 20e6, hollow=3e-3), -0.0355, 1.25)
    hollow, crack = crossings(before, after, limits, places)
    assert (hollow.reason.measure, crack.reason.measure) == ("hollow", "crack_depth")
    assert hollow.distance == pytest.approx(15e6, rel=1e-12)
    assert crack.distance == pytest.approx(18e6, rel=1e-12)
    there = between(before, after, hollow.distance)
    assert there.step.measures.hollow == pytest.approx(limits.largest_hollow, rel=1e-12)
    already = crossings(after, replace(after, step=replace(after.step, distance=30e6)), limits, places)
    assert {one.distance for one in already} == {20e6}


def test_bad_inspections(wheels: WheelCondition, limits: WheelLimits, places: WheelPlaces) -> None:
    with pytest.raises(ValueError, match="no cracks by 'burstow'; they have global, local"):
        due(wheels, limits, places, Inspection("burstow"))
    with pytest.raises(ValueError, match=r"places = \('rim',\) of an inspection; allowed are tread, root"):
        Inspection(places=("rim",))
