"""A wheel on a rail over the arc: against CONTACT (conformal and Manchester rows), symmetry, continuity."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from manchester_rail import manchester_rail

from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.halfspace.conformal import conformal_overlap
from hh_exudyn.contact.halfspace.conformal_slip import conformal_slip, force_on_wheel
from hh_exudyn.contact.halfspace.pose import wheel_above_rail
from hh_exudyn.contact.halfspace.rolling import rigid_slip, rolling_contact
from hh_exudyn.contact.halfspace.wheel_rail import ConformalContact, conformal_contact
from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile
from hh_exudyn.conventions import LEFT, RIGHT

MANCHESTER = [
    row
    for row in csv.DictReader(
        line
        for line in (Path(__file__).parents[2] / "reference" / "wheel_rail_mbench_a22.csv")
        .read_text()
        .splitlines()
        if not line.startswith("#")
    )
    if row["side"] == "left" and row["n_patch"] == "1"
]
R0, FRICTION, SPEED = 0.46, 0.3, 2.0


def s1002(lateral: float, height: float, side: int = RIGHT) -> WheelRailPair:
    """S1002 on 60E1 1:30, gauge 1445 mm, the wheelset displaced towards the rail [mm], as conformal.csv."""
    return wheel_above_rail(
        wheel_profile("S1002"), rail_profile("60E1", 1.0 / 30.0), side,
        lateral=side * lateral * 1e-3, height=height, radius=0.4575, yaw=side * 0.8e-3, gauge=1.445,
    )  # fmt: skip


def manchester(row: dict[str, str], rail: Profile) -> WheelRailPair:
    """The benchmark has y right and z down: y and yaw change sign, roll does not."""
    return wheel_above_rail(
        wheel_profile("S1002"), rail, LEFT, lateral=-float(row["y_ws"]) * 1e-3, radius=R0,
        height=R0 - float(row["z_ws"]) * 1e-3, yaw=-float(row["yaw_ws"]), roll=float(row["roll_ws"]),
    )  # fmt: skip


def rolling(row: dict[str, str], rail: Profile) -> tuple[ConformalContact, np.ndarray]:
    """Contact and force on the wheel under the row's vertical force, friction included."""
    wanted = load = float(row["fz_tr"])
    pair = manchester(row, rail)
    yaw, roll = -float(row["yaw_ws"]), float(row["roll_ws"])
    axle = np.array([-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)])
    for _ in range(2):
        found = conformal_contact(pair, load=load, spacing=(0.2e-3, 0.2e-3))
        assert found is not None
        slip = conformal_slip(found, np.array([SPEED, 0.0, 0.0]), -float(row["vpitch_ws"]) * axle, SPEED)
        solved = rolling_contact(found.influence, FRICTION * found.pressure, slip)
        force = force_on_wheel(found, solved.traction)
        load += wanted - force[2]
    return found, force


@pytest.fixture(scope="module")
def rail() -> Profile:
    return manchester_rail()


PLANE = [row for row in MANCHESTER if row["load"] in ("10kN", "60kN") and float(row["y_ws"]) >= 1.0]


@pytest.mark.parametrize("row", PLANE[::3], ids=lambda row: f"{row['load']}-{row['y_ws']}")
def test_manchester(row: dict[str, str], rail: Profile) -> None:
    """Forces 1 % of mu N (1.5 at 60 kN, y = 1 mm, where the patch is 17 mm wide and not plane), p_max 2 %.

    Measured: forces 0.02 to 0.3 % (1.3), normal force 0.01, pressure 0.2 %.
    """
    found, force = rolling(row, rail)
    normal = float(row["fn"])
    cosine, sine = math.cos(float(row["delta_r"])), math.sin(float(row["delta_r"]))
    # the row's plane of contact: forces on the rail, y to the right
    sideways = -(float(row["fs"]) * cosine - normal * sine)
    conformal = row["load"] == "60kN" and row["y_ws"] == "1"
    off = math.hypot(-force[0] - float(row["fx"]), force[1] - -sideways)
    assert off <= (0.015 if conformal else 0.01) * FRICTION * normal
    assert found.normal_force == pytest.approx(normal, rel=2e-3)
    assert found.max_pressure == pytest.approx(float(row["pmax"]) * 1e6, rel=0.02)
    assert abs(found.lowering) < 3e-6  # the height of the row, too


def test_a_conformal_patch_needs_its_own_slip(rail: Profile) -> None:
    """At y = 0, 16 mm wide: the row's plane creepages give the row's forces, the true slip others."""
    row = next(row for row in MANCHESTER if row["load"] == "10kN" and row["y_ws"] == "0")
    found, force = rolling(row, rail)
    limit = FRICTION * float(row["fn"])
    assert abs(-force[0] - float(row["fx"])) > 0.02 * limit
    # y of the contact frame is to the left, that of the row to the right; slip of wheel against rail
    phi = float(row["cphi"]) * 1e3
    grid = found.influence.grid
    place = np.interp(float(row["y_r"]) * 1e-3, found.y_rail[::-1], grid.y[::-1])
    plane = rigid_slip(found.influence, -float(row["cksi"]) + phi * float(place), float(row["ceta"]), phi)
    solved = rolling_contact(found.influence, FRICTION * found.pressure, plane)
    assert -solved.force[0] == pytest.approx(float(row["fx"]), abs=0.01 * limit)
    assert solved.force[1] == pytest.approx(float(row["fs"]), abs=0.01 * limit)


def test_both_sides_are_mirror_images() -> None:
    left, right = (conformal_contact(s1002(11.0, 0.45761, side), load=150e3) for side in (LEFT, RIGHT))
    assert left is not None
    assert right is not None
    assert left.outwards == pytest.approx(right.outwards, rel=1e-7)
    assert left.max_pressure == pytest.approx(right.max_pressure, rel=1e-4)
    one, other = (found.pressure.sum(axis=1) for found in (left, right))  # their grids may differ by a strip
    mirrored = np.interp(right.y_wheel, left.y_wheel[::-1], one[::-1])
    assert mirrored == pytest.approx(other, abs=2e-4 * other.max())
    assert left.lowering == pytest.approx(right.lowering, abs=1e-10)


def test_force_is_continuous_where_the_contact_moves_onto_the_flange() -> None:
    """Vertical minima jump from 34 to 38 mm on the wheel at y = 11.57; the force does not."""
    places = np.arange(11.56, 11.5905, 0.5e-3)
    forces = []
    for y in places:
        found = conformal_contact(s1002(float(y), 0.4575 + 0.38e-3))
        assert found is not None
        forces.append((found.vertical, found.outwards))
    steps = np.diff(np.array(forces), axis=0)
    assert np.all(steps > -50.0)  # monotone, but for the elements at the edge that come and go
    assert np.all(np.abs(steps) < 1.5e3)


def test_load_and_height_are_one_solution() -> None:
    pair = s1002(10.0, 0.4575)
    under_load = conformal_contact(pair, load=100e3)
    assert under_load is not None
    assert under_load.vertical == pytest.approx(100e3, rel=1e-6)
    lowered = conformal_contact(pair._replace(centre_z=pair.centre_z - under_load.lowering))
    assert lowered is not None
    assert lowered.vertical == pytest.approx(100e3, rel=2e-3)
    assert force_on_wheel(lowered) == pytest.approx([0.0, lowered.outwards, lowered.vertical])
    assert lowered.area > 1e-4
    assert conformal_contact(pair._replace(centre_z=pair.centre_z + 1e-3)) is None


def test_a_limit_of_pressure_spreads_the_contact() -> None:
    """y = 11.2 mm: from 91 to 116 mm2 at 1.8 GPa, the wheel 8 um lower (conformal_contact.md)."""
    pair = s1002(11.2, 0.4575)
    free, bounded = conformal_contact(pair, load=150e3), conformal_contact(pair, load=150e3, limit=1.8e9)
    assert free is not None
    assert bounded is not None
    assert free.max_pressure > 3.1e9
    assert bounded.max_pressure == pytest.approx(1.8e9)
    assert bounded.vertical == pytest.approx(150e3, rel=1e-4)
    assert free.area == pytest.approx(91e-6, rel=0.05)
    assert bounded.area == pytest.approx(116e-6, rel=0.05)
    assert bounded.lowering - free.lowering == pytest.approx(8e-6, abs=3e-6)


def test_overlap_of_a_cylinder_is_its_own() -> None:
    """Strips have the wheel's rolling radius: A = cos g/(2 R), and gaps grow by cos g with the height."""
    pair = s1002(5.0, 0.4575)
    overlap = conformal_overlap(pair, 0.5e-3)
    tread = np.abs(overlap.y_wheel) < 1e-3
    assert overlap.curvature[tread] == pytest.approx(0.5 / 0.4575, rel=2e-3)
    higher = conformal_overlap(pair._replace(centre_z=pair.centre_z + 1e-4), 0.5e-3)
    near = np.isfinite(overlap.overlap) & np.isfinite(higher.overlap)
    change = (overlap.overlap[near] - higher.overlap[near]) / np.cos(overlap.angle[near])
    assert change == pytest.approx(np.full(change.shape, 1e-4), abs=1e-12)
    assert higher.touching == pytest.approx(overlap.touching + 1e-4, abs=1e-12)


def test_bad_input_is_named() -> None:
    pair = s1002(10.0, 0.4575)
    with pytest.raises(ValueError, match="load = -1"):
        conformal_contact(pair, load=-1.0)
    with pytest.raises(ValueError, match="spacing"):
        conformal_contact(pair, load=1e5, spacing=(1e-3, 1.0))
    with pytest.raises(ValueError, match="side = 0"):
        s1002(0.0, 0.46, 0)
    found = conformal_contact(pair, load=1e5)
    assert found is not None
    with pytest.raises(ValueError, match="speed"):
        conformal_slip(found, np.zeros(3), np.zeros(3), 0.0)
