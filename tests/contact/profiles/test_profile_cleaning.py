"""Order, duplicates, loops and overhangs of scanned curves."""

from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.contact.profile import Profile, rail_profile, read_profile, wheel_profile
from hh_exudyn.contact.profiles.cleaning import distinct, file_order, single_valued

MM = 1e-3
S1002, RAIL = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)


def read(path: Path, y: np.ndarray, z: np.ndarray) -> tuple[Profile, tuple[str, ...]]:
    np.savetxt(path, 1e3 * np.column_stack([y, z]), fmt="%.9f")
    found = read_profile(path, smoothing="never")
    return found.profile, found.report.notes


def test_duplicates_are_left_out(tmp_path: Path) -> None:
    twice = np.repeat(np.arange(len(S1002.y)), 2)
    profile, notes = read(tmp_path / "w.txt", S1002.y[twice], S1002.z[twice])
    assert notes == (f"{len(S1002.y)} duplicates left out",)
    np.testing.assert_allclose(profile.y, S1002.y, atol=1e-12)
    assert list(distinct(np.array([0.0, 0.5e-6, 2e-6]), np.zeros(3))) == [0, 2]


@pytest.mark.parametrize("profile", [S1002, RAIL], ids=["wheel", "rail"])
def test_shuffled_lines_are_sorted(tmp_path: Path, profile: Profile) -> None:
    order = np.random.default_rng(3).permutation(len(profile.y))
    found, notes = read(tmp_path / "p.txt", profile.y[order], profile.z[order])
    assert "shuffled" in notes[0]
    np.testing.assert_allclose(found.y, profile.y, atol=1e-12)
    assert list(file_order(profile.y, profile.z)) == list(range(len(profile.y)))


def test_an_undercut_head_ends_where_it_turns_back(tmp_path: Path) -> None:
    """Below the flanks the underside of the head runs back at 1:4: no z(y) there."""
    under = np.linspace(0.3, 12, 40) * MM
    y = np.concatenate([(RAIL.y[0] + under)[::-1], RAIL.y, RAIL.y[-1] - under])
    z = np.concatenate([(RAIL.z[0] - under / 4)[::-1], RAIL.z, RAIL.z[-1] - under / 4])
    profile, notes = read(tmp_path / "r.txt", y, z)
    assert notes == ("80 points of overhangs cut off",)
    np.testing.assert_allclose(profile.y, RAIL.y, atol=1e-12)
    np.testing.assert_allclose(profile.z, RAIL.z, atol=1e-12)


def test_a_flange_back_that_hangs_over_ends_the_profile(tmp_path: Path) -> None:
    back = np.linspace(0.5, 20, 40) * MM  # upwards from the upright end of S1002, leaning to the field side
    y = np.concatenate([S1002.y, S1002.y[-1] - 0.01 * back])
    profile, notes = read(tmp_path / "w.txt", y, np.concatenate([S1002.z, S1002.z[-1] + back]))
    assert notes == ("40 points of overhangs cut off",)
    np.testing.assert_allclose(profile.y, S1002.y, atol=1e-12)


def test_a_loop_of_the_probe_is_left_out(tmp_path: Path) -> None:
    """The probe stops at y = 10 mm, goes back 0.3 mm and comes again, 0.05 mm higher."""
    stop = int(np.searchsorted(S1002.y, 10 * MM))
    back = np.linspace(-0.05, -0.3, 6) * MM
    loop = np.concatenate([back, back[::-1]])
    y = np.concatenate([S1002.y[:stop], S1002.y[stop - 1] + loop, S1002.y[stop:]])
    z = np.concatenate([S1002.z[:stop], S1002.z[stop - 1] + 0.05 * MM + 0 * loop, S1002.z[stop:]])
    profile, notes = read(tmp_path / "w.txt", y, z)
    assert notes == ("1 duplicates left out", "11 points in loops left out")  # it turns on one spot
    np.testing.assert_allclose(profile.y, S1002.y, atol=1e-12)


def test_single_valued_follows_the_curve_from_its_anchor() -> None:
    y = np.array([3.0, 2.0, 0.0, 1.0, 2.0, 1.9, 2.1, 3.0, 2.0, 1.0]) * MM
    z = np.array([-2.0, -2.0, -1.0, 0.0, 0.0, 0.1, 0.0, 0.0, -2.0, -5.0]) * MM
    kept, loops, overhangs = single_valued(y, z, 3)
    assert list(kept) == [2, 3, 4, 6, 7]
    assert (loops, overhangs) == (1, 4)


def test_all_together_backwards(tmp_path: Path) -> None:
    """The undercut rail once more, upside down, from the gauge side, with duplicates."""
    under = np.linspace(0.3, 12, 40) * MM
    y = np.concatenate([(RAIL.y[0] + under)[::-1], RAIL.y, RAIL.y[-1] - under])[::-1].repeat(3)
    z = np.concatenate([(RAIL.z[0] - under / 4)[::-1], RAIL.z, RAIL.z[-1] - under / 4])[::-1].repeat(3)
    profile, notes = read(tmp_path / "r.txt", y, -z)
    assert len(notes) == 2
    np.testing.assert_allclose(profile.y, RAIL.y, atol=1e-12)
    np.testing.assert_allclose(profile.z, RAIL.z, atol=1e-12)
