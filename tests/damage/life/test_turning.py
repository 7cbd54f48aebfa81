"""Turning keeps to the metal that is there, takes the cracks, and never goes below the least diameter."""

from dataclasses import replace

import numpy as np
import pytest

from damage.life.condition import WheelCondition
from damage.life.decision import due
from damage.life.forecast import life_from_rates
from damage.life.limits import WheelLimits
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates
from damage.life.turning import Turning, TurningRule, turn, turnings_left
from hh_exudyn.contact.profile import Profile, wheel_profile

BELOW = 0.5e-3


@pytest.fixture(scope="module")
def used(
    wheels: WheelCondition, rates: LifeRates, limits: WheelLimits, places: WheelPlaces
) -> WheelCondition:
    """40,000 km later, cracks in the root and on the flange too."""
    at = wheels.grid.lateral
    more = np.interp(at, [0.024, 0.03, 0.035, 0.05], [0.0, 0.4, 0.2, 0.2], 0.0, 0.0) / 50e3
    damage = {index: values + more for index, values in rates.damage_per_km.items()}
    return life_from_rates(wheels, LifeRates(rates.wear, damage), limits, places, longest=40e6).condition


def heights(worn: Profile, turned: Turning) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lateral positions, the worn line, and the turned one in the same place, both from the worn circle."""
    assert turned.condition is not None
    target = turned.condition.step.profile
    y = np.linspace(worn.y[0], target.y[np.argmin(target.z)], 5000)
    return y, np.interp(y, worn.y, worn.z), np.interp(y, target.y, target.z) + turned.cut


def test_the_new_line_is_nowhere_outside_the_old(
    used: WheelCondition, limits: WheelLimits, wp4: Profile
) -> None:
    turned = turn(used, limits, TurningRule([wp4]))
    _, old, new = heights(used.step.profile, turned)
    assert (new - old).min() > -1e-9
    assert turned.condition is not None
    assert turned.condition.step.radius == pytest.approx(used.step.radius - turned.cut, rel=1e-15)
    assert turned.diameter == 2.0 * turned.condition.step.radius


def test_cracks_of_tread_and_root_are_gone_with_metal_below_them(
    used: WheelCondition, limits: WheelLimits, wp4: Profile, places: WheelPlaces
) -> None:
    """The cut is the smallest: one crack has just the 0.5 mm below it (normal to the worn surface)."""
    turned = turn(used, limits, TurningRule([wp4], below_crack=BELOW))
    y, old, new = heights(used.step.profile, turned)
    slope = np.interp(y, used.step.profile.y, np.gradient(used.step.profile.z, used.step.profile.y))
    depth = (new - old) / np.hypot(1.0, slope)
    layer = used.cracks["global"]
    at = layer.grid.lateral
    gone = (places.within("tread", at) | places.within("root", at)) & (layer.depth > 0.1e-3)
    spare = np.interp(at, y, depth)[gone] - layer.depth[gone]
    assert spare.min() == pytest.approx(BELOW, rel=0.02)
    assert turned.condition is not None
    left = turned.condition.cracks["global"].damage
    assert left[gone].max() == 0.0
    assert turned.cut_for_profile < 0.1 * turned.cut
    assert (turned.cause, turned.cut_cause) == ("", "cracks")


def test_what_is_not_turned_out_is_shortened(
    used: WheelCondition, limits: WheelLimits, wp4: Profile, places: WheelPlaces
) -> None:
    """Flange cracks lose the depth that the face loses, no crack gets deeper; wear counts anew."""
    turned = turn(used, limits, TurningRule([wp4], places=("tread",)))
    assert turned.condition is not None
    for index, layer in turned.condition.cracks.items():
        assert (layer.depth <= used.cracks[index].depth).all()
        assert layer.worn.max() == 0.0
        assert np.array_equal(layer.damage, layer.damage_without_wear)
    y, old, new = heights(used.step.profile, turned)
    at = 0.0445  # on the face
    bin_at = int(np.argmin(np.abs(used.grid.lateral - at)))
    slope = np.interp(at, used.step.profile.y, np.gradient(used.step.profile.z, used.step.profile.y))
    removed = np.interp(at, y, new - old) / np.hypot(1.0, slope)
    before = used.cracks["global"].depth[bin_at]
    after = turned.condition.cracks["global"].depth[bin_at]
    assert after == pytest.approx(max(before - removed, 0.0), abs=2e-5)


def test_a_share_leaves_the_rest_of_the_crack(
    used: WheelCondition, limits: WheelLimits, wp4: Profile
) -> None:
    """Half of the deepest crack is 2 mm less of cut, and half of it goes on."""
    whole = turn(used, limits, TurningRule([wp4], below_crack=0.0))
    half = turn(used, limits, TurningRule([wp4], crack_share=0.5))
    none = turn(used, limits, TurningRule([wp4], crack_share=0.0))
    assert half.cut < whole.cut
    assert none.cut == none.cut_for_profile == whole.cut_for_profile
    assert half.condition is not None
    deepest = used.cracks["global"].depth.max()
    assert half.condition.cracks["global"].depth.max() == pytest.approx(0.5 * deepest, rel=0.05)


def test_a_turned_wheel_is_new_but_for_its_radius(
    used: WheelCondition, limits: WheelLimits, wp4: Profile, places: WheelPlaces, wheels: WheelCondition
) -> None:
    turned = turn(used, limits, TurningRule([wp4])).condition
    assert turned is not None
    assert np.array_equal(turned.step.profile.z, wp4.z)
    assert turned.step.measures.flange_thickness == wheels.step.measures.flange_thickness
    assert due(turned, limits, places) == ()
    assert (turned.turnings, turned.turned_at, turned.since_turning) == (1, 40e6, 0.0)
    assert turned.step.distance == used.step.distance


def test_the_cheaper_target_is_turned_if_its_flange_is_thick_enough(
    used: WheelCondition, limits: WheelLimits, wp4: Profile
) -> None:
    s1002 = wheel_profile("S1002")
    assert turn(used, limits, TurningRule([s1002, wp4])).target == wp4.name
    assert turn(used, limits, TurningRule([s1002, wp4], least_flange_thickness=30e-3)).target == "S1002"
    with pytest.raises(ValueError, match=r"no target with a flange of at least 40\.00 mm"):
        turn(used, limits, TurningRule([wp4], least_flange_thickness=40e-3))


@pytest.mark.parametrize("spare", [-1e-6, 1e-6])
def test_the_least_diameter_is_kept(
    used: WheelCondition, limits: WheelLimits, wp4: Profile, spare: float
) -> None:
    """A wheel that is 1 um too small for its cut is at its end, with its diameter as it was."""
    rule = TurningRule([wp4])
    cut = turn(used, limits, rule).cut
    radius = 0.5 * limits.least_diameter + cut + spare
    turned = turn(replace(used, step=replace(used.step, radius=radius)), limits, rule)
    assert (turned.condition is None) == (spare < 0.0)
    assert turned.diameter == pytest.approx(2.0 * radius if spare < 0.0 else limits.least_diameter, abs=3e-6)
    assert turned.cut == cut


def test_turnings_left(limits: WheelLimits) -> None:
    assert turnings_left(0.625, limits, 6.25e-3) == 8
    assert turnings_left(0.576, limits, 6.25e-3) == 0
    assert turnings_left(0.5, limits, 6.25e-3) == 0


def test_bad_rules(used: WheelCondition, limits: WheelLimits, wp4: Profile) -> None:
    with pytest.raises(ValueError, match="needs a target profile"):
        TurningRule([])
    with pytest.raises(ValueError, match=r"crack_share = 1\.5 of a turning, allowed 0 \.\. 1"):
        TurningRule([wp4], crack_share=1.5)
    with pytest.raises(ValueError, match=r"below_crack = -1\.0 m of a turning must be finite and >= 0 m"):
        TurningRule([wp4], below_crack=-1.0)
    with pytest.raises(ValueError, match=r"places = \('hub',\) of a turning"):
        TurningRule([wp4], places=("hub",))
    with pytest.raises(ValueError, match="no cracks by 'other'; they have global, local"):
        turn(used, limits, TurningRule([wp4], index="other"))
