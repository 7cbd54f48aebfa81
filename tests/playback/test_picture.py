"""Headless pictures: a real one where a Vulkan driver is there, and clear errors where something lacks."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hh_exudyn.playback import picture
from hh_exudyn.playback.run import record_tables
from hh_exudyn.playback.viewer import open_viewer

needs_driver = pytest.mark.skipif(
    picture.vulkan_driver() is None, reason="no Vulkan driver (Debian: apt install mesa-vulkan-drivers)"
)


@pytest.fixture(scope="module")
def recording(synthetic_run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Path:
    run = synthetic_run(seconds=2.0, rate=50.0)
    return record_tables(run.motion, run.contact, run.scene, tmp_path_factory.mktemp("picture") / "run.rrd")


def pixels(path: Path) -> np.ndarray:
    """The picture as (height, width, 3) numbers 0..255."""
    from matplotlib.image import imread

    return np.round(imread(io.BytesIO(path.read_bytes()))[..., :3] * 255)


@needs_driver
def test_picture_shows_a_wagon_that_moves(recording: Path, tmp_path: Path) -> None:
    """Sky above, ore in the middle, and another picture at another time."""
    first = pixels(picture.take(recording, tmp_path / "a.png", 0.1, size=(900, 600), view="Vehicle"))
    later = pixels(picture.take(recording, tmp_path / "b.png", 1.9, size=(900, 600), view="Vehicle"))
    assert first.shape == later.shape and first.shape[0] > 200
    red, green, blue = (first[..., i] for i in range(3))
    assert np.mean((blue > red) & (blue > 180)) > 0.10  # sky
    assert np.mean((red > 1.3 * green) & (red > 60)) > 0.005  # ore, rust
    assert np.mean(np.abs(first - later).max(axis=-1) > 10) > 0.005  # sleepers and curve have moved


@needs_driver
def test_unknown_view_is_named(recording: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"no view 'Nothing'.*Vehicle"):
        picture.take(recording, tmp_path / "a.png", 0.1, size=(400, 300), view="Nothing")


def test_missing_driver_is_said(recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "vulkan_driver", lambda: None)
    monkeypatch.setattr(picture.sys, "platform", "linux")
    with pytest.raises(picture.PictureError, match="mesa-vulkan-drivers"):
        picture.take(recording, tmp_path / "a.png", 0.1)


def test_missing_viewer_is_said(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(picture.rerun_cli, "__file__", str(tmp_path / "__init__.py"))
    with pytest.raises(picture.PictureError, match="viewer is missing"):
        picture.viewer_program()


def test_driver_named_by_the_environment(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    manifest = tmp_path / "driver.json"
    manifest.write_text("{}")
    monkeypatch.setattr(picture, "_DRIVER_FOLDERS", ())
    monkeypatch.delenv("VK_ICD_FILENAMES", raising=False)
    monkeypatch.setenv("VK_DRIVER_FILES", str(manifest))
    assert picture.vulkan_driver() == manifest
    monkeypatch.delenv("VK_DRIVER_FILES")
    assert picture.vulkan_driver() is None


def test_bad_input_is_named(recording: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="time"):
        picture.take(recording, tmp_path / "a.png", -1.0)
    with pytest.raises(ValueError, match="size"):
        picture.take(recording, tmp_path / "a.png", 0.0, size=(10, 10))
    with pytest.raises(FileNotFoundError):
        picture.take(tmp_path / "nothing.rrd", tmp_path / "a.png", 0.0)
    with pytest.raises(FileNotFoundError):
        open_viewer(tmp_path / "nothing.rrd")
