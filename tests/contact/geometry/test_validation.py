"""The table of ``hh-exudyn validate geometry``."""

from pathlib import Path

import pytest

from hh_exudyn.contact.comparison import Comparison
from hh_exudyn.contact.geometry.validation import (
    CASES,
    benchmark_columns,
    cone,
    conicity_rows,
    geometry_table,
    radius_difference_rows,
    standard_pair,
)
from hh_exudyn.contact.profile import Profile, rail_profile


def failing(rows: list[Comparison]) -> list[str]:
    return [f"{row.source}: {row.quantity}" for row in rows if not row.holds]


def test_every_row_holds_without_the_standards_profiles() -> None:
    """Cones, and the integration of the standard's own radius differences."""
    rows = geometry_table()
    assert len(rows) == 6
    assert failing(rows) == []


@pytest.fixture(scope="module", params=CASES)
def en_case(request: pytest.FixtureRequest, shared_profiles: Path) -> tuple[str, Profile, Profile]:
    return request.param, *standard_pair(shared_profiles, request.param)


def test_radius_difference_of_en_15302(en_case: tuple[str, Profile, Profile]) -> None:
    assert failing(radius_difference_rows(*en_case)) == []


def test_conicity_of_en_15302(en_case: tuple[str, Profile, Profile]) -> None:
    assert failing(conicity_rows(*en_case)) == []


def test_another_wheel_fails() -> None:
    """A cone of 1:20 is none of the standard's wheels."""
    wheel, rail = cone(0.05), rail_profile("60E1", 1.0 / 30.0)
    assert len(failing(radius_difference_rows("E4", wheel, rail))) >= 2
    assert len(failing(conicity_rows("E4", wheel, rail))) == 3


def test_a_folder_without_the_profiles_is_an_error(tmp_path: Path) -> None:
    with pytest.raises((ValueError, OSError), match="RUIC519A"):
        geometry_table(tmp_path)


def test_the_benchmark_is_read_whole() -> None:
    assert {case: benchmark_columns("en15302_conicity.csv", case).shape for case in CASES} == dict.fromkeys(
        CASES, (6, 66)
    )
    lateral, delta_r = benchmark_columns("en15302_radius_difference.csv", "E1")
    assert (lateral[0], delta_r[0]) == (-6.8, -10.954)
