"""Results that were once wrong without a word: each with the right value, or with what is said now.

The list is that of issue 14, section 3, as far as it needs no simulation; details are tested beside the code.
"""

import math
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from command_line import call
from made_up_run import made_up_run
from rolling_run import rolling_run

from damage.evolution.loop import evolve
from damage.evolution.profile_wear import ProfileWear
from damage.material import wheel_material
from damage.report import assess
from damage.wear.films import WearFilms
from hh_exudyn.assessment.report import standard_assessment
from hh_exudyn.case import Case, CaseError
from hh_exudyn.case.irregular import require_possible_track
from hh_exudyn.contact.profile import wheel_profile
from hh_exudyn.log.store import open_run, write_status
from track.irregularity.irregularity import Irregularity
from vehicles.catalogue import vehicle
from vehicles.variants import variant_of_table

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
CELLS = (20, 20)


def worn(run: Path, **options: object) -> float:
    """Worn area of the left wheel [mm^2/km]."""
    return assess(run, cells=CELLS, **options).to_table()["worn_area_mm2_per_km"].to_pylist()[-1]


def test_the_hardness_of_archards_law_is_the_steels(tmp_path: Path) -> None:
    """ER7 and ER9 wore alike, at 2.65 GPa: 235 HB are 2.305 GPa, and the wear is as 255 to 235."""
    run = rolling_run(tmp_path / "run", DEMO)
    er7, er9 = wheel_material("ER7"), wheel_material("ER9")
    assert er7.hardness == pytest.approx(2.3046e9, rel=1e-4)
    assert worn(run, material=er7) / worn(run, material=er9) == pytest.approx(255 / 235)
    from damage.wear.archard import archard

    assert worn(run, material=er7) / worn(run, law=archard(hardness=2.65e9)) == pytest.approx(
        2.65e9 / er7.hardness
    )


@pytest.mark.parametrize(
    ("angle", "divisor"), [(0.0, 1.0), (math.radians(30), 6.0), (math.radians(65), 100.0)]
)
def test_lubricant_of_the_case_divides_the_wear_by_zone(tmp_path: Path, angle: float, divisor: float) -> None:
    """Thesis, p. 70: 6 after Jendel, 100 after Zhu; all runs once wore as dry ones."""
    case = Case.from_toml(DEMO).with_changes(
        friction={"climate": "dry", "treatments": ["flange_lubrication"]}
    )
    run = rolling_run(tmp_path / "run", DEMO, contact_angle=angle)
    films = WearFilms(case.film_table(4), (4,))
    assert worn(run) / worn(run, films=films) == pytest.approx(divisor)


@pytest.mark.parametrize("reason", ["interrupted", "derailment: the wheelset has left the track"])
def test_a_run_that_ended_early_is_not_taken_for_a_whole_one(tmp_path: Path, reason: str) -> None:
    rolling_run(tmp_path / "run", DEMO)
    write_status(tmp_path / "run", {"finished": False, "reason": reason})
    with pytest.raises(ValueError, match=f"is not finished: {reason}"):
        assess(tmp_path / "run", cells=CELLS)
    named = assess(open_run(tmp_path / "run"), cells=CELLS, unfinished=True)
    for table in (named.to_table(), named.distance_table(1e6)):
        assert set(table["run"].to_pylist()) == {reason}


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"nu_x": 1e6}, "nu_x = 1e\\+06"),
        ({"speed": 1e9}, "speed = 1e\\+09 m/s"),
        ({"wheelset": 99}, "wheelset = 99"),
        ({"friction": 50.0}, "friction = 50"),
        ({"time": 0.0}, "has another row at time = 0 s"),
    ],
)
def test_impossible_values_and_equal_times_are_caught(
    tmp_path: Path, values: dict[str, float], message: str
) -> None:
    run = rolling_run(tmp_path / "run", DEMO, **values)
    with pytest.raises(ValueError, match=message):
        assess(run, cells=CELLS)


def test_a_narrow_gauge_by_irregularity_is_refused() -> None:
    """1410 mm ran with contact pressures of 6.6 GPa; the section alone was refused."""
    case = Case.from_toml(DEMO)
    with pytest.raises(CaseError, match="gauge_mm = 1410 mm leaves no flange clearance"):
        Case.from_toml(DEMO.replace("1445.0", "1410.0"))
    values = np.zeros((801, 4))
    values[:, 2] = -0.035
    with pytest.raises(ValueError, match="gauge with irregularity is 1410 mm"):
        require_possible_track(case, case.alignment(), Irregularity(20.0, 0.25, values))


@pytest.mark.parametrize(
    ("part", "quantity", "value"),
    [
        ("wagon", "payload", 98.4),  # t
        ("axle_box_pad", "longitudinal_stiffness", 13.1345),  # MN/m
        ("wheelset", "wheelbase", 1778.0),  # mm
        ("bolster", "height", -0.67),
        ("wagon", "centre_plate_distance", 11.0),  # beyond the ends of the body
        ("axle_box", "stop_stiffness", 1e15),  # took 188 s
    ],
)
def test_numbers_in_other_units_or_places_are_refused(part: str, quantity: str, value: float) -> None:
    with pytest.raises(ValueError, match=r"plausible|outside the vehicle"):
        variant_of_table({"name": "v", "base": "iore_wagon_loaded", part: {quantity: value}}, "test")


def test_said_units_are_converted() -> None:
    changes = {
        "axle_box_pad": {"longitudinal_stiffness": {"value": 13134.5, "unit": "kN/m"}},
        "wheelset": {"wheelbase": {"value": 1778, "unit": "mm"}},
    }
    same = variant_of_table({"name": "iore_wagon_loaded", "base": "iore_wagon_loaded", **changes}, "test")
    assert same.vehicle() == vehicle("iore_wagon_loaded")


def test_a_body_below_the_rails_is_refused() -> None:
    wagon = vehicle("iore_wagon_loaded")
    sunk = replace(wagon.bodies[0], position=(0.0, 0.0, -1.9))
    with pytest.raises(ValueError, match=r"car_body lies -1\.9 m above the rails"):
        replace(wagon, bodies=(sunk, *wagon.bodies[1:]))


def test_stretches_without_a_section_are_named(tmp_path: Path) -> None:
    run = made_up_run(tmp_path / "run", lambda w, side, t: 1e5 + 0 * t, lambda w, side, t: 0 * t)
    found = standard_assessment(run)
    assert [part.stretch.kind for part in found.left_out] == ["transition", "curve, 600 m and more"]
    assert "not assessed: curve R 20000 m" in call("assess", run.directory).stdout


def test_a_life_shorter_than_the_folders_is_the_wheel_at_that_distance(tmp_path: Path) -> None:
    """It was the wheel at 0 km. Even wear of 60 um per 1000 km."""
    wear = ProfileWear(np.array([-0.08, 0.08]), np.full(2, 60e-9))
    wheel = wheel_profile("WP4_like")
    evolve(wheel, 0.4575, lambda profile: wear, 4000e3, tmp_path)
    half = evolve(wheel, 0.4575, lambda profile: wear, 2000e3, tmp_path).last
    assert half.distance == 2000e3
    assert 0.4575 - half.radius == pytest.approx(2000 * 60e-9, rel=0.01)
