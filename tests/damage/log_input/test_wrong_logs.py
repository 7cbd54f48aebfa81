"""Contact logs that are wrong without a NaN: values of no contact, rows twice, missing and equal times."""

import numpy as np
import pyarrow
import pytest

from damage.report import assess

CELLS = (6, 6)
ROW = 50  # of the 186 rows of `random_log`
FAULTS = {  # column, value in one row, and what is said
    "creepage": ("nu_x", 1e6, "nu_x = 1e+06 - at time = 0.1 s must lie within -20..20 -"),
    "lateral creepage": ("nu_y", -1e6, "nu_y = -1e+06"),
    "spin": ("phi", 1e5, "phi = 100000 1/m"),
    "speed": ("speed", 1e9, "speed = 1e+09 m/s at time = 0.1 s must be <= 200 m/s"),
    "friction": ("friction", 50.0, "friction = 50 - at time = 0.1 s must be <= 2 -"),
    "wheelset": ("wheelset", 99, "wheelset = 99 - at time = 0.1 s must be a whole number from 1 to 64"),
    "wheelset from 0": ("wheelset", 0, "wheelset = 0"),
    "vehicle": ("vehicle", -1, "vehicle = -1"),
    "force": ("normal_force", 1e9, "normal_force = 1e+09 N"),
    "pressure": ("p_max", 1e15, "p_max = 1e+15 Pa"),
    "semi-axis": ("a", 6.0, "a = 6 m at time = 0.1 s must be <= 0.2 m"),
    "radius of nothing": (
        "rolling_radius",
        1e-300,
        "rolling_radius = 1e-300 m at time = 0.1 s must be >= 0.05 m",
    ),
    "radius in mm": ("rolling_radius", 460.0, "rolling_radius = 460 m"),
    "place in mm": ("y_wheel", 12.0, "y_wheel = 12 m"),
}


def changed(log: pyarrow.Table, name: str, values: np.ndarray) -> pyarrow.Table:
    return log.set_column(log.column_names.index(name), name, pyarrow.array(values))


@pytest.mark.parametrize("fault", FAULTS)
def test_a_value_of_no_contact_is_refused_or_left_out(random_log: pyarrow.Table, fault: str) -> None:
    name, value, part = FAULTS[fault]
    values = random_log[name].to_numpy().copy()
    values[ROW] = value
    log = changed(random_log, name, values)
    with pytest.raises(ValueError, match="1 of 186 rows are bad") as caught:
        assess(log, cells=CELLS)
    assert part in str(caught.value)
    left = assess(log, cells=CELLS, skip_bad_rows=True)
    assert (left.bad_rows.count, left.surface.rows) == (1, 185)
    others = random_log.filter(pyarrow.array(np.arange(186) != ROW))
    np.testing.assert_array_equal(left.surface.depth, assess(others, cells=CELLS).surface.depth)


@pytest.mark.parametrize("rows", [slice(50, 51), slice(0, 186), slice(100, 140)])
@pytest.mark.parametrize("sort", [True, False])
def test_rows_twice(random_log: pyarrow.Table, rows: slice, sort: bool) -> None:
    """Side by side in order of time, or the whole part once more behind: the wear would be more."""
    part = random_log.slice(rows.start, rows.stop - rows.start)
    log = pyarrow.concat_tables([random_log, part])
    if sort:
        log = log.take(np.argsort(log["time"].to_numpy(), kind="stable"))
    with pytest.raises(ValueError, match=f"{part.num_rows} of {log.num_rows} rows are bad") as caught:
        assess(log, cells=CELLS)
    assert "has another row at time = " in str(caught.value)
    left, whole = assess(log, cells=CELLS, skip_bad_rows=True), assess(random_log, cells=CELLS)
    np.testing.assert_allclose(left.surface.depth, whole.surface.depth, rtol=1e-12)


def test_equal_times(random_log: pyarrow.Table) -> None:
    """Output times 20 and 21 are the same: every wheel has two rows there."""
    time = random_log["time"].to_numpy().copy()
    times = np.unique(time)
    time[time == times[21]] = times[20]
    with pytest.raises(ValueError, match=r"has another row at time = 0\.2 s"):
        assess(changed(random_log, "time", time), cells=CELLS)
    with pytest.raises(ValueError, match="has another row at time = 0 s"):
        assess(changed(random_log, "time", np.zeros(186)), cells=CELLS)


@pytest.mark.parametrize("sort", [True, False])
def test_a_gap_in_time(random_log: pyarrow.Table, sort: bool) -> None:
    """Ten of 40 output times are missing: the row behind them would wear the wheel eleven times."""
    time = random_log["time"].to_numpy()
    log = random_log.filter(pyarrow.array((time < 0.145) | (time > 0.245)))
    if not sort:
        log = log.take(np.arange(log.num_rows)[::-1])
    with pytest.raises(
        ValueError, match=r"no rows between time = 0.14 and 0.25 s, .* 0.01 s apart"
    ) as caught:
        assess(log, cells=CELLS)
    assert "(1 such gap)" in str(caught.value)
    left = assess(log, cells=CELLS, skip_bad_rows=True).surface
    assert left.time == pytest.approx(30 * 0.01)  # with the gap it would be 0.4 s


def test_a_log_of_few_or_unequal_times_has_no_gaps(random_log: pyarrow.Table) -> None:
    time = random_log["time"].to_numpy()
    few = random_log.filter(pyarrow.array((time < 0.045) | (time > 0.345)))
    few = few.filter(pyarrow.array(few["time"].to_numpy() < 0.385))
    assert assess(few, cells=CELLS).surface.time == pytest.approx(0.39)
    unequal = assess(changed(random_log, "time", time**2), cells=CELLS).surface
    assert unequal.time == pytest.approx(0.39**2 + 0.01**2)
