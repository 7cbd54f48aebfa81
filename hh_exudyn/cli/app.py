"""The command ``hh-exudyn``: its parts, its version, its exit codes.

=========  ==================================================================================
exit code  meaning
=========  ==================================================================================
0          done
1          a full disk or another fault of the machine, with path and reason; a fault of the program, with the
           file of the traceback; `validate`: a row fails
2          bad input: one line with what is allowed; nothing was begun or overwritten
3          the vehicle derailed or the run diverged; the log up to then remains
130        Ctrl-C; the log up to then remains
143        SIGTERM; the log up to then remains
=========  ==================================================================================

Large packages are imported inside the commands, so that ``--help`` is fast.
"""

import signal
import sys
from contextlib import suppress
from types import FrameType
from typing import Annotated

import typer

from hh_exudyn import __version__
from hh_exudyn.cli import assess as cli_assess
from hh_exudyn.cli import campaign as cli_campaign
from hh_exudyn.cli import compare as cli_compare
from hh_exudyn.cli import contact as cli_contact
from hh_exudyn.cli import creep_curve as cli_creep_curve
from hh_exudyn.cli import damage as cli_damage
from hh_exudyn.cli import linear as cli_linear
from hh_exudyn.cli import output
from hh_exudyn.cli import parameters as cli_parameters
from hh_exudyn.cli import run as cli_run
from hh_exudyn.cli import track as cli_track
from hh_exudyn.cli import twist_test as cli_twist_test
from hh_exudyn.cli import validate as cli_validate
from hh_exudyn.cli import vehicle as cli_vehicle
from hh_exudyn.cli.usage import OneLineUsage

app = typer.Typer(
    cls=OneLineUsage,
    help="Wheel damage on heavy-haul railways.",
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)
cli_contact.register(app)
cli_validate.register(app)
cli_creep_curve.register(app)
cli_damage.register(app)
cli_track.register(app)
cli_assess.register(app)
cli_twist_test.register(app)
cli_compare.register(app)
cli_campaign.register(app)
cli_vehicle.register(app)
cli_linear.register(app)
cli_parameters.register(app)


def main() -> None:
    """The command, as `hh_exudyn.__main__` calls it."""
    try:
        with suppress(ValueError):  # not in the main thread, the only one that receives signals
            signal.signal(signal.SIGTERM, _terminate)
        app()
    except KeyboardInterrupt:  # outside of a command: while a library is imported
        sys.exit(output.INTERRUPTED)


def _terminate(number: int, frame: FrameType | None) -> None:
    """SIGTERM ends a command as Ctrl-C does: with one line, and no file that is not complete."""
    raise output.Terminated


def _print_version(wanted: bool) -> None:
    if wanted:
        output.print_line(f"hh-exudyn {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Wheel damage on heavy-haul railways: simulate a wagon, compute wear and fatigue, play it back."""


cli_run.register(app)
