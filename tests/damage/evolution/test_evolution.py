"""The loop over wear steps: when a step ends, what is kept, how it goes on, and what it measures."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scanned_wheel import scan_of_hollow_wheel

from damage.evolution.history import WearHistory, read_history, write_step
from damage.evolution.loop import StepControl, evolve
from damage.evolution.measures import ConicityTrack, measure
from damage.evolution.profile_wear import ProfileWear
from damage.evolution.worn_profile import worn_profile
from hh_exudyn.contact.profile import Profile, read_wheel_profile, wheel_profile
from hh_exudyn.contact.profiles.writer import write_profile

WP4 = wheel_profile("WP4_like")
RADIUS = 0.4575
LIMITS = StepControl()
WORN_FILES = (
    "worn_high_mileage.prw", "Car7216_0001r.whl", "Car7422_0001r.whl", "left-wheel-v1-pre-dry.whl",
)  # fmt: skip


def even(depth_per_km: float) -> Callable[[Profile], ProfileWear]:
    """The same wear all over the profile, whatever it is."""
    wear = ProfileWear(np.array([-0.08, 0.08]), np.full(2, depth_per_km))
    return lambda profile: wear


def tread(depth_per_km: float) -> ProfileWear:
    """Wear of the tread alone, deepest at the running circle."""
    y = np.linspace(-0.03, 0.03, 61)
    return ProfileWear(y, depth_per_km * np.cos(0.5 * np.pi * y / 0.03) ** 2)


def test_steps_end_at_depth_or_distance(tmp_path: Path) -> None:
    """8.9 um per 1000 km: 1500 km come first, with 100 um per 1000 km it is 0.1 mm after 1000 km."""
    slow = evolve(WP4, RADIUS, even(8.9e-9), 4000e3, tmp_path / "slow", LIMITS)
    assert [step.distance for step in slow.steps] == pytest.approx([0.0, 1500e3, 3000e3, 4000e3])
    assert slow.last.depth == pytest.approx(8.9e-6, rel=1e-9)
    fast = evolve(WP4, RADIUS, even(100e-9), 2500e3, tmp_path / "fast", LIMITS)
    assert [step.distance for step in fast.steps] == pytest.approx([0.0, 1000e3, 2000e3, 2500e3])
    assert [step.depth for step in fast.steps] == pytest.approx([0.0, 1e-4, 1e-4, 0.5e-4])
    control = StepControl(max_depth=1e-3, max_distance=2500e3)
    assert len(evolve(WP4, RADIUS, even(100e-9), 2500e3, tmp_path / "one", control).steps) == 2


def test_a_life_of_150000_km(tmp_path: Path) -> None:
    """Even wear in 20 steps is the offset curve, as in one: the flange keeps its height and gets thinner.

    The tip, whose tangent is level, rises by the depth; the running circle by the depth over the cosine of
    the tread's slope there.
    """
    depth = 1.335e-3
    control = StepControl(max_depth=depth, max_distance=7500e3)
    history = evolve(WP4, RADIUS, even(depth / 150e3), 150e6, tmp_path, control)
    assert len(history.steps) == 21
    first, last = history.steps[0].measures, history.last.measures
    slope = float(np.interp(0.0, WP4.y, np.gradient(WP4.z, WP4.y)))
    lost = depth * math.hypot(1.0, slope)
    assert first.diameter - last.diameter == pytest.approx(2.0 * lost, abs=1e-6)
    assert last.flange_height - first.flange_height == pytest.approx(lost - depth, abs=1e-6)
    # Sd is read in the root R15: its centre stays, its radius grows, the level rises with the tread
    y, z = 0.070 - first.flange_thickness, -0.010
    angle = math.atan(-float(np.interp(y, WP4.y, np.gradient(WP4.z, WP4.y))))
    centre_y, centre_z = y - 0.015 * math.sin(angle), z - 0.015 * math.cos(angle)
    face = centre_y + math.sqrt((0.015 + depth) ** 2 - (z + lost - centre_z) ** 2)
    assert last.flange_thickness == pytest.approx(0.070 - face, abs=2e-6)
    assert last.hollow == 0.0
    at_once, lost_at_once = worn_profile(WP4, even(depth / 150e3)(WP4), 150e6)
    assert lost_at_once == pytest.approx(lost, abs=1e-6)
    np.testing.assert_allclose(history.last.profile.y, at_once.y, rtol=0.0, atol=0.2e-6)
    np.testing.assert_allclose(history.last.profile.z, at_once.z, rtol=0.0, atol=0.2e-6)
    table = history.to_table()
    assert table["distance_km"].to_pylist()[-1] == pytest.approx(150e3)
    assert table["diameter_mm"].to_pylist()[0] == pytest.approx(915.0)
    assert set(table.column_names) >= {"Sh_mm", "Sd_mm", "qR_mm", "hollow_mm", "equivalent_conicity"}


def test_tread_wear_makes_a_higher_flange_and_a_hollow(tmp_path: Path) -> None:
    history = evolve(
        WP4,
        RADIUS,
        lambda profile: tread(20e-9),
        150e6,
        tmp_path,
        StepControl(max_depth=1e-3, max_distance=30e6),
    )
    first, last = history.steps[0].measures, history.last.measures
    assert last.flange_height - first.flange_height == pytest.approx(3e-3, rel=2e-3)
    assert 0.1e-3 < last.hollow < 3e-3
    np.testing.assert_array_equal(history.last.profile.y[WP4.y > 0.04], WP4.y[WP4.y > 0.04])


def test_it_goes_on_where_it_stopped(tmp_path: Path) -> None:
    """Killed in the third step and called again: the same steps to the last bit, none of them made twice."""
    asked: list[str] = []

    def wear_of(profile: Profile) -> ProfileWear:
        asked.append(profile.name)
        shift = float(np.interp(0.01, profile.y, profile.z))  # a wear that depends on the profile
        return tread(1e-7 * (1.0 + abs(shift)))

    def stopping(profile: Profile) -> ProfileWear:
        if len(asked) == 2:
            raise KeyboardInterrupt
        return wear_of(profile)

    whole = evolve(WP4, RADIUS, wear_of, 4500e3, tmp_path / "whole", LIMITS)
    asked.clear()
    with pytest.raises(KeyboardInterrupt):
        evolve(WP4, RADIUS, stopping, 4500e3, tmp_path / "cut", LIMITS)
    (tmp_path / "cut" / "step-00003.tmp").write_bytes(b"half a step")
    assert len(read_history(tmp_path / "cut").steps) == 3
    said: list[tuple[float, str]] = []
    again = evolve(
        WP4,
        RADIUS,
        wear_of,
        4500e3,
        tmp_path / "cut",
        LIMITS,
        progress=lambda done, text: said.append((done, text)),
    )
    assert len(asked) == len(set(asked)) == len(whole.steps) - 1
    assert [done for done, _ in said] == pytest.approx([s.distance / 4500e3 for s in whole.steps[3:]])
    assert said[0][1].startswith("step 3: ")
    _same(again, whole)
    _same(read_history(tmp_path / "cut"), whole)


def _same(one: WearHistory, other: WearHistory) -> None:
    assert one.to_table() == other.to_table()
    for step, twin in zip(one.steps, other.steps, strict=True):
        assert step.profile.name == twin.profile.name
        np.testing.assert_array_equal(step.profile.y, twin.profile.y)
        np.testing.assert_array_equal(step.profile.z, twin.profile.z)


def test_a_directory_is_one_wheels(tmp_path: Path) -> None:
    evolve(WP4, RADIUS, even(1e-8), 1500e3, tmp_path, LIMITS)
    with pytest.raises(ValueError, match=r"'WP4_like' with a radius of 457\.5 mm; it cannot .* 'S1002'"):
        evolve(wheel_profile("S1002"), RADIUS, even(1e-8), 1500e3, tmp_path, LIMITS)
    with pytest.raises(ValueError, match="'WP4_like' and 440 mm"):
        evolve(WP4, 0.44, even(1e-8), 1500e3, tmp_path, LIMITS)
    evolve(WP4, RADIUS, even(1e-8), 3000e3, tmp_path, LIMITS)
    (tmp_path / "step-00001.npz").unlink()
    with pytest.raises(ValueError, match=r"2 steps up to step-00002\.npz, some are missing"):
        read_history(tmp_path)
    (tmp_path / "step-00001.npz").write_bytes(b"no such thing")
    with pytest.raises(ValueError, match=r"step-00001\.npz: not a step of a wheel's life"):
        read_history(tmp_path)


@pytest.mark.parametrize("share", [0.0, 0.5, 0.99])
def test_a_step_that_is_cut_off_names_file_and_remedy(tmp_path: Path, share: float) -> None:
    whole = evolve(WP4, RADIUS, even(1e-8), 3000e3, tmp_path, LIMITS)
    last = tmp_path / f"step-{len(whole.steps) - 1:05d}.npz"
    content = last.read_bytes()
    last.write_bytes(content[: int(share * len(content))])
    with pytest.raises(ValueError, match=rf"{last.name}: .* delete it and all later steps"):
        read_history(tmp_path)
    last.unlink()
    _same(evolve(WP4, RADIUS, even(1e-8), 3000e3, tmp_path, LIMITS), whole)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda path: StepControl(max_depth=0.0),
            "max_depth = 0.0 m of a step of wear must be finite and > 0",
        ),
        (lambda path: StepControl(max_distance=math.inf), "max_distance = inf m"),
        (lambda path: StepControl(smoothing=1.0), "smoothing = 1.0 of a step of wear"),
        (
            lambda path: evolve(WP4, RADIUS, even(1e-8), -1.0, path),
            "distance = -1.0 m must be finite and >= 0",
        ),
        (lambda path: evolve(WP4, 0.0, even(1e-8), 1.0, path), "radius = 0.0 m must be finite and > 0 m"),
    ],
)
def test_bad_input(call: Callable[[Path], object], message: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=message):
        call(tmp_path)


def wears_in_noise(wheel: Profile, tmp_path: Path) -> None:
    """Noisy wear of tread and flange over 30,000 km: valid all along, and a file that reads back as it is."""
    generator = np.random.default_rng(1)
    y = np.arange(-0.05, 0.0505, 1e-3)
    depth = 9e-9 * np.exp(-((y / 0.02) ** 2)) + 3e-8 * np.exp(-(((y - 0.038) / 0.004) ** 2))
    wear = ProfileWear(y, depth * generator.uniform(0.9, 1.1, y.size))
    history = evolve(
        wheel, RADIUS, lambda profile: wear, 30e6, tmp_path, StepControl(max_depth=1e-3, max_distance=10e6)
    )
    before, after = history.steps[0].measures, history.last.measures
    assert after.flange_height - before.flange_height == pytest.approx(30e3 * 9e-9, rel=0.1)
    assert 0.2e-3 < before.flange_thickness - after.flange_thickness < 1.2e-3
    assert after.conicity > 0.0
    write_profile(history.last.profile, tmp_path / "worn.txt")
    again = read_wheel_profile(tmp_path / "worn.txt")
    heights = np.interp(history.last.profile.y, again.y, again.z)
    inner = history.last.profile.y < 0.05
    np.testing.assert_allclose(heights[inner], history.last.profile.z[inner], rtol=0.0, atol=30e-6)


@pytest.mark.parametrize("name", WORN_FILES)
def test_a_measured_worn_wheel_goes_through_wear(name: str, shared_profiles: Path, tmp_path: Path) -> None:
    wears_in_noise(read_wheel_profile(shared_profiles / name), tmp_path)


def test_a_scanned_worn_wheel_goes_through_wear(tmp_path: Path) -> None:
    wears_in_noise(read_wheel_profile(scan_of_hollow_wheel(tmp_path / "hollow.whl")), tmp_path / "steps")


def test_conicity_is_that_of_the_track() -> None:
    """A cone of 1:20 measures 0.05 at any gauge (amplitudes inside the flange clearance)."""
    y = np.concatenate([np.linspace(-0.06, 0.04, 400), np.linspace(0.0401, 0.05, 60)])
    z = -0.05 * y - 2.7 * np.maximum(y - 0.04, 0.0)
    wheel = Profile("cone", "wheel", y, z)
    for gauge in (1.435, 1.445):
        track = ConicityTrack(gauge=gauge, amplitude=2e-3)
        assert measure(wheel, RADIUS, track).conicity == pytest.approx(0.05, rel=1e-3)


def test_a_distance_below_what_the_folder_holds_is_the_state_there(tmp_path: Path) -> None:
    """As a life that ends there; it once was the wheel at 0 km. The folder stays as it is."""
    wear = even(60e-9)
    whole = evolve(WP4, RADIUS, wear, 4000e3, tmp_path / "life")
    files = sorted(path.name for path in (tmp_path / "life").iterdir())
    for distance in (0.0, 700e3, 1500e3, 2500e3):
        again = evolve(WP4, RADIUS, wear, distance, tmp_path / "life")
        alone = evolve(WP4, RADIUS, wear, distance, tmp_path / f"{distance:g}")
        assert again.last.distance == pytest.approx(distance)
        assert len(again.steps) == len(alone.steps)
        np.testing.assert_array_equal(again.last.profile.z, alone.last.profile.z)
        assert again.last.measures == alone.last.measures
    assert sorted(path.name for path in (tmp_path / "life").iterdir()) == files
    assert read_history(tmp_path / "life").last.distance == whole.last.distance


@pytest.mark.parametrize("distance", [math.nan, math.inf, -1.0])
def test_a_distance_that_is_none_is_refused(tmp_path: Path, distance: float) -> None:
    with pytest.raises(ValueError, match=r"distance = .* m must be finite and >= 0 m"):
        evolve(WP4, RADIUS, even(1e-9), distance, tmp_path / "life")
    assert not (tmp_path / "life").exists()


@pytest.mark.parametrize("distance", [math.nan, math.inf, 1000.0])
def test_a_folder_whose_distances_do_not_increase_is_refused(tmp_path: Path, distance: float) -> None:
    history = evolve(WP4, RADIUS, even(60e-9), 4000e3, tmp_path, LIMITS)
    write_step(tmp_path, 2, replace(history.steps[2], distance=distance))
    with pytest.raises(
        ValueError, match=r"step-00002.npz: distance = .* must be finite and above 1.5e\+06 m"
    ):
        evolve(WP4, RADIUS, even(60e-9), 5000e3, tmp_path, LIMITS)
