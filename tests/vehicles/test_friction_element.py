"""Spring, slider and damper of dry friction and of the wedge: Coulomb's law, and no energy out of nothing."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from vehicles.force_laws import FacesInYaw, WedgeFaces, dry_friction, shear_and_yaw_friction, wedge

SLOPE, TOE = math.radians(36.3), math.radians(1.0)
CONTROL_SPRING = 4.0e5  # N/m
ROUNDING = 1e-9  # of a force; a stretch is a difference of two places

places = st.floats(-0.02, 0.02)
rates = st.floats(-1.0, 1.0)
bounds = st.floats(0.0, 1.0e5)
stiffnesses = st.floats(3.0, 8.5).map(lambda power: 10.0**power)  # N/m
dampings = st.one_of(st.just(0.0), st.floats(2.0, 6.5).map(lambda power: 10.0**power))  # N s/m

# A leg of a path: direction, length [m], number of steps, how long one takes [s], and a share of the bound:
# from a single fast step, whose damper alone exceeds the bound, to a slow way in small steps.
legs = st.tuples(
    st.floats(0.0, 2.0 * math.pi),
    st.floats(1e-6, 3e-3),
    st.integers(1, 20),
    st.floats(-5.0, 1.0).map(lambda power: 10.0**power),
    st.floats(0.0, 1.0),
)
paths = st.lists(legs, min_size=1, max_size=12)
HALF_A_MILLIMETRE = 5e-4
coefficients = st.floats(0.0, 0.7)
compiles_first = settings(deadline=None)  # the first example has the kernel compiled


def steps(path):
    """Every step of a path from (0, 0): place, way, rate, and the leg's number 0..1 for the bound."""
    u, w = 0.0, 0.0
    for direction, length, number, duration, share in path:
        du, dw = length / number * math.cos(direction), length / number * math.sin(direction)
        for _ in range(number):
            u, w = u + du, w + dw
            yield (u, w), (du, dw), (du / duration, dw / duration), share


def back_and_forth(fast, way=HALF_A_MILLIMETRE):
    """A fast step out and a slow way back, the path that once gave more than it took."""
    return [(0.0, way, 1, fast, 1.0), (math.pi, way, 20, 1.0, 1.0)]


def across_and_back(fast, way=HALF_A_MILLIMETRE):
    return [(0.7, way, 1, fast, 1.0), (2.1, way, 1, fast, 0.3), (4.0, way, 20, 1.0, 1.0)]


def test_a_fast_step_stretches_the_spring_by_its_way_only():
    """0.053 mm at 1.05 bound / damping: the damper fills the bound, the spring of 40 MN/m holds 2.1 kN."""
    stiffness, damping, bound, way = 4.0e7, 8.0e4, 1.0e4, 0.053e-3
    contact = (stiffness, stiffness, damping, damping, bound)
    force, _, *slider = dry_friction(way, 0.0, 0.0, 0.0, 1.05 * bound / damping, 0.0, *contact)
    assert force == pytest.approx(-bound)
    assert slider == [0.0, 0.0]
    held, *_ = dry_friction(way, 0.0, *slider, 0.0, 0.0, *contact)
    assert held == pytest.approx(-stiffness * way)


@example(4e7, 4e7, 8e4, 8e4, 1e4, back_and_forth(4e-4, 0.053e-3))
@example(1e7, 6e6, 2e4, 3e6, 1e4, across_and_back(1e-3))
@compiles_first
@given(stiffnesses, stiffnesses, dampings, dampings, bounds, paths)
def test_no_path_gets_energy_out_of_dry_friction(k_u, k_w, d_u, d_w, largest, path):
    """From a relaxed slider, at every step: what was put in is at least what the spring holds.

    In one direction or two, whatever the ratios of stiffness and damping, while the bound changes from leg to
    leg.
    """
    slider, work, size = (0.0, 0.0), 0.0, 0.0
    for place, way, rate, share in steps(path):
        force_u, force_w, *slider = dry_friction(*place, *slider, *rate, k_u, k_w, d_u, d_w, share * largest)
        work -= force_u * way[0] + force_w * way[1]
        size += math.hypot(force_u, force_w) * math.hypot(*way)
        held = 0.5 * k_u * (place[0] - slider[0]) ** 2 + 0.5 * k_w * (place[1] - slider[1]) ** 2
        assert work >= held - ROUNDING * size


def faces(friction, slope_friction, stiffness, damping):
    angles = math.sin(SLOPE - TOE), math.cos(SLOPE - TOE), math.cos(SLOPE), math.cos(TOE)
    return WedgeFaces(*angles, friction, slope_friction, stiffness, damping)


def normal_forces(spring, down, slope):
    """Of column and slope of the wedge."""
    sine, cosine = math.sin(SLOPE - TOE), math.cos(SLOPE - TOE)
    column = (spring * math.cos(SLOPE) + down * cosine + slope) / sine
    return column, (spring * math.cos(TOE) + down + slope * cosine) / sine


@example(4e7, 8e4, 0.6, 0.0, 1.2, back_and_forth(4e-4, 0.053e-3))
@example(4e7, 8e4, 0.6, 0.3, 1.2, across_and_back(4e-4))
@compiles_first
@given(stiffnesses, dampings, coefficients, coefficients, st.floats(-1.5, 1.5), paths)
def test_no_path_gets_energy_out_of_a_wedge(stiffness, damping, largest, slope_friction, slip, path):
    """As of dry friction; the bounds go with the control spring, the frictions themselves, the coefficient.

    The bolster slips on the slope by `slip` times its way down the column and across it. The control spring's
    own force works on the way of the bolster alone and is left out. Where the wedge is loose its faces hold
    nothing.
    """
    middle = 1e-3  # of the compression: some paths go on to where the wedge is loose
    slider, work, size = (middle, 0.0, 0.0), 0.0, 0.0
    for place, way, rate, share in steps(path):
        down, slope = middle + place[0], slip * (place[0] + 0.5 * place[1])
        rub = wedge(
            (down, place[1], slope), slider, (*rate, slip * (rate[0] + 0.5 * rate[1])),
            CONTROL_SPRING * down, faces(share * largest, slope_friction, stiffness, damping),
        )  # fmt: skip
        slider = rub.slider
        way_slope = slip * (way[0] + 0.5 * way[1])
        if down > 0.0:
            assert min(normal_forces(CONTROL_SPRING * down, rub.down, rub.slope)) >= 0.0
        work += rub.down * way[0] + rub.across * way[1] + rub.slope * way_slope
        size += math.hypot(rub.down, rub.across, rub.slope) * math.hypot(*way, way_slope)
        held = 0.5 * stiffness * math.dist((down, place[1], slope), slider) ** 2
        assert work >= held - ROUNDING * size


@example(4e7, 2e7, 8e4, 1e5, 0.19, 1e5, back_and_forth(4e-4, 0.053e-3))
@compiles_first
@given(stiffnesses, stiffnesses, dampings, dampings, st.floats(0.01, 1.0), bounds, paths)
def test_no_path_gets_energy_out_of_a_plate(stiffness, yaw_stiffness, damping, yaw_damping, arm, most, path):
    """Of faces that shear and yaw under one bound; bound and arm change from leg to leg."""
    slider, work, size = (0.0, 0.0, 0.0), 0.0, 0.0
    in_yaw = FacesInYaw(stiffness, yaw_stiffness, damping, yaw_damping)
    for (u, w), (du, dw), (ru, rw), share in steps(path):
        # sheared in both directions and turned
        way, change, rate = (u, 0.5 * w, w), (du, 0.5 * dw, dw), (ru, 0.5 * rw, rw)
        x, y, torque, slider = shear_and_yaw_friction(
            way, slider, rate, in_yaw, share * most, arm * (1.0 + share)
        )
        assert math.hypot(x, y, torque / (arm * (1.0 + share))) <= share * most * (1 + 1e-9) + 1e-6
        work -= x * change[0] + y * change[1] + torque * change[2]
        size += abs(x * change[0]) + abs(y * change[1]) + abs(torque * change[2])
        held = 0.5 * stiffness * ((way[0] - slider[0]) ** 2 + (way[1] - slider[1]) ** 2)
        held += 0.5 * yaw_stiffness * (way[2] - slider[2]) ** 2
        assert work >= held - ROUNDING * max(size, held)


@example(0.015625, 0.0, 0.0, 0.0, -1.0, 0.0, 1e7, 6e6, 2e4, 3e4, 1.0)
@example(0.01, 0.01, 0.0, 0.0, 0.0, 0.0, 1e3, 1e4, 0.0, 0.0, 1e-200)
@compiles_first
@given(
    places, places, places, places, rates, rates, stiffnesses, stiffnesses, dampings, dampings, bounds
)  # fmt: skip
def test_friction_is_coulombs(u, w, slider_u, slider_w, rate_u, rate_w, k_u, k_w, d_u, d_w, bound):
    """Within its bound; the slider stays if the spring does, else slips along the force that is left.

    The damper adds as much of its own force as the bound has room for, and no more than all.
    """
    contact = (k_u, k_w, d_u, d_w, bound)
    tolerance = ROUNDING * max(bound, 0.02 * max(k_u, k_w))
    force = np.array(dry_friction(u, w, slider_u, slider_w, rate_u, rate_w, *contact))
    force, slider = force[:2], force[2:]
    spring = -np.array([k_u, k_w]) * (np.array([u, w]) - slider)
    assert np.hypot(*force) <= bound + tolerance
    trial = np.hypot(k_u * (u - slider_u), k_w * (w - slider_w))
    if trial <= bound * (1 - 1e-12):
        assert (slider == [slider_u, slider_w]).all()
    elif trial > bound * (1 + 1e-12):
        assert np.hypot(*spring) == pytest.approx(bound, abs=tolerance)
        slip = slider - [slider_u, slider_w]
        assert spring @ slip <= tolerance * np.hypot(*slip)  # the body is pulled back
        across = spring[0] * slip[1] - spring[1] * slip[0]
        assert abs(across) <= tolerance * np.hypot(*slip) + bound * ROUNDING
    damper = -np.array([d_u * rate_u, d_w * rate_w])
    check_damper(force - spring, damper, np.hypot(*force), bound, tolerance)


def check_damper(taken, damper, magnitude, bound, tolerance):
    """A share 0..1 of the damper's force, and less than 1 only where the bound is reached."""
    whole = np.hypot(*damper)
    if whole <= tolerance:
        return
    share = taken @ damper / whole**2
    assert -tolerance / whole <= share <= 1 + tolerance / whole
    assert taken == pytest.approx(share * damper, abs=tolerance)
    if share * whole < whole - tolerance:
        # where the bound is nearly touched from within, the way to it is the root of the room that is left
        assert magnitude == pytest.approx(bound, rel=1e-6, abs=math.sqrt(tolerance * bound) + tolerance)


@compiles_first
@given(
    st.tuples(places, places, places), st.tuples(places, places, places), st.tuples(rates, rates, rates),
    st.floats(10.0, 1e5), stiffnesses, dampings, coefficients, coefficients,
)  # fmt: skip
def test_the_wedges_faces_are_coulombs(way, slider, rate, spring, k, damping, mu, mu_slope):
    """The same with cones for the bounds: friction times the normal force that goes with both frictions.

    A face slips only where its own cone is reached, and along its trial force; slip and cone hold together.
    """
    rub = wedge(way, slider, rate, spring, faces(mu, mu_slope, k, damping))
    still = wedge(way, slider, (0.0, 0.0, 0.0), spring, faces(mu, mu_slope, k, 0.0))
    assert still.slider == rub.slider
    trial, held = k * (np.array(way) - slider), k * (np.array(way) - rub.slider)
    tolerance = 1e-7 * (spring + np.abs(trial).max())
    assert (still.down, still.across, still.slope) == pytest.approx(held, abs=tolerance)
    for force in (rub, still):
        column, slope = normal_forces(spring, force.down, force.slope)
        assert math.hypot(force.down, force.across) <= mu * column + tolerance
        assert abs(force.slope) <= mu_slope * slope + tolerance
    column, slope = normal_forces(spring, *held[[0, 2]])
    for part, bound in (([0, 1], mu * column), ([2], mu_slope * slope)):
        left, whole = np.linalg.norm(held[part]), np.linalg.norm(trial[part])
        assert held[part] * whole == pytest.approx(trial[part] * left, abs=tolerance * whole)
        assert left <= whole + tolerance
        if left < whole - 10 * tolerance:
            assert left == pytest.approx(bound, rel=1e-5, abs=10 * tolerance)


def test_a_bound_that_falls_lets_the_face_slip_at_rest():
    """Half the load, and what is held falls to the bound; the load that comes back finds it there."""
    stiffness, bound = 1.0e7, 1.0e4
    contact = (stiffness, 0.5 * stiffness, 3e4, 3e4)
    u, w = 0.6 * bound / stiffness, 0.7 * bound / (0.5 * stiffness)
    slider = (0.0, 0.0)
    magnitudes = []
    for load in (1.0, 0.5, 1.0):
        force_u, force_w, *slider = dry_friction(u, w, *slider, 0.0, 0.0, *contact, load * bound)
        magnitudes.append(math.hypot(force_u, force_w) / bound)
    assert magnitudes == pytest.approx([math.hypot(0.6, 0.7), 0.5, 0.5])


@pytest.mark.parametrize("direction", [0.3, 1.1, 2.5])
def test_a_body_dragged_far_is_held_against_its_motion(direction):
    """Coulomb's law once more: in steady sliding the spring's stiffnesses do not count."""
    towards = np.array([math.cos(direction), math.sin(direction)])
    slider, bound = (0.0, 0.0), 2.0e4
    for s in np.linspace(0.0, 0.05, 400):
        *force, slider_u, slider_w = dry_friction(
            *(s * towards), *slider, 0.0, 0.0, 13.1e6, 8.8e6, 0.0, 0.0, bound
        )
        slider = (slider_u, slider_w)
    assert force == pytest.approx(-bound * towards, abs=1e-6 * bound)


def test_extreme_ratios_of_stiffness_come_back_onto_the_bound():
    """Newton's method for the slip converges over twelve decades of stiffness, and of overshoot."""
    for k_w in 10.0 ** np.arange(0.0, 12.1, 1.0):
        for bound in 10.0 ** np.arange(-6.0, 6.0, 1.0):
            for w in (1e-9, 1e-5, 1e-2):
                force = dry_friction(0.01, w, 0.0, 0.0, 0.0, 0.0, 1e6, k_w, 0.0, 0.0, bound)
                u_slid, w_slid = force[2:]
                magnitude = math.hypot(*force[:2])
                assert magnitude == pytest.approx(min(bound, math.hypot(1e4, k_w * w)), rel=1e-12)
                if u_slid > 0.0:
                    assert force[0] * w_slid == pytest.approx(force[1] * u_slid, rel=1e-6)
