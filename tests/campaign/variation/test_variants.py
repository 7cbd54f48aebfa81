"""Variants of a campaign's file: what differs, shares, axle load, gauge, same random numbers, bad keys."""

import math
import tomllib
from pathlib import Path
from typing import Any

import pytest
from made_up_campaign import campaign_file

from hh_exudyn.campaign.life.plan import CampaignPlan, campaign_of_text
from hh_exudyn.campaign.variation.changed import changed_text
from hh_exudyn.campaign.variation.handy import mean_gauge
from hh_exudyn.campaign.variation.variants import variants

SEASONS = ("wet or snow", "humid", "moderate", "dry", "cold and dry", "lubricated flange")


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return campaign_file(tmp_path_factory.mktemp("file"))


def differences(one: Any, two: Any, place: str = "") -> set[str]:
    """Keys at which two files differ; names of campaigns do not count."""
    if isinstance(one, dict) and isinstance(two, dict):
        keys = {*one, *two} - ({"name"} if not place else set())
        return {
            found
            for key in keys
            for found in differences(one.get(key), two.get(key), f"{place}.{key}".strip("."))
        }
    if isinstance(one, list) and isinstance(two, list) and len(one) == len(two):
        pairs = enumerate(zip(one, two, strict=True))
        return {found for i, (a, b) in pairs for found in differences(a, b, f"{place}[{i}]")}
    return set() if one == two else {place}


def changed(file: Path, **changes: Any) -> set[str]:
    text = changed_text(file, {key.replace("__", "."): value for key, value in changes.items()})
    return differences(tomllib.loads(file.read_text()), tomllib.loads(text))


def plan_of(file: Path, changes: dict[str, Any]) -> CampaignPlan:
    return campaign_of_text(changed_text(file, changes), "variant", Path())


def test_a_variant_differs_in_its_key_alone(file: Path) -> None:
    assert changed(file) == set()
    assert changed(file, gauge__deviation_mm=5.0) == {"gauge.deviation_mm"}
    assert changed(file, case__wheel_profile="S1002") == {"case.wheel_profile"}
    assert changed(file, step__profile_um=10.0) == {"step.profile_um"}
    assert changed(file, material="ER9") == {"damage"}  # there was no such table
    assert changed(file, gauge=1442.0) == {"gauge.shift_mm"}
    assert changed(file, axle_load=32.5) == {"running[0].vehicle"}  # the empty one has no load
    assert changed(file, **{"season[1]__climate": "dry"}) == {"season[1].climate"}
    assert changed(file, wedge__friction=0.2) == {"running[0].vehicle", "running[1].vehicle"}


def test_a_number_that_leaves_its_range_has_none(file: Path) -> None:
    assert changed(file, gauge__deviation_mm=8.0) == {"gauge.deviation_mm", "gauge.ranges.deviation_mm"}
    assert plan_of(file, {"gauge.deviation_mm": 8.0}).collective.plan.gauge.deviation == pytest.approx(8e-3)


@pytest.mark.parametrize(
    "changes",
    [
        {"season.dry.share_percent": 30.0},
        {"season.dry.share_percent": 30.0, "season.humid.share_percent": 5.0},
        {"lubrication": 25.0},
        {"lubrication": 0.0, "season.dry.share_percent": 50},
    ],
)
def test_shares_sum_to_the_whole_and_keep_their_proportions(file: Path, changes: dict[str, float]) -> None:
    before = {one.name: one.share for one in plan_of(file, {}).collective.plan.seasons}
    after = {one.name: one.share for one in plan_of(file, changes).collective.plan.seasons}
    assert math.fsum(after.values()) == pytest.approx(1.0, abs=1e-12)
    wanted = {
        "lubricated flange" if key == "lubrication" else key.split(".")[1]: 1e-2 * value
        for key, value in changes.items()
    }
    assert {name: after[name] for name in wanted} == pytest.approx(wanted)
    ratios = [after[name] / before[name] for name in SEASONS if name not in wanted]
    assert ratios == pytest.approx([ratios[0]] * len(ratios))


def test_the_order_of_changes_does_not_matter(file: Path) -> None:
    changes = {"season.dry.share_percent": 30.0, "axle_load": 31, "season.humid.share_percent": 5.0}
    assert changed_text(file, changes) == changed_text(file, dict(reversed(changes.items())))


def test_shares_of_hauls_make_room_too(file: Path) -> None:
    plan = plan_of(file, {"running.loaded.haul.braking.share_percent": 20}).collective.plan
    assert {haul.name: haul.share for haul in plan.running[0].hauls} == pytest.approx(
        {"rolling": 0.8, "braking": 0.2}
    )


@pytest.mark.parametrize("load", [25.0, 32.5])
def test_the_loaded_vehicle_alone_has_another_axle_load(file: Path, load: float) -> None:
    collective = plan_of(file, {"axle_load": load}).collective
    loaded, empty = collective.plan.running
    assert loaded.described.mass / 4 == pytest.approx(1e3 * load)
    assert empty.described.mass / 4 == pytest.approx(5400.0)
    of_running = {item.stratum.running: item for item in collective.strata}
    for running in (loaded, empty):
        case = collective.cases([of_running[running.name]])[0].case
        assert case.described_vehicle().mass == running.described.mass


def test_the_mean_gauge_of_the_line_is_moved_with_the_same_irregularity(file: Path) -> None:
    before, after = plan_of(file, {}).collective, plan_of(file, {"gauge": 1445}).collective
    shift = 1445.0 - 1e3 * mean_gauge(before.plan)
    assert 1437.0 < 1e3 * mean_gauge(before.plan) < 1445.0  # straight track, tight curves
    for one, two in zip(before.strata, after.strata, strict=True):
        assert two.stratum.gauge_mm - one.stratum.gauge_mm == pytest.approx(shift, abs=1e-5)
        assert (one.weight, one.stratum.seed) == (two.weight, two.stratum.seed)
        assert one.stratum.key != two.stratum.key
    case, wider = before.cases(before.strata[:1])[0].case, after.cases(after.strata[:1])[0].case
    assert wider.track.sections[0].gauge_mm - case.track.sections[0].gauge_mm == pytest.approx(
        shift, abs=1e-5
    )


def test_a_vehicle_with_other_numbers_meets_the_same_irregularity(file: Path) -> None:
    before, after = plan_of(file, {}).collective, plan_of(file, {"wedge.friction": 0.2}).collective
    assert [one.stratum.seed for one in before.strata] == [two.stratum.seed for two in after.strata]


def test_all_combinations(file: Path) -> None:
    found = variants(file, {"gauge": [1438, 1442], "material": ["ER7", "ER9"]})
    assert list(found) == [f"gauge={g},material={m}" for g in (1438, 1442) for m in ("ER7", "ER9")]


def test_paths_of_the_file_start_at_its_folder(tmp_path: Path) -> None:
    path = campaign_file(tmp_path)
    (tmp_path / "stiff.toml").write_text('base = "iore_wagon_loaded"\n[wedge]\nfriction = 0.2\n')
    text = path.read_text().replace('vehicle = "iore_wagon_loaded"', 'vehicle = "stiff.toml"', 1)
    path.write_text(text)
    running = plan_of(path, {"gauge": 1440}).collective.plan.running[0]
    assert running.vehicle == "stiff"
    assert running.variant is not None
    assert running.variant.parameters()["wedge.friction"] == 0.2
    heavier = plan_of(path, {"axle_load": 31}).collective.plan.running[0]
    assert heavier.described.mass / 4 == pytest.approx(31e3)
    assert heavier.variant is not None
    assert heavier.variant.parameters()["wedge.friction"] == 0.2


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"gauge.devation_mm": 1.0}, "unknown key gauge.devation_mm; did you mean deviation_mm"),
        ({"season.dri.share_percent": 1.0}, "season has no 'dri': allowed wet or snow, humid, moderate, dry"),
        (
            {"wege.friction": 0.3},
            "allowed axle_load, gauge, lubrication, material.*did you mean wedge.friction",
        ),
        ({"case.wheel_profil": "S1002"}, 'did you mean "wheel_profile"'),
        ({"case.wheel_profile": "none"}, "none"),
        ({"material": "ER99"}, "allowed ER7, ER8, ER9"),
        ({"axle_load": 5.0}, "allowed above 5.4 t, empty"),
        ({"axle_load": "heavy"}, "axle_load = 'heavy' t: allowed 1 to 60 t"),
        ({"lubrication": 120}, "allowed 0 to 100 %"),
        ({"season.dry.share_percent": 60, "season.humid.share_percent": 50}, "110 % are set.*allowed 100 %"),
        ({"running[7].name": "x"}, "running has 2 items, counted from 0"),
        ({"gauge.deviation_mm.x": 1.0}, "gauge.deviation_mm is 4.0, no table"),
        ({"season..x": 1.0}, "allowed names with dots between them"),
    ],
)
def test_bad_keys_and_values_name_what_is_allowed(file: Path, changes: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words) as found:
        variants(file, {key: [value] for key, value in changes.items()})
    assert "\n" not in str(found.value)


def test_names_that_are_the_same_are_refused(file: Path) -> None:
    with pytest.raises(ValueError, match="two variants are named"):
        variants(file, {"gauge": [1440, 1440]})
