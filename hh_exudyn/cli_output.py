"""What all commands share: exit codes, one line for every fault, and tables that fit the terminal."""

import tempfile
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NoReturn

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from hh_exudyn.case_errors import CaseError

FAULT, BAD_INPUT, STOPPED, INTERRUPTED = 1, 2, 3, 130  # exit codes, see `hh_exudyn.cli`
TABLE_WIDTH = 120  # at most, of a table that goes into a file or a pipe

out = Console(soft_wrap=True, highlight=False)
err = Console(stderr=True, soft_wrap=True, highlight=False)


class Refused(ValueError):
    """What the user asked for cannot be done; the message is one line."""


@contextmanager
def told(folder: Path | None = None) -> Iterator[None]:
    """Turn what goes wrong in a command into one line on stderr and an exit code.

    Parameters
    ----------
    folder
        Folder of the run, where the traceback of a fault goes; None for a command without one.
    """
    try:
        yield
    except typer.Exit:
        raise
    except (CaseError, Refused) as error:
        fail(BAD_INPUT, str(error))
    except KeyboardInterrupt:
        fail(INTERRUPTED, f"interrupted; {kept(folder)}")
    except Exception as error:
        reason = " ".join(str(error).split()) or "no message"
        fail(FAULT, f"{type(error).__name__}: {reason}; traceback in {_written_traceback(folder)}")


def kept(folder: Path | None) -> str:
    """Where the log so far is."""
    if folder is None or not (folder / "case.toml").is_file():
        return "nothing was written"
    return f"the log so far is kept in {folder}"


def _written_traceback(folder: Path | None) -> Path:
    """Write the traceback at hand into the run's folder, or a temporary one where that cannot be written."""
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
    err.print(f"hh-exudyn: {message}", markup=False)
    raise typer.Exit(code)


def new_table(title: str, headings: tuple[str, ...]) -> Table:
    """An empty table that fits into 80 columns: a word of the heading a line."""
    table = Table(title=title, box=SIMPLE_HEAD, pad_edge=False)
    for heading in headings:
        table.add_column(escape(heading.replace(" ", "\n")), justify="right", no_wrap=True)
    return table


def print_table(table: Table) -> None:
    """The title on a line of its own, and whole columns also where the output is a file or a narrow pipe."""
    wide = out if out.is_terminal else Console(width=TABLE_WIDTH)
    out.print(table.title, markup=False)
    table.title = None  # rich would break it at the table's width
    wide.print(table)
