"""The ore wagon in a curve of 220 m with a check rail at 41 mm, beside the same without: slow runs."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from energy_ledger import missing_energy

from hh_exudyn.case import Case
from hh_exudyn.conventions import BACK_TO_BACK
from hh_exudyn.log.store import Run
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle

GAUGE, FLANGEWAY, R0 = 1.440, 0.041, 0.4575
RADIUS, CANT, SPEED_KM_H = 220.0, 0.050, 40.0
STEADY = (80.0, 94.0)  # m, of every wheelset: the curve begins at 65 m

pytestmark = pytest.mark.slow


def case_of(step_ms: float = 0.4, **track: Any) -> Case:
    return Case(
        name="check rail",
        vehicle="iore_wagon_loaded",
        speed_km_h=SPEED_KM_H,
        friction=0.4,
        wheel_profile="S1002",
        track={
            "flexibility": "rigid",
            "sections": (
                {"kind": "straight", "length_m": 30.0, "gauge_mm": 1e3 * GAUGE},
                {"kind": "transition", "length_m": 35.0},
                {
                    "kind": "curve",
                    "length_m": 45.0,
                    "radius_m": RADIUS,
                    "hand": "left",
                    "cant_mm": 1e3 * CANT,
                    "gauge_mm": 1e3 * GAUGE,
                },
            ),
            **track,
        },
        contact={"cells": (20, 16)},
        integration={"step_ms": step_ms, "output_interval_ms": 4.0},
    )


def run(folder: Path, step_ms: float = 0.4, **track: Any) -> Run:
    return simulate(case_of(step_ms, **track), folder)


CHECK = {"flangeway_mm": 1e3 * FLANGEWAY, "below_radius_m": 300.0}


@pytest.fixture(scope="module")
def checked(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return run(tmp_path_factory.mktemp("checked") / "run", check_rail=CHECK)


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Run:
    return run(tmp_path_factory.mktemp("bare") / "run")


def wheel(of: Run, log: str, wheelset: int, side: int) -> dict[str, np.ndarray]:
    """Columns of one wheel in the steady curve."""
    table = of.read(log)
    columns = {name: table[name].to_numpy() for name in table.column_names}
    inside = (columns["s"] > STEADY[0]) & (columns["s"] < STEADY[1])
    mine = inside & (columns["wheelset"] == wheelset) & (columns["side"] == side)
    return {name: values[mine] for name, values in columns.items()}


def test_the_outer_flange_leaves_its_rail(checked: Run, bare: Run) -> None:
    for wheelset in (1, 3):
        guided = wheel(bare, "wheels", wheelset, -1)["Y"].mean()
        free = wheel(checked, "wheels", wheelset, -1)["Y"].mean()
        assert guided > 30e3 > 0.0 > free
        assert np.degrees(wheel(bare, "contact", wheelset, -1)["contact_angle"]).max() > 30.0
        assert np.degrees(wheel(checked, "contact", wheelset, -1)["contact_angle"]).max() < 5.0


def test_a_wider_flangeway_shares_the_guiding(bare: Run, tmp_path: Path) -> None:
    """At 49.5 mm flange and flange back touch at once, steadily, and guide as the flange alone does."""
    shared = run(tmp_path / "shared", check_rail=CHECK | {"flangeway_mm": 49.5})
    for wheelset in (1, 3):
        alone, outer = (wheel(of, "wheels", wheelset, -1)["Y"] for of in (bare, shared))
        back = wheel(shared, "check_rail", wheelset, 1)["force_y"]
        assert 10e3 < outer.mean() < alone.mean() - 10e3
        assert outer.mean() + back.mean() == pytest.approx(alone.mean(), rel=0.02)
        assert max(outer.std(), back.std()) < 3e3


def test_the_inner_wheel_stops_at_its_check_rail(checked: Run) -> None:
    """By hand: back at 680 mm, face at 720 - 41 mm; the leading end of the chord reaches |yaw| x further.

    The wheel's own middle is 680 mm times the yaw ahead of the wheelset's: there its rim is less deep.
    """
    for wheelset in (1, 3):
        state, back = wheel(checked, "wheels", wheelset, 1), wheel(checked, "check_rail", wheelset, 1)
        x, height = back["x_shift"].mean(), back["height"].mean()
        yaw, half = -state["angle_of_attack"].mean(), 0.5 * BACK_TO_BACK
        straight = 0.5 * GAUGE - FLANGEWAY - half / np.cos(yaw)
        beyond = np.hypot(x - half * yaw, R0 - height) - R0 - 9.519e-3  # of the end of the back's plane
        recess = 20.5e-3 - np.sqrt(20.5e-3**2 - max(beyond, 0.0) ** 2)
        reach = yaw * x - recess + 0.5 * x**2 / RADIUS  # the rail bends towards the wheel
        place = straight + reach - back["overlap"].mean()
        assert state["y_wheelset"].mean() == pytest.approx(place, abs=0.05e-3)
        # the overlap is mostly the yielding of what carries the check rail, 100 MN/m
        assert back["overlap"].mean() == pytest.approx(back["normal_force"].mean() / 100e6, rel=0.25)


def test_it_lifts_and_brakes_the_wheel_ahead_of_its_axle(checked: Run) -> None:
    back = wheel(checked, "check_rail", 1, 1)
    assert 0.10 < back["x_shift"].mean() < 0.16
    assert back["force_z"].mean() == pytest.approx(0.3 * back["normal_force"].mean(), rel=0.25)
    assert back["force_x"].mean() < 0.0 < back["power"].mean()
    assert set(checked.read("check_rail")["side"].to_pylist()) == {1}
    assert checked.read("check_rail")["s"].to_numpy().min() > 45.0


def test_all_lateral_forces_are_those_of_the_curve(checked: Run, bare: Run) -> None:
    """Sum over all wheels, check rail included: m (v^2/R - g cant/1.5), by 1 % of the weight."""
    mass = sum(body.mass for body in vehicle("iore_wagon_loaded").bodies)
    wanted = mass * ((SPEED_KM_H / 3.6) ** 2 / RADIUS - 9.81 * CANT / 1.5)
    for of in (checked, bare):
        total = sum(
            -side * wheel(of, "wheels", wheelset, side)["Y"].mean()
            for wheelset in (1, 2, 3, 4)
            for side in (1, -1)
        )
        assert total == pytest.approx(wanted, abs=0.01 * mass * 9.81)


def test_the_energy_ledger_holds_the_sliding_of_the_backs(checked: Run, bare: Run) -> None:
    """Guided by its backs alone the wagon takes several times the work, and the ledger says where it goes."""
    missing, work = missing_energy(vehicle("iore_wagon_loaded"), checked)
    assert abs(missing) < 0.005 * work
    assert work > 3.0 * missing_energy(vehicle("iore_wagon_loaded"), bare)[1]


def test_it_does_not_chatter_and_half_the_step_changes_nothing(checked: Run, tmp_path: Path) -> None:
    half = run(tmp_path / "half", step_ms=0.2, check_rail=CHECK)
    for wheelset in (1, 3):
        one, other = (wheel(of, "check_rail", wheelset, 1)["normal_force"] for of in (checked, half))
        assert one.std() < 3e3
        assert one.mean() == pytest.approx(other.mean(), rel=0.01)
        for side in (1, -1):
            assert wheel(checked, "wheels", wheelset, side)["Y"].std() < 3e3


def test_mirrored_it_is_mirrored(checked: Run, tmp_path: Path) -> None:
    other = simulate(case_of(check_rail=CHECK).mirrored(), tmp_path / "mirrored")
    one, image = wheel(checked, "check_rail", 1, 1), wheel(other, "check_rail", 1, -1)
    assert image["normal_force"].mean() == pytest.approx(one["normal_force"].mean(), rel=1e-6)
    assert image["force_y"].mean() == pytest.approx(-one["force_y"].mean(), rel=1e-6)
