"""Malformed run folders: logs and status that no run writes are refused by every command that reads them."""

import json
from collections.abc import Callable
from importlib import resources
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
from malformed import check_refused
from rolling_run import rolling_run

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
Fault = Callable[[Path], None]


@pytest.fixture
def run(tmp_path: Path) -> Path:
    return rolling_run(tmp_path / "run", DEMO)


def part_of(run: Path) -> Path:
    return next((run / "contact").glob("part-*.parquet"))


def value(name: str, wrong: float, row: int = 600) -> Fault:
    def fault(run: Path) -> None:
        table = pyarrow.parquet.read_table(part_of(run))
        column = table[name].to_numpy().copy()
        column[row] = wrong
        table = table.set_column(table.column_names.index(name), name, pyarrow.array(column))
        pyarrow.parquet.write_table(table, part_of(run))

    return fault


def taken(*pieces: slice) -> Fault:
    def fault(run: Path) -> None:
        table = pyarrow.parquet.read_table(part_of(run))
        parts = [table.slice(piece.start, piece.stop - piece.start) for piece in pieces]
        pyarrow.parquet.write_table(pyarrow.concat_tables(parts), part_of(run))

    return fault


def text(name: str, content: str) -> Fault:
    return lambda run: (run / name).write_text(content) and None


def ended(reason: str) -> Fault:
    return text("status.json", json.dumps({"finished": False, "reason": reason}))


def dropped(name: str) -> Fault:
    def fault(run: Path) -> None:
        table = pyarrow.parquet.read_table(part_of(run)).drop_columns([name])
        pyarrow.parquet.write_table(table, part_of(run))

    return fault


def twice(name: str) -> Fault:
    def fault(run: Path) -> None:
        table = pyarrow.parquet.read_table(part_of(run))
        table = table.append_column(name, table[name])
        pyarrow.parquet.write_table(table, part_of(run))

    return fault


DAMAGE: dict[str, tuple[Fault, str]] = {
    "creepage": (value("nu_x", 1e6), "nu_x = 1e+06 - at time = 1.2 s must lie within -20..20 -"),
    "speed": (value("speed", 1e9), "speed = 1e+09 m/s at time = 1.2 s must be <= 200 m/s"),
    "friction": (value("friction", 50.0), "friction = 50 - at time = 1.2 s must be <= 2 -"),
    "wheelset 99": (value("wheelset", 99), "wheelset = 99 - at time = 1.2 s must be a whole number"),
    "wheelset 9": (value("wheelset", 9), "vehicle 1, wheelset 9: the run has vehicles of 4 wheelsets"),
    "vehicle": (value("vehicle", 2), "vehicle 2, wheelset 1: the run has vehicles of 4 wheelsets"),
    "infinite time": (value("time", np.inf), "time is NaN or infinite (1 such rows)"),
    "side": (value("side", 0), "side = 0 - at time = 1.2 s must be +1 (left) or -1 (right)"),
    "NaN": (value("phi", np.nan), "phi is NaN or infinite (1 such rows)"),
    "infinite": (value("a", np.inf), "a is NaN or infinite (1 such rows)"),
    "negative": (value("normal_force", -1e3), "normal_force = -1000 N at time = 1.2 s must be >= 0 N"),
    "force": (value("force_x", 1e6), "must not exceed friction times normal force"),
    "angle": (value("contact_angle", 2.0), "contact_angle = 2 rad"),
    "one row twice": (taken(slice(0, 500), slice(499, 1000)), "1 of 1001 rows are bad"),
    "all rows twice": (taken(slice(0, 1000), slice(0, 1000)), "1000 of 2000 rows are bad"),
    "equal times": (value("time", 0.0, row=2), "has another row at time = 0 s"),
    "gap": (
        taken(slice(0, 400), slice(600, 1000)),
        "rows are missing: no rows between time = 0.796 and 1.2 s",
    ),
    "no column": (dropped("phi"), "has no column phi"),
    "column twice": (twice("phi"), "has the column phi more than once"),
    "not Parquet": (lambda run: part_of(run).write_text("nothing") and None, "arquet"),
    "empty part": (lambda run: part_of(run).write_text("") and None, "arquet"),
    "case": (
        text("case.toml", DEMO.replace("60.0", "600.0")),
        "speed_km_h = 600 km/h: allowed 5 to 130 km/h",
    ),
    "case text": (text("case.toml", "name"), "not valid TOML"),
    "interrupted": (ended("interrupted"), "the run is not finished: interrupted; --unfinished takes"),
    "derailed": (
        ended("derailment: no contact for 0.1 s"),
        "is not finished: derailment: no contact for 0.1 s",
    ),
    "running": (ended("running"), "is not finished: cut off while it ran, or still running"),
    "status": (text("status.json", "{"), "status"),
    "status list": (text("status.json", "[]"), "status"),
    "no status": (lambda run: (run / "status.json").unlink(), "is not finished: no status.json"),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_damage(run: Path, name: str) -> None:
    fault, part = DAMAGE[name]
    fault(run)
    check_refused(run.parent, ("damage", run, "--out", run.parent / "out", "--theory", "fastsim"), part)


ASSESS: dict[str, tuple[Fault, str]] = {
    "Q": (value("Q", np.nan), "Q = nan N at time = 1.2 s: allowed"),
    "Y": (value("Y", 1e9), "Y = 1e+09 N at time = 1.2 s: allowed"),
    "wheelset": (value("wheelset", 99), "wheelset = 99 at time = 1.2 s: allowed 1 to 64"),
    "one row twice": (taken(slice(0, 500), slice(499, 1000)), "1 rows are there twice"),
    "equal times": (value("time", 0.0, row=2), "1 rows are there twice"),
    "gap": (taken(slice(0, 400), slice(600, 1000)), "output interval is 4 to 404 ms, it must be constant"),
    "interrupted": (ended("interrupted"), "the run is not finished: interrupted"),
    "no motion log": (lambda run: None, "no straight or curve is long enough"),
}


@pytest.mark.parametrize("name", ASSESS)
def test_assess(run: Path, name: str) -> None:
    fault, part = ASSESS[name]
    fault(run)
    check_refused(run.parent, ("assess", run), part)


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (("assess", "RUN", "--section-length-m", "20"), "has no finished part of the log 'motion'"),
        (("playback", "RUN"), "has no finished part of the log 'motion'"),
        (("playback", "RUN", "--save", "RUN/case.toml"), "exists already"),
        (("damage", "RUN", "--out", "/proc/hh-exudyn"), "/proc/hh-exudyn: No such file or directory"),
        (("damage", "RUN", "--out", "RUN/case.toml/x"), "--out"),
    ],
)
def test_outputs_and_missing_logs(run: Path, words: tuple[str, ...], part: str) -> None:
    check_refused(run.parent, tuple(word.replace("RUN", str(run)) for word in words), part)
