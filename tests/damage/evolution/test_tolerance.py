"""Steps sized by their error: convergence, area, resume, folding, running-in, and the notch on the bench."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from contact_bench import POSES, R0, bench_wear, life_wear

from damage.evolution.history import WearHistory, WearStep
from damage.evolution.loop import StepControl, evolve
from damage.evolution.measures import ConicityTrack, measure
from damage.evolution.profile_wear import ProfileWear
from damage.evolution.running_in import RunningIn, running_in
from damage.evolution.tolerance import StepTolerance, filtered_rate, tolerated_step, tolerated_steps
from hh_exudyn.contact.profile import Profile, wheel_profile
from hh_exudyn.contact.profiles.cleaning import arc_length

WP4 = wheel_profile("WP4_like")
TRACK = ConicityTrack()
Y = np.linspace(-0.05, 0.05, 401)
START = WearStep(0.0, WP4, R0, 0.0, measure(WP4, R0, TRACK))

CURVES = POSES[-3:]


def hollowing(profile: Profile) -> ProfileWear:
    """Wear of the tread that spreads and slows as the line gets hollow; pressure falls with it."""
    hollow = 1e3 * abs(float(np.interp(-0.02, profile.y, profile.z) - np.interp(-0.02, WP4.y, WP4.z)))
    width = 8e-3 * (1.0 + 0.5 * hollow)
    depth = 30e-9 / (1.0 + hollow) * np.exp(-0.5 * (Y / width) ** 2)
    return ProfileWear(Y, depth, 1.2e9 / (1.0 + 0.3 * hollow))


def lost(history: WearHistory) -> float:
    return history.steps[0].radius - history.last.radius


def worn_area(before: WearStep, after: WearStep) -> float:
    """Cross-section between two lines [m^2]."""
    y = np.linspace(-0.06, 0.03, 20001)
    heights = [np.interp(y, one.profile.y, one.profile.z) - one.radius for one in (before, after)]
    return float(np.trapezoid(heights[1] - heights[0], y))


@pytest.mark.slow
def test_half_the_tolerance_changes_little(tmp_path: Path) -> None:
    """Fewer than 60 steps to 150,000 km, and less than 5 % of the worn depth from tolerance to half of it."""
    whole = evolve(WP4, R0, hollowing, 150e6, tmp_path / "1", StepTolerance())
    half = evolve(WP4, R0, hollowing, 150e6, tmp_path / "2", StepTolerance(5e-6, 0.05, 0.01))
    fine = evolve(
        WP4, R0, hollowing, 150e6, tmp_path / "3", StepTolerance(1e-6, 0.02, 0.004, max_distance=2e6)
    )
    assert len(whole.steps) - 1 <= 60
    assert whole.last.distance == 150e6
    errors = [abs(lost(history) / lost(fine) - 1.0) for history in (whole, half)]
    assert errors[0] < 0.05
    assert errors[1] < errors[0]
    assert lost(whole) == pytest.approx(lost(half), rel=0.05)


def test_the_worn_area_is_that_of_the_wear() -> None:
    """To 1e-3, with the filter: on a tread the area between the lines is the integral of the wear."""
    step = tolerated_step(START, "w", hollowing, 1e6, replace(StepTolerance(), profile=1e-4), TRACK)
    s = arc_length(WP4.y, WP4.z)
    first = np.trapezoid(1e-3 * hollowing(WP4).at(WP4.y), s)
    filtered = np.trapezoid(filtered_rate(WP4, hollowing(WP4), 1.5e-3), s)
    assert filtered == pytest.approx(first, rel=1e-9)
    after = np.trapezoid(1e-3 * hollowing(step.profile).at(WP4.y), s)
    assert worn_area(START, step) == pytest.approx(0.5 * (first + after) * step.distance, rel=1e-3)
    later = tolerated_step(step, "w", hollowing, 2e6, replace(StepTolerance(), profile=1e-4), TRACK)
    rates = [float(np.trapezoid(one.next_rate, s)) for one in (step, later) if one.next_rate is not None]
    worn = sum(rates) / 2.0 * (later.distance - step.distance)
    assert worn_area(step, later) == pytest.approx(worn, rel=1e-3)


def test_it_goes_on_with_the_same_steps(tmp_path: Path) -> None:
    whole = evolve(WP4, R0, hollowing, 15e6, tmp_path / "whole", StepTolerance())
    asked = 0

    def stopping(profile: Profile) -> ProfileWear:
        nonlocal asked
        asked += 1
        if asked == 8:
            raise KeyboardInterrupt
        return hollowing(profile)

    with pytest.raises(KeyboardInterrupt):
        evolve(WP4, R0, stopping, 15e6, tmp_path / "cut", StepTolerance())
    again = evolve(WP4, R0, hollowing, 15e6, tmp_path / "cut", StepTolerance())
    assert again.to_table() == whole.to_table()
    for one, other in zip(again.steps, whole.steps, strict=True):
        np.testing.assert_array_equal(one.profile.z, other.profile.z)
        assert one.profile.name == other.profile.name


def test_a_step_that_folds_over_is_halved() -> None:
    """12 mm in a band of the tread would fold its edges: the step is made again until the line is single."""
    wear = ProfileWear(np.array([-0.011, -0.0105, 0.0, 0.0005]), np.array([0.0, 1e-6, 1e-6, 0.0]))
    now = replace(START, next_distance=200e6)
    control = StepTolerance(1.0, 1.0, 10.0, max_distance=1e9, filter_length=0.2e-3)
    step = tolerated_step(now, "w", lambda profile: wear, 200e6, control, TRACK)
    assert step.distance < 200e6
    assert math.log2(200e6 / step.distance) % 1.0 == pytest.approx(0.0, abs=1e-9)
    assert np.diff(step.profile.y).min() > 0.0


def test_no_step_is_short_enough_for_a_pressure_that_jumps() -> None:
    def jumping(profile: Profile) -> ProfileWear:
        return replace(hollowing(profile), pressure=1e9 if profile is WP4 else 2e9)

    with pytest.raises(ValueError, match=r"'WP4_like': no step of wear from 0\.000 km on is short enough"):
        tolerated_step(START, "w", jumping, 1e6, StepTolerance(), TRACK)


def milder(profile: Profile) -> ProfileWear:
    wear = hollowing(profile)
    return replace(wear, depth_per_km=0.1 * wear.depth_per_km)


def test_wheels_wear_together_in_one_step() -> None:
    """The step is that of the wheel with the largest error; asked for at once, at the start and each try."""
    asked: list[tuple[Profile, ...]] = []

    def both(profiles: tuple[Profile, ...]) -> tuple[ProfileWear, ...]:
        asked.append(profiles)
        return milder(profiles[0]), hollowing(profiles[1])

    alone = tolerated_step(START, "worse", hollowing, 150e6, StepTolerance(), TRACK)
    mild, worse = tolerated_steps((START, START), ("mild", "worse"), both, 150e6, StepTolerance(), TRACK)
    assert (worse.distance, worse.next_distance) == (alone.distance, alone.next_distance)
    np.testing.assert_array_equal(worse.profile.z, alone.profile.z)
    assert (mild.distance, mild.next_distance) == (alone.distance, alone.next_distance)
    assert mild.depth == pytest.approx(0.1 * worse.depth, rel=0.1)
    assert mild.next_rate is not None and worse.next_rate is not None
    assert mild.next_rate.max() == pytest.approx(0.1 * worse.next_rate.max(), rel=0.1)
    assert mild.profile.name.startswith("mild after ")
    assert asked[0] == (WP4, WP4)
    assert asked.count(asked[0]) == 1


def test_the_wear_of_all_wheels_at_one_distance_is_needed() -> None:
    def one(profiles: tuple[Profile, ...]) -> tuple[ProfileWear, ...]:
        return (hollowing(profiles[0]),)

    with pytest.raises(ValueError, match="wear_of gave the wear of 1 wheels, needed 2"):
        tolerated_steps((START, START), ("a", "b"), one, 1e6, StepTolerance(), TRACK)
    with pytest.raises(ValueError, match=r"2 wheels and 1 names: each needs one"):
        tolerated_steps((START, START), ("a",), one, 1e6, StepTolerance(), TRACK)
    later = replace(START, distance=2e3)
    with pytest.raises(ValueError, match=r"have run 0\.000, 2\.000 km, needed the same distance"):
        tolerated_steps((START, later), ("a", "b"), one, 1e6, StepTolerance(), TRACK)


def test_what_the_wear_raises_ends_the_step() -> None:
    """No shorter step is tried: the fault of a campaign is no error of a step."""
    asked = 0

    def failing(profile: Profile) -> ProfileWear:
        nonlocal asked
        asked += 1
        if asked == 2:
            raise ValueError("7 of 20 cases failed")
        return hollowing(profile)

    with pytest.raises(ValueError, match="7 of 20 cases failed"):
        tolerated_step(START, "w", failing, 1e6, StepTolerance(), TRACK)
    assert asked == 2


@pytest.mark.parametrize("name", ["profile", "pressure", "conicity", "max_distance", "filter_length"])
def test_tolerances_are_above_zero(name: str) -> None:
    with pytest.raises(ValueError, match=rf"{name} = 0.0 .*tolerance of a step of wear must be"):
        StepTolerance(**{name: 0.0})


def test_running_in_ends_with_the_last_step_under_seizure(tmp_path: Path) -> None:
    """From 2.5 GPa: it ends where the pressure is below 0.8 of 2.3 GPa, at the depth worn until there."""

    def fitting(profile: Profile) -> ProfileWear:
        deep = abs(float(np.interp(-0.02, profile.y, profile.z) - np.interp(-0.02, WP4.y, WP4.z)))
        depth = 4e-4 * np.exp(-0.5 * (Y / 6e-3) ** 2)
        return ProfileWear(Y, depth, 1.2e9 + 1.3e9 * math.exp(-deep / 40e-6))

    history = evolve(WP4, R0, fitting, 400.0, tmp_path, StepTolerance())
    found = running_in(history, 2.3e9)
    assert found.finished
    exact = 40e-6 * math.log(1.3 / 0.64)  # m, at which the pressure is 1.84 GPa
    ends = [step.distance for step in history.steps]
    last = ends.index(found.distance)
    least = (ends[last - 1]) * 0.4e-6  # m, the step under seizure began below the depth
    assert least < exact * 1.05 < found.depth * 1.1
    assert found.depth == pytest.approx(sum(step.depth for step in history.steps[: last + 1]), rel=0.01)
    assert not running_in(WearHistory(history.steps[: last + 1]), 2.3e9).finished
    assert running_in(history, 9e9) == RunningIn(0.0, 0.0, True)
    unknown = WearHistory((history.steps[0], replace(history.steps[1], pressure=math.nan)))
    with pytest.raises(ValueError, match="needs steps with contact pressures"):
        running_in(unknown, 2.3e9)


def test_one_step_makes_no_notch() -> None:
    """Curves, dry: the deepest 30 um of a step leave the largest pressure below its value before."""
    now = replace(START, next_distance=3e3)
    step = tolerated_step(now, "w", lambda wheel: bench_wear(wheel, CURVES), 3e3, StepTolerance(), TRACK)
    assert step.depth > 15e-6
    assert bench_wear(step.profile, CURVES).pressure < step.pressure


@pytest.mark.slow
def test_no_notch_after_several_steps(tmp_path: Path) -> None:
    """Curves, dry: some 60 um, in a few steps, leave the largest pressure below its value before."""
    sized = evolve(WP4, R0, bench_wear, 12.8e3, tmp_path, StepTolerance())
    assert bench_wear(sized.last.profile).pressure < 0.98 * sized.steps[1].pressure
    assert len(sized.steps) < 10


@pytest.mark.slow
def test_one_step_of_a_fixed_depth_makes_the_notch(tmp_path: Path) -> None:
    """The same distance in one explicit step of 0.1 mm at most: the bench shows what the tolerance cures."""
    fixed = evolve(WP4, R0, bench_wear, 12.8e3, tmp_path, StepControl(max_depth=1e-4))
    assert len(fixed.steps) == 2
    assert bench_wear(fixed.last.profile).pressure > 1.05 * fixed.last.pressure


@pytest.mark.slow
def test_a_life_on_the_bench(tmp_path: Path) -> None:
    """150,000 km in at most 60 steps, of one evaluation each but for refused tries; half the tolerance
    changes tread < 5 %, flange < 10 %, and moves the front of wear towards the flange by less than 0.3 mm."""
    asked = 0

    def counted(wheel: Profile) -> ProfileWear:
        nonlocal asked
        asked += 1
        return life_wear(wheel)

    whole = evolve(WP4, R0, counted, 150e6, tmp_path / "whole", StepTolerance())
    assert len(whole.steps) - 1 <= 60
    assert asked <= 1.3 * len(whole.steps)
    half = evolve(WP4, R0, life_wear, 150e6, tmp_path / "half", StepTolerance(5e-6, 0.05, 0.01))
    y = np.linspace(-0.01, 0.038, 481)
    worn = [
        np.interp(y, life.last.profile.y, life.last.profile.z) + lost(life) - np.interp(y, WP4.y, WP4.z)
        for life in (whole, half)
    ]
    change = np.abs(worn[0] / worn[1] - 1.0)
    assert change[y < 0.025].max() < 0.05
    assert change[y < 0.033].max() < 0.10
    fronts = [float(np.interp(-0.25e-3, -depth[y > 0.02], y[y > 0.02])) for depth in worn]
    assert fronts[0] == pytest.approx(fronts[1], abs=0.3e-3)
