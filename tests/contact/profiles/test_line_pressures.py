"""The line's stand-in profiles as a grinding train and traffic leave them: radii, and pressures in curves.

The poses are those of runs with these shapes, friction 0.35, concrete track, coupled strips, in curves of 400
and 600 m: the loaded wagon at 60 km/h, the locomotive at 60 km/h, left-hand curves, the outer wheel right.
Where the flange carries, the wheel stands less far out than in the run, whose track gave way by 0.8 mm.
"""

import math
from typing import Any

import numpy as np
import pytest

from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.profiles.malmbanan import LINE_RAILS
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.contact.wheelset import WheelOnRail, wheel_on_rail, wheelset_equilibrium
from hh_exudyn.conventions import LEFT, RIGHT

RUNNING_BAND = 24e-3  # m from the axis: beyond lies the gauge corner, 60E1's from 26 mm on
LEAST_RADIUS = 60e-3  # m
WINDOW = (1.0e9, 2.0e9)  # Pa
LOAD = 150e3  # N
SPEED = 60.0 / 3.6  # m/s
RADIUS = {"WP4_like": 0.4575, "WPL9_like": 0.625}  # m, wagon and locomotive


def curvature(name: str) -> tuple[np.ndarray, np.ndarray]:
    """y [m] and lateral curvature [1/m] of an upright rail as kernels see it."""
    table = spline_table(rail_profile(name, 0.0))
    y = table.start + table.step * np.arange(table.z.size)
    return y, -table.second / (1.0 + table.slope**2) ** 1.5


@pytest.mark.parametrize("name", LINE_RAILS)
def test_no_radius_below_60_mm_in_the_running_band(name: str) -> None:
    y, found = curvature(name)
    band = np.abs(y) < RUNNING_BAND
    assert found[band].max() < 1.0 / LEAST_RADIUS
    assert found[band].min() > 0.0  # no hollow


def test_ground_corners_are_blunter_than_that_of_a_60e1() -> None:
    def sharpest(name: str) -> float:
        y, found = curvature(name)
        return float(found[(y > 28e-3) & (y < 33e-3)].max())

    assert sharpest("60E1") > sharpest("MB4_like") > sharpest("MB1_like")


def standing(wheel: str, rail: str, side: int, lateral: float, yaw: float, gauge: float) -> WheelOnRail:
    """One wheel under 150 kN; displacement [mm], yaw [mrad], gauge [mm]."""
    return wheel_on_rail(
        wheel_profile(wheel), rail_profile(rail, 1 / 30), side,
        lateral=1e-3 * lateral, yaw=1e-3 * yaw, roll=0.0, load=LOAD, gauge=1e-3 * gauge, radius=RADIUS[wheel],
        speed=SPEED, pitch_rate=SPEED / RADIUS[wheel], friction=0.35, normal="coupled_strips",
    )  # fmt: skip


POSES = (  # wheel, gauge, displacement to the left [mm], yaw [mrad]
    ("WP4_like", 1445.0, -8.95, 0.27),  # 400 m, second wheelset
    ("WP4_like", 1445.0, 1.40, 0.55),  # fourth
    ("WP4_like", 1443.0, -16.6, -0.33),  # 600 m, first
    ("WP4_like", 1443.0, -14.4, -0.23),  # third
    ("WPL9_like", 1445.0, -3.36, 0.44),  # 400 m, third
    ("WPL9_like", 1445.0, -2.59, 0.67),  # sixth
    ("WPL9_like", 1443.0, -10.8, -0.71),  # 600 m, second
)


@pytest.mark.parametrize(("wheel", "gauge", "lateral", "yaw"), POSES)
def test_treads_carry_with_1_to_2_gpa(wheel: str, gauge: float, lateral: float, yaw: float) -> None:
    """On MB1_like outside, on MB4_like (Norway) or 60E1 (Sweden) inside."""
    for side, rail in ((RIGHT, "MB1_like"), (LEFT, "MB4_like"), (LEFT, "60E1")):
        contacts = standing(wheel, rail, side, lateral, yaw, gauge).contacts
        assert len(contacts) == 1
        assert contacts[0].contact_angle < math.radians(12.0)
        assert WINDOW[0] < contacts[0].p_max < WINDOW[1], (rail, contacts[0].p_max)


@pytest.mark.parametrize(
    ("wheel", "lateral", "yaw", "flange"),
    [
        ("WP4_like", -18.24, -1.62, 45e3),
        ("WPL9_like", -12.43, -6.6, 100e3),
    ],
)
def test_the_leading_outer_wheel_stands_on_tread_and_flange_below_2_gpa(
    wheel: str, lateral: float, yaw: float, flange: float
) -> None:
    """With as much force on the flange as the first wheels of wagon and locomotive have in 400 m."""
    contacts = standing(wheel, "MB1_like", RIGHT, lateral, yaw, 1445.0).contacts
    tread, root = sorted(contacts, key=lambda contact: contact.contact_angle)
    assert tread.contact_angle < math.radians(12.0) < math.radians(60.0) < root.contact_angle
    assert root.normal_force == pytest.approx(flange, rel=0.25)
    for contact in (tread, root):
        assert WINDOW[0] < contact.p_max < WINDOW[1]
    assert root.y_rail - tread.y_rail > 18e-3  # the gauge corner lies free between them


@pytest.mark.parametrize("lateral", [0.0, 1e-3, -3e-3, 5e-3])
def test_a_wagon_wheelset_stands_on_60e1_at_1435_mm(lateral: float) -> None:
    wheel, rail = wheel_profile("WP4_like"), rail_profile("60E1", 1 / 30)
    common: dict[str, Any] = {
        "load": 2.0 * LOAD, "gauge": 1.435, "radius": 0.4575, "speed": SPEED,
        "pitch_rate": SPEED / 0.4575, "friction": 0.35, "normal": "coupled_strips",
    }  # fmt: skip
    found = wheelset_equilibrium(wheel, rail, wheel, rail, lateral=lateral, yaw=0.0, **common)
    mirrored = wheelset_equilibrium(wheel, rail, wheel, rail, lateral=-lateral, yaw=0.0, **common)
    assert found.height == pytest.approx(mirrored.height, abs=1e-9)
    for side in (found.left, found.right):
        assert abs(side.contacts[0].Q - LOAD) < 1.0
        assert WINDOW[0] < side.contacts[0].p_max < WINDOW[1]
    assert found.roll * lateral >= 0.0  # the wheel that rises to its flange is lifted
