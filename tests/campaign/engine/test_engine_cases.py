"""Real cases through processes give the bytes of a serial run; keys follow content; the cost model."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.campaign.engine.case_damage import (
    CaseWork,
    Part,
    case_task,
    code,
    evaluate_case,
    part_sums,
)
from hh_exudyn.campaign.engine.cost import CostModel, longest_share
from hh_exudyn.campaign.engine.mapping import evaluate_all, weighted_sum
from hh_exudyn.campaign.engine.results import ResultFolder
from hh_exudyn.campaign.engine.sums import to_bytes
from hh_exudyn.campaign.engine.workers import ProcessWorkers
from hh_exudyn.case import Case, StraightCase, TrackCase
from hh_exudyn.contact.profile import wheel_profile
from hh_exudyn.contact.profiles.writer import write_profile
from hh_exudyn.log.store import open_run

PARTS = (Part("first", 20.0, 30.0), Part("second", 30.0, 45.0))


def straight(friction: float, wheel: str = "S1002", name: str = "straight") -> CaseWork:
    track = TrackCase(sections=(StraightCase(length_m=60, gauge_mm=1437),))
    case = Case(name=name, speed_km_h=60, friction=friction, track=track, wheel_profile=wheel)
    return CaseWork(case, PARTS)


def test_the_key_is_of_content(tmp_path: Path) -> None:
    """The name of a case says nothing, the content of its wheel profile does."""
    key = straight(0.3).key
    assert key == straight(0.3, name="another").key
    assert key != straight(0.31).key
    assert key != CaseWork(straight(0.3).case, PARTS[:1]).key
    wheel = tmp_path / "wheel.txt"
    write_profile(wheel_profile("S1002"), wheel)
    before = straight(0.3, str(wheel)).key
    write_profile(wheel_profile("WP4_like"), wheel)
    assert straight(0.3, str(wheel)).key != before


def test_parts_are_checked() -> None:
    with pytest.raises(ValueError, match="part curve: start = 30 m must be >= 0 and below end = 20 m"):
        Part("curve", 30.0, 20.0)


@pytest.mark.slow
def test_two_processes_give_the_bytes_of_a_serial_run(tmp_path: Path) -> None:
    works = [straight(0.3), straight(0.4)]
    tasks = [case_task(works[0], "mu 0.3", 1.0), case_task(works[1], "mu 0.4", 3.0)]
    with ProcessWorkers(2) as workers, ResultFolder(tmp_path, "ours", code()) as folder:
        report = evaluate_all(tasks, evaluate_case, folder, workers)
        assert (report.count, report.failures) == (2, ())
        serial = [evaluate_case(work) for work in works]
        for task, sums in zip(tasks, serial, strict=True):
            assert folder.path(task.key).read_bytes() == to_bytes(sums, task.key)
        total = weighted_sum(tasks, folder)["second"].surfaces[0]
    assert not (tmp_path / "scratch").exists()
    parts = [one["second"].surfaces[0].scaled(1.0) for one in serial]
    assert np.array_equal(total.work, parts[0].work + 3.0 * parts[1].work)
    # straight track without irregularity is the same everywhere: so is its damage per metre
    first, second = (serial[0][name].surfaces[0] for name in ("first", "second"))
    assert (first.distance, second.distance) == (pytest.approx(10.0), pytest.approx(15.0))
    assert first.work / 10.0 == pytest.approx(second.work / 15.0, rel=0.02)


def test_the_cost_model_learns_the_median() -> None:
    cost = CostModel(least_timeout=10.0)
    assert cost.wall(3.0) == 3.0
    for wall in (2.0, 2.2, 1.8, 90.0, 2.0):  # one of them compiled
        cost.learn(1.0, wall)
    assert cost.wall(3.0) == pytest.approx(6.0)
    assert cost.timeout(0.1) == 10.0
    assert cost.timeout(3.0) == pytest.approx(60.0)


def test_predictions_for_other_numbers_of_cores() -> None:
    """The busiest core, never faster than the longest piece or than the main process."""
    cost = CostModel()
    sizes = [4.0, 3.0, 3.0, 2.0]
    assert [cost.predicted(sizes, cores) for cores in (1, 2, 3, 256)] == [12.0, 6.0, 5.0, 4.0]
    assert cost.predicted(sizes, 256, serial=2.0) == 8.0
    assert cost.left([2.0, 2.0], [(3.0, 1.0)], 2) == pytest.approx(4.0)
    with pytest.raises(ValueError, match="cores = 0"):
        longest_share([1.0], 0)


def test_what_16_and_256_cores_do_for_a_loop_of_evaluations() -> None:
    """20 cases of 9 s, twice the time guessed: evaluations wait for each other, so 20 cores are enough."""
    cost = CostModel()
    cost.learn(1.0, 2.0)
    few = cost.scaling([4.5] * 20, (1, 2, 16, 256), evaluations=120)
    assert [p.wall for p in few] == pytest.approx([120 * 180.0, 120 * 90.0, 120 * 18.0, 120 * 9.0])
    assert [p.speedup for p in few] == pytest.approx([1.0, 2.0, 10.0, 20.0])
    assert [p.bound for p in few] == ["cores", "cores", "cores", "longest case"]
    assert few[3].words() == "256 cores: 0.30 h, 20.0 times one core (8%), bound by the longest case"
    many = cost.scaling([4.5] * 5120, (16, 256), serial=0.05)  # the main process keeps 20 results a second
    assert many[0].efficiency == pytest.approx(1.0)
    assert (many[1].bound, many[1].speedup) == ("main process", pytest.approx(180.0))


@pytest.mark.slow
def test_a_run_folder_is_kept_where_that_is_asked_for(tmp_path: Path) -> None:
    """The log of the folder gives the sums of the evaluation; a second one takes the place of the first."""
    work = replace(straight(0.3), keep_logs=tmp_path / "logs", scratch=tmp_path / "scratch")
    assert work.key == straight(0.3).key  # keeping changes no result
    for _ in range(2):
        sums = evaluate_case(work)
        kept = list((tmp_path / "logs").iterdir())
        assert [folder.name for folder in kept] == [work.key]
        assert to_bytes(part_sums(open_run(kept[0]).contact(), work), work.key) == to_bytes(sums, work.key)
        assert list((tmp_path / "scratch").iterdir()) == []
