"""The steps of a campaign on disk: one file a group of wheels, and one that ends the step.

    DIR/steps/step-00004.json                 distance, profiles' hash, pressures: written last
    DIR/steps/leading-outer/step-00004.npz    the wheels of a group after the step (`damage.life.condition`)

A step counts when its json is there; what was written of a later one is written again.
"""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from damage.life.condition import WheelCondition
from hh_exudyn.log.parts import write_text

STEPS = "steps"


@dataclass(frozen=True)
class StepEnd:
    """What is written at the end of a step, beside the wheels.

    Attributes
    ----------
    distance
        Since the start [m].
    evaluation
        Name of the last evaluation, on a first guess of the wheels at the end of the step
        (`hh_exudyn.campaign.life.evaluation`): the next step begins with its rates; "" before any step.
    evaluations, ran, reused
        Evaluations of this step, and cases run and not run again in them [-].
    failed
        Names, weights and reasons of cases that failed in them.
    turned
        Rows of `damage.life.life_table` of wheels that were turned, or replaced, at the end of the step.
    """

    distance: float
    evaluation: str = ""
    evaluations: int = 0
    ran: int = 0
    reused: int = 0
    failed: tuple[tuple[str, float, str], ...] = ()
    turned: tuple[Mapping[str, Any], ...] = ()


class StepFiles:
    """The steps in a campaign's folder.

    Parameters
    ----------
    directory
        Of the campaign.
    groups
        Of wheels.
    """

    def __init__(self, directory: Path, groups: tuple[str, ...]) -> None:
        self.directory, self.groups = directory / STEPS, groups

    def _end(self, number: int) -> Path:
        return self.directory / f"step-{number:05d}.json"

    def _wheels(self, group: str, number: int) -> Path:
        return self.directory / group.replace(" ", "-") / f"step-{number:05d}.npz"

    @property
    def count(self) -> int:
        """Number of whole steps, the first state included."""
        number = 0
        while self._end(number).is_file():
            number += 1
        return number

    def write(self, number: int, wheels: Mapping[str, WheelCondition], end: StepEnd) -> None:
        """Write a step, whole or not at all.

        Parameters
        ----------
        number
            From 0 for the first state.
        wheels
            By group.
        end
            Of the step.
        """
        for group in self.groups:
            self._wheels(group, number).parent.mkdir(parents=True, exist_ok=True)
            wheels[group].save(self._wheels(group, number))
        write_text(self._end(number), json.dumps(asdict(end), indent=1) + "\n")

    def ends(self) -> list[StepEnd]:
        """The ends of all whole steps. Raises ValueError for a file that is not one."""
        return [_read_end(self._end(number)) for number in range(self.count)]

    def conditions(self, number: int) -> dict[str, WheelCondition]:
        """The wheels of every group after a step, before turning (0: at the start).

        Raises
        ------
        FileNotFoundError, BrokenFile
            There is no such step; a file is not what was written.
        """
        return {group: WheelCondition.load(self._wheels(group, number)) for group in self.groups}


def _read_end(path: Path) -> StepEnd:
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        return StepEnd(
            **{**found, "failed": tuple(map(tuple, found["failed"])), "turned": tuple(found["turned"])}
        )
    except (ValueError, TypeError, KeyError) as error:
        raise ValueError(
            f"{path}: not the end of a step, or a broken one ({error}); delete it and all later ones, and "
            "the campaign goes on from the step before"
        ) from None
