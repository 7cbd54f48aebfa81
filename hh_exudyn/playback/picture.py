"""Pictures of a recording without a screen.

The only file that uses rerun's experimental `ViewerClient`. The viewer is started headless, on 127.0.0.1 and
a free port, and stopped again; it needs a Vulkan driver, which may be a software one (Debian:
``apt install mesa-vulkan-drivers``), but no X server.
"""

import os
import socket
import subprocess
import sys
import tempfile
import time as wall_clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

import rerun_cli  # type: ignore[import-untyped]
from rerun.experimental import ViewerClient, ViewerState

T = TypeVar("T")

START_LIMIT = 60.0  # seconds until the viewer answers; software rendering on a busy machine is slow
LOAD_LIMIT = 120.0  # seconds until a recording is loaded
STEADY_LIMIT = 60.0  # seconds until two successive pictures are equal
NOTICE_TIME = 5.0  # seconds during which the viewer's own notice covers a corner of the picture
_DRIVER_FOLDERS = ("/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d")


class PictureError(RuntimeError):
    """No picture, with the reason: no viewer, no Vulkan driver, or a viewer that ended early."""


def viewer_program() -> Path:
    """The viewer that comes with rerun-sdk.

    Raises
    ------
    PictureError
        There is none.
    """
    path = Path(rerun_cli.__file__).with_name("rerun.exe" if sys.platform == "win32" else "rerun")
    if not path.is_file():
        raise PictureError(f"the rerun viewer is missing: no {path}; install rerun-sdk 0.41 as a wheel")
    return path


def vulkan_driver() -> Path | None:
    """A Vulkan driver's manifest on this machine (Linux), or None where there is none."""
    named = os.environ.get("VK_DRIVER_FILES") or os.environ.get("VK_ICD_FILENAMES")
    candidates = [Path(name) for name in named.split(os.pathsep)] if named else []
    for folder in _DRIVER_FOLDERS:
        candidates += sorted(Path(folder).glob("*.json"))
    return next((path for path in candidates if path.is_file()), None)


def take(
    recording: Path | str,
    picture: Path | str,
    time: float,
    *,
    size: tuple[int, int] = (1600, 900),
    view: str | None = None,
) -> Path:
    """Write a picture (PNG) of a recording at a time, and return its path.

    Parameters
    ----------
    recording
        The `.rrd` file.
    picture
        File to write.
    time
        On the timeline ``sim_time`` [s], 0 or later.
    size
        Width and height of the viewer [pixels], 200 to 8000.
    view
        Name of one view of the blueprint, such as "Vehicle"; None for the whole viewer.

    Raises
    ------
    ValueError
        A time or size out of range, or no view of that name.
    FileNotFoundError
        There is no such recording.
    PictureError
        The viewer or a Vulkan driver is missing, or the viewer did not come to rest.
    """
    source, target = Path(recording), Path(picture)
    if not time >= 0.0:
        raise ValueError(f"time = {time} s must be at least 0 s")
    if not all(200 <= length <= 8000 for length in size):
        raise ValueError(f"size = {size} pixels; each must be 200 to 8000")
    if not source.is_file():
        raise FileNotFoundError(f"no recording {source}")
    if sys.platform.startswith("linux") and vulkan_driver() is None:
        raise PictureError(
            "no Vulkan driver on this machine, pictures cannot be drawn; on Debian and Ubuntu "
            "`apt install mesa-vulkan-drivers` brings one that needs no graphics card"
        )
    with _headless_viewer(source, size) as client:
        state = _wait(lambda: _loaded(client), LOAD_LIMIT, f"the viewer did not load {source}")
        client.set_time("sim_time", duration=time, play_state="paused")
        if view is None:
            wall_clock.sleep(NOTICE_TIME)
        image = _steady_image(client, None if view is None else _view_id(state, view))
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(image)
    return target


def free_port() -> int:
    """A port on 127.0.0.1 that nobody listens on."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


@contextmanager
def _headless_viewer(source: Path, size: tuple[int, int]) -> Iterator[ViewerClient]:
    """A headless viewer that shows the recording, stopped at the end."""
    port = free_port()
    command = [
        str(viewer_program()), "--headless", "--bind", "127.0.0.1", "--port", str(port),
        "--window-size", f"{size[0]}x{size[1]}", "--hide-welcome-screen", str(source),
    ]  # fmt: skip
    with tempfile.TemporaryFile() as messages:
        # CI: the viewer then sends no usage statistics
        environment = {**os.environ, "RERUN_APP_ONLY": "true", "CI": "true"}
        viewer = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=messages, stderr=messages, env=environment
        )

        def connected() -> ViewerClient | None:
            if viewer.poll() is not None:
                messages.seek(0)
                text = messages.read().decode(errors="replace").strip()
                raise PictureError(
                    f"the rerun viewer stopped with status {viewer.returncode}: {text[-2000:]}"
                )
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) != 0:
                    return None
            try:
                client = ViewerClient.connect(f"rerun+http://127.0.0.1:{port}/proxy")
                client.get_state()
            except Exception:  # the bindings raise various exceptions until the viewer answers
                return None
            return client

        try:
            yield _wait(connected, START_LIMIT, "the rerun viewer did not answer")
        finally:
            viewer.terminate()
            try:
                viewer.wait(timeout=10.0)
            except subprocess.TimeoutExpired:
                viewer.kill()
                viewer.wait()


def _wait(ready: Callable[[], T | None], limit: float, failure: str) -> T:
    """The first answer of `ready` that is not None; PictureError after `limit` seconds."""
    end = wall_clock.monotonic() + limit
    while wall_clock.monotonic() < end:
        answer = ready()
        if answer is not None:
            return answer
        wall_clock.sleep(0.2)
    raise PictureError(f"{failure} within {limit:g} s")


def _loaded(client: ViewerClient) -> ViewerState | None:
    """The viewer's state once the recording is loaded and nothing is pending; else None."""
    state = client.get_state()
    timelines = {line.name for recording in state.recordings for line in recording.timelines}
    return state if "sim_time" in timelines and state.views and not state.loading else None


def _view_id(state: ViewerState, name: str) -> str:
    """The viewer's own name of a view."""
    for view in state.views:
        if view.name == name and view.visible:
            return view.view_id
    shown = sorted(view.name for view in state.views if view.visible)
    raise ValueError(f"no view {name!r} is shown; shown are {', '.join(shown)}")


def _steady_image(client: ViewerClient, view_id: str | None) -> bytes:
    """The first picture that equals the one before it: everything has been drawn."""
    last: list[bytes] = []

    def steady() -> bytes | None:
        image = client.take_screenshot(view_id)
        if last and image == last[-1]:
            return image
        last[:] = [image]
        return None

    return _wait(steady, STEADY_LIMIT, "the rerun viewer's picture did not come to rest")
