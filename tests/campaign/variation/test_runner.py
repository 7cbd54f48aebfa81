"""Variants run one after the other: folders, resuming, time, failures, the comparison."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pyarrow
import pytest
from made_up_wear import CRACK_RATE, TREAD_RATE
from small_campaign import by_load, small_campaign_file

from hh_exudyn.campaign.engine.case_damage import CaseWork
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.engine.workers import GivenWorkers
from hh_exudyn.campaign.life.campaign import Campaign, CampaignStanding
from hh_exudyn.campaign.variation import run_variants, runner, variants
from hh_exudyn.campaign.variation.comparison import comparison_table
from hh_exudyn.campaign.variation.runner import Outcome

LOADS = {"axle_load": [25, 30]}


def run(
    texts: dict[str, str], folder: Path, kilometres: float, evaluate=by_load, **options
) -> tuple[Outcome, ...]:
    with ThreadPoolExecutor(1) as threads:
        workers = GivenWorkers(threads, 1)
        return run_variants(texts, folder, workers, 1e3 * kilometres, evaluate=evaluate, **options)


@pytest.fixture(scope="module")
def texts(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return variants(small_campaign_file(tmp_path_factory.mktemp("file"), groups="all"), LOADS)


@pytest.fixture(scope="module")
def whole(
    texts: dict[str, str], tmp_path_factory: pytest.TempPathFactory
) -> tuple[Path, tuple[Outcome, ...]]:
    folder = tmp_path_factory.mktemp("whole") / "out"
    return folder, run(texts, folder, 2e3)


def test_every_variant_has_its_file_and_its_campaign(whole, texts: dict[str, str]) -> None:
    folder, outcomes = whole
    assert [one.name for one in outcomes] == ["axle_load=25", "axle_load=30"]
    assert all(one.reached and one.distance == pytest.approx(2e6) for one in outcomes)
    for name, text in texts.items():
        assert (folder / f"{name}.toml").read_text() == text
        assert (folder / name / "campaign.toml").read_text() == text


def test_a_variant_can_be_repeated_alone(whole, tmp_path: Path) -> None:
    folder, _ = whole
    alone = Campaign.begin(folder / "axle_load=25.toml", tmp_path / "alone")
    with ThreadPoolExecutor(1) as threads:
        alone.run(GivenWorkers(threads, 1), 2e6, evaluate=by_load)
    for path in (folder / "axle_load=25" / "steps").rglob("*.npz"):
        own = alone.directory / path.relative_to(folder / "axle_load=25")
        assert own.read_bytes() == path.read_bytes()


def test_what_is_there_is_not_run_again(whole, texts: dict[str, str]) -> None:
    def never(work: CaseWork) -> PartSums:
        raise AssertionError("run again")

    again = run(texts, whole[0], 2e3, never)
    assert [(one.name, one.distance, one.reached, one.reason) for one in again] == [
        (one.name, one.distance, one.reached, one.reason) for one in whole[1]
    ]


def stored(folder: Path) -> set[tuple[str, str]]:
    """Variants and keys of all results."""
    return {(path.parents[2].name, path.stem) for path in folder.glob("*/results/sums/*.npz")}


def test_an_interrupted_variation_runs_nothing_twice(texts: dict[str, str], tmp_path: Path, whole) -> None:
    folder, ran = tmp_path / "out", []

    def counted(work: CaseWork) -> PartSums:
        ran.append((work.scratch.parents[1].name, work.key))
        return by_load(work)

    def interrupting(name: str, standing: CampaignStanding) -> None:
        if name == "axle_load=30" and standing.cases is not None and standing.cases.done >= 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(texts, folder, 2e3, counted, progress=interrupting)
    kept = stored(folder)
    ran.clear()
    assert all(one.reached for one in run(texts, folder, 2e3, counted))
    assert ran
    assert kept.isdisjoint(ran)
    everything = stored(whole[0])
    assert {*kept, *ran} == everything
    assert len(kept) + len(ran) == len(everything)


def test_heavier_wagons_wear_more_and_the_table_says_by_how_much(whole) -> None:
    _, outcomes = whole
    rows = comparison_table({one.name: one.campaign for one in outcomes}).to_pylist()
    light, heavy = rows
    assert (light["campaign"], heavy["campaign"]) == ("axle_load=25", "axle_load=30")
    assert light["distance_km"] == heavy["distance_km"] == pytest.approx(2e3)
    # loaded and empty vehicles have half the distance each
    ratio = (25.0 + 5.4) / (30.0 + 5.4)
    for name in ("tread_um_per_1000_km", "tread_miner_local_per_1000_km", "tread_miner_global_per_1000_km"):
        assert light[name] / heavy[name] == pytest.approx(ratio, rel=2e-2)
    mean = (30.0 + 5.4) / 60.0
    assert heavy["tread_miner_local_per_1000_km"] == pytest.approx(1e6 * CRACK_RATE * mean, rel=1e-2)
    assert 0.85 < heavy["tread_um_per_1000_km"] / (1e12 * TREAD_RATE * mean) < 1.0  # a filter lowers the peak


def test_campaigns_are_compared_where_all_have_been(whole, texts: dict[str, str], tmp_path: Path) -> None:
    _, outcomes = whole
    run({"axle_load=30": texts["axle_load=30"]}, tmp_path / "out", 1.5e3)
    shorter = Campaign(tmp_path / "out" / "axle_load=30")
    table: pyarrow.Table = comparison_table({"long": outcomes[1].campaign, "short": shorter})
    assert table["distance_km"].to_pylist() == pytest.approx([1.5e3, 1.5e3])
    long, short = table["tread_um_per_1000_km"].to_pylist()
    assert long == pytest.approx(short, rel=1e-2)


def test_one_that_fails_does_not_end_the_others(texts: dict[str, str], tmp_path: Path) -> None:
    def failing(work: CaseWork) -> PartSums:
        if 80e3 < work.case.described_vehicle().mass < 110e3:
            raise ValueError("derailed")
        return by_load(work)

    light, heavy = run(texts, tmp_path / "out", 100.0, failing)
    assert not light.reached
    assert "derailed" in light.reason
    assert heavy.reached
    assert heavy.reason == ""


def test_time_is_shared_alike(texts: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two have half of it each, and the second all that the first leaves; without any, none begins."""
    now, given, taken = [0.0], [], [10.0, 60.0]

    def running(campaign: Campaign, workers: object, distance: float, budget: float, *others: object) -> bool:
        given.append(budget)
        now[0] += taken[len(given) - 1]
        return False

    monkeypatch.setattr(Campaign, "run", running)
    monkeypatch.setattr(runner.clock, "monotonic", lambda: now[0])
    outcomes = run(texts, tmp_path / "out", 2e3, budget=100.0)
    assert given == [50.0, 90.0]
    assert not any(one.reached or one.reason for one in outcomes)
    run(texts, tmp_path / "out", 2e3, budget=0.0)
    assert len(given) == 2


def test_folders_of_something_else_are_refused(whole, texts: dict[str, str], tmp_path: Path) -> None:
    folder, _ = whole
    with pytest.raises(FileExistsError, match="is a campaign"):
        run(texts, folder / "axle_load=25", 2e3)
    other = {name: text + "# other\n" for name, text in texts.items()}
    with pytest.raises(FileExistsError, match="holds another campaign of that name"):
        run(other, folder, 2e3)
