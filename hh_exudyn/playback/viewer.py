"""The viewer in a window."""

import os
import subprocess
from pathlib import Path

from hh_exudyn.playback.picture import free_port, viewer_program


def open_viewer(recording: Path | str) -> int:
    """Open a recording in rerun's viewer, in a window of its own, and return the viewer's process id.

    The viewer listens on 127.0.0.1 only, and continues after the end of this program.

    Raises
    ------
    FileNotFoundError
        There is no such recording.
    PictureError
        The viewer is missing.
    """
    source = Path(recording)
    if not source.is_file():
        raise FileNotFoundError(f"no recording {source}")
    viewer = subprocess.Popen(
        [str(viewer_program()), "--bind", "127.0.0.1", "--port", str(free_port()), str(source.resolve())],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        env={**os.environ, "RERUN_APP_ONLY": "true"},
    )
    return viewer.pid
