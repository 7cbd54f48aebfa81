"""A recording file (`.rrd`), renamed into place when it is complete."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import rerun as rr
import rerun.blueprint as rrb

APPLICATION = "hh_exudyn"


@contextmanager
def new_recording(path: Path, name: str, blueprint: rrb.Blueprint) -> Iterator[rr.RecordingStream]:
    """A stream into a file, for a `with` statement; an error inside leaves no file.

    Parameters
    ----------
    path
        File to write; an existing one is replaced at the end.
    name
        Name of the recording in the viewer.
    blueprint
        How the viewer arranges it.
    """
    stream = rr.RecordingStream(APPLICATION, send_properties=False)
    partial = path.with_name(path.name + ".part")
    try:
        stream.save(partial, default_blueprint=blueprint)
        stream.send_recording_name(name)
        yield stream
        stream.disconnect()  # flushes
        partial.replace(path)
    finally:
        stream.disconnect()
        partial.unlink(missing_ok=True)
