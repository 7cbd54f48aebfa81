"""The command ``hh-exudyn`` in the process of a test."""

from pathlib import Path

from typer.testing import CliRunner, Result

from hh_exudyn.cli.app import app


def call(*words: str | Path) -> Result:
    """Exit code and output of a command."""
    return CliRunner().invoke(app, [str(word) for word in words])


def refused(*words: str | Path) -> str:
    """The one line on stderr of a command that is refused; nothing on stdout."""
    result = call(*words)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith("hh-exudyn: ")
    assert result.stderr.count("\n") == 1
    return result.stderr
