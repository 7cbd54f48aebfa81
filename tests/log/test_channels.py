"""The channel table against the kernels' records, and what a new channel takes: a row and a line."""

import os
import shutil
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from hh_exudyn.contact.state import ContactState, Patch
from hh_exudyn.log.channels import CONTACT, ENERGY, LEDGER, LOGS, PATCH, ContactColumn, positions
from hh_exudyn.multibody.model import Ledger

ROOT = Path(__file__).resolve().parents[2]
NOT_LOGGED = {
    "POWER",
    "FLOORED",
}  # summed over the wheels instead, in the energy ledger and the run's warnings


def test_patch_channels_are_the_kernels_record() -> None:
    """Every column of the record is copied into the log under its own name, but two that are summed."""
    copied = {column.name.upper() for column in CONTACT if column.source == PATCH}
    assert copied == {column.name for column in Patch} - NOT_LOGGED


def test_ledger_channels_are_the_ledger() -> None:
    assert {column.name.upper() for column in ENERGY if column.source == LEDGER} == {
        power.name for power in Ledger
    }


def test_contact_state_is_a_row_of_the_log() -> None:
    names = [column.name for column in CONTACT]
    assert {field.name for field in fields(ContactState)} == set(names) - {
        "time", "vehicle", "bogie", "wheelset", "patch", "yaw",
    }  # fmt: skip


@pytest.mark.parametrize("log", LOGS)
def test_names_are_unique_and_every_channel_has_unit_and_meaning(log: str) -> None:
    columns = LOGS[log]
    assert len({column.name for column in columns}) == len(columns)
    assert all(column.unit and column.meaning and column.source for column in columns)
    assert [member.name for member in positions("Some", columns)] == [column.name for column in columns]


def test_positions_are_those_of_the_table() -> None:
    assert CONTACT[ContactColumn.angle_of_attack].name == "angle_of_attack"


BEFORE_YAW = ("hh_exudyn/log/channels.py", '    Column("yaw"')
EDITS = {  # what a new channel takes: file, the text before which a line is put, the line
    "of a wheel": (
        (*BEFORE_YAW, '    Column("load_sum", WHEELSET, "N", "of both wheels"),'),
        (
            "hh_exudyn/multibody/recording.py",
            "            row[WheelColumn.yaw] = yaw",
            "            row[WheelColumn.load_sum] = -work.rail_force[w, :, 1].sum()",
        ),
    ),
    "of a patch": (
        (*BEFORE_YAW, '    Column("slip", PATCH, "m/s", "along and across"),'),
        ("hh_exudyn/contact/state.py", "    FLOORED = 20", "    SLIP = 21"),
        (
            "hh_exudyn/contact/state.py",
            "    record[Patch.NORMAL_FORCE] =",
            "    record[Patch.SLIP] = math.hypot(slip.along, slip.across)",
        ),
    ),
}  # fmt: skip
RUN = """
import numpy as np
from hh_exudyn.case import Case
from importlib.resources import files
from hh_exudyn.log.channels import CONTACT
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.model import coordinates, workspace
from hh_exudyn.multibody.recording import LogWriter
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.wheelset import wheel_on_rail
from hh_exudyn.contact import wheelset, state
from vehicles.catalogue import vehicle

class Rows:
    def append_rows(self, log, rows):
        setattr(self, log, rows.copy())

states = []
make = wheelset.contact_state
def noted(record, **wheel):
    states.append((record.copy(), wheel))
    return make(record, **wheel)

wheelset.contact_state = noted
found = wheel_on_rail(
    wheel_profile("S1002"), rail_profile("60E1"), 1, lateral=1e-3, yaw=2e-3, roll=0.0, load=1e5, radius=0.46,
    speed=10.0, pitch_rate=10.0 / 0.46, friction=0.3, theory="linear",
)
record, wheel = states[-1]
case = Case.from_toml((files("hh_exudyn") / "data/demo.toml").read_text(encoding="utf-8"))
wagon = vehicle("iore_wagon_loaded")
model = assemble(wagon, case)
work, rows = workspace(model), Rows()
work.rotation[:] = np.eye(3)
work.rail_rotation[:] = np.eye(3)
work.frame_axle[:] = [0.0, 1.0, 0.0]
work.patches[:] = record
work.rail_force[:, :, 1] = -wheel["Q"]
LogWriter(wagon, model, work, rows).write(0.0, np.zeros(coordinates(model)))
print({column.name: float(value) for column, value in zip(CONTACT, rows.contact[0], strict=True)})
"""


@pytest.mark.slow
@pytest.mark.parametrize("kind", EDITS)
def test_a_new_channel_is_a_row_and_the_line_that_computes_it(tmp_path: Path, kind: str) -> None:
    """In a copy of the toolkit, run without compiling: two files are touched, the log holds the number."""
    for package in ("hh_exudyn", "vehicles", "track", "damage"):
        shutil.copytree(ROOT / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    assert len({file for file, _, _ in EDITS[kind]}) == 2
    for file, before, line in EDITS[kind]:
        text = (tmp_path / file).read_text(encoding="utf-8")
        assert text.count(before) == 1
        (tmp_path / file).write_text(text.replace(before, line + "\n" + before), encoding="utf-8")
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        capture_output=True,
        text=True,
        env=environment,
        cwd=tmp_path,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    row = eval(done.stdout.splitlines()[-1], {"nan": float("nan")})
    if kind == "of a wheel":
        assert row["load_sum"] == 2.0 * row["Q"] > 0.0
    else:
        slip = row["speed"] if row["speed"] else 10.0  # the work space stands, the wheel rolled at 10 m/s
        assert row["slip"] == pytest.approx(slip * (row["nu_x"] ** 2 + row["nu_y"] ** 2) ** 0.5, rel=1e-12)
        assert row["slip"] > 0.0
    assert row["yaw"] == 0.0  # what stands behind the new column is still in its place
