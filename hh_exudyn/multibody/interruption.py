"""Ctrl-C while Exudyn integrates, which reports an exception of a user function as a failure of its own."""

import signal
import threading
from types import FrameType, TracebackType


class Interruption:
    """Records Ctrl-C instead of raising it; the integration checks `wanted` after every step.

    ::

        with Interruption() as interruption:
            ...
        if interruption.wanted:
            raise KeyboardInterrupt

    Outside of the main thread, the only one that receives signals, it has no effect.
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
