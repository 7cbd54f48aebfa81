"""How a run ended, for results from its logs: one cut short is never taken for a whole one."""

from hh_exudyn.log.store import Run

FINISHED = "finished"


def ending(run: Run) -> str:
    """`FINISHED`, or why the run ended early: the reason in its status.

    Parameters
    ----------
    run
        On disk.
    """
    try:
        status = run.status
    except (OSError, ValueError) as error:
        return f"its status cannot be read ({error})"
    if not isinstance(status, dict):
        return "its status is none"
    if status.get("finished") is True:
        return FINISHED
    reason = str(status.get("reason", "unknown"))
    return "cut off while it ran, or still running" if reason == "running" else reason


def require_finished(run: Run, unfinished: bool = False) -> str:
    """The `ending` of a run; an early one only where it is wanted.

    Parameters
    ----------
    run
        On disk.
    unfinished
        Whether a run that ended early is wanted.

    Raises
    ------
    ValueError
        The run ended early, with the reason.
    """
    found = ending(run)
    if found != FINISHED and not unfinished:
        raise ValueError(
            f"{run.directory}: the run is not finished: {found}; --unfinished takes its log so far"
        )
    return found
