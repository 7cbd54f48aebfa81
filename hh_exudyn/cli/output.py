"""Output of the commands: lines, tables that fit the terminal, files, errors in one line with exit code."""

import errno
import math
import tempfile
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.status import Status
from rich.table import Table

from hh_exudyn.cli.inputs import BadInput

if TYPE_CHECKING:
    import pyarrow
    from matplotlib.figure import Figure

    from hh_exudyn.log.store import Run

FAULT, BAD_INPUT, STOPPED, INTERRUPTED, TERMINATED = 1, 2, 3, 130, 143  # exit codes, see `hh_exudyn.cli.app`
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)  # no room for a file
NOTHING = "–"  # in a table, for a missing number
DOTS_PER_INCH = 150  # of figures
TABLE_WIDTH = 120  # largest width of a table in a file or a pipe

# names and paths are anybody's: "[/b]" and ":x:" are text, never markup or emoji
out = Console(soft_wrap=True, highlight=False, markup=False, emoji=False)
err = Console(stderr=True, soft_wrap=True, highlight=False, markup=False, emoji=False)
_FAULTY_MACHINE = {errno.EIO, errno.ENOMEM, errno.EMFILE, errno.ENFILE}


class Terminated(SystemExit):
    """SIGTERM outside of an integration, which has an exception of its own for it with the same exit code."""

    def __init__(self) -> None:
        super().__init__(TERMINATED)


@contextmanager
def errors_in_one_line(folder: Path | None = None) -> Iterator[None]:
    """Every error of a command as one line on stderr and an exit code.

    Parameters
    ----------
    folder
        Folder of the run, for the traceback of a fault; None for a command without one.
    """
    try:
        yield
    except typer.Exit:
        raise
    except BadInput as error:
        fail(BAD_INPUT, str(error))
    except KeyboardInterrupt:
        fail(INTERRUPTED, f"interrupted; {log_place(folder)}")
    except SystemExit as end:
        if end.code == TERMINATED:
            fail(TERMINATED, f"terminated; {log_place(folder)}")
        raise
    except OSError as error:
        if error.errno in _FULL:
            fail(FAULT, f"{error.filename or folder}: {error.strerror}; {log_place(folder)}")
        if error.errno not in _FAULTY_MACHINE:
            fail(BAD_INPUT, _file_fault(error))  # a file or folder of the user: missing, read-only, a loop
        _fail_with_traceback(error, folder)
    except Exception as error:
        from hh_exudyn.case.errors import CaseError  # the package of cases is heavy: not for --help

        if isinstance(error, CaseError):
            fail(BAD_INPUT, str(error))
        _fail_with_traceback(error, folder)


def _file_fault(error: OSError) -> str:
    """What is wrong with which file, in one line."""
    text = " ".join(str(error).split())
    return f"{error.filename}: {error.strerror}" if error.filename and error.strerror else text


def _fail_with_traceback(error: Exception, folder: Path | None) -> NoReturn:
    """End the command for a fault of the program."""
    reason = " ".join(str(error).split()) or "no message"
    fail(FAULT, f"{type(error).__name__}: {reason}; traceback in {_written_traceback(folder)}")


def log_place(folder: Path | None, resumable: bool = True) -> str:
    """The folder of the log so far, as part of a message; for a run that may be resumed, with that hint."""
    if folder is None or not (folder / "case.toml").is_file():
        return "nothing was written"
    if not (resumable and (folder / "checkpoint.npz").is_file()):
        return f"the log so far is kept in {folder}"
    return f"the log so far is kept in {folder}, and --resume goes on"


def _written_traceback(folder: Path | None) -> Path:
    """Write the current traceback into the run's folder, or a temporary one where that is read-only."""
    text = traceback.format_exc()
    if folder is not None:
        path = folder / "error.txt"
        with suppress(OSError):
            path.write_text(text, encoding="utf-8")
            return path
    path = Path(tempfile.mkdtemp(prefix="hh-exudyn-")) / "error.txt"
    path.write_text(text, encoding="utf-8")
    return path


def fail(code: int, message: str) -> NoReturn:
    """End the command with one line on stderr."""
    err.print(f"hh-exudyn: {message}")
    raise typer.Exit(code)


def print_line(text: str) -> None:
    """One or more lines on stdout, as they are."""
    out.print(text)


def print_left_out(run: "Run") -> None:
    """Name the broken parts of a run's logs that are left out, if any are."""
    for broken in run.broken_parts() if run.skip_broken_parts else ():
        print_line(f"left out: {broken.path}: {broken.reason}")


def status(text: str) -> Status:
    """A progress indicator on stderr, for a `with` statement."""
    return err.status(text)


def new_table(title: str, headings: tuple[str, ...]) -> Table:
    """An empty table for 80 columns, with one word of a heading per line."""
    table = Table(title=title, box=SIMPLE_HEAD, pad_edge=False)
    for heading in headings:
        table.add_column(heading.replace(" ", "\n"), justify="right", no_wrap=True)
    return table


def print_table(table: Table) -> None:
    """Print the title in its own line, and the columns in full width also into a file or a narrow pipe."""
    wide = out if out.is_terminal else Console(width=TABLE_WIDTH, markup=False, emoji=False)
    print_line(str(table.title))
    table.title = None  # rich would break it at the table's width
    wide.print(table)


def number(value: float, digits: int) -> str:
    """A number of a table: no sign before a zero, a dash for NaN."""
    return NOTHING if math.isnan(value) else f"{round(value, digits) + 0.0:.{digits}f}"


def write_figure(figure: "Figure", path: Path, option: str = "--out") -> None:
    """Write a figure into the file of an option and print its path. Raises BadInput where it cannot."""
    with _written(path, option, "figure"):
        figure.savefig(path, dpi=DOTS_PER_INCH)


def write_table(table: "pyarrow.Table", path: Path, option: str) -> None:
    """Write a table (.csv), as `write_figure` does."""
    import pyarrow.csv

    with _written(path, option, "table"):
        pyarrow.csv.write_csv(table, path)


def write_text(text: str, path: Path, option: str, kind: str) -> None:
    """Write a text of some kind, as `write_figure` does."""
    with _written(path, option, kind):
        path.write_text(text, encoding="utf-8")


@contextmanager
def _written(path: Path, option: str, kind: str) -> Iterator[None]:
    """Print the path of a file after it is written; a file that cannot be written is bad input."""
    try:
        yield
    except OSError as error:
        raise BadInput(f"{option} {path}: {error.strerror}") from None
    print_line(f"{kind}: {path}")
