"""Weights of a load collective reproduce every share of its file and of its line."""

import csv
import math
from collections import defaultdict
from functools import cache
from pathlib import Path

import pytest
from collectives import product_text

from hh_exudyn.campaign.collective import Collective, plan_of_text, template_text
from hh_exudyn.campaign.collective.plan import DESIGNS, HANDS, SAMPLED
from track.irregularity.quality import CLASSES
from track.line.line import read_line

REFERENCE = Path(__file__).parents[2] / "reference" / "hossein_nia_2018_line.csv"
EXACT = 1e-12
LOCOMOTIVE = "iore_locomotive"


def table() -> list[dict[str, str]]:
    lines = [line for line in REFERENCE.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def collective(design: str = "overlay", hands: str = "merged", replicates: int = 3) -> Collective:
    text = product_text(design, replicates=replicates) if design != SAMPLED else template_text()
    return Collective(plan_of_text(text.replace('hands = "merged"', f'hands = "{hands}"')))


OF_CELLS = [(design, hands) for design in DESIGNS if design != SAMPLED for hands in HANDS]


@pytest.fixture(scope="module", params=[*OF_CELLS, *((SAMPLED, hands) for hands in HANDS)])
def found(request: pytest.FixtureRequest) -> Collective:
    return made(*request.param)


@pytest.fixture(scope="module", params=OF_CELLS)
def cells(request: pytest.FixtureRequest) -> Collective:
    """With the exact shares of every axis; what points have of them is in `test_stratified`."""
    return made(*request.param)


@cache
def made(design: str, hands: str) -> Collective:
    return collective(design, hands, 2 if design == "overlay" else 1)


def test_classes_and_hands_are_those_of_the_curve_table(found: Collective) -> None:
    """Table 1-3 for the loaded train; for the empty one, which returns, with left and right exchanged."""
    other = {"left": "right", "right": "left"}
    for row in table():
        share = float(row["share_percent"]) / 100.0
        for running, hand in (("loaded", row["hand"]), ("empty", other[row["hand"]])):
            mine = found.share(running=running, curve_class=row["class"], hand=hand)
            assert mine == pytest.approx(0.5 * share, abs=EXACT)
    assert found.share() == pytest.approx(1.0, abs=EXACT)
    assert found.share(hand="straight") == pytest.approx(0.502, abs=EXACT)


def test_quality_within_every_class_is_the_lines(cells: Collective) -> None:
    for part in read_line("malmbanan").classes:
        for quality, share in zip(CLASSES, part.quality, strict=True):
            mine = cells.share(running="loaded", curve_class=part.name, hand=part.hand, quality=quality)
            assert mine == pytest.approx(0.5 * part.share * share, abs=EXACT)


def test_every_axis_has_the_shares_of_the_file_in_every_group(cells: Collective) -> None:
    by: dict[tuple[str, str], dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))
    for item in cells.strata:
        group = (item.stratum.running, item.stratum.group)
        for axis in ("season", "haul", "speed_km_h", "gauge_mm"):
            by[group][f"{axis}={getattr(item.stratum, axis)}"].append(item.weight)
        by[group]["all"].append(item.weight)
    for shares in by.values():
        whole = math.fsum(shares["all"])
        for season in cells.plan.seasons:
            assert math.fsum(shares[f"season={season.name}"]) == pytest.approx(
                season.share * whole, abs=EXACT
            )
        assert math.fsum(shares["haul=braking"]) == pytest.approx(0.05 * whole, abs=EXACT)
        speeds = [math.fsum(value) / whole for key, value in shares.items() if key.startswith("speed_km_h")]
        assert sorted(speeds) == pytest.approx([0.3, 0.7], abs=EXACT)
        gauges = [math.fsum(value) / whole for key, value in shares.items() if key.startswith("gauge_mm")]
        assert gauges == pytest.approx([1 / 3] * 3, abs=EXACT)


def test_mean_gauge_of_a_class_is_the_lines() -> None:
    mine = [s for s in collective().strata if s.stratum.curve_class == "<350"]
    mean = math.fsum(s.weight * s.stratum.gauge_mm for s in mine) / math.fsum(s.weight for s in mine)
    assert mean == pytest.approx(1e3 * read_line("malmbanan").gauge.at(305.0), abs=1e-5)  # labels to 1e-6 mm


def test_right_hand_classes_are_mirrors_of_left_hand_runs_unless_run_as_they_lie(found: Collective) -> None:
    for item in found.strata:
        runs, lies = item.stratum.run_hand, item.stratum.hand
        if lies == "straight":
            continue
        assert item.mirrored == (runs != lies)
        assert found.plan.hands != "both" or not item.mirrored
    straight = [s for s in found.strata if s.stratum.hand == "straight"]
    mirrored = math.fsum(s.weight for s in straight if s.mirrored)
    assert mirrored == pytest.approx(math.fsum(s.weight for s in straight) / 2, abs=EXACT)


def test_merged_hands_share_runs_and_an_overlay_needs_few() -> None:
    merged, mirrored = collective("full", "merged", 1), collective("full", "mirrored", 1)
    assert merged.runs < 0.75 * mirrored.runs
    few = collective("overlay", "merged", 1)
    assert few.runs < 0.05 * merged.runs
    assert collective("overlay", "merged", 3).runs == pytest.approx(3 * few.runs, rel=0.1)


def test_mean_curvature_of_merged_classes_is_the_tables() -> None:
    """Geometry of a group is the mean of its members, so that the mean curvature of the line stays."""
    wanted = math.fsum(float(row["share_percent"]) / 100.0 / float(row["radius_m"]) for row in table())
    for hands in HANDS:
        mine = math.fsum(s.weight / s.stratum.radius_m for s in collective("overlay", hands, 1).strata)
        assert mine == pytest.approx(wanted, rel=1e-8)


def test_the_table_has_a_row_a_stratum_and_parts_that_sum_to_its_weight() -> None:
    mine = collective()
    rows = mine.table().to_pylist()
    assert len(rows) == len(mine.strata)
    for row in rows:
        parts = math.fsum(row[f"weight_{part}"] for part in ("transition_in", "body", "transition_out"))
        assert parts == pytest.approx(row["weight"], abs=EXACT)
        assert (row["radius_m"] is None) == (row["curve_class"] == "straight")
    tight = next(row for row in rows if row["curve_class"] == "<350")
    # Table 1-3: 68 mm at 1:700 are 47.6 m of transition, twice in a curve of 350 m
    assert tight["weight_body"] / tight["weight"] == pytest.approx(1 - 2 * 47.6 / 350.0)
    assert {row["wear_divisor_tread"] for row in rows if row["season"] == "humid"} == {6.0}
    assert {row["wear_divisor_tread"] for row in rows if row["season"] == "dry"} == {1.0}
    assert math.fsum(row["weight"] for row in rows) == pytest.approx(1.0, abs=EXACT)


@pytest.mark.parametrize("design", ["full", "overlay"])
def test_hauls_have_the_shares_of_single_classes(design: str) -> None:
    """Three in four tight curves lie on the descent of the loaded train, and climb on the way back."""
    mine = Collective(plan_of_text(product_text(design, LOCOMOTIVE, replicates=1)))
    for running, haul, tight, wide in (("loaded", "down", 0.75, 0.35), ("empty", "up", 0.75, 0.35)):
        for curve_class, share in (("350:400", tight), ("400:450", tight), ("450:600", wide)):
            whole = mine.share(running=running, curve_class=curve_class)
            found = mine.share(running=running, curve_class=curve_class, haul=haul) / whole
            assert found == pytest.approx(share, abs=EXACT)
