"""How the format of a profile file is recognised by its content: from the file to points in its own axes.

Each format has its own axes, in which the points are read; `reader` converts them by `axes`:

* two columns: `two_columns`; y and z in side coordinates, see `reader`.
* SIMPACK prw/prr: `simpack`.
* VAMPIRE whe/rai: `vampire`.
* MiniProf, with keys or with the older headers: `miniprof`.
"""

import os
import re
from pathlib import Path

from hh_exudyn.contact.profiles import simpack, vampire
from hh_exudyn.contact.profiles.miniprof import (
    KEY_VALUE,
    OLD_HEADER,
    SECTION,
    USUAL_KEY,
    read_keyed,
    read_old,
)
from hh_exudyn.contact.profiles.points import RawPoints
from hh_exudyn.contact.profiles.two_columns import read_two_columns
from hh_exudyn.text_files import read_text

_MAX_BYTES = 10_000_000  # a profile has a few hundred lines
_SEPARATOR_OF_EXCEL = re.compile(r"^sep=.$", re.IGNORECASE)
_OLD_HEADER_LINES = 3  # among the first of which MiniProf's name stands


def read_points(path: Path, side: str | None = None) -> RawPoints:
    """The points of a profile file of any known format.

    Parameters
    ----------
    path : Path
        The file.
    side : str or None
        ``"left"`` or ``"right"`` of a file with both sides (`vampire`).

    Raises
    ------
    ValueError
        A missing, empty, binary, too large or truncated file, or a line of another form; the message names
        file, line and the expected form.
    """
    if not os.path.lexists(path):
        raise ValueError(f"profile {path}: file not found")
    try:
        text = read_text(path, _MAX_BYTES).splitlines()
    except ValueError as error:
        raise ValueError(f"profile {error}") from None
    if text and _SEPARATOR_OF_EXCEL.match(text[0]):
        text[0] = ""
    filled = [line for line in text if line.strip()][:100]
    if not filled:
        raise ValueError(f"profile {path}: the file is empty")
    if any(simpack.FIRST_LINE.match(line) for line in filled):
        return simpack.read_simpack(path, text)
    if vampire.FIRST_LINE.match(filled[0]):
        return vampire.read_vampire(path, text, side)
    if any(OLD_HEADER.match(line) for line in filled[:_OLD_HEADER_LINES]):
        return read_old(path, text)
    if any(map(USUAL_KEY.match, filled)) or KEY_VALUE.match(filled[0]) or SECTION.match(filled[0]):
        return read_keyed(path, text)
    return read_two_columns(path, text)
