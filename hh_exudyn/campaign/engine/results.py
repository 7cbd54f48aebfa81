"""The folder of results: one file each, whole and checked, of one campaign and one state of the code.

    DIR/engine.json           campaign and code
    DIR/sums/KEY.npz          sums of an evaluation; the same bytes whenever and wherever it was made
    DIR/sums/KEY.failed.json  why there are none
    DIR/times.jsonl           wall times, for the cost model
    DIR/logs/, DIR/scratch/   run folders that are kept; those of cases that run now

A file is written under another name and renamed when it is on the disk: so a kill at any time, a full disk or
a power failure leaves a folder that can be gone on with.
"""

import json
import shutil
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Self

from damage.surface.stored import BrokenFile
from hh_exudyn.campaign.engine.sums import PartSums, from_bytes
from hh_exudyn.campaign.engine.task import Ending, Task
from hh_exudyn.log.lock import FolderLock, locked
from hh_exudyn.log.parts import TEMPORARY_SUFFIX, sync_folder, write_bytes, write_text

FORM = 1  # of the folder
IDENTITY, SUMS, TIMES, LOGS, SCRATCH = "engine.json", "sums", "times.jsonl", "logs", "scratch"


@dataclass(frozen=True)
class Failure:
    """An evaluation without a result.

    Attributes
    ----------
    name, weight
        Of the task.
    reason
        In a line.
    ending
        `Ending.FAILED` for an error of its own, which would come again; `Ending.LOST` for the end of its
        workers.
    attempts
        How often it was begun.
    """

    name: str
    weight: float
    reason: str
    ending: Ending
    attempts: int


class ResultFolder:
    """Results of a campaign on disk; open for one process at a time, by `with`.

    Parameters
    ----------
    directory
        Made if it does not exist.
    campaign
        Name or hash of the campaign, which the folder must be of.
    code
        Hashes and versions of everything that computes: `hh_exudyn.campaign.engine.case_damage.code`.

    Raises
    ------
    FileExistsError
        The folder holds something else, or results of another campaign or other code, or another process has
        it open. Nothing was changed.
    """

    def __init__(self, directory: Path | str, campaign: str, code: Mapping[str, Any]) -> None:
        self.directory = Path(directory)
        self._identity = {"form": FORM, "campaign": campaign, "code": dict(code)}
        self._lock = FolderLock(None)

    def __enter__(self) -> Self:
        self._require_own()
        for folder in (self.directory, self.directory / SUMS):
            folder.mkdir(parents=True, exist_ok=True)
        self._lock = locked(self.directory)
        if not (self.directory / IDENTITY).is_file():
            write_text(self.directory / IDENTITY, json.dumps(self._identity, indent=2, sort_keys=True) + "\n")
        shutil.rmtree(self.scratch, ignore_errors=True)  # of cases that were killed
        for left in (self.directory / SUMS).glob(f"*{TEMPORARY_SUFFIX}"):
            left.unlink(missing_ok=True)
        return self

    def __exit__(self, *error: object) -> None:
        shutil.rmtree(self.scratch, ignore_errors=True)
        self._lock.close()

    @property
    def scratch(self) -> Path:
        """For the run folders of cases that run now."""
        return self.directory / SCRATCH

    @property
    def logs(self) -> Path:
        """For the run folders that are kept."""
        return self.directory / LOGS

    def _require_own(self) -> None:
        """Raise FileExistsError for a folder of something else."""
        if not self.directory.exists():
            return
        if not self.directory.is_dir():
            raise FileExistsError(f"{self.directory}: is a file, allowed is a folder for results")
        try:
            there = json.loads((self.directory / IDENTITY).read_text(encoding="utf-8"))
        except FileNotFoundError:
            if not {path.name for path in self.directory.iterdir()} <= {SUMS, IDENTITY + TEMPORARY_SUFFIX}:
                raise FileExistsError(
                    f"{self.directory}: holds other files and no {IDENTITY}; allowed is a new or empty "
                    "folder, or one of this campaign"
                ) from None
            return
        except ValueError as error:
            raise FileExistsError(f"{self.directory / IDENTITY}: cannot be read ({error})") from None
        if differs := _differing(there, json.loads(json.dumps(self._identity))):
            raise FileExistsError(
                f"{self.directory}: holds results of something else: {', '.join(differs)}; begin in a new "
                "folder"
            )

    def path(self, key: str) -> Path:
        """The file of a result."""
        return self.directory / SUMS / f"{key}.npz"

    def _failed_path(self, key: str) -> Path:
        return self.directory / SUMS / f"{key}.failed.json"

    def sums(self, key: str) -> PartSums:
        """The sums of an evaluation.

        Raises
        ------
        FileNotFoundError, BrokenFile
            There are none; the file is not what was written.
        """
        path = self.path(key)
        return from_bytes(path.read_bytes(), key, str(path))

    def is_whole(self, key: str) -> bool:
        """Whether the sums of an evaluation are there; a file that is not what was written is deleted."""
        try:
            self.sums(key)
        except FileNotFoundError:
            return False
        except BrokenFile:
            self.path(key).unlink(missing_ok=True)
            return False
        return True

    def failure(self, key: str) -> Failure | None:
        """Why an evaluation has no sums; None where that is not known."""
        try:
            found = json.loads(self._failed_path(key).read_text(encoding="utf-8"))
            return Failure(**{**found, "ending": Ending(found["ending"])})
        except (FileNotFoundError, ValueError, TypeError, KeyError):
            return None

    def store(self, key: str, content: bytes) -> None:
        """Write the sums of an evaluation; OSError where they cannot be written."""
        write_bytes(self.path(key), content)
        self._failed_path(key).unlink(missing_ok=True)

    def store_failure(self, key: str, failure: Failure) -> None:
        """Write why an evaluation has no sums."""
        write_text(self._failed_path(key), json.dumps(asdict(failure), indent=2, sort_keys=True) + "\n")

    def forget_failure(self, key: str) -> None:
        """Let an evaluation be tried again."""
        with suppress(FileNotFoundError):
            self._failed_path(key).unlink()
            sync_folder(self.directory / SUMS)

    def note_time(self, task: Task, wall: float) -> None:
        """Write down how long an evaluation took; nothing depends on it but estimates."""
        line = json.dumps({"key": task.key, "name": task.name, "size": task.size, "wall": round(wall, 4)})
        with open(self.directory / TIMES, "a", encoding="utf-8") as stream:
            stream.write(line + "\n")

    def times(self) -> Iterator[tuple[float, float]]:
        """Size and wall time [s] of all evaluations so far; a line that was cut off is left out."""
        try:
            lines = (self.directory / TIMES).read_text(encoding="utf-8", errors="replace").splitlines()
        except FileNotFoundError:
            return
        for line in lines:
            with suppress(ValueError, KeyError, TypeError):
                one = json.loads(line)
                yield float(one["size"]), float(one["wall"])


def _differing(there: Any, here: dict[str, Any]) -> list[str]:
    """In words, what differs between the identity of a folder and that wanted."""
    if not isinstance(there, dict) or there.get("form") != here["form"]:
        return ["another form of the folder"]
    found = []
    if there.get("campaign") != here["campaign"]:
        found.append(f"campaign {there.get('campaign')!r}, wanted {here['campaign']!r}")
    old, new = there.get("code"), here["code"]
    if old != new:
        keys = sorted(key for key in {*old, *new} if old.get(key) != new.get(key)) if old else sorted(new)
        found.append(f"made by other code ({', '.join(keys)})")
    return found
