"""Contact geometry functions and equivalent conicity: cones, symmetry, Manchester benchmark, bad input."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from manchester_rail import manchester_rail

from hh_exudyn.contact.functions import (
    contact_functions,
    equivalent_conicity,
    rolling_radius_difference,
    wheelset_functions,
)
from hh_exudyn.contact.geometry.conicity import conicity_from_radius_difference
from hh_exudyn.contact.geometry.merit import (
    conicity_report,
    flange_clearance,
    gauge_sensitivity,
    radial_steering_index,
)
from hh_exudyn.contact.geometry.validation import cone
from hh_exudyn.contact.profile import (
    rail_profile,
    wheel_profile,
)
from hh_exudyn.conventions import LEFT, RIGHT

REFERENCE = Path(__file__).parents[2] / "reference"


def test_s1002_on_60e1_has_its_known_conicity() -> None:
    """Commonly quoted as 0.17 to 0.18 at 3 mm for 1:40 at 1435 mm (from memory, no printed source)."""
    report = conicity_report(wheel_profile("S1002"), rail_profile("60E1", 1 / 40), radius=0.46)
    assert report.reference_conicity == pytest.approx(0.175, abs=0.005)


@given(
    slope=st.floats(0.01, 0.2),
    gauge=st.floats(1.43, 1.46),
    inclination=st.floats(0.0, 0.05),
    amplitude=st.floats(0.5e-3, 4e-3),
)
@settings(max_examples=8, deadline=None)
def test_cones_have_their_own_conicity(
    slope: float, gauge: float, inclination: float, amplitude: float
) -> None:
    """Klingel: on any rail, at any gauge and amplitude, without roll."""
    wheel, rail = cone(slope), rail_profile("60E1", inclination)
    lateral = np.linspace(-4e-3, 4e-3, 9)
    track = {"gauge": gauge, "tape_distance": 1.5, "radius_left": 0.46, "radius_right": 0.46}
    found = rolling_radius_difference(wheel, rail, wheel, rail, lateral=lateral, **track)
    assert found == pytest.approx(2.0 * slope * lateral, abs=1e-8)
    conicity = equivalent_conicity(wheel, rail, wheel, rail, amplitudes=np.array([amplitude]), **track)
    assert conicity == pytest.approx(slope, rel=1e-5)


def test_a_wheelset_of_cones_is_restored_by_unlike_radii_off_the_middle() -> None:
    """A larger left wheel runs to the right, y0 = -(difference) / (2 slope); its conicity stays."""
    wheel, rail = cone(0.05), rail_profile("60E1", 1 / 30)
    track = {"gauge": 1.435, "tape_distance": 1.5, "radius_left": 0.4601, "radius_right": 0.46}
    lateral = np.array([-1e-3, 0.0])
    found = rolling_radius_difference(wheel, rail, wheel, rail, lateral=lateral, **track)
    assert found == pytest.approx([0.0, 1e-4], abs=1e-8)
    conicity = equivalent_conicity(wheel, rail, wheel, rail, amplitudes=np.array([2e-3]), **track)
    assert conicity == pytest.approx(0.05, rel=1e-5)


@given(
    gauge=st.floats(1.43, 1.45),
    inclination=st.sampled_from((1 / 20, 1 / 30, 1 / 40)),
    roll=st.sampled_from((0.0, None)),
)
@settings(max_examples=5, deadline=None)
def test_a_mirrored_pair_is_odd(gauge: float, inclination: float, roll: float | None) -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", inclination)
    # no grid of displacements that falls on a jump
    lateral = np.linspace(-5.003e-3, 5.003e-3, 12)
    both = wheelset_functions(
        wheel, rail, wheel, rail, lateral=lateral, radius_left=0.46, radius_right=0.46, gauge=gauge, roll=roll
    )
    assert both.radius_difference == pytest.approx(-both.radius_difference[::-1], abs=1e-7)
    assert both.contact_angle_difference == pytest.approx(-both.contact_angle_difference[::-1], abs=1e-5)
    assert both.left.wheel_lift == pytest.approx(both.right.wheel_lift[::-1], abs=1e-10)


def test_the_roll_sets_both_wheels_on_the_rails() -> None:
    """Unlike wheels, radii and rails: one centre height for both, no gap anywhere below zero."""
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    lateral = np.linspace(-9e-3, 9e-3, 37)
    both = wheelset_functions(
        cone(0.05), rail, wheel, rail_profile("54E1", 1 / 20), lateral=lateral, radius_left=0.4605,
        radius_right=0.46, roll=None,
    )  # fmt: skip
    heights = both.left.wheel_lift + 0.4605 - (both.right.wheel_lift + 0.46)
    assert np.abs(heights).max() < 1e-9
    assert np.diff(both.roll).min() > 0.0  # the wheel that moves outwards climbs
    # by hand: a small roll lifts the wheels apart by their distance, less what the contact angles give away
    flat = wheelset_functions(
        wheel, rail, wheel, rail, lateral=lateral, radius_left=0.46, radius_right=0.46, roll=0.0
    )
    rolled = wheelset_functions(
        wheel, rail, wheel, rail, lateral=lateral, radius_left=0.46, radius_right=0.46
    )
    near = np.abs(lateral) < 2e-3
    distance = 1.5 - flat.left.y_wheel - flat.right.y_wheel
    distance -= 0.46 * (np.tan(flat.left.contact_angle) + np.tan(flat.right.contact_angle))
    expected = (flat.left.wheel_lift - flat.right.wheel_lift) / distance
    assert rolled.roll[near] == pytest.approx(expected[near], rel=0.02, abs=1e-9)


def test_positions_roll_and_lift_of_the_manchester_benchmark() -> None:
    """Case A-2.2 at 10 kN, whose small elastic approach and yaw (up to 24 mrad) a rigid contact leaves out.

    The benchmark's y is positive to the right, its z downwards.
    """
    wheel, rail = wheel_profile("S1002"), manchester_rail()
    lines = (REFERENCE / "wheel_rail_mbench_a22.csv").read_text().splitlines()
    rows = [
        row
        for row in csv.DictReader(line for line in lines if not line.startswith("#"))
        if row["load"] == "10kN" and row["patch"] == "1"
    ]
    for side, name in ((LEFT, "left"), (RIGHT, "right")):
        mine = [row for row in rows if row["side"] == name]
        lateral, roll, lift, y_rail, angle = np.array(
            [[float(row[key]) for key in ("y_ws", "roll_ws", "z_ws", "y_r", "delta_r")] for row in mine]
        ).T
        found = wheelset_functions(
            wheel, rail, wheel, rail, lateral=-1e-3 * lateral, radius_left=0.46, radius_right=0.46
        )
        assert found.roll == pytest.approx(roll, rel=0.04, abs=5e-6)
        one = found.left if side == LEFT else found.right
        assert 1e3 * one.wheel_lift == pytest.approx(-lift, abs=0.1)
        assert one.contact_angle == pytest.approx(np.abs(angle), abs=0.012)
        top = rail.y[np.argmax(rail.z)]
        off = np.abs(1e3 * (one.y_rail - top) - np.abs(y_rail))
        assert off[lateral > 0.0].max() < 0.6
        assert (
            off.max() < 1.7
        )  # centred, the contact is nearly conformal: two micrometres move it a millimetre


def test_a_wheel_touches_where_the_slopes_agree() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    lateral = np.linspace(-6e-3, 8e-3, 57)
    one = contact_functions(wheel, rail, lateral=lateral, radius=0.46, side=LEFT, gauge=1.435)
    slope = -np.interp(one.y_wheel, 0.5 * (wheel.y[1:] + wheel.y[:-1]), np.diff(wheel.z) / np.diff(wheel.y))
    assert np.tan(one.contact_angle) == pytest.approx(slope, abs=0.03)
    assert one.rolling_radius == pytest.approx(0.46 - np.interp(one.y_wheel, wheel.y, wheel.z), abs=1e-5)
    assert (np.diff(one.wheel_lift[one.y_wheel > 0.0]) > 0.0).all()  # outwards the wheel climbs
    assert (one.lateral_curvature > 0.0).all()  # else it would not touch there
    other = contact_functions(wheel, rail, lateral=-lateral, radius=0.46, side=RIGHT, gauge=1.435)
    assert other.y_rail == pytest.approx(one.y_rail, abs=1e-9)


@given(
    slope=st.floats(-0.5, 0.5).filter(lambda k: abs(k) > 1e-3),
    offset=st.floats(-1e-3, 1e-3),
    amplitude=st.floats(0.5e-3, 4e-3),
    radius=st.floats(0.3, 0.7),
    tape=st.floats(1.0, 2.0),
)
def test_a_linear_difference_is_exact(
    slope: float, offset: float, amplitude: float, radius: float, tape: float
) -> None:
    """Wherever its zero lies; a difference that drives away has the negative conicity."""
    lateral = np.array([-10e-3, -3.1e-3, 0.4e-3, 2.2e-3, 10e-3])
    found = conicity_from_radius_difference(
        lateral, 2.0 * slope * (lateral - offset), radius=radius, tape_distance=tape,
        amplitudes=np.array([amplitude]),
    )  # fmt: skip
    assert found == pytest.approx(slope, rel=1e-9)


def test_jumps_dead_bands_and_hopeless_tables() -> None:
    def conicity(lateral: list[float], delta_r: list[float], amplitude: float) -> float:
        table = np.array(lateral) * 1e-3, np.array(delta_r) * 1e-3
        return float(
            conicity_from_radius_difference(
                *table, radius=0.5, tape_distance=1.5, amplitudes=np.array([amplitude * 1e-3])
            )[0]
        )

    # a jump at the middle: constant acceleration d / (e r0), a quarter wave takes sqrt(2 A e r0 / d)
    step = [-5.0, 0.0, 0.0, 5.0], [-0.4, -0.4, 0.4, 0.4]
    assert conicity(*step, 2.0) == pytest.approx(math.pi**2 * 0.4 / (16.0 * 2.0), rel=1e-9)
    # dead band of half width b: quarter wave b / v + pi / (2 w), v = w (A - b)
    band = [-8.0, -1.0, 1.0, 8.0], [-1.4, 0.0, 0.0, 1.4]
    assert conicity(*band, 0.9) == 0.0
    quarter = 1.0 / 2.0 + math.pi / 2.0
    assert conicity(*band, 3.0) == pytest.approx(0.1 * (0.5 * math.pi / quarter) ** 2, rel=1e-9)
    # drives away inside and back outside: a small motion is negative, a larger one does not pass its middle
    hill = [-5.0, -2.0, 2.0, 5.0], [-3.0, 0.4, -0.4, 3.0]
    assert conicity(*hill, 1.0) == pytest.approx(-0.1, rel=1e-9)
    assert math.isnan(conicity(*hill, 2.5))
    assert math.isnan(conicity(*hill, 5.1))  # leaves the table


def test_nothing_is_lost_by_a_finer_table() -> None:
    """The closed form over pieces does not depend on how the pieces are cut."""
    lateral = np.array([-6.0, -2.0, 0.5, 1.0, 1.0, 4.0, 6.0]) * 1e-3
    delta_r = np.array([-3.0, -0.3, -0.1, 0.2, 0.5, 0.6, 4.0]) * 1e-3
    finer = np.union1d(lateral, np.linspace(-6e-3, 6e-3, 331))
    finer = np.sort(np.append(finer, 1e-3))  # the jump
    values = np.interp(finer, lateral, delta_r)
    at_jump = np.flatnonzero(finer == 1e-3)
    values[at_jump] = 0.2e-3, 0.5e-3
    amplitudes = np.array([0.4, 1.0, 3.0, 5.0]) * 1e-3
    coarse = conicity_from_radius_difference(
        lateral, delta_r, radius=0.46, tape_distance=1.5, amplitudes=amplitudes
    )
    fine = conicity_from_radius_difference(
        finer, values, radius=0.46, tape_distance=1.5, amplitudes=amplitudes
    )
    assert coarse == pytest.approx(fine, rel=1e-8)


def test_report_clearance_and_steering() -> None:
    wheel, rail = cone(0.05), rail_profile("60E1", 1 / 30)
    report = conicity_report(wheel, rail, radius=0.46, gauge=1.435, amplitudes=np.arange(1, 17) * 1e-3)
    # the rail's gauge face stands 31.5 mm inwards of the running circle, the flange 40 mm and more
    assert report.clearance_left == pytest.approx(-report.clearance_right, abs=1e-9)
    assert 8e-3 < report.clearance_left < 15e-3
    beyond = report.amplitudes > report.largest_amplitude
    assert beyond.any()
    assert np.isnan(report.conicity[beyond]).all()
    assert report.conicity[~beyond] == pytest.approx(0.05, rel=1e-5)
    assert report.nonlinearity == pytest.approx(0.0, abs=1e-3)
    # a cone's steering is exact: 2 slope clearance R / (e r0)
    expected = 2.0 * 0.05 * (report.clearance_left - 0.02e-3) * 600.0 / (1.5 * 0.46)
    assert report.steering_index(600.0) == pytest.approx(expected, rel=1e-4)
    assert report.steering_index(-600.0) == pytest.approx(expected, rel=1e-4)
    wider = conicity_report(wheel, rail, radius=0.46, gauge=1.445)
    assert wider.clearance_left == pytest.approx(report.clearance_left + 5e-3, abs=0.03e-3)


def test_conicity_over_the_gauge() -> None:
    """S1002 on 60E1 1:40: a tighter gauge brings the contact nearer to the flange root."""
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    found = gauge_sensitivity(wheel, rail, wheel, rail, gauges=np.array([1.432, 1.435, 1.440]), radius=0.46)
    assert found[0] > found[1] > found[2] > 0.0


def test_bad_input_is_named() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    track = {"gauge": 1.435, "tape_distance": 1.5, "radius_left": 0.46, "radius_right": 0.46}
    here = np.zeros(1)
    with pytest.raises(ValueError, match="needed: 'rail'"):
        rolling_radius_difference(wheel, wheel, wheel, rail, lateral=here, **track)
    with pytest.raises(ValueError, match="gauge = 1435"):
        rolling_radius_difference(wheel, rail, wheel, rail, lateral=here, **(track | {"gauge": 1435.0}))
    with pytest.raises(ValueError, match="lateral"):
        rolling_radius_difference(wheel, rail, wheel, rail, lateral=np.array([3.0]), **track)
    with pytest.raises(ValueError, match="amplitudes"):
        equivalent_conicity(wheel, rail, wheel, rail, amplitudes=np.array([3.0]), **track)
    with pytest.raises(ValueError, match=r"amplitudes = .*\(m,\) numbers"):
        equivalent_conicity(wheel, rail, wheel, rail, amplitudes=np.full((2, 2), 3e-3), **track)
    assert equivalent_conicity(wheel, rail, wheel, rail, amplitudes=np.array([]), **track).size == 0
    with pytest.raises(ValueError, match="side = 0"):
        contact_functions(wheel, rail, lateral=here, radius=0.46, side=0)
    with pytest.raises(ValueError, match="roll"):
        contact_functions(wheel, rail, lateral=here, radius=0.46, roll=3.0)
    with pytest.raises(ValueError, match="roll: shape"):
        contact_functions(wheel, rail, lateral=here, radius=0.46, roll=np.zeros(3))
    table = np.array([0.0, 1.0, 0.5]) * 1e-3
    with pytest.raises(ValueError, match="must not decrease"):
        conicity_from_radius_difference(table, table, radius=0.46, tape_distance=1.5, amplitudes=here + 1e-3)
    with pytest.raises(ValueError, match="positive"):
        conicity_from_radius_difference(table[:2], table[:2], radius=0.46, tape_distance=1.5, amplitudes=here)
    with pytest.raises(ValueError, match=r"\(m,\) numbers"):
        conicity_from_radius_difference(
            table[:2], table[:2], radius=0.46, tape_distance=1.5, amplitudes=np.full((1, 1), 1e-3)
        )
    short = wheelset_functions(
        wheel, rail, wheel, rail, lateral=np.linspace(-1e-3, 1e-3, 5), radius_left=0.46, radius_right=0.46
    )
    assert flange_clearance(short) == (-math.inf, math.inf)
    with pytest.raises(ValueError, match="before the outer flange touches"):
        radial_steering_index(short, curve_radius=500.0, radius=0.46)
    with pytest.raises(ValueError, match="curve_radius"):
        radial_steering_index(short, curve_radius=5.0, radius=0.46)


def test_a_wheel_that_misses_its_rail_has_no_contact() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    one = contact_functions(wheel, rail, lateral=np.zeros(1), radius=0.46, gauge=1.7)
    assert np.isnan(one.rolling_radius).all()
    with pytest.raises(ValueError, match="do not touch centred"):
        conicity_report(wheel, rail, radius=0.46, gauge=1.7)
