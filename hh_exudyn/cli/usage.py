"""Mistakes in the words of a command as one line with exit code 2, like every other bad input."""

import sys
from typing import Any

from typer.core import TyperGroup


class OneLineUsage(TyperGroup):
    """A group of commands that says a missing, unknown or misspelt option in one line on stderr."""

    def main(self, args: Any = None, *, standalone_mode: bool = True, **extra: Any) -> Any:  # type: ignore[override]
        """Run the command of the words, as click does, with the same arguments."""
        try:
            result = super().main(args=args, standalone_mode=False, **extra)
        except Exception as error:
            # click's, which typer brings along in some versions: told by what it can say
            if not standalone_mode or not hasattr(error, "format_message"):
                raise
            if type(error).__name__ == "NoArgsIsHelpError":
                error.show()  # type: ignore[attr-defined]
            else:
                message = " ".join(error.format_message().split()).rstrip(".")
                sys.stderr.write(f"hh-exudyn: {message}; see {_help_of(getattr(error, 'ctx', None))}\n")
            sys.exit(getattr(error, "exit_code", 2))
        if standalone_mode:
            sys.exit(result if isinstance(result, int) else 0)
        return result


def _help_of(context: Any) -> str:
    """The command that explains the words: ``hh-exudyn track plot --help``."""
    words = [] if context is None else context.command_path.split()[1:]
    return " ".join(["hh-exudyn", *words, "--help"])
