"""A malformed input through the command line: exit code, one line on stderr, and nothing written."""

from pathlib import Path

from command_line import call


def listing(folder: Path) -> dict[Path, bytes | None]:
    """Every file below a folder with its bytes, and every folder."""
    return {path: path.read_bytes() if path.is_file() else None for path in sorted(folder.rglob("*"))}


def check_refused(folder: Path, words: tuple[str | Path, ...], part: str, code: int = 2) -> None:
    """The command ends with the code and one line that has the part; below the folder all is as it was.

    Parameters
    ----------
    folder
        Of the input and the output.
    words
        The command.
    part
        Of the line.
    code
        Exit code.
    """
    before = listing(folder)
    result = call(*words)
    assert result.exit_code == code, result.output
    assert result.stdout == ""
    assert result.stderr.startswith("hh-exudyn: ")
    assert result.stderr.count("\n") == 1
    assert part in result.stderr
    assert listing(folder) == before
