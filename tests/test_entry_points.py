"""Vehicles and lines of another package: a tiny one, installed by hand, is found by name everywhere."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

WAGON = """
from functools import partial

from hh_exudyn.sourced import load_parameters
from vehicles.catalogue import vehicle
from vehicles.description import Body
from vehicles.record import VehicleRecord
from dataclasses import replace


def build(name, p):
    wagon = vehicle("iore_wagon_empty")
    first = replace(wagon.bodies[0], mass=p["body.mass"])
    return replace(wagon, name=name, bodies=(first, *wagon.bodies[1:]))


RECORD = VehicleRecord("tiny_wagon", build, partial(load_parameters, "tiny", "tiny_wagon"), "a tiny wagon")
"""
LINES = """
from pathlib import Path

from track.line.line_file import LineRecord

QUARRY = LineRecord("tiny_quarry", Path(__file__).with_name("data") / "quarry.toml", "a quarry")
"""
ENTRIES = """[hh_exudyn.vehicles]
tiny_wagon = tiny.wagon:RECORD
broken_wagon = tiny.nowhere:RECORD
wrong_wagon = tiny.lines:QUARRY

[hh_exudyn.lines]
tiny_quarry = tiny.lines:QUARRY
"""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder for sys.path with the package and its metadata, as pip would leave them."""
    folder = tmp_path_factory.mktemp("site")
    package, metadata = folder / "tiny", folder / "tiny-1.0.dist-info"
    (package / "data").mkdir(parents=True)
    metadata.mkdir()
    (package / "__init__.py").write_text("")
    (package / "wagon.py").write_text(WAGON)
    (package / "lines.py").write_text(LINES)
    (package / "data" / "tiny_wagon.toml").write_text(
        '[body]\nmass = { value = 9876.0, unit = "kg", source = "assumed: tiny" }\n'
    )
    (package / "data" / "quarry.toml").write_text(
        (ROOT / "tests" / "track" / "line" / "quarry_line.toml").read_text()
    )
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: tiny\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text(ENTRIES)
    return folder


def run(site: Path, *words: str) -> str:
    """Output of python with these words, the package on its path."""
    path = os.pathsep.join((str(site), str(ROOT)))
    done = subprocess.run(
        [sys.executable, *words],
        env={**os.environ, "PYTHONPATH": path, "COLUMNS": "120"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_by_name(site: Path) -> None:
    """The vehicle, a case and a variant with it, the line; what cannot be imported says whose it is."""
    script = """
from hh_exudyn.case.vehicle import described
from track.line.line import line_names, read_line
from track.line.line_numbers import line_numbers
from vehicles.catalogue import vehicle, vehicle_names
from vehicles.variants import variant_of_table

assert vehicle("tiny_wagon").bodies[0].mass == 9876.0
assert described("tiny_wagon").name == "tiny_wagon"
heavy = variant_of_table({"name": "heavy", "base": "tiny_wagon", "body": {"mass": 1e4}}, "test")
assert heavy.vehicle().bodies[0].mass == 1e4
assert "tiny_wagon" in vehicle_names() and line_names() == ("malmbanan", "tiny_quarry")
assert read_line("tiny_quarry").length == 12e3
assert line_numbers("tiny_quarry")[0].value == 12.0
for name in ("broken_wagon", "wrong_wagon", "tinny_wagon"):
    try:
        vehicle(name)
    except ValueError as error:
        print(error)
"""
    broken, wrong, unknown = run(site, "-c", script).splitlines()
    assert "broken_wagon = tiny.nowhere:RECORD of tiny cannot be imported: ModuleNotFoundError" in broken
    assert "wrong_wagon = tiny.lines:QUARRY of tiny is a LineRecord, allowed is a VehicleRecord" in wrong
    assert 'did you mean "tiny_wagon"?' in unknown


def test_commands(site: Path) -> None:
    entries = site / "tiny-1.0.dist-info" / "entry_points.txt"
    entries.write_text("".join(line for line in ENTRIES.splitlines(True) if "tiny.nowhere" not in line
                               and not line.startswith("wrong")))  # fmt: skip
    listed = run(site, "-m", "hh_exudyn", "vehicle", "list")
    assert "tiny_wagon" in listed
    assert "a tiny wagon" in listed
    shown = run(site, "-m", "hh_exudyn", "parameters", "vehicle", "--assumed")
    assert "9876" in shown
    entries.write_text(ENTRIES)
