"""Exudyn's own window on a run: without a screen one error, with one the bodies are where they are."""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from two_axle_wagon import two_axle_wagon

from hh_exudyn.case import Case, StraightCase, TrackCase
from hh_exudyn.multibody import build
from hh_exudyn.multibody.viewer import NoScreen, Viewer, require_screen

TRACK = TrackCase(sections=(StraightCase(length_m=30),))
CASE = Case(name="looked at", speed_km_h=60, friction=0.35, track=TRACK)

LOOK = """
import numpy as np, sys
from pathlib import Path
from two_axle_wagon import two_axle_wagon
from test_viewer import CASE
from hh_exudyn.multibody.simulate import simulate
from hh_exudyn.multibody.viewer import Viewer

viewer, pictures = Viewer(CASE), []

def look(fraction, text):
    if fraction > 0.0 and not pictures:
        pictures.append(viewer.picture())

simulate(CASE, Path(sys.argv[1]) / "shown", look, vehicle=two_axle_wagon(), viewer=viewer)
simulate(CASE, Path(sys.argv[1]) / "plain", vehicle=two_axle_wagon())
np.save(Path(sys.argv[1]) / "picture.npy", pictures[0])
"""


@pytest.fixture
def no_screen(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def screen() -> Iterator[str]:
    """A virtual screen of its own."""
    if shutil.which("Xvfb") is None:
        pytest.skip("Xvfb is not installed")
    name = f":{200 + os.getpid() % 700}"
    server = subprocess.Popen(["Xvfb", name, "-screen", "0", "1100x850x24"], stderr=subprocess.DEVNULL)
    try:
        for _ in range(100):
            if os.path.exists(f"/tmp/.X11-unix/X{name[1:]}"):
                break
            time.sleep(0.1)
        yield name
    finally:
        server.terminate()
        server.wait()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems always have a screen")
def test_without_a_screen_there_is_one_error(no_screen: None) -> None:
    with pytest.raises(NoScreen, match="needs a screen, and neither DISPLAY nor WAYLAND_DISPLAY is set"):
        require_screen()
    with pytest.raises(NoScreen):
        Viewer(CASE)


def test_shapes_stand_where_the_bodies_stand(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the renderer would draw, without a window: the car body's box, wheels that touch the rails."""
    monkeypatch.setattr("hh_exudyn.multibody.viewer.require_screen", lambda: None)
    system = build(CASE, vehicle=two_axle_wagon())
    Viewer(CASE).dress(system)
    system.mbs.Assemble()
    drawn = system.container.renderer.GetGraphicsData(flatShapes=True)
    places, items = drawn["triangles"]["points"], drawn["triangles"]["items"][:, 2]
    places = places.reshape(len(items), -1, 3)
    for name, number in system.objects.items():
        own = places[items == number].reshape(-1, 3)
        middle = (own.min(axis=0) + own.max(axis=0)) / 2
        centre = system.place(system.vehicle.body(name).position)
        assert middle[0] == pytest.approx(centre[0], abs=0.02), name
        assert middle[1] == pytest.approx(0.0, abs=0.02), name
        if name != "body":
            assert own[:, 2].min() == pytest.approx(0.0, abs=5e-3)
            assert np.ptp(own[:, 2]) == pytest.approx(2 * system.vehicle.wheelsets[0].radius, rel=0.02)
    rails = drawn["lines"]["points"].reshape(-1, 3)
    assert rails[:, 0].min() == pytest.approx(0.0)
    assert rails[:, 0].max() == pytest.approx(30.0)
    assert np.abs(rails[:, 1]) == pytest.approx(0.7535, abs=0.02)


@pytest.mark.slow
def test_the_window_shows_the_run_and_changes_nothing(screen: str, tmp_path) -> None:
    """Brown car body and grey wheels in the picture; both runs have the same logs."""
    from hh_exudyn.log.store import open_run

    env = {
        **os.environ,
        "DISPLAY": screen,
        "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path]),
    }
    subprocess.run([sys.executable, "-c", LOOK, str(tmp_path)], env=env, check=True, timeout=500)
    shown, plain = (open_run(tmp_path / name) for name in ("shown", "plain"))
    for name in ("contact", "motion", "energy"):
        assert shown.read(name).equals(plain.read(name)), name
    picture = np.load(tmp_path / "picture.npy").astype(int)
    red, green, blue = picture[..., 0], picture[..., 1], picture[..., 2]
    brown = (red > green + 40) & (red > blue + 40)
    dark_grey = (red < 140) & (abs(red - green) < 20) & (abs(blue - green) < 25) & (red > 20)
    assert 0.02 < brown.mean() < 0.6
    assert 0.001 < dark_grey.mean() < 0.3
    middle = np.argwhere(brown).mean(axis=0) / brown.shape  # the camera follows the heaviest body
    assert middle == pytest.approx([0.5, 0.5], abs=0.2)
