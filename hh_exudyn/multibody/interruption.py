"""Ctrl-C while Exudyn integrates: it would make a fault of its own of an exception in a user function."""

import signal
import threading
from types import FrameType, TracebackType


class Interruption:
    """Notes Ctrl-C instead of raising it; whoever integrates looks at `wanted` after every step.

    ::

        with Interruption() as interruption:
            ...
        if interruption.wanted:
            raise KeyboardInterrupt

    Outside of the main thread, which alone gets signals, it does nothing.
    """

    def __init__(self) -> None:
        self.wanted = False

    def __enter__(self) -> "Interruption":
        self._in_main = threading.current_thread() is threading.main_thread()
        if self._in_main:
            self._before = signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._in_main:
            signal.signal(signal.SIGINT, self._before)

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.wanted = True
