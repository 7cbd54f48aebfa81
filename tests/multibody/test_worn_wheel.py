"""A measured worn wheel goes through a step of wear and runs."""

from pathlib import Path

import numpy as np
import pytest
from scanned_wheel import scan_of_hollow_wheel

from damage.evolution.profile_wear import ProfileWear
from damage.evolution.worn_profile import worn_profile
from hh_exudyn.case import Case, StraightCase, TrackCase
from hh_exudyn.contact.profile import read_wheel_profile
from hh_exudyn.contact.profiles.writer import write_profile
from hh_exudyn.multibody.simulate import simulate


def wears_and_runs(profile: Path, tmp_path: Path) -> None:
    """0.1 mm off the tread, then 20 m at 40 km/h: all wheels carry their load to the end."""
    y = np.linspace(-0.03, 0.03, 61)
    wear = ProfileWear(y, 1e-8 * np.cos(0.5 * np.pi * y / 0.03) ** 2)
    wheel, lost = worn_profile(read_wheel_profile(profile), wear, 10e6)
    assert lost == pytest.approx(0.1e-3, rel=0.05)
    write_profile(wheel, tmp_path / "worn.txt")
    case = Case(
        name="worn", speed_km_h=40, friction=0.3, wheel_profile=str(tmp_path / "worn.txt"),
        track=TrackCase(sections=(StraightCase(length_m=32, gauge_mm=1440),)),
    )  # fmt: skip
    run = simulate(case, tmp_path / "run")
    assert run.status["finished"]
    log = run.contact()
    end = np.asarray(log["time"]) == np.max(np.asarray(log["time"]))
    loads = np.asarray(log["normal_force"])[end]
    wheels = {(log["wheelset"][int(k)].as_py(), log["side"][int(k)].as_py()) for k in np.flatnonzero(end)}
    assert len(wheels) == 8
    assert loads.sum() == pytest.approx(8 * 147e3, rel=0.02)  # 30 t axle load


@pytest.mark.parametrize("name", ["worn_high_mileage.prw", "Car7216_0001r.whl"])
def test_a_measured_worn_wheel_wears_and_runs(name: str, shared_profiles: Path, tmp_path: Path) -> None:
    wears_and_runs(shared_profiles / name, tmp_path)


def test_a_scanned_worn_wheel_wears_and_runs(tmp_path: Path) -> None:
    wears_and_runs(scan_of_hollow_wheel(tmp_path / "hollow.whl"), tmp_path)
