"""Friction loops of the three-piece bogie: what they enclose, and the closed forms of their sides."""

from dataclasses import replace

import numpy as np
import pytest
from coupling_bench import WAGON, first

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
    arm = 2 / 3 * plate.radius
    for title, bound, stiffness in (
        ("axle box, longitudinal", box.friction * on_box, box.stiffness[X]),
        ("axle box, lateral", box.friction * on_box, box.stiffness[Y]),
        ("centre plate, yaw", plate.friction * car_body * arm, plate.stick_stiffness * arm**2),
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


def test_wedges_resist_warp_up_to_their_friction(loops):
    """Stiff while they stick; then each line slides, one down and one up, and all across their columns.

    By virtual work: the moment is what friction takes per angle. A line of contact slides by s = (v, l) per
    angle, v along the column by half the width over tan(slope), l across it by the wedge's place ahead of the
    bolster; its column force is that of the friction's vertical part, F/2 / (tan -+ mu v/|s|).
    """
    loop, wedge = loops["wedges of a side, warp"], first(Wedge)
    sunk = loops["wedge, vertical"].displacement.mean()
    down = 1 / (1 - np.tan(wedge.toe) / np.tan(wedge.slope))
    force = wedge.spring_share * wedge.spring_stiffness * (wedge.compression + sunk * down)
    along = wedge.width / 2 / (np.tan(wedge.slope) - np.tan(wedge.toe)) / np.cos(wedge.toe)
    slip = np.hypot(along, abs(wedge.point[0] - WAGON.body("bolster_1").position[0]))
    part = wedge.friction * along / slip
    normal = force / 2 * (1 / (wedge.tan_slope - part) + 1 / (wedge.tan_slope + part))
    up = np.gradient(loop.displacement) > 0.0
    at_zero = np.interp(0.0, loop.displacement[up], loop.force[up])
    assert at_zero == pytest.approx(2 * wedge.friction * normal * slip, rel=0.02)
    reversal = int(np.argmax(loop.displacement))
    flank = slice(reversal + 1, reversal + 50)
    stiffness = (np.diff(loop.force[flank]) / np.diff(loop.displacement[flank])).mean()
    assert stiffness > 20 * first(SpringNest).warp_stiffness
