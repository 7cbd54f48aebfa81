"""A sealed case: its vehicle and files by content, the same again when it is sealed again."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.case import Case, read_case
from hh_exudyn.case.sealed import SealedCase, sealed
from hh_exudyn.contact.profile import wheel_profile
from vehicles.stored import from_json

CASE = """
name = "with files"
vehicle = "worn.toml"
speed_km_h = 60.0
friction = 0.4
wheel_profile = "mine/wheel.csv"
[track]
rail_left = "mine/rail.csv"
rail_right = "other/rail.csv"
alignment = "line.csv"
irregularity = "rough.csv"
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A case with every kind of file; two rails of one file name."""
    root = tmp_path / "home"
    for name in ("mine", "other"):
        (root / name).mkdir(parents=True)
    wheel = wheel_profile("S1002")
    rows = "\n".join(f"{1e3 * y:.6f},{1e3 * z:.6f}" for y, z in zip(wheel.y, wheel.z, strict=True))
    (root / "mine" / "wheel.csv").write_text(f"{rows}\n")
    for name, wide in (("mine", 35.0), ("other", 36.0)):
        y = np.linspace(-wide, wide, 141)
        z = -(y**2) / 600.0 - np.where(np.abs(y) > 30.0, (np.abs(y) - 30.0) ** 2 * 0.6, 0.0)
        text = "\n".join(f"{a:.4f},{b:.6f}" for a, b in zip(y, z, strict=True))
        (root / name / "rail.csv").write_text(f"{text}\n")
    (root / "worn.toml").write_text('base = "iore_wagon_loaded"\nwedge.friction = 0.3\n')
    (root / "case.toml").write_text(CASE)
    return root


def written(whole: SealedCase, root: Path) -> Path:
    for name, content in whole.files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes(content)
    (root / "case.toml").write_text(whole.text)
    return root / "case.toml"


def only_profiles(root: Path) -> Case:
    """The case without the two long files, on a straight."""
    text = (
        (root / "case.toml").read_text().replace('alignment = "line.csv"\nirregularity = "rough.csv"\n', "")
    )
    (root / "case.toml").write_text(f'{text}\n[[track.sections]]\nkind = "straight"\nlength_m = 60.0\n')
    return read_case(root / "case.toml")


def test_sources_may_go(folder: Path, tmp_path: Path) -> None:
    case = only_profiles(folder)
    wheel, vehicle = case.wheel, case.described_vehicle()
    whole = sealed(case)
    assert sorted(whole.files) == ["inputs/2-rail.csv", "inputs/rail.csv", "inputs/wheel.csv", "vehicle.json"]
    file = written(whole, tmp_path / "run")
    shutil.rmtree(folder)
    again = read_case(shutil.move(file.parent, tmp_path / "sent") / Path("case.toml"))
    np.testing.assert_array_equal(again.wheel.z, wheel.z)
    assert again.described_vehicle() == vehicle
    assert sealed(again) == whole
    assert sealed(again).digest == whole.digest
    left, right = (
        again.track.rails_along().sections[0].rails.left,
        again.track.rails_along().sections[0].rails.right,
    )
    assert Path(left).name == "rail.csv"
    assert Path(right).name == "2-rail.csv"


def test_every_content_counts(folder: Path) -> None:
    case = only_profiles(folder)
    before = sealed(case).digest
    wheel = folder / "mine" / "wheel.csv"
    wheel.write_text(wheel.read_text().replace("0.000000", "0.000001", 1))
    after = sealed(case).digest
    assert after != before
    vehicle = case.described_vehicle()
    heavier = replace(vehicle.bodies[0], mass=vehicle.bodies[0].mass + 1.0)
    other = replace(vehicle, bodies=(heavier, *vehicle.bodies[1:]))
    assert sealed(case, other).digest != after
    assert from_json(sealed(case, other).files["vehicle.json"].decode()) == other


def test_the_origin_of_the_vehicle_is_kept(folder: Path, tmp_path: Path) -> None:
    from hh_exudyn.case.numbers import case_numbers

    case = only_profiles(folder)
    again = read_case(written(sealed(case), tmp_path / "run"))
    assert case_numbers(again) == case_numbers(case)
    bare = replace(case.described_vehicle(), name="of my own")
    own = read_case(written(sealed(case, bare), tmp_path / "own"))
    assert len(case_numbers(own)) < len(case_numbers(case))


def test_a_file_that_has_gone_is_named(folder: Path) -> None:
    case = only_profiles(folder)
    (folder / "mine" / "wheel.csv").unlink()
    with pytest.raises(ValueError, match=r"wheel_profile .*wheel\.csv: cannot be read: No such file"):
        sealed(case)
