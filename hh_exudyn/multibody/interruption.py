"""Ctrl-C and SIGTERM while Exudyn integrates, which reports an exception of a user function as its own."""

import signal
import threading
from types import FrameType, TracebackType
from typing import Any

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Terminated(SystemExit):
    """SIGTERM has ended a run: the log up to then is complete. Not caught, it ends the program with 143."""

    def __init__(self) -> None:
        super().__init__(128 + signal.SIGTERM)


class Interruption:
    """Records Ctrl-C and SIGTERM instead of raising them; the integration checks `wanted` after every step.

    ::

        with Interruption() as interruption:
            ...
        interruption.raise_wanted()

    Outside of the main thread, the only one that receives signals, it has no effect.
    """

    def __init__(self) -> None:
        self._number: int | None = None
        self._before: dict[int, Any] = {}

    @property
    def wanted(self) -> bool:
        """Whether a signal has come."""
        return self._number is not None

    def raise_wanted(self) -> None:
        """Raise KeyboardInterrupt after Ctrl-C, `Terminated` after SIGTERM."""
        if self._number == signal.SIGTERM:
            raise Terminated
        if self._number is not None:
            raise KeyboardInterrupt

    def __enter__(self) -> "Interruption":
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                self._before[number] = signal.signal(number, self._note)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        while self._before:
            number, before = self._before.popitem()
            signal.signal(number, before)

    def _note(self, number: int, frame: FrameType | None) -> None:
        self._number = number
