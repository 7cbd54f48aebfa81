"""A campaign with made-up wear: distance, resuming, turning, what is not run again, what is refused."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from made_up_campaign import campaign_file, run
from made_up_wear import TREAD_AREA, made_up_sums, scattered_sums

from hh_exudyn.campaign.engine.case_damage import CaseWork
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.engine.workers import GivenWorkers
from hh_exudyn.campaign.life.campaign import Campaign


def contents(folder: Path) -> dict[str, bytes]:
    """All files of a campaign but wall times."""
    files = (file for file in folder.rglob("*") if file.is_file() and file.name != "times.jsonl")
    return {str(file.relative_to(folder)): file.read_bytes() for file in files}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Campaign:
    folder = tmp_path_factory.mktemp("whole")
    campaign = Campaign.begin(campaign_file(folder), folder / "out")
    assert run(campaign, 12e3)
    return campaign


def test_wheels_lose_the_area_of_their_rate(whole: Campaign) -> None:
    """The made-up rate does not depend on the profile: area is rate times distance, whatever the steps."""
    history = whole.histories()["inner"]
    first, last = history.steps[0], history.last
    assert last.distance == pytest.approx(12e6)
    y = np.linspace(-30e-3, 25e-3, 2000)
    before = np.interp(y, first.profile.y, first.profile.z)
    after = np.interp(y, last.profile.y, last.profile.z) + (first.radius - last.radius)
    assert np.trapezoid(after - before, y) == pytest.approx(12e6 * TREAD_AREA, rel=5e-3)


def test_the_outer_wheel_alone_wears_at_its_root(whole: Campaign) -> None:
    """Only curves wear roots, and of outer wheels: at y = 30 mm they are lower, and nowhere on the tread."""
    outer, inner = (whole.histories()[role].last.profile for role in ("outer", "inner"))
    y = np.array([-10e-3, 0.0, 5e-3, 30e-3])
    deeper = np.interp(y, outer.y, outer.z) - np.interp(y, inner.y, inner.z)
    assert deeper[3] > 1e-6
    assert np.abs(deeper[:3]).max() < 0.02 * deeper[3]


def test_cracks_grow_less_what_wears_off(whole: Campaign) -> None:
    """Miner's sum of the tread without wear is rate times distance, and with wear less."""
    last = whole.files.conditions(whole.files.count - 1)["inner"].cracks["local"]
    assert last.damage_without_wear.max() > 0.0
    assert np.all(last.damage <= last.damage_without_wear + 1e-12)


class Killed(RuntimeError):
    """The end of a process."""


@pytest.mark.parametrize(
    "after", [pytest.param(1, marks=pytest.mark.slow), 20, pytest.param(33, marks=pytest.mark.slow)]
)
def test_a_killed_campaign_goes_on_to_the_same_bytes(after: int, tmp_path: Path, whole: Campaign) -> None:
    campaign = Campaign.begin(campaign_file(tmp_path), tmp_path / "out")
    left = [after]

    def dying(work: CaseWork) -> PartSums:
        left[0] -= 1
        if left[0] < 0:
            raise MemoryError("a kill")
        return made_up_sums(work)

    with pytest.raises(Exception, match="a kill"):
        run(campaign, 12e3, dying)
    again = Campaign.begin(campaign_file(tmp_path), tmp_path / "out")
    assert run(again, 12e3)
    here, there = contents(tmp_path / "out"), contents(whole.directory)
    names = {name for name in here if name.startswith(("steps", "evaluations", "profiles"))}
    assert names == {name for name in there if name.startswith(("steps", "evaluations", "profiles"))}
    assert all(here[name] == there[name] for name in names)


@pytest.mark.parametrize(("evaluate", "scatter"), [(made_up_sums, False), (scattered_sums, True)])
def test_the_error_is_that_of_the_scatter_between_samples(evaluate, scatter: bool, tmp_path: Path) -> None:
    """Samples that are equal have no error and are bought no more than thrice; others have one, stated."""
    campaign = Campaign.begin(campaign_file(tmp_path), tmp_path / "out")
    with ThreadPoolExecutor(1) as threads:
        workers = GivenWorkers(threads, 1)
        with pytest.raises(ValueError, match="no step has been made yet"):
            campaign.size(workers, 40, evaluate=evaluate)
        assert campaign.run(workers, 1.0, evaluate=evaluate)
        found = campaign.size(workers, 30, error=0.01, evaluate=evaluate)
    assert found.runs <= 30
    assert found.reached is not scatter
    assert bool(found.sampling.max() > 0.01) is scatter
    assert (tmp_path / "out" / "errors.json").is_file()
