"""The state of a run between two segments of its integration, on disk: a run goes on from there.

Exudyn starts anew at every border, in a run without a break as in one that is resumed: so both pass through
the same states, bit for bit. The state is stored at the first border, and from then on about once in a second
of wall time: whatever the next step reads, which is coordinates and velocities (bodies, track, creepages that
lag), sliders, the whole work space with the guesses that searches begin from, the watch's histories,
controllers, and the number of rows of each log.
"""

import io
import json
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.log.parts import write_whole
from hh_exudyn.log.store import CHECKPOINT_FILE

SEGMENT = 0.5  # s of simulated time from one border to the next
STORE_INTERVAL = 1.0  # s of wall time; storing the state at every border takes 5 % of a run

_FACTS = "facts"


@dataclass(frozen=True)
class Checkpoint:
    """A stored state.

    Attributes
    ----------
    arrays
        By name.
    facts
        Numbers and texts by name: ``step`` of the border, ``rows`` of every log, ``inputs`` that the run is
        made from, and what the integration adds.
    """

    arrays: Mapping[str, FloatArray]
    facts: Mapping[str, Any]

    def copy(self) -> "Checkpoint":
        """The same state in memory of its own."""
        arrays = {name: array.copy() for name, array in self.arrays.items()}
        return Checkpoint(arrays, json.loads(json.dumps(self.facts)))

    def write(self, directory: Path) -> None:
        """Write it into the folder of a run in place of the one before; OSError where that fails."""
        texts = np.array(json.dumps(self.facts))
        arrays: dict[str, Any] = {**self.arrays, _FACTS: texts}
        write_whole(directory / CHECKPOINT_FILE, lambda stream: np.savez(stream, **arrays))

    def fill(self, prefix: str, target: Any) -> None:
        """Write the arrays stored by `flat` back into a NamedTuple of arrays."""
        for name, array in flat(prefix, target):
            array[...] = self.arrays[name]

    def below(self, prefix: str) -> dict[str, FloatArray]:
        """Arrays whose names begin with a prefix, by the rest of their names."""
        return {
            name.removeprefix(prefix): array for name, array in self.arrays.items() if name.startswith(prefix)
        }


def flat(prefix: str, source: Any) -> Iterator[tuple[str, FloatArray]]:
    """(name, array) of all arrays in a NamedTuple and the NamedTuples in it."""
    for name in source._fields:
        value = getattr(source, name)
        if isinstance(value, np.ndarray):
            yield f"{prefix}{name}", value
        elif hasattr(value, "_fields"):
            yield from flat(f"{prefix}{name}/", value)


def read_checkpoint(directory: Path) -> Checkpoint | None:
    """The stored state of the run in a folder; None where there is none.

    Raises
    ------
    ValueError
        The file is broken.
    """
    path = directory / CHECKPOINT_FILE
    if not path.is_file():
        return None
    try:
        with np.load(io.BytesIO(path.read_bytes())) as data:
            arrays = {name: data[name] for name in data.files}
        facts = json.loads(str(arrays.pop(_FACTS)))
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error) as error:
        raise ValueError(
            f"{path}: is broken ({error}); delete it, and the run begins at its start again"
        ) from None
    return Checkpoint(arrays, facts)
