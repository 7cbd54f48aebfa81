"""What all commands share: exit codes, one line for every fault, figures, tables that fit the terminal."""

import math
import tempfile
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FAULT, BAD_INPUT, STOPPED, INTERRUPTED = 1, 2, 3, 130  # exit codes, see `hh_exudyn.cli.app`
FIGURES = (".png", ".pdf", ".svg")
NOTHING = "–"  # in a table, where there is no such number
TABLE_WIDTH = 120  # at most, of a table that goes into a file or a pipe

out = Console(soft_wrap=True, highlight=False)
err = Console(stderr=True, soft_wrap=True, highlight=False)

NewFigure = Annotated[
    Path | None,
    typer.Option("--out", metavar="FIGURE", help="Write a figure to this new file (.png, .pdf, .svg)."),
]


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
    except Refused as error:
        fail(BAD_INPUT, str(error))
    except KeyboardInterrupt:
        fail(INTERRUPTED, f"interrupted; {kept(folder)}")
    except Exception as error:
        from hh_exudyn.case.errors import CaseError  # the package of cases is heavy: not for --help

        if isinstance(error, CaseError):
            fail(BAD_INPUT, str(error))
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


def number(value: float, digits: int) -> str:
    """A number of a table: no sign before a zero, a dash for NaN."""
    return NOTHING if math.isnan(value) else f"{round(value, digits) + 0.0:.{digits}f}"


def check(option: str, value: float, low: float, high: float, unit: str) -> None:
    """Refuse a number out of its range, NaN included."""
    if not low <= value <= high:
        raise Refused(
            f"{option} {value:g}{unit and ' ' + unit}: allowed {low:g} to {high:g}{unit and ' ' + unit}"
        )


def require_new_folder(folder: Path) -> None:
    """Refuse a folder that holds anything, before any work."""
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            kind = "is not empty" if folder.is_dir() else "is a file"
            raise Refused(f"--out {folder}: {kind}, allowed is a new or an empty folder")
    except OSError as error:
        raise Refused(f"--out {folder}: {error.strerror}") from None


def require_new_figure(path: Path | None, option: str = "--out") -> None:
    """Refuse a figure that cannot be written, before any work."""
    if path is None:
        return
    if path.suffix.lower() not in FIGURES:
        raise Refused(f"{option} {path}: allowed are {', '.join(FIGURES)}")
    if path.exists():
        raise Refused(f"{option} {path}: exists already, allowed is a new file")
    if not path.parent.is_dir():
        raise Refused(f"{option} {path}: there is no folder {path.parent}")


def write_figure(figure: "Figure", path: Path, option: str = "--out") -> None:
    """Write a figure and say where it is."""
    try:
        figure.savefig(path, dpi=150)
    except OSError as error:
        raise Refused(f"{option} {path}: {error.strerror}") from None
    out.print(f"figure: {path}")
