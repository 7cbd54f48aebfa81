"""The viewer in a window."""

import os
import subprocess
import tempfile
from pathlib import Path

from hh_exudyn.playback.picture import PictureError, free_port, viewer_program

START_TIME = 3.0  # s; without a display the viewer ends within 0.3 s


def open_viewer(recording: Path | str) -> int:
    """Open a recording in rerun's viewer, in a window of its own, and return the viewer's process id.

    The viewer listens on 127.0.0.1 only, and continues after the end of this program. It is watched for
    `START_TIME`: without a display it ends at once.

    Raises
    ------
    FileNotFoundError
        There is no such recording.
    PictureError
        The viewer is missing, or ended early: with the last line that it wrote.
    """
    source = Path(recording)
    if not source.is_file():
        raise FileNotFoundError(f"no recording {source}")
    with tempfile.TemporaryFile() as messages:
        viewer = subprocess.Popen(
            [str(viewer_program()), "--bind", "127.0.0.1", "--port", str(free_port()), str(source.resolve())],
            stdin=subprocess.DEVNULL,
            stdout=messages,
            stderr=messages,
            start_new_session=True,
            env={**os.environ, "RERUN_APP_ONLY": "true"},
        )
        try:
            code = viewer.wait(timeout=START_TIME)
        except subprocess.TimeoutExpired:
            return viewer.pid
        messages.seek(0)
        lines = messages.read().decode(errors="replace").split("\n")
    last = next((line.strip() for line in reversed(lines) if line.strip()), "no message")
    raise PictureError(f"the rerun viewer ended with status {code}, so {source} is not open: {last}")
