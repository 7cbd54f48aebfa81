"""Wheel profiles by side, wheelset and wheel."""

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.case import Case, CaseError, read_case
from hh_exudyn.case.overrides import overridden
from hh_exudyn.case.sealed import sealed
from hh_exudyn.case.wheels import wheel_names
from hh_exudyn.contact.profile import wheel_profile
from hh_exudyn.contact.profiles.measures import flange_thickness

DEMO = files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8")


def with_profiles(table: str) -> str:
    return DEMO.replace("[track]", f"[wheel_profiles]\n{table}\n\n[track]", 1)


def names(case: Case) -> list[tuple[str, str]]:
    return wheel_names(case.wheel_profiles, case.wheel_profile, 4)


def test_the_most_particular_counts() -> None:
    case = Case.from_toml(with_profiles('L = "WP4_like"\n2 = "WPL9_like"\n2R = "S1002"'))
    assert names(case) == [
        ("WP4_like", "S1002"), ("WPL9_like", "S1002"), ("WP4_like", "S1002"), ("WP4_like", "S1002")
    ]  # fmt: skip
    assert Case.from_toml(case.to_toml()) == case
    assert hash(Case.from_toml(case.to_toml())) == hash(case)
    assert [left.name for left, _ in case.wheels(4)] == ["WP4_like", "WPL9_like", "WP4_like", "WP4_like"]


def test_the_mirrored_case_has_them_on_the_other_side() -> None:
    case = Case.from_toml(with_profiles('1L = "WP4_like"\n2 = "WPL9_like"'))
    assert names(case.mirrored()) == [(right, left) for left, right in names(case)]
    assert case.mirrored().mirrored() == case


def test_the_thickest_wheelset_bounds_the_gauge() -> None:
    plain = Case.from_toml(DEMO)
    thin = {name: flange_thickness(wheel_profile(name)) for name in ("S1002", "WPL9_like", "WP4_like")}
    case = plain.with_changes(wheel_profiles=dict.fromkeys("1234", "WPL9_like") | {"4R": "WP4_like"})
    sums = thin["WPL9_like"] * 2, thin["WPL9_like"] + thin["WP4_like"]
    assert case.least_gauge - case.back_to_back == pytest.approx(max(sums), abs=1e-12)
    assert plain.least_gauge - plain.back_to_back == pytest.approx(2 * thin["S1002"], abs=1e-12)


def test_files_start_at_the_case_and_are_sealed(tmp_path: Path) -> None:
    profile = wheel_profile("S1002")
    rows = (f"{1e3 * y:.6f} {1e3 * z:.6f}\n" for y, z in zip(profile.y, profile.z, strict=True))
    (tmp_path / "worn.txt").write_text("".join(rows))
    (tmp_path / "case.toml").write_text(with_profiles('3R = "worn.txt"'))
    case = read_case(tmp_path / "case.toml")
    once = sealed(case)
    assert once.files["inputs/worn.txt"] == (tmp_path / "worn.txt").read_bytes()
    assert '3R = "inputs/worn.txt"' in once.text
    other = overridden(Case.from_toml(DEMO), {"wheel_profiles.3R": str(tmp_path / "worn.txt")})
    assert sealed(other).text == once.text


def test_the_model_has_a_table_for_every_profile() -> None:
    case = Case.from_toml(with_profiles('1L = "WP4_like"\n3 = "WP4_like"'))
    wheels = case.contact_model().wheels
    assert wheels.which.tolist() == [[0, 1], [1, 1], [0, 0], [1, 1]]
    assert Case.from_toml(DEMO).contact_model().wheels.which.size == 0


def test_all_wheels_are_smoothed_alike() -> None:
    """By the case's own length, as the wheel of a case without the table."""
    plain = Case.from_toml(DEMO).with_changes(contact={"profile_smoothing_mm": 2.0})
    own = plain.with_changes(wheel_profiles={"2R": "S1002"}).contact_model()
    wanted = plain.contact_model().wheel_left
    np.testing.assert_array_equal(own.wheels.nodes[0], [wanted.z, wanted.second, wanted.slope])


FAULTS = {
    '5 = "S1002"': "wheel_profiles.5: the vehicle has wheelsets 1 to 4",
    'X = "S1002"': 'key X: allowed a side "L" or "R", a wheelset "1", a wheel "1L"',
    '0L = "S1002"': "key 0L: allowed a side",
    "1L = 3": "1L = 3: allowed the name or the file of a wheel profile",
    '1L = "S1003"': "1L = S1003: unknown wheel profile 'S1003'; known: S1002",
    '1L = "none.txt"': "none.txt",
}


@pytest.mark.parametrize("table", FAULTS)
def test_faults_are_one_line(table: str) -> None:
    with pytest.raises(CaseError) as caught:
        Case.from_toml(with_profiles(table))
    assert FAULTS[table] in str(caught.value)
    assert "\n" not in str(caught.value)
