"""The summary of a run against means taken by hand from a few rows."""

import math
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

from damage.summary import stretch_summaries, wheelset_summary
from hh_exudyn.log.channels import CONTACT
from hh_exudyn.log.store import Run


def row(time: float, side: int, patch: int, **values: float) -> dict[str, float]:
    """A contact state of wheelset 1 that has Q/P = 0.05 and p far below shakedown unless given otherwise."""
    usual = {
        "vehicle": 1, "bogie": 1, "wheelset": 1, "normal_force": 1e5, "a": 7e-3, "b": 5e-3, "p_max": 1.2e9,
        "rolling_radius": 0.4575, "friction": 0.4, "speed": 15.0, "Q": 1e5, "force_x": 5e3,
    }  # fmt: skip
    here = {"time": time, "s": 10.0 * time, "side": side, "patch": patch}
    return {column.name: 0.0 for column in CONTACT} | usual | here | values


def write(folder: Path, rows: list[dict[str, float]]) -> Run:
    (folder / "contact").mkdir()
    types = {"float64": pyarrow.float64(), "int32": pyarrow.int32()}
    columns = {
        column.name: pyarrow.array([entry[column.name] for entry in rows]).cast(types[column.kind])
        for column in CONTACT
    }
    pyarrow.parquet.write_table(pyarrow.table(columns), folder / "contact" / "part-00000.parquet")
    return Run(folder)


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Ten output times; left wheel with two patches at the last two, right wheel in the air at the last."""
    rows = []
    for i in range(11):
        time = 0.1 * i
        Q, Y = 1e5 + 1e3 * i, 2e4 + 2e3 * i
        both = {"angle_of_attack": 1e-3 * i, "y_wheelset": 2e-3 * i}
        rows.append(row(time, 1, 0, Q=Q, Y=Y, nu_x=-0.001, **both))
        if i >= 9:
            strong = {"force_y": 4e4, "nu_y": -0.005, "p_max": 2e9, "a": 4e-3, "b": 2e-3}
            rows.append(row(time, 1, 1, Q=Q, Y=Y, nu_x=-0.001, **strong, **both))
        if i < 10:
            rows.append(row(time, -1, 0, Q=9e4, Y=-1e4, moment_z=3.0, phi=-2.0, **both))
    return write(tmp_path, rows)


def test_means_over_a_stretch(run: Run) -> None:
    """Times 0.8, 0.9, 1.0 s at 10 m/s, by hand; a log this coarse has its peaks as logged."""
    (summary,) = wheelset_summary(run, (7.9, 10.1))
    assert (summary.vehicle, summary.wheelset) == (1, 1)
    assert pytest.approx((109e3, 2 / 3 * 9e4)) == summary.Q  # the right wheel is off the rail at 1.0 s
    assert pytest.approx((38e3, -2 / 3 * 1e4)) == summary.Y
    assert summary.y_over_q == pytest.approx((38 / 109, -1 / 9))
    assert summary.angle_of_attack == pytest.approx(9e-3)
    assert summary.lateral == pytest.approx(18e-3)
    assert summary.p_max == pytest.approx(((1.2 + 2 + 2) / 3 * 1e9, 2 / 3 * 1.2e9))
    assert pytest.approx((110e3, 9e4)) == summary.Q_peak
    assert pytest.approx((108e3, 0.0)) == summary.Q_least
    assert pytest.approx((40e3, 0.0)) == summary.Y_peak
    assert summary.y_over_q_peak == pytest.approx((40 / 110, 0.0))
    first, second = 5e3 * 0.001, 5e3 * 0.001 + 4e4 * 0.005
    assert summary.wear_number == pytest.approx((first + 2 / 3 * second, 2 / 3 * 6.0))


def test_fatigue_share_counts_times_beyond_shakedown(run: Run) -> None:
    """Patch 1: Q/P = 0.403, 2 pi a b k/(3 P) = 0.050, so FI = 0.353; patch 0: 0.05 - 0.220 < 0."""
    (summary,) = wheelset_summary(run, (7.9, 10.1))
    assert summary.fatigue_share == pytest.approx((2 / 3, 0.0))


def test_wheel_without_load_has_no_ratio(tmp_path: Path) -> None:
    run = write(tmp_path, [row(0.0, 1, 0, Q=1e5)])
    (summary,) = wheelset_summary(run, (0.0, 10.0))
    assert math.isnan(summary.y_over_q[1])
    assert summary.Q[1] == 0.0


def test_wheelsets_are_listed_from_the_leading_end(tmp_path: Path) -> None:
    rows = [row(0.0, 1, 0, wheelset=w, Q=1e4 * w) for w in (3, 1, 4, 2)]
    summary = wheelset_summary(write(tmp_path, rows), (0.0, 0.0))
    assert [entry.wheelset for entry in summary] == [1, 2, 3, 4]
    np.testing.assert_allclose([entry.Q[0] for entry in summary], [1e4, 2e4, 3e4, 4e4])


def test_every_wheelset_counts_while_it_is_there_itself(tmp_path: Path) -> None:
    """The second one comes 5 m behind: it alone is on the first stretch, and nobody on the last one."""
    rows = []
    for i in range(11):
        rows += [row(0.1 * i, 1, 0, Q=1e3 * i)]
        rows += [row(0.1 * i, 1, 0, wheelset=2, s=1.0 * i - 5.0, Q=2e3 * i)]
    first, second, nobody = stretch_summaries(
        write(tmp_path, rows), [(-5.0, -1.0), (6.0, 10.0), (50.0, 60.0)]
    )
    assert [(one.wheelset, one.Q[0]) for one in first] == [(2, pytest.approx(4e3))]
    assert [(one.wheelset, one.Q[0]) for one in second] == [(1, pytest.approx(8e3))]
    assert nobody == []


def test_peaks_of_a_fine_log_are_below_20_hz(tmp_path: Path) -> None:
    """40 Hz of 50 kN on 100 kN leaves 1 / (1 + 0.414 2^8) of it, about 0.5 kN, with the bilinear tangents."""
    rows = [
        row(0.002 * i, 1, 0, Q=100e3 + 50e3 * math.sin(2 * math.pi * 40.0 * 0.002 * i)) for i in range(1001)
    ]
    (summary,) = wheelset_summary(write(tmp_path, rows), (5.0, 15.0))
    assert 100.1e3 < summary.Q_peak[0] < 100.6e3
    assert 99.4e3 < summary.Q_least[0] < 99.9e3


def test_empty_stretch_is_refused(run: Run) -> None:
    with pytest.raises(ValueError, match="no contact between s = 50 and 60 m"):
        wheelset_summary(run, (50.0, 60.0))
