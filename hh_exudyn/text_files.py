"""Text files of users: read once, whole, and only where they are ordinary files of a sensible size.

A path in a case may lead to a device (``/dev/zero`` never ends), a named pipe (opening it waits for a
writer), a folder, a loop of links or gigabytes; the text in it may be UTF-8, UTF-16 (instruments on Windows)
or one byte a character (Latin-1, as older programs write names and degree signs).
"""

import os
import stat
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

LARGEST = 100_000_000  # bytes; a recording of 100 km every 0.25 m has 30 MB

_MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))
_KINDS: tuple[tuple[Callable[[int], bool], str], ...] = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a named pipe"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
    (stat.S_ISSOCK, "a socket"),
)


def read_bytes(path: str | Path, largest: int = LARGEST) -> bytes:
    """The content of an ordinary file.

    Parameters
    ----------
    path : str or Path
        The file; links are followed.
    largest : int
        Most bytes that are read.

    Raises
    ------
    ValueError
        No such file, no ordinary file (folder, pipe, device, loop of links), too large, or not readable. The
        message begins with the path.
    """
    try:
        # without O_NONBLOCK the opening of a pipe would wait for a writer
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        with os.fdopen(descriptor, "rb") as file:
            mode = os.fstat(descriptor).st_mode
            for is_kind, name in _KINDS:
                if is_kind(mode):
                    raise ValueError(f"{path}: is {name}, allowed is a file")
            data = file.read(largest + 1)
    except IsADirectoryError:
        raise ValueError(f"{path}: is a folder, allowed is a file") from None
    except OSError as error:
        raise ValueError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:
        if "null" in str(error):
            raise ValueError(f"{str(path)!r}: is no path of a file: it holds a null character") from None
        raise
    if len(data) > largest:
        raise ValueError(f"{path}: is larger than {largest} bytes, which are allowed")
    return data


def read_text(path: str | Path, largest: int = LARGEST) -> str:
    """The text of a file: UTF-8, UTF-16 with or without its mark, else one byte a character (Windows-1252).

    Parameters
    ----------
    path : str or Path
        The file.
    largest : int
        Most bytes that are read.

    Raises
    ------
    ValueError
        As `read_bytes`; an empty file, or one with null characters (binary).
    """
    data = read_bytes(path, largest)
    text = _decoded(data).rstrip("\x1a")  # the end of a file in DOS
    if not text.strip():
        raise ValueError(f"{path}: the file is empty")
    if "\0" in text:
        raise ValueError(f"{path}: a binary file, allowed is text")
    return text


def read_toml(path: str | Path) -> dict[str, Any]:
    """The tables of a TOML file, which is UTF-8.

    Raises
    ------
    ValueError
        As `read_bytes`, or not valid TOML, with line and column.
    """
    return parsed_toml(read_bytes(path), str(path))


def parsed_toml(text: str | bytes, source: str) -> dict[str, Any]:
    """The tables of TOML text.

    Parameters
    ----------
    text : str or bytes
        The text; bytes are UTF-8, perhaps with a mark.
    source : str
        Name of the file for messages.

    Raises
    ------
    ValueError
        Not valid TOML, with line and column; brackets nested too deep.
    """
    try:
        return tomllib.loads(text if isinstance(text, str) else text.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise ValueError(f"{source}: not valid TOML: not UTF-8 at byte {error.start}") from None
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"{source}: not valid TOML: {error}") from None
    except RecursionError:
        raise ValueError(f"{source}: not valid TOML: brackets nested too deep") from None


def _decoded(data: bytes) -> str:
    """Bytes as text."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return data.decode(encoding, errors="replace")
    # numbers in UTF-16 have a zero in every second byte
    for start, encoding in ((1, "utf-16-le"), (0, "utf-16-be")):
        half = data[start::2]
        if len(data) > 1 and half.count(0) > 0.9 * len(half) and data[1 - start :: 2].count(0) == 0:
            return data.decode(encoding, errors="replace")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")
