"""The command ``hh-exudyn``, also as ``python -m hh_exudyn``; Ctrl-C in its imports is no fault."""

import sys

_INTERRUPTED = 130  # as `hh_exudyn.cli.app` has it


def main() -> None:
    """Entry point of ``hh-exudyn``."""
    try:
        from hh_exudyn.cli.app import main as command
    except KeyboardInterrupt:
        sys.stderr.write("hh-exudyn: interrupted; nothing was written\n")
        sys.exit(_INTERRUPTED)
    command()


if __name__ == "__main__":
    main()
