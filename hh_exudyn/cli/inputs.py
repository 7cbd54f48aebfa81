"""Input of the commands: common arguments, and the refusal of bad input before any work."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from hh_exudyn.case import Case
    from hh_exudyn.log.store import Run

FIGURES = (".png", ".pdf", ".svg")
TABLES = (".csv",)
VEHICLES = (".toml",)
RECORDINGS = ()  # of any suffix

SkipBrokenParts = Annotated[
    bool, typer.Option("--skip-broken-parts", help="Read the rest of logs with broken files; name those.")
]
RunFolder = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a run.")]
CaseFile = Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file.")]
NewFolder = Annotated[Path, typer.Option("--out", metavar="DIR", help="New or empty folder for the run.")]
Unfinished = Annotated[
    bool,
    typer.Option("--unfinished", help="Take the log of a run that derailed, diverged or was interrupted."),
]
# of an elliptic patch
SemiAxisAlong = Annotated[
    float, typer.Option(metavar="mm", help="Semi-axis of the patch in rolling direction.")
]
SemiAxisAcross = Annotated[float, typer.Option(metavar="mm", help="Lateral semi-axis.")]
NormalForce = Annotated[float, typer.Option(metavar="kN", help="Normal force.")]
Friction = Annotated[float, typer.Option(metavar="NUMBER", help="Friction coefficient.")]
NewFigure = Annotated[
    Path | None,
    typer.Option("--out", metavar="FIGURE", help="Write a figure to this new file (.png, .pdf, .svg)."),
]


class BadInput(ValueError):
    """Impossible input of the user; the message is one line with what is allowed."""


@contextmanager
def refused_as_bad_input() -> Iterator[None]:
    """Convert errors of the toolkit about input (ValueError, OSError) to `BadInput`."""
    try:
        yield
    except (ValueError, OSError) as error:
        raise BadInput(str(error)) from None


def check_range(option: str, value: float | None, low: float, high: float, unit: str = "") -> None:
    """Raise `BadInput` for a number out of its range or NaN; None, an option not given, passes."""
    if value is not None and not low <= value <= high:
        behind = f" {unit}" if unit else ""
        raise BadInput(f"{option} {value:g}{behind}: allowed {low:g} to {high:g}{behind}")


def check_patch(
    a_mm: float, b_mm: float, load_kn: float, nu_x: float, nu_y: float, spin: float, friction: float
) -> None:
    """Raise `BadInput` for a number of an elliptic patch out of its range."""
    check_range("--a-mm", a_mm, 0.1, 100.0, "mm")
    check_range("--b-mm", b_mm, 0.1, 100.0, "mm")
    check_range("--load-kn", load_kn, 0.001, 1000.0, "kN")
    check_range("--nu-x", nu_x, -1.0, 1.0)
    check_range("--nu-y", nu_y, -1.0, 1.0)
    check_range("--spin", spin, -100.0, 100.0, "1/m")
    check_range("--friction", friction, 0.001, 2.0)


def require_new_folder(folder: Path, option: str = "--out") -> None:
    """Raise `BadInput` for a folder of an option that is not empty, or cannot be made; it is not made."""
    made: list[Path] = []
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            kind = "is not empty" if folder.is_dir() else "is a file"
            raise BadInput(f"{option} {folder}: {kind}, allowed is a new or an empty folder")
        for path in (*reversed(folder.parents), folder):
            if not path.is_dir():
                path.mkdir()
                made.append(path)
        if not os.access(folder, os.W_OK | os.X_OK):
            raise BadInput(f"{option} {folder}: cannot be written to, allowed is a new or an empty folder")
    except OSError as error:
        raise BadInput(f"{option} {folder}: {error.strerror}") from None
    finally:
        for path in reversed(made):
            with suppress(OSError):  # another process has begun to use it
                path.rmdir()


def require_new_file(path: Path | None, option: str, suffixes: Sequence[str]) -> None:
    """Raise `BadInput` for a file that cannot be written as a new one.

    Parameters
    ----------
    path
        The file; None, an option not given, passes.
    option
        Its name on the command line, for the message.
    suffixes
        Allowed suffixes (`FIGURES`, `TABLES`); empty for any.

    Raises
    ------
    BadInput
        Another suffix, a file that exists, or no folder to write it into.
    """
    if path is None:
        return
    if suffixes and path.suffix.lower() not in suffixes:
        raise BadInput(
            f"{option} {path}: allowed {'is' if len(suffixes) == 1 else 'are'} {', '.join(suffixes)}"
        )
    try:
        there = path.exists() or path.is_symlink()
    except OSError as error:
        raise BadInput(f"{option} {path}: {error.strerror}") from None
    if there:
        raise BadInput(f"{option} {path}: exists already, allowed is a new file")
    if not path.parent.is_dir():
        raise BadInput(f"{option} {path}: there is no folder {path.parent}")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise BadInput(f"{option} {path}: its folder cannot be written to")


def read_run(folder: Path, skip_broken_parts: bool = False) -> "Run":
    """The run in a folder, with at least one row in its contact log.

    Parameters
    ----------
    folder
        Of the run.
    skip_broken_parts
        Leave out parts of its logs that cannot be read.

    Raises
    ------
    BadInput
        No run, or a contact log without rows.
    """
    from hh_exudyn.log.store import open_run

    with refused_as_bad_input():
        run = open_run(folder, skip_broken_parts=skip_broken_parts)
        if run.read("contact", ["time"]).num_rows == 0:
            raise BadInput(f"{folder}: the contact log has no rows")
    return run


def case_of(run: "Run") -> "Case":
    """The case of a run."""
    from hh_exudyn.case import Case

    return Case.from_toml(run.case_text, source=f"{run.directory}/case.toml", folder=run.directory)
