"""The largest of each quantity, with its wheel and the beginning of the element of the track."""

import math

import pyarrow
import pytest

from damage.extremes import extremes
from damage.summary import WheelsetSummary


def summary(number: int, **values: object) -> WheelsetSummary:
    plain: dict[str, object] = {
        "vehicle": 1, "wheelset": number, "Q": (100e3, 90e3), "Y": (1e3, -5e3), "y_over_q": (0.01, math.nan),
        "Q_peak": (0.0, 0.0), "Y_peak": (0.0, 0.0), "y_over_q_peak": (0.0, 0.0), "Q_least": (0.0, 0.0),
        "angle_of_attack": -2e-3, "lateral": 0.0, "p_max": (1e9, 2e9), "wear_number": (10.0, 20.0),
        "fatigue_share": (0.0, 0.5),
    }  # fmt: skip
    return WheelsetSummary(**{**plain, **values})  # type: ignore[arg-type]


def test_largest_of_all_wheels() -> None:
    rows = {
        0.0: [summary(1), summary(2, Q=(95e3, 110e3), wear_number=(0.0, 0.0))],
        100.0: [summary(1), summary(2, Q=(95e3, 120e3), angle_of_attack=1e-3, wear_number=(30.0, 0.0))],
    }
    wear = pyarrow.table(
        {"vehicle": [1, 1, 1, 1], "wheelset": [1, 1, 2, 2], "side": [-1, 1, -1, 1],
         "wear_depth_mm_per_1000_km": [0.1, 0.2, 0.7, 0.3]}
    )  # fmt: skip
    found = {one.quantity: (one.value, one.unit, one.wheel) for one in extremes(rows, wear)}
    assert found["Q"] == (pytest.approx(120.0), "kN", "2R@100m")
    assert found["Y"] == (pytest.approx(1.0), "kN", "1L@0m")  # outwards
    assert found["Y/Q"] == (pytest.approx(0.01), "-", "1L@0m")  # a wheel off its rail has none
    assert found["angle of attack"] == (pytest.approx(2.0), "mrad", "1@0m")  # either way
    assert found["p_max"] == (pytest.approx(2000.0), "MPa", "1R@0m")
    assert found["wear number"] == (30.0, "N", "2L@100m")
    assert found["FI>0"] == (50.0, "%", "1R@0m")
    assert found["tread wear"] == (0.7, "mm/1000 km", "2R")


def test_no_wheel_on_its_rail() -> None:
    rows = {0.0: [summary(1, y_over_q=(math.nan, math.nan))]}
    wear = pyarrow.table({"vehicle": [1], "wheelset": [1], "side": [1], "wear_depth_mm_per_1000_km": [0.1]})
    ratio = next(one for one in extremes(rows, wear) if one.quantity == "Y/Q")
    assert math.isnan(ratio.value)
    assert ratio.wheel == ""
