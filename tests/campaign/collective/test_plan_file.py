"""The file of a load collective: the template, and faults in one line."""

import re
from pathlib import Path

import pytest

from hh_exudyn.campaign.collective import Collective, plan_of_text, read_plan, template_text

TEXT = template_text()


@pytest.mark.parametrize(
    "vehicle", ["iore_wagon_pair", "iore_locomotive", "iore_locomotive_pair", "y25_wagon"]
)
def test_the_template_of_a_vehicle_is_a_plan(vehicle: str) -> None:
    plan = plan_of_text(template_text("malmbanan", vehicle))
    assert {running.vehicle.removesuffix("_loaded").removesuffix("_empty") for running in plan.running} == {
        vehicle
    }
    assert plan.distance == 150e6
    assert sum(season.share for season in plan.seasons) == pytest.approx(1.0)
    assert min(s.friction.flange for s in plan.seasons) == 0.2
    assert max(s.friction.tread for s in plan.seasons) == 0.75  # Hossein-Nia 2018, 1.1.5


def test_every_assumed_share_of_the_seasons_has_a_range() -> None:
    shares = [n for n in plan_of_text(TEXT).numbers if re.fullmatch(r"season\[\d\]\.share_percent", n.name)]
    assert len(shares) == 6
    assert all(n.range is not None or "remainder" in n.source or "tribometer" in n.source for n in shares)


def test_a_file_with_a_line_of_its_own(tmp_path: Path) -> None:
    quarry = Path(__file__).parents[2] / "track" / "line" / "quarry_line.toml"
    (tmp_path / "line.toml").write_text(quarry.read_text())
    text = template_text(str(tmp_path / "line.toml"), "iore_wagon_loaded")
    (tmp_path / "campaign.toml").write_text(text.replace(str(tmp_path / "line.toml"), "line.toml"))
    plan = read_plan(tmp_path / "campaign.toml")
    assert plan.line == str(tmp_path / "line.toml")
    assert Collective(plan).share() == pytest.approx(1.0, abs=1e-12)


def test_worn_rails_of_single_classes() -> None:
    text = TEXT.replace(
        "percent = { new = 100.0 }", 'percent = { new = 100.0 }\nof_class = { "<400" = { new = 100.0 } }'
    )
    with pytest.raises(
        ValueError, match="curve class '<400' of Malmbanan and Ofotbanen: allowed <350, 350:400"
    ):
        _ = Collective(plan_of_text(text)).strata
    text = text.replace('"<400" = { new = 100.0 }', '"<350" = { worn = 100.0 }')
    with pytest.raises(ValueError, match="wear state 'worn' is not known, there are: new"):
        _ = Collective(plan_of_text(text)).strata


FAULTS = {
    "share": (
        ("share_percent = 12.0", "share_percent = 13.0"),
        "campaign: season: share_percent sums to 101 %: allowed 100 %",
    ),
    "range": (
        ("deviation_mm = 4.0", "deviation_mm = 40.0"),
        "gauge.deviation_mm = 40 mm: allowed 0 to 15 mm",
    ),
    "outside": (
        ("deviation_mm = 4.0", "deviation_mm = 7.0"),
        "gauge.deviation_mm: value 7 lies outside its range",
    ),
    "typo": (
        ("quantiles = 8", "quantile = 8"),
        "gauge.quantiles is missing: allowed 1 to 64 -; is it gauge.quantile",
    ),
    "half": (("quantiles = 8", "quantiles = 2.5"), "gauge.quantiles = 2.5 -: allowed whole numbers 1 to 64"),
    "unknown": (("quantiles = 8", "quantiles = 8\nsteps = 4"), "unknown key gauge.steps"),
    "design": (('kind = "sampled"', 'kind = "some"'), "design.kind = 'some': allowed full, overlay, sampled"),
    "climate": (
        ('climate = "dry"', 'climate = "arid"'),
        r"season\[3\].climate = 'arid': allowed very_humid, humid",
    ),
    "both": (
        ('climate = "dry"', 'climate = "dry"\ntread = 0.5'),
        r"season\[3\].climate and season\[3\].tread",
    ),
    "film": (
        ('film = { tread = "lubricated"', 'film = { tread = "oily"'),
        "film.tread = 'oily': allowed dry, lubricated",
    ),
    "treatment": (
        ('["flange_lubrication"]', '["soap"]'),
        r"treatments = \['soap'\]: allowed a list out of top_of_rail",
    ),
    "foundation": (('"concrete_frozen"', '"ice"'), r"season\[4\].flexibility = 'ice'"),
    "vehicle": (
        ("iore_wagon_pair_loaded", "iore_waggon"),
        r"running\[0\].vehicle: vehicle 'iore_waggon' is not known",
    ),
    "twice": (
        ('name = "humid"', 'name = "dry"'),
        "season.name = 'dry' is there twice: allowed names that differ",
    ),
    "source": (
        ('source = "assumed: share; hand', 'source = "from share; hand'),
        r"season\[3\].source = .*: allowed a text that starts",
    ),
    "own": (
        ("[case.track]", "[case.track]\nirregularity_seed = 3"),
        "case.track.irregularity_seed: set by the load coll",
    ),
    "merged": (('"350:400", "400:450"', '"350:400", "350:400"'), "design.merged_classes = .*each name once"),
    "ranges": (("lowest = [0.2, 0.8]", "least = [0.2, 0.8]"), "quality.ranges.least: quality has no least"),
    "haul": (
        ("shoe_force_kN = 10.0", "gradient_per_mille = 6.0"),
        "shoe_force_kN: running.* has no shoe_force_kN",
    ),
    "speed": (
        ("[100.0, 80.0], share_percent = [70.0, 30.0]", "[100.0, 80.0], share_percent = [70.0, 20.0]"),
        "speed.share_percent sums to 90 %: allowed 100 %",
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_one_line_with_key_value_and_what_is_allowed(name: str) -> None:
    (old, new), message = FAULTS[name]
    assert old in TEXT
    with pytest.raises(ValueError, match=message) as caught:
        plan_of_text(TEXT.replace(old, new, 1))
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith("campaign: ")


def test_a_class_or_vehicle_that_the_line_has_not() -> None:
    with pytest.raises(ValueError, match="curve class '350:500' of Malmbanan and Ofotbanen: allowed <350"):
        _ = Collective(plan_of_text(TEXT.replace('"350:400", "400:450"', '"350:500"'))).strata
    with pytest.raises(ValueError, match="has no speed for vehicle 'tram'"):
        text = TEXT.replace('line_vehicle = "iore_wagon_loaded"', 'line_vehicle = "tram"')
        _ = Collective(plan_of_text(text)).strata
    with pytest.raises(ValueError, match="vehicle 'tram' is not known"):
        template_text("malmbanan", "tram")


def test_shares_of_hauls_in_a_class_are_whole_and_of_a_class_of_the_line() -> None:
    text = template_text("malmbanan", "iore_locomotive")
    with pytest.raises(ValueError, match=r"running\[0\].haul: of_class.'<350' sums to 95 % over all hauls"):
        plan_of_text(text.replace('"<350" = 10.0', '"<350" = 5.0'))
    with pytest.raises(ValueError, match="curve class '<300' of Malmbanan and Ofotbanen: allowed <350"):
        _ = Collective(plan_of_text(text.replace('"<350" = ', '"<300" = '))).strata
