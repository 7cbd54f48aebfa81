"""`Campaign`: a folder in which wheels run a distance, step by step, and which goes on where it was stopped.

DIR/campaign.toml, campaign.json    the file, and where it was read
DIR/results/                        sums of all cases (`hh_exudyn.campaign.engine.results`)
DIR/profiles/, evaluations/         profiles, and which results each evaluation took
DIR/steps/                          the wheels after every step
"""

import hashlib
import json
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from damage.evolution.history import WearHistory
from damage.evolution.measures import ConicityTrack
from damage.evolution.profile_wear import ProfileWear
from damage.evolution.tolerance import tolerated_steps
from damage.life.condition import WheelCondition
from damage.life.places import WheelPlaces
from hh_exudyn.campaign.collective.sizing import Sizing
from hh_exudyn.campaign.engine.case_damage import code, evaluate_case
from hh_exudyn.campaign.engine.mapping import Standing
from hh_exudyn.campaign.engine.results import ResultFolder
from hh_exudyn.campaign.engine.task import Evaluate
from hh_exudyn.campaign.engine.workers import Workers
from hh_exudyn.campaign.life.errors import sized, write_errors
from hh_exudyn.campaign.life.evaluation import Evaluated, Evaluation
from hh_exudyn.campaign.life.plan import CampaignPlan, campaign_of_text
from hh_exudyn.campaign.life.steps import StepEnd, StepFiles
from hh_exudyn.campaign.life.wheels import after_step, new_wheels, turned
from hh_exudyn.contact.profile import Profile
from hh_exudyn.log.parts import write_text

FILE, IDENTITY, RESULTS = "campaign.toml", "campaign.json", "results"
_LAST = 1e-9  # of the distance: a remainder below it is rounding

Progress = Callable[["CampaignStanding"], None]
Conditions = dict[str, WheelCondition]
"""By group of wheels."""


@dataclass(frozen=True)
class CampaignStanding:
    """How far a campaign is.

    Attributes
    ----------
    distance, goal
        Rolled since the start, and wanted [m].
    step, evaluation
        Number of the step that is made, from 1, and of the evaluation in it, from 1.
    cases
        Of the evaluation; None between evaluations.
    spent, left
        Time since this process began, and expected until the goal [s]; infinite before the first step.
    text
        What has just ended; empty for nothing.
    """

    distance: float
    goal: float
    step: int
    evaluation: int
    cases: Standing | None
    spent: float
    left: float
    text: str = ""


class BudgetSpent(Exception):
    """The time that was given is over; what is done is kept."""


class Campaign:
    """A campaign's folder.

    Parameters
    ----------
    directory
        Of a campaign that `begin` made.

    Raises
    ------
    ValueError
        The folder holds no campaign, or its file cannot be read any more.
    """

    def __init__(self, directory: Path | str) -> None:
        self.directory = Path(directory)
        try:
            identity = json.loads((self.directory / IDENTITY).read_text(encoding="utf-8"))
            self._text = (self.directory / FILE).read_text(encoding="utf-8")
            self._source, self._folder = str(identity["file"]), Path(identity["folder"])
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise ValueError(f"{self.directory}: is no folder of a campaign ({error})") from None

    @classmethod
    def begin(cls, file: Path | str, directory: Path | str) -> "Campaign":
        """The campaign of a file in a folder: a new one, or one of the same file that goes on.

        Raises
        ------
        ValueError
            A fault of the file.
        FileExistsError
            The folder holds another campaign, or something else.
        """
        file, directory = Path(file), Path(directory)
        folder = file.parent.resolve()
        text = file.read_text(encoding="utf-8")
        campaign_of_text(text, str(file), folder)
        if (directory / IDENTITY).is_file():
            found = cls(directory)
            if found._text != text:
                raise FileExistsError(f"{directory}: holds the campaign of another file; begin anew")
            return found
        if directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
            raise FileExistsError(f"{directory}: holds something else; allowed is a new or an empty folder")
        directory.mkdir(parents=True, exist_ok=True)
        write_text(directory / FILE, text)
        write_text(directory / IDENTITY, json.dumps({"file": str(file), "folder": str(folder)}) + "\n")
        return cls(directory)

    @property
    def text(self) -> str:
        """Of the file, as it was at the start."""
        return self._text

    @cached_property
    def plan(self) -> CampaignPlan:
        """Of the file, as it was at the start."""
        return campaign_of_text(self._text, self._source, self._folder)

    @cached_property
    def groups(self) -> tuple[str, ...]:
        """Names of the groups of wheels."""
        return self.plan.grouping.names(self.plan.collective.plan.running[0].described)

    @cached_property
    def files(self) -> StepFiles:
        """Its steps."""
        return StepFiles(self.directory, self.groups)

    def histories(self) -> dict[str, WearHistory]:
        """The wheels of each group in all steps so far, each as it was before it was turned."""
        states = [self.files.conditions(number) for number in range(self.files.count)]
        return {group: WearHistory(tuple(state[group].step for state in states)) for group in self.groups}

    def run(
        self,
        workers: Workers,
        distance: float | None = None,
        budget: float = float("inf"),
        progress: Progress | None = None,
        evaluate: Evaluate = evaluate_case,
    ) -> bool:
        """Go on until a distance, or until a time is over.

        Parameters
        ----------
        workers
            Where cases run.
        distance
            Since the start [m]; None for that of the file.
        budget
            Time that may be used [s].
        progress
            Called some times a second, and after every step.
        evaluate
            From a case to its sums, as `Evaluation`.

        Returns
        -------
        bool
            Whether the distance is reached.

        Raises
        ------
        ValueError
            A fault of a case or a profile.
        FileExistsError
            The folder is of other code, or another process has it.
        TooManyFailed, EngineStopped, OSError, KeyboardInterrupt, Terminated
            As the engine's; the campaign can be gone on with.
        """
        goal = self.plan.collective.plan.distance if distance is None else distance
        with self._results() as folder:
            try:
                _Loop(self, folder, workers, goal, clock.monotonic() + budget, progress, evaluate).run()
            except BudgetSpent:
                return False
        return True

    def size(
        self, workers: Workers, runs: int, error: float = 0.05,
        progress: Callable[[Standing], None] | None = None, evaluate: Evaluate = evaluate_case,
    ) -> Sizing:  # fmt: skip
        """The error of the rates at the last step, with a budget of cases; `show` and `status` state it.

        Parameters
        ----------
        workers
            Where cases run.
        runs
            Most cases [-].
        error
            Relative half width at which buying ends [-].
        progress, evaluate
            As `Evaluation`.

        Raises
        ------
        ValueError
            No step has been made yet, or a budget too small for three samples.
        FileExistsError, TooManyFailed, EngineStopped, OSError, KeyboardInterrupt, Terminated
            As `run`.
        """
        if self.files.count == 0:
            raise ValueError(f"{self.directory}: no step has been made yet; run the campaign first")
        start, wheels = self.start(), self.files.conditions(self.files.count - 1)
        profiles = {group: condition.step.profile for group, condition in wheels.items()}
        places = {group: WheelPlaces.of(start[group].step.profile) for group in wheels}
        with self._results() as folder:
            evaluation = Evaluation(
                self.plan, self.plan.of_steps.cases(), folder, workers, self.directory, progress, evaluate
            )
            found = sized(evaluation, profiles, places, runs, error)
        write_errors(self.directory, found, self.files.ends()[-1].distance)
        return found

    def evaluated(
        self, workers: Workers, progress: Callable[[Standing], None] | None = None,
        evaluate: Evaluate = evaluate_case,
    ) -> Evaluated:  # fmt: skip
        """Rates of the wheels as they are after the last step, of new ones before any; all cases are run.

        Parameters
        ----------
        workers
            Where cases run.
        progress, evaluate
            As `Evaluation`.

        Raises
        ------
        ValueError, FileExistsError, TooManyFailed, EngineStopped, OSError, KeyboardInterrupt, Terminated
            As `run`.
        """
        wheels = self.files.conditions(self.files.count - 1) if self.files.count else self.start()
        with self._results() as folder:
            evaluation = Evaluation(
                self.plan, self.plan.of_steps.cases(), folder, workers, self.directory, progress, evaluate
            )
            return evaluation({group: one.step.profile for group, one in wheels.items()})

    def _results(self) -> ResultFolder:
        """The folder of results of this file and this code."""
        name = hashlib.sha256(self._text.encode()).hexdigest()[:16]
        return ResultFolder(self.directory / RESULTS, name, code())

    def start(self) -> dict[str, WheelCondition]:
        """The wheels before the first step, by group."""
        collective = self.plan.collective
        case = collective.cases(collective.strata[:1])[0].case
        wheel, radius = case.wheels(1)[0][0], case.described_vehicle().wheelsets[0].radius
        return {group: new_wheels(group, wheel, radius) for group in self.groups}


class _Loop:
    """Steps from the last one on disk to the goal."""

    def __init__(
        self, campaign: Campaign, folder: ResultFolder, workers: Workers, goal: float, deadline: float,
        progress: Progress | None, evaluate: Evaluate,
    ) -> None:  # fmt: skip
        self._campaign, self._goal, self._deadline, self._progress = campaign, goal, deadline, progress
        self._began = clock.monotonic()
        plan = campaign.plan
        self._evaluation = Evaluation(
            plan, plan.of_steps.cases(), folder, workers, campaign.directory, self._of_cases, evaluate
        )
        self._made: list[Evaluated] = []
        self._latest: Evaluated | None = None  # of the step before: its rates begin the next one
        self._distance = self._first = 0.0
        self._number = 0

    def run(self) -> None:
        files, start = self._campaign.files, self._campaign.start()
        if files.count == 0:
            files.write(0, start, StepEnd(0.0))
        self._number, end = files.count - 1, files.ends()[-1]
        wheels = files.conditions(self._number)
        if end.turned:
            wheels = self._turned(files.conditions(self._number - 1), wheels, start)[0]
        self._latest = self._evaluation.go_on(end.evaluation) if end.evaluation else None
        self._distance = self._first = end.distance
        while self._goal - self._distance > _LAST * self._goal:
            self._number += 1
            after = self._step(wheels)
            self._distance = next(iter(after.values())).step.distance
            going_on, rows = self._turned(wheels, after, start)
            files.write(self._number, after, self._end(rows))
            wheels = going_on
            told = "".join(f", {row['group']} turned for {row['reasons']}" for row in rows)
            self._tell(None, f"step {self._number} to {1e-3 * self._distance:.3f} km{told}")

    def _step(self, wheels: Conditions) -> Conditions:
        """The wheels of all groups one step later."""
        self._made = []
        groups, plan = tuple(wheels), self._campaign.plan

        def wear_of(profiles: tuple[Profile, ...]) -> tuple[ProfileWear, ...]:
            return self._wear(dict(zip(groups, profiles, strict=True)))

        now = tuple(condition.step for condition in wheels.values())
        steps = tolerated_steps(now, groups, wear_of, self._goal, plan.step, ConicityTrack())
        begun = self._latest if all(step.next_rate is not None for step in now) else None
        first, last = (begun or self._made[0]).rates, self._made[-1].rates
        self._latest = self._made[-1]
        return {
            group: after_step(wheels[group], step, first[group], last[group])
            for group, step in zip(groups, steps, strict=True)
        }

    def _turned(
        self, before: Conditions, after: Conditions, start: Conditions
    ) -> tuple[Conditions, tuple[dict[str, object], ...]]:
        """The wheels that go on, and the rows of those that were turned."""
        workshop = self._campaign.plan.workshop
        if workshop is None:
            return after, ()
        found = {group: turned(before[group], after[group], start[group], workshop) for group in after}
        rows = tuple(row for _, row in found.values() if row is not None)
        return {group: going_on for group, (going_on, _) in found.items()}, rows

    def _wear(self, profiles: dict[str, Profile]) -> tuple[ProfileWear, ...]:
        """Wear of all groups: an evaluation."""
        found = self._evaluation(profiles)
        self._made.append(found)
        return tuple(found.rates[group].wear for group in profiles)

    def _end(self, turned_rows: tuple[dict[str, object], ...]) -> StepEnd:
        """Of the step just made."""
        made = self._made
        failed = {one for evaluated in made for one in evaluated.failed}
        return StepEnd(
            self._distance, made[-1].digest, len(made),
            sum(one.ran for one in made), sum(one.reused for one in made), tuple(sorted(failed)),
            turned_rows,
        )  # fmt: skip

    def _of_cases(self, cases: Standing) -> None:
        """Standing of an evaluation; ends it when the time is over."""
        if clock.monotonic() > self._deadline:
            raise BudgetSpent
        self._tell(cases, "")

    def _tell(self, cases: Standing | None, text: str) -> None:
        if self._progress is None:
            return
        spent = clock.monotonic() - self._began
        gone = self._distance - self._first
        left = spent * (self._goal - self._distance) / gone if gone > 0.0 else float("inf")
        self._progress(
            CampaignStanding(
                self._distance, self._goal, self._number, len(self._made) + 1, cases, spent, left, text
            )
        )
