"""Wear and fatigue as a function of parameters: units, purity, what is kept, profiles."""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from made_up_wear import CRACK_RATE, FLANGE_RATE, TREAD_AREA, TREAD_RATE, made_up_sums
from small_campaign import by_load, small_campaign_file

from hh_exudyn.campaign.engine.case_damage import CaseWork
from hh_exudyn.campaign.engine.mapping import TooManyFailed
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.engine.workers import GivenWorkers
from hh_exudyn.campaign.objective import Objective, objective
from hh_exudyn.contact.profile import Profile, wheel_profile
from hh_exudyn.contact.profiles.writer import write_profile

Of = Callable[[Mapping[str, Any]], Objective]


@pytest.fixture
def workers() -> Iterator[GivenWorkers]:
    with ThreadPoolExecutor(1) as threads:
        yield GivenWorkers(threads, 1)


def made(folder: Path, workers: GivenWorkers, evaluate=made_up_sums, **options: Any) -> Of:
    folder.mkdir(exist_ok=True)
    return objective(small_campaign_file(folder), folder / "out", workers, evaluate=evaluate, **options)


def test_units(tmp_path: Path, workers: GivenWorkers) -> None:
    """The made-up rates of a tread are known; a root wears in curves alone, and only on outer wheels."""
    found = made(tmp_path, workers)({})
    assert found.tread == pytest.approx(1e12 * TREAD_RATE, rel=1e-2)
    assert found.rcf == pytest.approx(0.5e6 * CRACK_RATE, rel=1e-2)
    assert 0.0 < found.flange < 1e12 * FLANGE_RATE
    root_area = 1e6 * found.flange * 1e-12 * 5e-3 * np.sqrt(np.pi)  # a bell of 5 mm, in m^2 per 1000 km
    assert found.wear == pytest.approx(1e12 * TREAD_AREA + 0.5e6 * root_area, rel=2e-2)
    local = made(tmp_path, workers, index="local")({})
    assert local.rcf == pytest.approx(2.0 * found.rcf)


def test_it_is_a_function_of_its_parameters(tmp_path: Path, workers: GivenWorkers) -> None:
    """The order of calls and of parameters, and the folder, do not matter."""
    one, two = {"axle_load": 28, "season.dry.share_percent": 40.0}, {"lubrication": 0.0}
    first, second = (made(tmp_path / name, workers, by_load) for name in "ab")
    found = first(one)
    assert second(two) != found
    assert second(dict(reversed(one.items()))) == found


def test_nothing_is_computed_twice(tmp_path: Path, workers: GivenWorkers) -> None:
    ran: list[str] = []

    def counted(work: CaseWork) -> PartSums:
        ran.append(work.key)
        return made_up_sums(work)

    of = made(tmp_path, workers, counted)
    found, count = of({"gauge": 1440}), len(ran)
    assert count > 0
    assert of({"gauge": 1440}) == made(tmp_path, workers, counted)({"gauge": 1440}) == found
    assert len(ran) == count
    of({"gauge": 1441})
    assert len(ran) > count


def test_profiles_count_by_their_content(tmp_path: Path, workers: GivenWorkers) -> None:
    """A file's name does not count; a file that was written anew, and a profile of other points, do."""
    wheel = wheel_profile("S1002")
    lower = Profile("lower", "wheel", wheel.y, wheel.z * (1.0 + 1e-3 * (wheel.y > 20e-3)))
    path, copy = tmp_path / "wheel.txt", tmp_path / "copy.txt"
    of = made(tmp_path, workers)
    write_profile(wheel, path)
    same = of({"case.wheel_profile": str(path)})
    copy.write_bytes(path.read_bytes())
    assert of({"case.wheel_profile": str(copy)}) == same
    assert len(list((tmp_path / "out").glob("*/objective.json"))) == 1
    write_profile(lower, path)
    of({"case.wheel_profile": str(path)})
    of({"case.wheel_profile": lower})
    assert len(list((tmp_path / "out").glob("*/objective.json"))) == 3


def test_after_a_distance_the_wheels_are_worn(tmp_path: Path, workers: GivenWorkers) -> None:
    """The made-up rates do not change with the profile; the campaign has run the distance."""
    found = made(tmp_path, workers, distance=200e3)({})
    assert found.tread == pytest.approx(1e12 * TREAD_RATE, rel=2e-2)
    assert list((tmp_path / "out").glob("*/campaign/steps/step-00001.json"))


def test_parameters_that_are_not_allowed(tmp_path: Path, workers: GivenWorkers) -> None:
    of = made(tmp_path, workers)
    with pytest.raises(ValueError, match="allowed ER7, ER8, ER9"):
        of({"material": "wood"})
    with pytest.raises(ValueError, match="unknown key wege"):
        of({"wege": 1.0})


def test_a_failure_is_raised_and_the_next_call_goes_on(tmp_path: Path, workers: GivenWorkers) -> None:
    def failing(work: CaseWork) -> PartSums:
        if work.case.described_vehicle().mass > 121e3:
            raise ValueError("derailed")
        return made_up_sums(work)

    of = made(tmp_path, workers, failing)
    with pytest.raises(TooManyFailed, match="derailed"):
        of({"axle_load": 31})
    assert of({"axle_load": 30}).wear > 0.0
