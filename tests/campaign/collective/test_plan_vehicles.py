"""The vehicle of a running: a name, a vehicle file, or the table of a variant, as in a case."""

from pathlib import Path

import pytest

from hh_exudyn.campaign.collective import Collective, plan_of_text, template_text

TEXT = template_text("malmbanan", "iore_wagon")
NAMED = 'vehicle = "iore_wagon_loaded"'
TABLE = 'vehicle = { base = "iore_wagon_loaded", wedge = { friction = 0.2 } }'


def collective(vehicle: str, folder: Path | None = None) -> Collective:
    assert TEXT.count(f"\n{NAMED}") == 1
    return Collective(plan_of_text(TEXT.replace(f"\n{NAMED}", f"\n{vehicle}"), "campaign", folder))


def test_a_name_is_a_vehicle_of_the_catalogue() -> None:
    running = collective(NAMED).plan.running[0]
    assert running.variant is None
    assert running.vehicle_of_case == running.vehicle == running.described.name == "iore_wagon_loaded"


def test_a_table_and_a_file_of_equal_numbers_are_the_same_cases(tmp_path: Path) -> None:
    """The name of a vehicle counts for the irregularity, so the file has the name of its base."""
    text = 'name = "iore_wagon_loaded"\nbase = "iore_wagon_loaded"\n[wedge]\nfriction = 0.2\n'
    (tmp_path / "slippery.toml").write_text(text)
    table, file = collective(TABLE), collective('vehicle = "slippery.toml"', tmp_path)
    strata = [next(row for row in one.strata if row.stratum.running == "loaded") for one in (table, file)]
    cases = [one.cases([row])[0].case for one, row in zip((table, file), strata, strict=True)]
    assert cases[0].described_vehicle() == cases[1].described_vehicle()
    assert cases[0].described_vehicle() != collective(NAMED).plan.running[0].described
    assert strata[0].stratum == strata[1].stratum


@pytest.mark.parametrize(
    ("vehicle", "words"),
    [
        ('vehicle = { base = "lorry" }', "vehicle 'lorry' is not known"),
        (TABLE.replace("friction", "frction"), r"did you mean wedge\.friction"),
        ('vehicle = "missing.toml"', r"missing\.toml: cannot be read"),
        ("vehicle = 3", "allowed a text"),
        ("vehicle = {}", "base is missing"),
    ],
)
def test_bad_vehicles(vehicle: str, words: str) -> None:
    with pytest.raises(ValueError, match=words) as found:
        collective(vehicle)
    assert r"running[0].vehicle" in str(found.value)
