"""Contact logs from anywhere, and rows in them that no contact can have."""

from dataclasses import fields
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

from damage.log_input.bad_rows import BadRows
from damage.log_input.contact_states import DAMAGE_COLUMNS, contact_chunks
from damage.report import DamageReport, assess
from damage.surface.wheel_surface import WheelSurface

CELLS = (6, 6)


def changed(log: pyarrow.Table, **columns: np.ndarray) -> pyarrow.Table:
    for name, values in columns.items():
        log = log.set_column(log.column_names.index(name), name, pyarrow.array(values))
    return log


def with_bad_rows(log: pyarrow.Table) -> tuple[pyarrow.Table, np.ndarray]:
    """The log with 5 bad rows, two faults in one of them; and which rows are good."""
    phi, force, radius = (log[name].to_numpy().copy() for name in ("phi", "force_y", "rolling_radius"))
    phi[[50, 51]] = np.nan
    force[[51, 90]] = 1.02 * log["friction"].to_numpy()[[51, 90]] * log["normal_force"].to_numpy()[[51, 90]]
    radius[[100, 101]] = 0.0
    force_x = log["force_x"].to_numpy().copy()
    force_x[[51, 90]] = 0.0
    good = np.ones(log.num_rows, dtype=bool)
    good[[50, 51, 90, 100, 101]] = False
    return changed(log, phi=phi, force_x=force_x, force_y=force, rolling_radius=radius), good


def test_bad_rows_are_refused_and_said(random_log: pyarrow.Table) -> None:
    bad, _ = with_bad_rows(random_log)
    times = random_log["time"].to_numpy()
    with pytest.raises(ValueError, match="5 of 186 rows are bad") as caught:
        assess(bad, cells=CELLS)
    message = str(caught.value)
    shown = ", ".join(f"{time:.6g}" for time in np.unique(times[[50, 51, 90, 100, 101]])[:3])
    assert f"the first at time = {shown} s" in message
    assert "phi is NaN or infinite (2 such rows)" in message
    assert "rolling_radius = 0 m at time" in message
    assert "must not exceed friction times normal force" in message


def test_skipped_rows_are_counted_and_the_rest_is_summed(random_log: pyarrow.Table) -> None:
    bad, good = with_bad_rows(random_log)
    report = assess(bad, cells=CELLS, skip_bad_rows=True)
    assert (report.bad_rows.count, report.bad_rows.total) == (5, 186)
    assert report.surface.rows == 181
    found = {row["fault"]: row["rows"] for row in report.bad_rows.to_table().to_pylist()}
    assert found == {"phi not finite": 2, "force above friction": 2, "rolling_radius out of range": 2}
    alone = assess(random_log.filter(good), cells=CELLS)
    assert alone.bad_rows.count == 0
    for field in fields(WheelSurface):
        one, other = getattr(report.surface, field.name), getattr(alone.surface, field.name)
        if isinstance(one, np.ndarray):
            np.testing.assert_array_equal(one, other, err_msg=field.name)
    assert report.surface.distance == pytest.approx(alone.surface.distance)


def test_an_output_time_without_good_rows_is_lost_not_given_to_the_next(random_log: pyarrow.Table) -> None:
    times = random_log["time"].to_numpy()
    lost = times == np.unique(times)[20]
    phi = random_log["phi"].to_numpy().copy()
    phi[lost] = np.nan
    time = times.copy()
    time[np.flatnonzero(lost)[0]] = np.nan
    surface = assess(changed(random_log, phi=phi, time=time), cells=CELLS, skip_bad_rows=True).surface
    assert surface.time == pytest.approx(39 * 0.01)  # 40 output times of 10 ms


def test_forces_within_the_tolerance_are_good(random_log: pyarrow.Table) -> None:
    force = 1.009 * random_log["friction"].to_numpy() * random_log["normal_force"].to_numpy()
    log = changed(random_log, force_x=force, force_y=np.zeros_like(force))
    assert sum(chunk["time"].size for chunk in contact_chunks(log)) == log.num_rows


def test_nothing_but_bad_rows(random_log: pyarrow.Table) -> None:
    nothing = changed(random_log, phi=np.full(random_log.num_rows, np.nan))
    with pytest.raises(ValueError, match="no good rows: 186 of 186"):
        assess(nothing, cells=CELLS, skip_bad_rows=True)


def test_tally_over_chunks(random_log: pyarrow.Table) -> None:
    bad, good = with_bad_rows(random_log)
    whole, pieces = BadRows(), BadRows()
    list(contact_chunks(bad, bad_rows=whole))
    rows = sum(chunk["time"].size for chunk in contact_chunks(bad, rows=7, bad_rows=pieces))
    assert rows == good.sum()
    assert str(whole) == str(pieces)


@pytest.fixture(scope="module")
def report(random_log: pyarrow.Table) -> DamageReport:
    return assess(random_log, cells=CELLS)


def test_arrays_files_and_folders_of_files(
    tmp_path: Path, random_log: pyarrow.Table, report: DamageReport
) -> None:
    arrays = {name: random_log[name].to_numpy() for name in DAMAGE_COLUMNS}
    (tmp_path / "set" / "b").mkdir(parents=True)
    pyarrow.parquet.write_table(random_log.slice(0, 60), tmp_path / "set" / "a.parquet")
    pyarrow.parquet.write_table(random_log.slice(60), tmp_path / "set" / "b" / "c.parquet")
    pyarrow.parquet.write_table(random_log, tmp_path / "one.parquet")
    for source in (arrays, tmp_path / "set", str(tmp_path / "one.parquet")):
        surface = assess(source, cells=CELLS).surface
        np.testing.assert_allclose(surface.depth, report.surface.depth, rtol=1e-11)
        np.testing.assert_allclose(surface.rcf_number, report.surface.rcf_number, rtol=1e-11, atol=1e-15)


def test_sources_that_are_none(tmp_path: Path, random_log: pyarrow.Table) -> None:
    with pytest.raises(ValueError, match=r"equally long; they have time 2, s 3 rows"):
        assess({"time": np.zeros(2), "s": np.zeros(3)})
    with pytest.raises(FileNotFoundError, match="is not a directory"):
        assess(tmp_path / "none")
    pyarrow.parquet.write_table(random_log.drop_columns(["phi"]), tmp_path / "one.parquet")
    with pytest.raises(ValueError, match=r"one.parquet has no column phi; damage needs time"):
        assess(tmp_path / "one.parquet")
    (tmp_path / "text.parquet").write_text("no such thing")
    with pytest.raises(ValueError, match=r"text.parquet cannot be read as Parquet"):
        assess(tmp_path / "text.parquet")


def test_distance_table(report: DamageReport) -> None:
    near, far = (report.distance_table(distance).to_pylist() for distance in (1e6, 1e8))
    for one, other in zip(near, far, strict=True):
        for name in ("wear_depth_mm", "worn_area_mm2", "rcf_number", "crack_damage", "flange_crack_damage"):
            assert other[name] == pytest.approx(100.0 * one[name])
    wheel = report.to_table().to_pylist()[1]
    assert near[1]["wear_depth_mm"] == pytest.approx(wheel["wear_depth_mm_per_1000_km"])
    with pytest.raises(ValueError, match="distance = 0"):
        report.distance_table(0.0)
