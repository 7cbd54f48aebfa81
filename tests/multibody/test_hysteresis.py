"""Friction loops of the three-piece bogie: what they enclose, and the closed forms of their sides."""

from dataclasses import replace

import numpy as np
import pytest
from coupling_bench import WAGON, first

from hh_exudyn.multibody.couplings.three_piece_bogie import RING_RADIUS
from hh_exudyn.multibody.hysteresis import X, Y, bogie_loops
from vehicles.couplings import AxleBox, CentrePlate, SideBearer, SpringNest, Wedge

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
