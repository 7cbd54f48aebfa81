"""Files of a run that are whole or not there at all: parts of the logs (Parquet), texts.

A file is written under a temporary name, brought to the disk, and renamed into place; then the folder is
brought to the disk too. So after a kill, a full disk or a power failure every file with its final name is
complete. Parts have a checksum of every page, which is verified when they are read.
"""

import errno
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import BinaryIO

import pyarrow
import pyarrow.parquet

PART_PATTERN = "part-*.parquet"  # finished parts; temporary files end differently and are never read
TEMPORARY_SUFFIX = ".tmp"
LOG_KEY = b"log"  # of a part's metadata: the log that it belongs to


class BrokenPart(ValueError):
    """A part of a log cannot be read, or is missing between others; the message names file and remedy."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(
            f"{path}: {reason}; the other parts can be read: --skip-broken-parts, or "
            "open_run(directory, skip_broken_parts=True)"
        )
        self.path = path
        self.reason = reason


def part_path(directory: Path, log: str, number: int) -> Path:
    """Path of one part of a log.

    Parameters
    ----------
    directory, log
        Directory of the run, and ``contact``, ``motion``, ``energy`` or ``control``.
    number
        Of the part, from 0.
    """
    return directory / log / f"part-{number:05d}.parquet"


def part_number(path: Path) -> int:
    """Number of a part, from its name."""
    return int(path.stem.removeprefix("part-"))


def part_paths(directory: Path, log: str) -> list[Path]:
    """Parts of a log that are there, in order of time."""
    parts = (directory / log).glob(PART_PATTERN)
    return sorted((path for path in parts if path.stem[5:].isdecimal()), key=part_number)


def write_whole(path: Path, write: Callable[[BinaryIO], object]) -> None:
    """Write a file by a function of its stream: afterwards it is complete and on disk, or unchanged.

    Raises
    ------
    OSError
        It cannot be written, for instance on a full disk; with path and reason.
    """
    temporary = path.with_name(path.name + TEMPORARY_SUFFIX)
    try:
        with open(temporary, "wb") as stream:
            write(stream)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(temporary, path)
        sync_folder(path.parent)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise OSError(error.errno, error.strerror or str(error), str(path)) from error
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def write_text(path: Path, text: str) -> None:
    """Write a text (UTF-8), as `write_whole` does."""
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes, read_back: bool = False) -> None:
    """Write a file, as `write_whole` does.

    Parameters
    ----------
    path
        Of the file.
    content
        All of it.
    read_back
        Compare the file with its content before it gets its name; OSError where it differs.
    """

    def write(stream: BinaryIO) -> None:
        stream.write(content)
        stream.flush()
        if read_back and Path(stream.name).read_bytes() != content:
            raise OSError(errno.EIO, "does not read back as it was written")

    write_whole(path, write)


def sync_folder(folder: Path) -> None:
    """Bring the names of the files in a folder to the disk, where the system can."""
    if os.name != "posix":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def write_part(path: Path, table: pyarrow.Table, texts: Sequence[str], growing: bool = False) -> None:
    """Write a table as a part.

    Parameters
    ----------
    path
        Of the part.
    table
        Its rows.
    texts
        Names of the columns of repeated texts; numbers hardly ever repeat.
    growing
        Whether it is to be replaced by a longer one soon: without compression it takes half the time.
    """
    write_whole(
        path,
        lambda stream: pyarrow.parquet.write_table(
            table,
            stream,
            compression="none" if growing else "zstd",
            use_dictionary=list(texts),
            write_page_checksum=True,
        ),
    )


def part_columns(path: Path) -> list[str]:
    """Names of the columns of a part.

    Raises
    ------
    BrokenPart
        It is missing, is not a Parquet file, or not a whole one.
    """
    if not path.is_file():
        raise BrokenPart(path, "is missing, and there are later ones")
    try:
        schema = pyarrow.parquet.read_schema(path)
    except (pyarrow.ArrowException, OSError, ValueError) as error:  # of a broken text as well
        raise BrokenPart(path, _reason(error)) from None
    log = (schema.metadata or {}).get(LOG_KEY)
    if log is not None and log.decode("utf-8", "replace") != path.parent.name:
        raise BrokenPart(path, f"is a part of the log {log.decode('utf-8', 'replace')!r}")
    return list(schema.names)


def read_part(path: Path, columns: Sequence[str]) -> pyarrow.Table:
    """Columns of a part, in the wanted order, its checksums verified.

    Raises
    ------
    BrokenPart
        It is not a whole Parquet file, or its content is not what was written.
    """
    there = part_columns(path)
    missing = [name for name in columns if name not in there]
    if missing:
        raise BrokenPart(path, f"has no column {', '.join(missing)}")
    try:
        with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
            return file.read(columns=list(columns)).select(list(columns))
    except (pyarrow.ArrowException, OSError, ValueError) as error:  # of a broken text as well
        raise BrokenPart(path, _reason(error)) from None


def _reason(error: Exception) -> str:
    """Why a part cannot be read, in a few words of one line."""
    return f"cannot be read ({' '.join(str(error).split())[:160]})"
