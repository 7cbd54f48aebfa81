"""A free wheelset on rigid track follows Klingel's wavelength."""

import numpy as np
import pytest
from run_tables import table

from hh_exudyn.contact.profile import gauge_point, rail_profile
from hh_exudyn.multibody.free_wheelset import CONICITY, conical_wheel, free_wheelset
from hh_exudyn.multibody.simulate import simulate


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
