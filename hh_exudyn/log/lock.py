"""One writer in the folder of a run: a lock that ends with its process, however that ends."""

import os
from pathlib import Path

try:
    import fcntl
except ImportError:  # not a POSIX system: there is no such lock, and none is held
    fcntl = None  # type: ignore[assignment]


class FolderLock:
    """A held lock; `close` gives it up."""

    def __init__(self, descriptor: int | None) -> None:
        self._descriptor = descriptor

    def close(self) -> None:
        """Let others write."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None


def locked(folder: Path) -> FolderLock:
    """Lock a folder for this process.

    Raises
    ------
    FileExistsError
        Another process, or another recorder of this one, holds it.
    """
    if fcntl is None:
        return FolderLock(None)
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(descriptor)
        raise FileExistsError(f"{folder}: another process writes a run into it") from None
    except OSError:  # a file system without locks
        os.close(descriptor)
        return FolderLock(None)
    return FolderLock(descriptor)
