"""Friction loops of the three-piece bogie: what they enclose, and the closed forms of their sides."""

from dataclasses import replace

import numpy as np
import pytest
from coupling_bench import WAGON, first

from hh_exudyn.multibody.couplings.three_piece_bogie import RING_RADIUS
from hh_exudyn.multibody.hysteresis import X, Y, Z, bogie_loops, drive, suspension_loops, warp_loop
from vehicles.catalogue import vehicle
from vehicles.couplings import AxleBox, CentrePlate, Rod, SideBearer, SpringNest, Wedge
from vehicles.variants import variant_of_table

PLAIN = replace(
    WAGON,
    couplings=tuple(replace(c, toe=0.0) if isinstance(c, Wedge) else c for c in WAGON.couplings),
)


@pytest.fixture(scope="module")
def loops(demo):
    return {loop.title: loop for loop in bogie_loops(WAGON, demo)}


def test_area_is_what_is_dissipated(loops):
    """All nine loops take energy, and all of it is in the ledger."""
    assert len(loops) == 9
    for loop in loops.values():
        assert loop.area > 10.0, loop.title
        assert loop.dissipated == pytest.approx(loop.area, rel=0.01), loop.title


def test_wedge_loads_and_unloads_as_its_statics_say(demo):
    """N2/Fs is 2.301 going down and 0.967 coming up (sources: vehicles.md 1.3, slope 36.3 deg, mu 0.3)."""
    loop = {loop.title: loop for loop in bogie_loops(PLAIN, demo)}["wedge, vertical"]
    wedge = first(Wedge)
    spring = wedge.spring_stiffness * (wedge.compression + loop.displacement)
    normal = loop.force / np.tan(wedge.slope)  # lift is N2 tan(slope)
    ratio = normal / spring
    down = np.gradient(loop.displacement) > 0.0
    middle = np.abs(loop.displacement - loop.displacement.mean()) < 0.5 * np.ptp(loop.displacement) / 2
    assert ratio[down & middle] == pytest.approx(2.301, abs=1e-3)
    assert ratio[~down & middle] == pytest.approx(0.967, abs=1e-3)


def coulomb(bound, amplitude, stiffness):
    """Loss [J] of a cycle with a Coulomb slider behind a spring."""
    return 4 * bound * (amplitude - bound / stiffness)


def test_loops_of_sliding_faces_in_closed_form(loops):
    """Axle box, plate in yaw and shear, side bearer: 4 mu N (u - mu N / k); stops take nothing."""
    box, plate, bearer = first(AxleBox), first(CentrePlate), first(SideBearer)
    on_box = sum(body.mass for body in WAGON.bodies if body.kind != "wheelset") * 9.81 / 8
    car_body = WAGON.body("car_body").mass * 9.81 / 2
    arm = RING_RADIUS.mean() * plate.radius
    for title, bound, stiffness in (
        ("axle box, longitudinal", box.friction * on_box, box.stiffness[X]),
        ("axle box, lateral", box.friction * on_box, box.stiffness[Y]),
        ("centre plate, yaw", plate.friction * car_body * arm, plate.yaw_stiffness),
        ("centre plate, longitudinal", plate.friction * car_body, plate.stick_stiffness),
        ("side bearer, longitudinal", bearer.friction * bearer.preload, bearer.stick_stiffness),
    ):
        loop = loops[title]
        expected = coulomb(bound, np.ptp(loop.displacement) / 2, stiffness)
        assert loop.area == pytest.approx(expected, rel=0.01), title


def test_axle_box_stops_at_the_pedestal(loops):
    """Between the stops no more than the pad's friction, beyond the clearance the pedestal's stiffness."""
    box = first(AxleBox)
    on_box = sum(body.mass for body in WAGON.bodies if body.kind != "wheelset") * 9.81 / 8
    for title, clearance in (
        ("axle box, longitudinal", box.longitudinal_clearance),
        ("axle box, lateral", box.lateral_clearance),
    ):
        loop = loops[title]
        free = np.abs(loop.displacement) < clearance
        bound = np.abs(loop.force[free]).max()
        assert bound == pytest.approx(box.friction * on_box, rel=2e-3)
        most = bound + box.stop_stiffness * 0.3 * clearance
        assert np.abs(loop.force).max() == pytest.approx(most, rel=1e-3)


def sliding_warp_moment(wedge, spring, ahead):
    """Moment [N m] against the warp of one wedge that slides on both faces, by virtual work.

    It is what friction takes per angle. A line of contact slides on the column by s = (v, l) per angle, v
    along it and l across it by the wedge's place ahead of the bolster, and on the slope by c. One line is
    squeezed, the other let up.
    """
    towards, _ = wedge.ways
    along, on_slope = wedge.width / 2 * np.array(towards[:2])
    slip = np.hypot(along, ahead)
    moment, angle = 0.0, wedge.slope - wedge.toe
    for way in (1, -1):
        column = wedge.normal_force(spring / 2, way * along / slip, way)
        down = way * wedge.friction * column * along / slip
        slope = (spring / 2 * np.cos(wedge.toe) + down) / (
            np.sin(angle) - way * wedge.slope_friction * np.cos(angle)
        )
        moment += wedge.friction * column * slip + wedge.slope_friction * slope * on_slope
    return moment


def test_wedges_resist_warp_up_to_their_friction(loops):
    """Stiff while they stick, then by the friction of both faces: several times that of the columns alone."""
    loop, wedge = loops["wedges of a side, warp"], first(Wedge)
    sunk = loops["wedge, vertical"].displacement.mean()
    force = wedge.spring_stiffness * (wedge.compression + sunk * wedge.ways[1][2])
    ahead = abs(wedge.point[0] - WAGON.body("bolster_1").position[0])
    up = np.gradient(loop.displacement) > 0.0
    at_zero = np.interp(0.0, loop.displacement[up], loop.force[up])
    most = sliding_warp_moment(wedge, force, ahead)
    assert at_zero == pytest.approx(2 * most, rel=0.02)
    assert most > 2.0 * sliding_warp_moment(replace(wedge, slope_friction=0.0), force, ahead)
    reversal = int(np.argmax(loop.displacement))
    flank = slice(reversal + 1, reversal + 50)
    stiffness = (np.diff(loop.force[flank]) / np.diff(loop.displacement[flank])).mean()
    towards, _ = wedge.ways
    lines = (wedge.width / 2) ** 2 * (towards[0] ** 2 + towards[1] ** 2) + ahead**2
    springs = wedge.spring_stiffness * (wedge.width / 2 * towards[2]) ** 2
    assert stiffness == pytest.approx(2 * (wedge.stick_stiffness * lines + springs), rel=0.01)
    assert stiffness > 20 * first(SpringNest).warp_stiffness


def variant(**changes):
    return variant_of_table({"name": "other", "base": "iore_wagon_loaded", **changes}, "test").vehicle()


def stiffness_after_turning_back(loop, share=0.02):
    """Slope of a loop on the first `share` of its way back [N m/rad]."""
    k = int(np.argmax(loop.displacement))
    back = slice(k + 1, k + 1 + int(share * len(loop.displacement)))
    return np.polyfit(loop.displacement[back], loop.force[back], 1)[0]


def test_warp_of_the_bogie(demo):
    """Stuck it has MN m/rad; sliding it holds more than the centre plate and the side bearers can turn.

    Plate and bearers, 14 and 8 kN m, are what a curve can put on a bolster: a bogie that holds more is not
    pulled askew by them. The columns' friction alone holds less, and that bogie lozenges. The order of
    magnitude of braced bogies, 2..5 MN m/rad, is from memory: no published figure could be read.
    """
    plate, bearer = first(CentrePlate), first(SideBearer)
    turning = plate.friction * WAGON.body("car_body").mass * 9.81 / 2 * plate.radius * RING_RADIUS.mean()
    turning += 2 * bearer.friction * bearer.preload * bearer.point[1]
    held = {}
    for friction in (0.0, 0.1, 0.2):
        loop = warp_loop(variant(wedge={"slope_friction": friction}), demo)
        assert loop.dissipated == pytest.approx(loop.area, rel=0.01)
        up = np.gradient(loop.displacement) > 0.0
        held[friction] = np.interp(0.0, loop.displacement[up], loop.force[up])
        stuck = stiffness_after_turning_back(loop)
        assert 5e6 < stuck < 20e6
    assert held[0.0] < turning < held[0.1] < held[0.2]
    assert held[0.1] > 1.5 * held[0.0]


def test_lugs_stop_the_warp(demo):
    """Beyond the rotation clearance both side frames stand on their lugs."""
    nest = first(SpringNest)
    loop = warp_loop(WAGON, demo, 0.025)
    beyond = loop.displacement > 1.3 * nest.rotation_clearance
    up = np.gradient(loop.displacement) > 0.0
    slope = np.polyfit(loop.displacement[beyond & up], loop.force[beyond & up], 1)[0]
    coils = 2 * nest.warp_stiffness + 4 * first(AxleBox).yaw_stiffness
    assert slope == pytest.approx(2 * nest.rotation_stop_stiffness + coils, rel=0.1)


@pytest.mark.parametrize("part", ["frame_brace", "cross_brace"])
def test_braces_square_the_bogie(demo, part):
    """Two crossed rods of stiffness k add 2 k times the square of their elongation per angle."""
    braced = variant(**{part: {"stiffness": 10e6, "damping": 0.0}})
    rods = [c for c in braced.couplings if isinstance(c, Rod)]
    assert len(rods) == 4  # in either bogie
    reach, lateral = (np.subtract(rods[0].point_b, rods[0].point_a) / 2)[:2]
    per_angle = 2 * reach * 2 * abs(lateral) / rods[0].length
    plain, stiff = warp_loop(WAGON, demo), warp_loop(braced, demo)
    top = int(np.argmax(plain.displacement))
    added = stiff.force[top] - plain.force[top]
    assert added / plain.displacement[top] == pytest.approx(2 * 10e6 * per_angle**2, rel=0.01)
    assert stiff.area == pytest.approx(plain.area, rel=1e-3)


def test_ride_control_damps_as_much_empty_as_loaded(demo):
    """Control springs in the bolster keep their preload: the same friction under any load."""
    spring = {"constant_damping": 1.0, "preload": 16.4e3, "spring_stiffness": 344e3, "toe": 0.0}
    for name in ("loaded", "empty"):
        state = {"name": "other", "base": f"iore_wagon_{name}", "wedge": spring}
        wagon = variant_of_table(state, "test").vehicle()
        wedge = next(c for c in wagon.couplings if isinstance(c, Wedge))
        down = {"loaded": 0.07, "empty": 0.016}[name]
        path = np.zeros((801, 6))
        path[:, Z] = -down * (1.0 + 0.3 * np.sin(np.linspace(0.0, 2.0 * np.pi, 801)))
        loop = drive(wagon, demo, "wedge", (wedge,), Z, path)
        bound = [0.3 * wedge.normal_force(16.4e3, motion) for motion in (1, -1)]
        assert (loop.force.max(), loop.force.min()) == pytest.approx((bound[0], -bound[1]), rel=1e-6)
        assert loop.dissipated == pytest.approx(loop.area, rel=0.01)
    with pytest.raises(ValueError, match=r"constant_damping 0\.5 must be 1"):
        variant(wedge={"constant_damping": 0.5})


def test_loops_of_a_y25_axle_box(demo):
    """Vertically 9 % of the load to either side, laterally as much and the coils; all in the ledger."""
    wagon = vehicle("y25_wagon_loaded")
    loops = suspension_loops(wagon, demo)
    load = (wagon.mass - 4 * 1300.0) * 9.81 / 8
    assert all(loop.dissipated == pytest.approx(loop.area, rel=0.01) for loop in loops)
    vertical, lateral, longitudinal = loops
    up = np.gradient(vertical.displacement) > 0.0
    at_rest = vertical.displacement.mean()
    going_up = np.interp(at_rest, vertical.displacement[up], vertical.force[up])
    assert going_up == pytest.approx(1.09 * load, rel=0.01)
    free = np.abs(lateral.displacement) < 0.005
    assert np.ptp(lateral.force[free]) / 2 == pytest.approx(0.09 * load + 0.3e6 * 0.005, rel=0.03)
    assert longitudinal.area > 0.0
    with pytest.raises(ValueError, match="iore_wagon_loaded has no LenoirSuspension"):
        suspension_loops(WAGON, demo)
