"""A recording file (`.rrd`), renamed into place when it is complete and has been read back.

It is gathered in memory and written here: on a full disk rerun's own writer leaves a file cut off, and waits
for ever.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import rerun as rr
import rerun.blueprint as rrb

from hh_exudyn.log.parts import write_bytes

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

    Raises
    ------
    OSError
        The file cannot be written, for instance on a full disk.
    """
    stream = rr.RecordingStream(APPLICATION, send_properties=False)
    memory = stream.memory_recording()
    try:
        stream.send_blueprint(blueprint)
        stream.send_recording_name(name)
        yield stream
        stream.flush()
        write_bytes(path, memory.drain_as_bytes(), read_back=True)
    finally:
        stream.disconnect()
