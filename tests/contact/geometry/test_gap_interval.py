"""What the search takes as certain about an interval of the gap: against the gap itself, sampled finely."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hh_exudyn.contact.geometry.gap_interval import gap_slope_zero, least_gap, never_zero, slope_rate_bounds
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, gap_at, wheel_rail_pair
from hh_exudyn.contact.profile import gauge_point, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.spline import spline_evaluate, spline_table

WHEEL = spline_table(wheel_profile("S1002"))
RAIL_PROFILE = rail_profile("60E1", 1 / 40)
RAIL = spline_table(RAIL_PROFILE)
RAIL_Y = 0.7175 + gauge_point(RAIL_PROFILE)
FIRST = round((-0.035 - WHEEL.start) / WHEEL.step)  # node where the search begins
ROUND_OFF = 1e-4  # of a derivative by differences over a micrometre [1/m], relative to the curvatures


def pair_at(y: float, z: float, yaw: float, roll: float, side: float) -> WheelRailPair:
    axle = np.array([-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)])
    centre = np.array([0.0, side * (y - RAIL_Y), z])
    return wheel_rail_pair(WHEEL, RAIL, side, 0.75, 0.46, centre, axle)


def node(i: int) -> float:
    return WHEEL.start + i * WHEEL.step


poses = st.builds(
    pair_at,
    st.floats(-0.008, 0.008),
    st.floats(0.4595, 0.468),
    st.floats(-0.03, 0.03),
    st.floats(-0.005, 0.005),
    st.sampled_from([1.0, -1.0]),
)
intervals = st.tuples(st.integers(FIRST, FIRST + 300), st.sampled_from([1, 2, 3, 4, 7, 8, 16, 29, 32, 64]))


def test_tables_hold_slopes_and_bounds() -> None:
    for table in (WHEEL, RAIL):
        y = table.start + table.step * np.arange(table.z.size)
        slopes = [spline_evaluate(table, float(value))[1] for value in y[:-1]]
        np.testing.assert_allclose(table.slope[:-1], slopes, rtol=0, atol=1e-10)
        end = spline_evaluate(table, float(y[-1]) - 1e-9)[1]
        assert table.slope[-1] == pytest.approx(end, abs=1e-5)
        assert table.per_step == pytest.approx(1.0 / table.step, rel=1e-15)
        for level in range(table.bounds.shape[0]):
            for i in range(0, table.z.size - (1 << level), 7):
                piece = table.second[i : i + (1 << level) + 1]
                assert tuple(table.bounds[level, i]) == (piece.min(), piece.max())
        assert (1 << table.bounds.shape[0]) > table.z.size - 1  # two windows of the last level span the table


@given(pair=poses, interval=intervals)
def test_bounds_hold_in_every_interval(pair: WheelRailPair, interval: tuple[int, int]) -> None:
    """Rate of the slope, least gap and missing zeros, against 60 points of the gap in the interval."""
    first, last = interval[0], min(interval[0] + interval[1], WHEEL.z.size - 1)
    start, end = gap_at(pair, node(first)), gap_at(pair, node(last))
    if first >= last or math.isnan(start[0] + end[0]):
        return
    least, most = slope_rate_bounds(pair, first, last, start[2], end[2], start[3], end[3])
    places = np.linspace(node(first), node(last), 60)
    samples = np.array([gap_at(pair, float(y))[:2] for y in places])
    step = 0.5e-6
    rates = np.array(
        [
            (gap_at(pair, float(y) + step)[1] - gap_at(pair, float(y) - step)[1]) / (2 * step)
            for y in places[1:-1]
        ]
    )
    doubt = ROUND_OFF * (abs(least) + abs(most) + 10.0)
    assert rates.min() > least - doubt
    assert rates.max() < most + doubt
    width = node(last) - node(first)
    bound = least_gap(start[0], start[1], end[0], end[1], width, least)
    # where a side view is not that of no roll and yaw, y on the wheel is not quite y on the rail: 2 %
    assert bound <= samples[:, 0].min() + 0.02 * abs(start[0] - end[0]) + 1e-9
    if (start[1] < 0.0) == (end[1] < 0.0) and never_zero(start[1], end[1], width, least, most):
        assert (np.sign(samples[:, 1]) == np.sign(start[1])).all()


def test_bounds_are_close_enough_to_be_of_use() -> None:
    """Single intervals on tread and crown: the width of the bounds is a small part of the curvature."""
    pair = pair_at(-0.002, 0.46, 0.002, 0.0, 1.0)
    for i in range(FIRST + 80, FIRST + 160, 5):
        start, end = gap_at(pair, node(i)), gap_at(pair, node(i + 1))
        least, most = slope_rate_bounds(pair, i, i + 1, start[2], end[2], start[3], end[3])
        assert least <= min(start[2], end[2]) <= max(start[2], end[2]) <= most
        assert most - least < 8.0  # 1/m; two curvatures of 1/(300 mm) to 1/(80 mm)


@given(pair=poses, interval=intervals)
def test_zero_is_found_in_any_bracket(pair: WheelRailPair, interval: tuple[int, int]) -> None:
    first, last = interval[0], min(interval[0] + interval[1], WHEEL.z.size - 1)
    low, high = node(first), node(last)
    start, end = gap_at(pair, low), gap_at(pair, high)
    if first >= last or math.isnan(start[0] + end[0]) or (start[1] < 0.0) == (end[1] < 0.0):
        return
    y, gap, y_rail, *_ = gap_slope_zero(pair, low, high, start[1], end[1], start[2], end[2])
    assert low <= y <= high
    here = gap_at(pair, y)
    assert (gap, y_rail) == (here[0], here[3])
    assert abs(here[1]) < 1e-9 * (abs(start[2]) + abs(end[2]) + 2e4)  # the slope changes by 2e4/m at most
