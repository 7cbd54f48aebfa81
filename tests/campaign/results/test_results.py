"""Tables, figures and the page of a campaign with made-up wear, in which the wheels are turned once."""

import json
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from command_line import call, refused
from made_up_campaign import campaign_file, run
from made_up_wear import CRACK_RATE, TREAD_RATE, made_up_sums

from damage.rails.rail_surface import RailSurface
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.wheel_surface import Wheel
from hh_exudyn.campaign.engine.case_damage import CaseWork
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.campaign.life.errors import FILE
from hh_exudyn.campaign.results import figures, inputs, lives, shares, tables
from hh_exudyn.campaign.results.comparison import comparison_figure, comparison_table
from hh_exudyn.campaign.results.errors import errors_table
from hh_exudyn.campaign.results.html_parts import figure_html, heading, number_text, table_html
from hh_exudyn.campaign.results.page import page
from hh_exudyn.campaign.results.rails import rails_table
from hh_exudyn.campaign.results.recorded import Recorded
from hh_exudyn.conventions import LEFT, RIGHT

FASTER = 60.0  # cracks than those of the made-up wear: due after some 2,000 km


RAIL_DEPTH, PASSING = 2e-9, 1e5  # m by one passing of a mass [kg]


def worn_rail(side: int) -> RailSurface:
    """A rail worn in one bin by one passing."""
    rail = RailSurface.zero(side, (Wheel(1, 1, 1, side),), LateralGrid(), PatchGrid())
    rail.by_wheel.depth_by_part[0, 0, 80] = RAIL_DEPTH
    return replace(rail, mass=PASSING)


def cracking(work: CaseWork) -> PartSums:
    """The made-up wear with faster cracks, and with rails."""
    rails = (worn_rail(LEFT), worn_rail(RIGHT))
    found = {name: replace(sums, rails=rails) for name, sums in made_up_sums(work).items()}
    for sums in found.values():
        for surface in sums.surfaces:
            surface.crack_damage[...] *= FASTER
            surface.global_crack_damage[...] *= FASTER
    return found


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Recorded:
    folder = tmp_path_factory.mktemp("campaign")
    campaign = Campaign.begin(campaign_file(folder, longest=1500.0), folder / "out")
    assert run(campaign, 3500.0, cracking)
    return Recorded.of(campaign)


def of_group(table, group: str) -> list[dict]:
    return [row for row in table.to_pylist() if row["group"] == group]


def test_changes_are_those_of_the_measures(recorded: Recorded) -> None:
    table = tables.measures_table(recorded)
    assert table.num_rows == len(recorded.groups) * len(recorded.ends)
    for group in recorded.groups:
        rows = of_group(table, group)
        for name in ("Sh", "Sd", "qR"):
            changes = [row[f"{name}_mm"] - rows[0][f"{name}_mm"] for row in rows]
            assert [row[f"{name}_change_mm"] for row in rows] == changes
        assert [row["distance_km"] for row in rows] == [1e-3 * end.distance for end in recorded.ends]


def test_a_turning_begins_a_new_life(recorded: Recorded) -> None:
    rows = of_group(tables.measures_table(recorded), "outer")
    turned = lives.turnings_table(recorded).to_pylist()
    assert [row["life"] for row in rows] == sorted(row["life"] for row in rows)
    assert {row["life"] for row in rows} == {1, 2}
    end_of_first = max(row["distance_km"] for row in rows if row["life"] == 1)
    assert {row["distance_km"] for row in turned} == {end_of_first}
    assert {row["cause"] for row in turned} == {"cracks"}


def test_the_tread_of_a_life_wears_by_what_its_radius_loses(recorded: Recorded) -> None:
    """The made-up wear is deepest at the running circle, where a depth along the normal is one in z."""
    for group, of_lives in recorded.lives.items():
        rows = [row for row in of_group(tables.wear_table(recorded), group) if row["place"] == "tread"]
        assert [row["life"] for row in rows] == [1, 2]
        for row, life in zip(rows, of_lives, strict=True):
            assert (row["from_km"], row["to_km"]) == (
                1e-3 * life[0].step.distance,
                1e-3 * life[-1].step.distance,
            )
            lost = 1e6 * (life[0].step.radius - life[-1].step.radius)
            assert row["depth_um"] == pytest.approx(lost, rel=2e-3)
            assert 0.8e12 * TREAD_RATE < row["um_per_1000_km"] <= 1e12 * TREAD_RATE


def test_a_life_begins_with_the_wheels_of_its_turning(recorded: Recorded) -> None:
    """A step keeps the wheels before they are turned; the life after it begins with those of the workshop."""
    for row in lives.turnings_table(recorded).to_pylist():
        begun = recorded.lives[row["group"]][1][0]
        assert 2e3 * begun.step.radius == pytest.approx(row["diameter_mm"], abs=1e-9)
        assert begun.since_turning == 0.0


def test_running_in_is_over_at_once_below_seizure(recorded: Recorded) -> None:
    assert tables.running_in_table(recorded)["distance_km"].to_pylist() == [0.0, 0.0]


def test_cracks_without_wear_are_rate_times_distance(recorded: Recorded) -> None:
    way = recorded.distance - recorded.wheels["inner"][-1].turned_at
    rows = [row for row in of_group(tables.cracks_table(recorded), "inner") if row["index"] == "global"]
    found = {row["place"]: row for row in rows}
    grown = 0.5 * FASTER * CRACK_RATE * way
    assert found["tread"]["miner_without_wear"] == pytest.approx(grown, rel=5e-3)
    assert found["tread"]["miner"] <= grown
    assert found["middle_band"]["miner"] <= found["tread"]["miner"]
    assert found["field_band"]["from_mm"] == -50.0


def test_shares_of_a_label_sum_to_a_hundred_percent(recorded: Recorded) -> None:
    table = shares.shares_table(recorded)
    names = [name for name in table.column_names if name.endswith("_percent")]
    assert len(names) == 6
    for group in recorded.groups:
        for label in shares.LABELS:
            rows = [row for row in of_group(table, group) if row["label"] == label]
            for name in names:
                assert sum(row[name] for row in rows) == pytest.approx(100.0)


def test_wear_that_is_the_same_everywhere_has_the_shares_of_the_distance(recorded: Recorded) -> None:
    rows = [row for row in of_group(shares.shares_table(recorded), "outer") if row["label"] == "curve_class"]
    collective = recorded.campaign.plan.of_steps
    for row in rows:
        assert row["distance_percent"] == pytest.approx(1e2 * collective.share(curve_class=row["value"]))
        for name in ("wear_tread", "cracks_global", "cracks_local"):
            assert row[f"{name}_percent"] == pytest.approx(row["distance_percent"])
    straight = next(row for row in rows if row["value"] == "straight")
    assert straight["wear_root_percent"] < 1e-3  # only curves wear roots


def test_a_life_at_constant_rates_is_forecast_to_its_end(recorded: Recorded) -> None:
    """Made-up rates do not depend on the profile: from any step, the forecast is what the campaign found."""
    due = lives.turnings_table(recorded).to_pylist()[0]["due_km"]
    number = 1
    assert not recorded.ends[number].turned
    early = Recorded(
        recorded.campaign,
        recorded.ends[: number + 1],
        {group: states[: number + 1] for group, states in recorded.wheels.items()},
    )
    row = lives.forecast_table(early).to_pylist()[0]
    assert row["cause"] == "cracks"
    assert row["due_km"] == pytest.approx(due, rel=1e-3)


def test_turned_wheels_are_forecast_from_their_turning(recorded: Recorded) -> None:
    """At a step that ends in a turning a whole life lies ahead: turned wheels have no deep cracks."""
    number = next(number for number, end in enumerate(recorded.ends) if end.turned)
    turned = Recorded(
        recorded.campaign,
        recorded.ends[: number + 1],
        {group: states[: number + 1] for group, states in recorded.wheels.items()},
    )
    row = lives.forecast_table(turned).to_pylist()[0]
    assert row["since_turning_km"] == 0.0
    assert row["due_km"] > row["now_km"] + 1000.0


def test_every_assumed_number_has_a_source(recorded: Recorded) -> None:
    rows = inputs.assumed_table(recorded.campaign).to_pylist()
    assert {"step.profile_um", "design.replicates"} <= {row["number"] for row in rows}
    assert all(row["source"] and row["kind"] == "assumed" for row in rows)
    limits = {row["number"]: row["value"] for row in inputs.limits_table(recorded.campaign).to_pylist()}
    assert limits["least_diameter"] == 857.0


def test_rails_wear_by_class_and_mass(recorded: Recorded) -> None:
    """Every passing wears alike: all rails have that wear over its mass, straight or curved."""
    rows = rails_table(recorded).to_pylist()
    assert {row["rail"] for row in rows} == {"straight", "high", "low"}
    for row in rows:
        assert row["wear_mm_per_MGT"] == pytest.approx(1e3 * 1e9 * RAIL_DEPTH / PASSING)


def test_errors_are_those_of_the_file(recorded: Recorded) -> None:
    assert errors_table(recorded) is None
    path = recorded.campaign.directory / FILE
    content = {
        "distance_km": 3500.0, "runs": 48, "reached": True, "words": "48 runs were bought.",
        "quantities": ["outer: wear at y = 0 mm [m/m]", "inner: global crack damage of the tread [1/m]"],
        "total": [1e-11, 2e-8], "sampling": [0.03, 0.05], "discretisation": {"gauge": [0.01, 0.02]},
    }  # fmt: skip
    try:
        path.write_text(json.dumps(content))
        rows = errors_table(recorded).to_pylist()
        assert [row["group"] for row in rows] == ["outer", "inner"]
        assert [row["rate"] for row in rows] == pytest.approx([10.0, 0.02])
        assert [row["sampling_percent"] for row in rows] == pytest.approx([3.0, 5.0])
        assert rows[1]["steps_of_gauge_percent"] == pytest.approx(2.0)
        drawn = figures.errors_figure(recorded, content)
        assert [axes.get_title(loc="left") for axes in drawn.axes] == [
            f"{group}: wear [µm per 1000 km]" for group in recorded.groups
        ]
        path.write_text(json.dumps(content | {"total": [1e-11]}))
        with pytest.raises(ValueError, match=r"errors.json: holds no errors"):
            errors_table(recorded)
    finally:
        path.unlink()


def test_a_campaign_beside_itself_does_not_differ(recorded: Recorded) -> None:
    rows = comparison_table(recorded, recorded).to_pylist()
    assert {row["group"] for row in rows} == set(recorded.groups)
    assert all(row["difference"] == 0.0 for row in rows)


def test_campaigns_are_compared_where_both_have_been(recorded: Recorded) -> None:
    """The shorter one is the longer one's beginning; there both are the same, at the end of a step."""
    short = Recorded(
        recorded.campaign,
        recorded.ends[:2],
        {group: states[:2] for group, states in recorded.wheels.items()},
    )
    rows = comparison_table(recorded, short).to_pylist()
    assert {row["distance_km"] for row in rows} == {1e-3 * recorded.ends[1].distance}
    assert all(row["difference"] == 0.0 for row in rows)
    comparison_figure(recorded, short, ("long", "short"))
    other = Recorded(short.campaign, short.ends, {"all": short.wheels["outer"]})
    with pytest.raises(ValueError, match="a group in common"):
        comparison_table(recorded, other)


class Tags(HTMLParser):
    """Addresses, figures and headings of a page, and whether its tags are closed in order."""

    EMPTY = ("meta", "img", "wbr")

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.addresses: list[str] = []
        self.images: list[str] = []
        self.words: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in self.EMPTY:
            self.open.append(tag)
        self.addresses += [value or "" for name, value in attrs if name in ("src", "href", "data", "action")]
        if tag == "img":
            self.images.append(dict(attrs)["alt"] or "")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words.append(data)


@pytest.fixture(scope="module")
def parsed(recorded: Recorded) -> Tags:
    failed = replace(recorded.ends[-1], failed=(("case <7>", 0.01, "derailed & lost"),))
    found = Tags()
    found.feed(page(replace(recorded, ends=(*recorded.ends[:-1], failed))))
    found.close()
    return found


def test_the_page_is_whole_and_needs_no_network(parsed: Tags) -> None:
    assert parsed.open == []
    assert all(address.startswith("data:image/svg+xml;base64,") for address in parsed.addresses)


def test_the_page_has_every_figure(parsed: Tags, recorded: Recorded) -> None:
    for group in recorded.groups:
        assert sum(alt.startswith(f"{group}: ") for alt in parsed.images) == 2
    assert len(parsed.images) == 2 + 2 * len(recorded.groups)
    assert len(parsed.addresses) == len(parsed.images)


def test_the_page_says_what_went_in_and_what_is_left_out(parsed: Tags, recorded: Recorded) -> None:
    text = "".join(parsed.words)
    for words in recorded.campaign.plan.collective.left_out():
        assert words in text
    for number in recorded.campaign.plan.collective.assumed():
        assert number.name in text
    assert "case <7>" in text
    assert "derailed & lost" in text
    assert recorded.campaign.text in text
    assert "hh-exudyn campaign run campaign.toml --out DIR --distance-km 3500" in text


def test_a_figure_is_the_same_every_time(recorded: Recorded) -> None:
    texts = {figure_html(figures.over_profile_figure(recorded), "cracks & wear") for _ in range(2)}
    assert len(texts) == 1
    assert "cracks &amp; wear" in texts.pop()


def test_tables_keep_exact_values_to_sort_by(recorded: Recorded) -> None:
    table = tables.steps_table(recorded).select(["step", "distance_km"])
    text = table_html(table)
    for distance in table["distance_km"].to_pylist():
        assert f'data-value="{distance!r}"' in text
    assert heading("p_max_MPa") == "p max [MPa]"
    assert heading("um_per_1000_km") == "µm per 1000 km"
    assert number_text("Sh_change_mm", -1e-9) == "0.000"
    assert number_text("p_max_MPa", None) == "–"


def test_axes_do_not_blow_up_what_does_not_change(recorded: Recorded) -> None:
    """A new wheel has no hollow: its axis spans hundredths of a millimetre, and begins at zero."""
    panels = {axes.get_title(loc="left"): axes for axes in figures.over_distance_figure(recorded).axes}
    low, high = panels["hollow tread [mm]"].get_ylim()
    assert low == 0.0
    assert high >= 0.02
    low, high = panels["flange thickness Sd [mm]"].get_ylim()
    assert high - low > 0.0199


def test_the_commands_show_and_compare(recorded: Recorded, tmp_path: Path) -> None:
    folder = recorded.campaign.directory
    shown = call("campaign", "show", folder, "--tables", tmp_path / "tables")
    assert shown.exit_code == 0, shown.output
    names = {path.name for path in (tmp_path / "tables").iterdir()}
    assert {"measures.csv", "wear.csv", "shares.csv", "turnings.csv", "rails.csv"} <= names
    compared = call("campaign", "compare", folder, folder, "--csv", tmp_path / "measures.csv")
    assert compared.exit_code == 0, compared.output
    assert (tmp_path / "measures.csv").is_file()
    (tmp_path / "page.html").touch()
    assert "exists" in refused("campaign", "show", folder, "--html", tmp_path / "page.html")


@pytest.mark.slow
def test_the_command_writes_page_and_figures(recorded: Recorded, tmp_path: Path) -> None:
    folder = recorded.campaign.directory
    shown = call("campaign", "show", folder, "--html", tmp_path / "a.html", "--figures", tmp_path / "figures")
    assert shown.exit_code == 0, shown.output
    assert (tmp_path / "a.html").read_text(encoding="utf-8").startswith("<!doctype html>")
    assert len(list((tmp_path / "figures").iterdir())) == 6


def test_a_campaign_without_a_step_is_refused(tmp_path: Path) -> None:
    campaign = Campaign.begin(campaign_file(tmp_path), tmp_path / "out")
    assert "no step yet" in refused("campaign", "show", campaign.directory)
    assert "no folder of a campaign" in refused("campaign", "compare", tmp_path, campaign.directory)


def test_the_profile_table_is_what_the_steps_lost(recorded: Recorded) -> None:
    rows = of_group(tables.profile_table(recorded), "inner")
    worn = np.array([row["worn_um"] for row in rows])
    life = recorded.history("inner")
    lost = 1e6 * (life.steps[0].radius - life.last.radius)
    assert worn[np.argmin([abs(row["y_mm"]) for row in rows])] == pytest.approx(lost, rel=2e-2)


def test_rates_under_seizure_are_not_extrapolated(
    recorded: Recorded, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Made-up pressures are 1 GPa; above 0.8 of the hardness of ER7 a wheel is in its running-in."""
    assert all(row["note"] is None for row in lives.forecast_table(recorded).to_pylist())
    monkeypatch.setattr(Recorded, "pressure", lambda self, group: 2.1e9)
    for row in lives.forecast_table(recorded).to_pylist():
        assert row["due_km"] is None
        assert row["note"] == "running-in: not to be extrapolated"
