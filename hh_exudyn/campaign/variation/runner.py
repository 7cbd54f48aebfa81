"""Variants of a campaign run one after the other, by the same workers, each in a folder of its own.

DIR/axle_load=30.toml    the file of a variant, which can be run alone
DIR/axle_load=30/        its campaign
"""

import time as clock
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from hh_exudyn.campaign.engine.case_damage import evaluate_case
from hh_exudyn.campaign.engine.mapping import TooManyFailed
from hh_exudyn.campaign.engine.task import Evaluate
from hh_exudyn.campaign.engine.workers import Workers
from hh_exudyn.campaign.life.campaign import IDENTITY, Campaign, CampaignStanding
from hh_exudyn.log.parts import write_text

Progress = Callable[[str, CampaignStanding], None]


@dataclass(frozen=True)
class Outcome:
    """How far a variant has come.

    Attributes
    ----------
    name
        Of the variant.
    campaign
        Its folder.
    distance
        Rolled so far [m].
    reached
        Whether that is the goal.
    reason
        Why it ended before; empty where its time was over.
    """

    name: str
    campaign: Campaign
    distance: float
    reached: bool
    reason: str = ""


def run_variants(
    texts: Mapping[str, str],
    folder: Path,
    workers: Workers,
    distance: float | None = None,
    budget: float = float("inf"),
    progress: Progress | None = None,
    evaluate: Evaluate = evaluate_case,
) -> tuple[Outcome, ...]:
    """Run variants, or go on with them; one that fails does not end the others.

    Those that still have a way to go share the time that is left alike: what one does not need the later ones
    have.

    Parameters
    ----------
    texts
        Of their files, by name (`hh_exudyn.campaign.variation.variants.variants`).
    folder
        Of all of them.
    workers
        Where cases run.
    distance
        Since the start [m]; None for that of each file.
    budget
        Time for all together [s].
    progress
        Called with the name of the variant, otherwise as by `Campaign.run`.
    evaluate
        From a case to its sums.

    Raises
    ------
    ValueError
        A fault of a file, before anything has run.
    FileExistsError
        The folder holds something else, or another campaign under the name of a variant.
    EngineStopped, KeyboardInterrupt, Terminated
        As the engine's; all can be gone on with.
    """
    campaigns = _begun(texts, folder)
    goals = {
        name: one.plan.collective.plan.distance if distance is None else distance
        for name, one in campaigns.items()
    }
    waiting = [name for name, one in campaigns.items() if not _is_at(one, goals[name])]
    deadline, reasons = clock.monotonic() + budget, dict.fromkeys(campaigns, "")
    for place, name in enumerate(waiting):
        left = deadline - clock.monotonic()
        if left <= 0.0:
            break
        report = None if progress is None else _named(name, progress)
        try:
            ended = campaigns[name].run(workers, distance, left / (len(waiting) - place), report, evaluate)
        except (TooManyFailed, ValueError, FileExistsError) as error:
            reasons[name], ended = str(error), False
        if not ended and place + 1 < len(waiting):
            workers.renew([], [])  # an evaluation that does not end stops them
    return tuple(
        Outcome(name, one, _distance(one), _is_at(one, goals[name]), reasons[name])
        for name, one in campaigns.items()
    )


def _begun(texts: Mapping[str, str], folder: Path) -> dict[str, Campaign]:
    """The campaigns of all variants, new ones or those that are there."""
    if (folder / IDENTITY).exists() or (folder.exists() and not folder.is_dir()):
        raise FileExistsError(
            f"{folder}: is a campaign or a file; allowed is a folder for {len(texts)} of them"
        )
    folder.mkdir(parents=True, exist_ok=True)
    files = {name: folder / f"{name}.toml" for name in texts}
    for name, file in files.items():
        if file.exists() and file.read_text(encoding="utf-8") != texts[name]:
            raise FileExistsError(f"{file}: holds another campaign of that name; begin in a new folder")
    found = {}
    for name, file in files.items():
        if not file.exists():
            write_text(file, texts[name])
        found[name] = Campaign.begin(file, folder / name)
    return found


def _named(name: str, progress: Progress) -> Callable[[CampaignStanding], None]:
    return lambda standing: progress(name, standing)


def _distance(campaign: Campaign) -> float:
    """Rolled since the start [m]."""
    ends = campaign.files.ends()
    return ends[-1].distance if ends else 0.0


def _is_at(campaign: Campaign, goal: float) -> bool:
    return _distance(campaign) >= goal * (1.0 - 1e-9)
