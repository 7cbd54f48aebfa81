"""The log is read once: intervals found on the way are those of the whole log, however it is cut."""

from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pyarrow
import pytest

from damage.log_input import contact_states as module
from damage.log_input.bad_rows import BadRows
from damage.log_input.output_clock import OutOfOrder, output_clock, timed_states
from damage.log_input.states import UNITS, ContactStates, contact_states
from damage.report import assess
from hh_exudyn.log.channels import CONTACT

CELLS = (8, 8)


@pytest.fixture
def reads(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Rows read so far, one entry a pass through the source."""
    passes: list[int] = []
    batches = module.batches

    def counted(*arguments: object) -> object:
        passes.append(0)
        for batch in batches(*arguments):
            passes[-1] += batch.num_rows
            yield batch

    monkeypatch.setattr(module, "batches", counted)
    return passes


def with_column(log: pyarrow.Table, name: str, values: np.ndarray) -> pyarrow.Table:
    return log.set_column(log.column_names.index(name), name, pyarrow.array(values))


@pytest.mark.parametrize("skip", [False, True])
def test_a_log_in_order_of_time_is_read_once(random_log: pyarrow.Table, reads: list[int], skip: bool) -> None:
    assess(random_log, cells=CELLS, skip_bad_rows=skip)
    assert reads == [random_log.num_rows]


def test_bad_rows_are_counted_in_the_same_pass(random_log: pyarrow.Table, reads: list[int]) -> None:
    force = random_log["normal_force"].to_numpy().copy()
    force[[5, 180]] = -1.0
    with pytest.raises(ValueError, match=rf"2 of {random_log.num_rows} rows are bad"):
        assess(with_column(random_log, "normal_force", force), cells=CELLS)
    assert reads == [random_log.num_rows]


@pytest.mark.parametrize("rows", [1, 2, 7, 50, 1000])
@pytest.mark.parametrize("skip", [False, True])
def test_the_cut_does_not_change_an_interval(random_log: pyarrow.Table, rows: int, skip: bool) -> None:
    """Bit for bit, with rows that are skipped at the first time, at the last, and all of one time."""
    log = random_log
    if skip:
        time, force = log["time"].to_numpy(), log["normal_force"].to_numpy().copy()
        force[[0, -1]] = -1.0
        force[time == time[60]] = -1.0
        log = with_column(log, "normal_force", force)
    clock = output_clock(log, skip_bad_rows=skip)
    bad = [BadRows() if skip else None for _ in range(2)]
    pieces = list(timed_states(log, rows, bad[0]))
    known = list(timed_states(log, rows, bad[1], clock))
    assert str(bad[0]) == str(bad[1])
    assert len(pieces) == len(known)
    for one, other in zip(pieces, known, strict=True):
        np.testing.assert_array_equal(one.interval, other.interval)
        np.testing.assert_array_equal(one.sharing, other.sharing)
        np.testing.assert_array_equal(one.states, other.states)


def test_a_piece_waits_for_one_more_only(random_log: pyarrow.Table, reads: list[int]) -> None:
    """Constant memory: what is read lies at the most two pieces before what is passed on."""
    rows, passed = 20, 0
    for piece in timed_states(random_log, rows):
        passed += piece.interval.size
        assert reads[-1] - passed <= 2 * rows


def test_one_output_time(make_log: Callable[..., pyarrow.Table]) -> None:
    (piece,) = timed_states(make_log(side=np.array([1, -1])))
    np.testing.assert_array_equal(piece.interval, [1.0, 1.0])
    np.testing.assert_array_equal(piece.sharing, [2, 2])
    with pytest.raises(ValueError, match="the contact log has no rows"):
        list(timed_states(make_log(side=np.array([1, -1])).slice(0, 0)))


def test_a_log_in_another_order_gives_the_same(random_log: pyarrow.Table, reads: list[int]) -> None:
    """Sorted by wheel instead of time: read for its times first, the sums are equal to rounding."""
    by_wheel = random_log.sort_by([("wheelset", "ascending"), ("side", "ascending")])
    with pytest.raises(OutOfOrder):
        list(timed_states(by_wheel))
    reads.clear()
    one, other = (assess(log, cells=CELLS, skip_bad_rows=True) for log in (random_log, by_wheel))
    assert len(reads) == 4
    assert other.bad_rows.total == random_log.num_rows
    for field in fields(one.surface):
        left, right = getattr(one.surface, field.name), getattr(other.surface, field.name)
        if isinstance(left, np.ndarray):
            np.testing.assert_allclose(right, left, rtol=1e-11, atol=1e-13 * np.abs(left).max())


def test_damage_takes_the_columns_of_the_channel_table_by_name(random_log: pyarrow.Table) -> None:
    """Numbers all of them; and a table of the log is the record, the columns not asked for NaN."""
    kinds = {column.name: column.kind for column in CONTACT}
    assert all(kinds[name] in ("float64", "int32") for name in ContactStates._fields)
    assert UNITS["p_max"] == "Pa"
    states = contact_states(random_log, ("a", "phi"))
    np.testing.assert_array_equal(states.phi, random_log["phi"].to_numpy())
    assert np.isnan(states.b).all()
