"""A dip in the track: the wagon's bounce dies away by a constant step, as dry friction says, and stops."""

import math
from dataclasses import replace

import numpy as np
import pytest
from run_tables import table

from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.couplings import SpringNest, Wedge

DEPTH, LENGTH, BEGINS = 0.030, 8.0, 55.0  # m; behind the 50 m over which irregularities are faded in
FRICTION = 0.1  # of the wedges: low, so that the bounce lasts


def lightly_damped(wagon):
    """The wagon with wedges of little friction, and nests of set A: one stage, and here without dampers.

    With a toe the slope slips as well, a fiftieth of the way: it is smooth here, as in the statics below.
    """
    light = {"friction": FRICTION, "slope_friction": 0.0, "preload": 2000.0}
    couplings = []
    for c in wagon.couplings:
        match c:
            case Wedge():
                couplings.append(replace(c, **light))
            case SpringNest():
                couplings.append(replace(c, first_stiffness=c.second_stiffness, vertical_damping=0.0))
            case _:
                couplings.append(c)
    return replace(wagon, couplings=tuple(couplings))


@pytest.fixture(scope="module")
def bounce(demo, tmp_path_factory):
    """Time and height of the car body against its last height [m] after the dip, and the wagon."""
    folder = tmp_path_factory.mktemp("dip")
    s = np.arange(0.0, 170.0, 0.25)
    inside = (s > BEGINS) & (s < BEGINS + LENGTH)
    level = np.where(inside, -DEPTH / 2 * (1 - np.cos(2 * np.pi * (s - BEGINS) / LENGTH)), 0.0)
    rows = [f"{x:.2f},{1e3 * z:.4f},0,0,0" for x, z in zip(s, level, strict=True)]
    (folder / "dip.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    case = demo.with_changes(
        track={
            "sections": [{"kind": "straight", "length_m": 180.0, "gauge_mm": 1435.0}],
            "irregularity": str(folder / "dip.csv"),
            "sleeper_passing": False,
        }
    )
    wagon = lightly_damped(vehicle(case.vehicle))
    motion = table(simulate(case, folder / "run", vehicle=wagon), "motion")
    mine = motion.body == "car_body"
    behind = motion.s[mine] > 11.3 + BEGINS + LENGTH + 10.29
    time, height = motion.time[mine][behind], motion.z[mine][behind]
    return time, height - height[-1], wagon


def turning_points(time, height, least=1e-3):
    """Times and heights where the motion turns, larger than `least` [m]."""
    turns = np.flatnonzero(np.diff(np.sign(np.diff(height)))) + 1
    keep = turns[np.abs(height[turns]) > least]
    return time[keep], height[keep]


def test_deflection_and_bounce_of_set_a(bounce):
    """Sources: vehicles.md 1.1: 56.5 mm and 2.10 Hz with its springs all at work from the start."""
    time, height, wagon = bounce
    nest = next(c for c in wagon.couplings if isinstance(c, SpringNest))
    wedge = next(c for c in wagon.couplings if isinstance(c, Wedge))
    sprung = sum(body.mass for body in wagon.bodies if body.kind in ("car_body", "bolster"))
    stiffness = 4 * (nest.second_stiffness + 2 * wedge.spring_stiffness)
    deflection = (sprung * 9.81 - 8 * wedge.preload) / stiffness
    assert deflection == pytest.approx(0.0565, rel=5e-3)  # its 110.4 t sprung are here 112.4 t, and preloaded
    at, _ = turning_points(time, height)
    frequency = 0.5 / np.diff(at[:4]).mean()
    # the track under the wheels takes a few per cent off the springs' 2.10 Hz
    assert frequency == pytest.approx(math.sqrt(stiffness / sprung) / (2 * math.pi), rel=0.06)


def test_bounce_dies_away_by_a_constant_step(bounce):
    """Each whole cycle takes the same off the amplitude, by the statics of the wedges, until they stick."""
    time, height, wagon = bounce
    _, turns = turning_points(time, height)
    swings = np.abs(np.diff(turns))  # from turn to turn: no middle is needed
    assert len(swings) >= 4
    steps = swings[:-2] - swings[2:]  # one whole cycle apart
    wedges = [c for c in wagon.couplings if isinstance(c, Wedge)]
    c = wedges[0]
    force = c.spring_stiffness * (c.compression + 0.0565)
    nest = next(c for c in wagon.couplings if isinstance(c, SpringNest))
    stiffness = 4 * (nest.second_stiffness + 2 * c.spring_stiffness)
    friction = sum(FRICTION * c.normal_force(force, motion) for motion in (1, -1)) / 2
    # the amplitude loses 2 F / k each half cycle, so the swing from turn to turn 8 F / k in a whole one
    expected = 8 * len(wedges) * friction / stiffness
    assert steps == pytest.approx(expected, rel=0.05)
    assert swings[2] / swings[0] > 1.5 * swings[4] / swings[2]  # no exponential decay
