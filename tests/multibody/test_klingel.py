"""A free wheelset on rigid track follows Klingel's wavelength."""

import numpy as np
import pytest
from run_tables import table

from hh_exudyn.contact.profile import gauge_point, rail_profile
from hh_exudyn.multibody.simulate import simulate
from vehicles.description import Body, Coupler, Vehicle, Wheelset

CONICITY, RADIUS = 0.05, 0.46


def free_wheelset() -> Vehicle:
    """A wheelset pulled at its axle's middle: nothing holds it laterally or in yaw."""
    body = Body("wheelset_1", "wheelset", 2000.0, (1000.0, 120.0, 1000.0), (0.0, 0.0, RADIUS))
    train = Coupler(("wheelset_1",) * 2, ((0.0, 0.0, RADIUS), (0.0, 0.0, RADIUS)), stiffness=2e4, damping=1e4)
    return Vehicle("free_wheelset", (body,), (), (Wheelset("wheelset_1", 1, RADIUS),), train, {})


def conical_wheel(path):
    """A cone of 1:20 that bends over 12 mm into a 70 degree flange, two columns in mm."""
    y = np.arange(-60.0, 45.0, 0.1)
    bend = np.clip((y - 28.0) / 12.0, 0.0, 1.0)
    slope = CONICITY + (np.tan(np.radians(70)) - CONICITY) * bend**2 * (3 - 2 * bend)
    z = -np.concatenate([[0.0], np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(y))])
    z -= np.interp(0.0, y, z)
    np.savetxt(path, np.column_stack([y, z]), fmt="%.5f")
    return str(path)


def test_free_wheelset_runs_in_klingels_wave(demo, runs, tmp_path):
    """L = 2 pi sqrt(r0 e / conicity) within 2 %, e half the distance of the contacts (Klingel 1883).

    A gentle curve puts the wheelset off the middle; on the straight behind it swings freely. Rails of 1:20
    carry the cone in the middle of their heads.
    """
    section = {"gauge_mm": 1435.0}
    sections = [
        {"kind": "straight", "length_m": 10.0, **section},
        {"kind": "transition", "length_m": 3.0},
        {"kind": "curve", "length_m": 8.0, "radius_m": 3000.0, "hand": "left", **section},
        {"kind": "transition", "length_m": 3.0},
        {"kind": "straight", "length_m": 80.0, **section},
    ]
    case = demo.with_changes(
        speed_km_h=15.0,
        wheel_profile=conical_wheel(tmp_path / "cone.txt"),
        track={"sections": sections, "inclination": "1:20", "flexibility": "rigid"},
    )
    contact = table(simulate(case, runs / "klingel", vehicle=free_wheelset()), "contact")
    left = (contact.side == 1) & (contact.s > 26.0)
    s, y = contact.s[left], contact.y_wheelset[left]
    swing = y - y.mean()
    rising = np.flatnonzero((swing[:-1] < 0.0) & (swing[1:] >= 0.0))
    crossings = s[rising] - swing[rising] * np.diff(s)[rising] / np.diff(swing)[rising]
    wavelength = np.diff(crossings).mean()

    rail = rail_profile("60E1", inclination=1 / 20)
    half_distance = case.track.sections[0].gauge_mm / 2000 + gauge_point(rail) - contact.y_rail[left].mean()
    klingel = 2 * np.pi * np.sqrt(contact.rolling_radius[left].mean() * half_distance / CONICITY)
    assert 5e-4 < np.abs(swing).max() < 8e-3  # free of the flanges, and not round-off
    assert wavelength == pytest.approx(klingel, rel=0.02)
