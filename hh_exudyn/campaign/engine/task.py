"""`Task`: what is to be evaluated, under its key; `Evaluated`: what a worker gives back of it.

A worker gives back bytes and texts only: whatever goes wrong in it comes through to the other side.
"""

import errno
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from hh_exudyn.campaign.engine.sums import PartSums, to_bytes

Evaluate = Callable[[Any], PartSums]
"""From a task's payload to sums by part: a pure function, defined in a module."""

_OF_THE_MACHINE = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EIO, errno.EMFILE, errno.ENFILE)


@dataclass(frozen=True)
class Task:
    """One evaluation.

    Attributes
    ----------
    name
        For messages.
    payload
        Argument of the evaluating function; can be pickled.
    key
        Name of its result: a hash of everything that the result depends on.
    weight
        Share in the whole, >= 0; of all tasks together it need not be 1.
    size
        Wall time expected before anything has run [s]; only ratios count afterwards.
    """

    name: str
    payload: Any
    key: str
    weight: float = 1.0
    size: float = 1.0


class Ending(StrEnum):
    """How an evaluation ended."""

    DONE = "done"
    FAILED = "failed"  # and would again: it raised an error of its own
    LOST = "lost"  # by its worker: it died, hung, was interrupted, or had no memory
    STUCK = "stuck"  # the disk is full, or fails: others would end alike


@dataclass(frozen=True)
class Evaluated:
    """How an evaluation ended in its worker.

    Attributes
    ----------
    ending
        One of `Ending`.
    wall
        Time taken [s].
    content
        The result as the content of its file; empty where there is none.
    reason
        Why there is none, in a line.
    """

    ending: Ending
    wall: float
    content: bytes = b""
    reason: str = ""


def evaluated(evaluate: Evaluate, payload: Any, key: str) -> Evaluated:
    """Evaluate a payload, in a worker: never raises.

    Parameters
    ----------
    evaluate, payload, key
        The function, its argument, and the key of the result.
    """
    begun = clock.perf_counter()
    try:
        content = to_bytes(evaluate(payload), key)
    except MemoryError as error:
        ending, reason = Ending.LOST, f"no memory: {error}"
    except OSError as error:
        ending = Ending.STUCK if error.errno in _OF_THE_MACHINE else Ending.FAILED
        reason = str(error)
    except (KeyboardInterrupt, SystemExit) as error:
        ending, reason = Ending.LOST, f"interrupted ({type(error).__name__})"
    except Exception as error:
        ending, reason = Ending.FAILED, f"{type(error).__name__}: {error}"
    else:
        return Evaluated(Ending.DONE, clock.perf_counter() - begun, content)
    return Evaluated(ending, clock.perf_counter() - begun, reason=" ".join(reason.split()))
