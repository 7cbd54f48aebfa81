"""Names as they are on any terminal, exit codes of files and disks, Ctrl-C while libraries are imported."""

import errno
import io
import os
import subprocess
import sys
from pathlib import Path

import pytest
from command_line import call, refused
from rich.console import Console

from hh_exudyn.case import Case
from hh_exudyn.cli import output
from hh_exudyn.cli import run as cli

NAMES = ("{}", "{0.x}", "[/b]", "[bold]x", ":x:", ":smile:", "[link=x]", "{task}", "\\[", "100 %")


@pytest.mark.parametrize("name", NAMES)
def test_a_name_is_no_markup(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Progress bars, lines, titles and cells show it as it is: braces and brackets once ended a run."""
    shown = io.StringIO()
    kinds = {"markup": False, "emoji": False, "highlight": False, "soft_wrap": True}
    terminal = Console(file=shown, force_terminal=True, width=200, **kinds)
    monkeypatch.setattr(output, "err", terminal)
    with cli._progress_bar(name) as progress:
        progress(0.5, name)
    assert name in shown.getvalue()
    for console in (output.out, Console(stderr=True, markup=False, emoji=False)):
        assert (console._markup, console._emoji) == (False, False)
    with terminal.capture() as captured:
        monkeypatch.setattr(output, "out", terminal)
        table = output.new_table(f"Track of {name}", ("name",))
        table.add_row(name)
        output.print_table(table)
        output.print_line(name)
    assert captured.get().count(name) == 3


def test_output_consoles_know_no_markup() -> None:
    for console in (output.out, output.err):
        assert (console._markup, console._emoji) == (False, False)


@pytest.mark.parametrize(
    ("error", "code", "part"),
    [
        (PermissionError(errno.EACCES, "Permission denied", "/mine/x"), 2, "/mine/x: Permission denied"),
        (OSError(errno.EROFS, "Read-only file system", "/ro/x"), 2, "/ro/x: Read-only file system"),
        (OSError(errno.ELOOP, "Too many levels of symbolic links", "loop"), 2, "loop: Too many levels"),
        (FileNotFoundError("run has no finished part of the log 'motion'"), 2, "no finished part"),
        (
            OSError(errno.ENOSPC, "No space left on device", "/full/x"),
            1,
            "/full/x: No space left on device",
        ),
        (OSError(errno.EIO, "Input/output error", "/disk/x"), 1, "Input/output error"),
        (ZeroDivisionError("a fault"), 1, "ZeroDivisionError: a fault"),
    ],
)
def test_files_of_the_user_are_bad_input_and_a_full_disk_is_not(
    error: Exception, code: int, part: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise error

    monkeypatch.setattr("vehicles.catalogue.vehicle_names", broken)
    result = call("vehicle", "list")
    assert result.exit_code == code
    assert part in result.stderr
    assert result.stderr.count("\n") == 1


def test_the_loser_of_two_runs_writes_nothing_into_the_winners_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The folder is claimed by another process while this one compiles."""

    def claimed(case: Case, directory: Path, **options: object) -> None:
        directory.mkdir()
        (directory / "case.toml").write_text("the winner's")
        raise FileExistsError(f"{directory} is not empty: a run is never overwritten")

    monkeypatch.setattr("hh_exudyn.multibody.simulate.simulate", claimed)
    assert "is not empty: a run is never overwritten" in refused("demo", "--out", tmp_path / "run")
    assert [path.name for path in (tmp_path / "run").iterdir()] == ["case.toml"]
    assert (tmp_path / "run" / "case.toml").read_text() == "the winner's"


@pytest.mark.parametrize("module", ["typer", "rich.table", "hh_exudyn.log.store", "pyarrow"])
def test_ctrl_c_while_a_library_is_imported(module: str) -> None:
    """A real signal, from the import of a library of the program itself or of a command."""
    code = f"""
import importlib.abc, os, signal, sys

class Interrupting(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name == {module!r}:
            sys.meta_path.remove(self)
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting())
sys.argv = ["hh-exudyn", "damage", "/nowhere"]
from hh_exudyn.__main__ import main
main()
"""
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=os.environ)
    assert result.returncode == 130, result.stderr
    assert result.stderr in ("hh-exudyn: interrupted; nothing was written\n", "")
    assert result.stdout == ""
