"""A stand-in for the simulation in tests of the engine's faults: small sums of a number, and a fault."""

import errno
import os
import signal
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.campaign.engine.sums import DamageSums, PartSums
from hh_exudyn.campaign.engine.task import Task

CODE = {"damage": "1"}


@dataclass(frozen=True)
class Payload:
    """What `evaluate` does: a number, how long it takes [s], and a fault.

    `fault` is one of "", "die", "hang", "raise", "disk"; it happens as often as `times` says, counted in
    files of the folder `marks`.
    """

    number: float
    seconds: float = 0.0
    fault: str = ""
    marks: Path = Path()
    times: int = 1


class Unpicklable(Exception):
    """Cannot be sent to another process."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.held = lambda: text


def evaluate(payload: Payload) -> PartSums:
    """Sums of a number, or its fault."""
    time.sleep(payload.seconds)
    marks = payload.marks / f"{payload.number:g}"
    if payload.fault and (begun := marks.stat().st_size if marks.exists() else 0) < payload.times:
        marks.write_text("x" * (begun + 1))
        if payload.fault == "die":
            os.kill(os.getpid(), signal.SIGKILL)
        elif payload.fault == "hang":
            time.sleep(60.0)
        elif payload.fault == "disk":
            raise OSError(errno.ENOSPC, "No space left on device")
        raise Unpicklable("wheel 2L has left\nits rail")
    grid, along = LateralGrid(-0.01, 0.002, 10), PatchGrid(-0.004, 0.002, 4)
    zero = WheelSurface.zero((Wheel(1, 1, 1, -1), Wheel(1, 1, 1, 1)), grid, along)
    work = np.array([payload.number, 0.1 * payload.number])
    surface = replace(zero, rows=1, time=1.0, distance=10.0, work=work)
    return {"run": DamageSums((surface,), {"Q_N": payload.number})}


def tasks(payloads: Sequence[Payload]) -> list[Task]:
    """Tasks of payloads, with a weight of 1 to 3 and keys of their number."""
    return [
        Task(f"case {one.number:g}", one, f"{one.number:08.3f}", 1.0 + i % 3, max(one.seconds, 0.01))
        for i, one in enumerate(payloads)
    ]
