"""A campaign of the stand-in in a process of its own, to be killed."""

from dataclasses import replace

from stand_in import CODE, Payload, evaluate, tasks

from hh_exudyn.campaign.engine.mapping import evaluate_all
from hh_exudyn.campaign.engine.results import ResultFolder
from hh_exudyn.campaign.engine.workers import ProcessWorkers


def main(folder: str, count: int, quick: int) -> None:
    """A campaign in a process of its own: after the first ones its evaluations take for ever."""
    work = tasks([Payload(1.0 + i, 0.0 if i < quick else 60.0) for i in range(count)])
    work = [replace(task, size=float(count - i)) for i, task in enumerate(work)]  # the quick ones first
    with ProcessWorkers(1) as workers, ResultFolder(folder, "ours", CODE) as results:
        evaluate_all(work, evaluate, results, workers)


def to_be_killed(folder: str, count: int, seconds: float) -> None:
    """A campaign in a process of its own, of many short evaluations by two workers."""
    work = tasks([Payload(1.0 + i, seconds) for i in range(count)])
    with ProcessWorkers(2) as workers, ResultFolder(folder, "ours", CODE) as results:
        evaluate_all(work, evaluate, results, workers)
