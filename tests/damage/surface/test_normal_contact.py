"""Damage by the strips of a run and by the half-space, on states whose poses are known."""

import math
from collections.abc import Callable
from dataclasses import astuple, fields, replace
from typing import Any

import numpy as np
import pyarrow
import pytest

from damage.patch_strips import FLANGE, TREAD
from damage.report import NOT_EXTRAPOLATED, DamageReport, assess
from damage.surface import accumulate as module
from damage.surface.normal_contact import NORMAL_CONTACTS, chosen_contact
from damage.surface.wheel_surface import WheelSurface
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.types import WheelRailModel
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.contact.wheelset import wheel_on_rail
from hh_exudyn.conventions import LEFT, RIGHT

R0 = 0.46
WHEEL, RAIL = wheel_profile("S1002"), rail_profile("60E1", 1.0 / 30.0)
TREAD_STATE = {"lateral": 1e-3, "yaw": 2e-3}
ROOT_STATE = {"lateral": 6.2e-3, "yaw": 5e-3}  # a left wheel: its flange root
CONFORMAL_STATE = {"lateral": 6.6e-3, "yaw": 5e-3}  # root and flange in one patch
COLUMNS = (
    "y_wheel", "contact_angle", "rolling_radius", "normal_force", "a", "b", "p_max", "nu_x", "nu_y", "phi",
    "friction", "speed", "force_x", "force_y", "moment_z", "Q", "Y", "angle_of_attack", "centre_y",
    "centre_z", "roll", "s",
)  # fmt: skip


@pytest.fixture(scope="module")
def contact() -> WheelRailModel:
    return wheel_rail_model(WHEEL, WHEEL, RAIL, RAIL, nominal_radius=R0, normal="coupled_strips")


def log_of(make_log: Callable[..., pyarrow.Table], side: int, poses: list[dict[str, float]]) -> pyarrow.Table:
    """A contact log of one wheel at rest in its poses, one output time each."""
    rows: dict[str, list[float]] = {name: [] for name in ("time", "side", "patch", *COLUMNS)}
    for number, pose in enumerate(poses):
        given: dict[str, Any] = {"roll": 0.0, "load": 110e3, "radius": R0, "speed": 20.0, "friction": 0.4}
        given |= {"pitch_rate": 20.0 / R0 * 1.001, "normal": "coupled_strips"} | pose
        for patch, state in enumerate(wheel_on_rail(WHEEL, RAIL, side, **given).contacts):
            rows["time"].append(0.1 * number)
            rows["side"].append(side)
            rows["patch"].append(patch)
            for name in COLUMNS:
                rows[name].append(getattr(state, name))
    return make_log(**{name: np.array(values) for name, values in rows.items()})


def energy(report: DamageReport) -> float:
    """Energy per metre rolled in all bins, times their area [N], of one wheel."""
    surface = report.surface
    turn = 2.0 * math.pi * R0
    return float(surface.energy_density[0].sum() * surface.grid.step / surface.distance * turn)


def solve(log: pyarrow.Table, contact: WheelRailModel | None, **options: Any) -> DamageReport:
    return assess(log, profile=WHEEL, contact=contact, **options)


@pytest.mark.parametrize("side", [LEFT, RIGHT])
@pytest.mark.parametrize(("normal", "allowed"), [("strips", 0.05), ("halfspace", 0.03)])
def test_energy_on_the_wheel_is_the_wear_number_of_the_log(
    side: int, normal: str, allowed: float, make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    report = solve(log_of(make_log, side, [TREAD_STATE]), contact, normal=normal)
    assert report.normal_contact == normal
    assert energy(report) == pytest.approx(float(report.surface.mean_wear_number[0]), rel=allowed)


@pytest.mark.parametrize("side", [LEFT, RIGHT])
def test_strips_are_those_of_the_log(
    side: int, make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    """Their pressure is the logged one, and both sides of a mirrored pose are alike."""
    log = log_of(make_log, side, [{name: side * value for name, value in ROOT_STATE.items()}])
    report = solve(log, contact)
    assert report.normal_contact == "strips"
    assert report.surface.max_pressure[0] == pytest.approx(log["p_max"].to_numpy().max(), rel=2e-3)
    left = solve(log_of(make_log, LEFT, [ROOT_STATE]), contact)
    np.testing.assert_allclose(report.surface.depth, left.surface.depth, rtol=1e-6, atol=1e-20)


def test_strips_and_half_space_agree_on_a_tread(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    log = log_of(make_log, LEFT, [TREAD_STATE])
    by = {normal: solve(log, contact, normal=normal).surface for normal in NORMAL_CONTACTS}
    exact = by["halfspace"]
    for normal, worn, pressure in (("strips", 0.08, 0.04), ("ellipse", 0.15, 0.05)):
        assert by[normal].worn_volume.sum() == pytest.approx(exact.worn_volume.sum(), rel=worn), normal
        assert by[normal].max_pressure[0] == pytest.approx(exact.max_pressure[0], rel=pressure), normal


def test_conformal_patch_is_worn_over_its_strips(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    """From root to flange, 12 mm along the arc, where the half-space has it, bin by bin.

    The equivalent ellipse, in the plane of the resultant, wears most in its middle; here the ends wear most.
    """
    log = log_of(make_log, LEFT, [CONFORMAL_STATE])
    strips, exact, ellipse = (
        solve(log, contact, normal=normal).surface.depth[0] for normal in ("strips", "halfspace", "ellipse")
    )
    assert np.count_nonzero(strips) >= 12
    assert np.abs(strips - exact).max() < 0.2 * exact.max()
    assert np.abs(strips - exact).sum() < 0.18 * exact.sum()  # 0.152
    assert np.abs(ellipse - exact).sum() > 0.3 * exact.sum()


def test_patches_of_one_wheel_press_on_each_other(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    """Two patches: the half-space keeps each row's force, and has no third contact between them."""
    log = log_of(make_log, LEFT, [{"lateral": 5.8e-3, "yaw": 0.0}])
    assert log.num_rows == 2
    report = solve(log, contact, normal="halfspace")
    touched = np.flatnonzero(report.surface.contact_time[0].sum(axis=0) > 0.0)
    assert np.count_nonzero(np.diff(touched) > 1) == 1
    strips = solve(log, contact, normal="strips").surface
    np.testing.assert_allclose(report.surface.max_pressure, strips.max_pressure, rtol=0.1)


def test_pressure_limit_keeps_the_force(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    log = log_of(make_log, LEFT, [TREAD_STATE])
    free = solve(log, contact, normal="halfspace").surface
    limit = 0.7 * float(free.max_pressure[0])
    held = solve(log, contact, normal="halfspace", pressure_limit=limit).surface
    assert held.max_pressure[0] == pytest.approx(limit, rel=1e-12)
    assert (held.contact_time[0] > 0).sum() >= (free.contact_time[0] > 0).sum()
    # the creep force is near its limit, friction times the force, which is kept
    assert held.energy.sum() == pytest.approx(free.energy.sum(), rel=0.1)
    assert held.fatigue_share[0, TREAD] <= free.fatigue_share[0, TREAD]


@pytest.mark.parametrize("normal", ["strips", "halfspace"])
def test_number_of_threads_does_not_matter(
    normal: str,
    make_log: Callable[..., pyarrow.Table],
    contact: WheelRailModel,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(module, "BLOCK_ROWS", 2)
    monkeypatch.setattr(module, "HALFSPACE_ROWS", 2)
    poses = [{"lateral": 1e-3 + 2e-4 * k, "yaw": 1e-3} for k in range(5)]
    log = log_of(make_log, LEFT, poses)
    done: list[int] = []
    one = solve(log, contact, normal=normal, threads=1, progress=done.append).surface
    assert done[-1] == log.num_rows
    assert done == sorted(done)
    three = solve(log, contact, normal=normal, threads=3).surface
    for name in (field.name for field in fields(WheelSurface)):
        first, other = getattr(one, name), getattr(three, name)
        assert np.array_equal(first, other) if isinstance(first, np.ndarray) else first == other, name


def test_start_from_the_state_before_changes_nothing(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    log = log_of(make_log, LEFT, [{"lateral": 2e-3 + 5e-4 * k, "yaw": 2e-3} for k in range(4)])
    warm = solve(log, contact, normal="halfspace").surface
    monkeypatch.setattr(module, "HALFSPACE_ROWS", 1)
    cold = solve(log, contact, normal="halfspace").surface
    np.testing.assert_allclose(warm.energy.sum(), cold.energy.sum(), rtol=1e-3)
    np.testing.assert_allclose(warm.worn_volume.sum(), cold.worn_volume.sum(), rtol=1e-2)
    np.testing.assert_allclose(warm.max_pressure, cold.max_pressure, rtol=2e-3)


def test_ellipse_by_the_half_space(make_log: Callable[..., pyarrow.Table]) -> None:
    """A log without poses: its ellipses, at FaStrip's own error."""
    log = make_log(nu_x=np.array([1e-3, 1.1e-3]), time=np.array([0.0, 0.1]))
    exact, fast = (assess(log, cells=(30, 30), theory=theory) for theory in ("halfspace", "fastrip"))
    assert exact.normal_contact == fast.normal_contact == "ellipse"
    assert exact.surface.energy.sum() == pytest.approx(fast.surface.energy.sum(), rel=0.05)
    assert exact.surface.work[0] == fast.surface.work[0]


def test_seizure_on_the_flange_is_marked(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    report = solve(log_of(make_log, LEFT, [ROOT_STATE | {"load": 150e3}]), contact)
    (row,) = report.to_table().to_pylist()
    seized = report.surface.pressure_by_part[0, FLANGE] > report.model.seizure_pressure
    assert seized
    # of the steel: 235 HB of ER7; it was 0.8 x 2.65 GPa while Archard's law had a hardness of its own
    assert report.model.seizure_pressure == pytest.approx(0.8 * 235 * 9.80665e6, rel=1e-9)
    assert row["flange_wear_note"] == NOT_EXTRAPOLATED
    assert row["normal_contact"] == "strips"
    assert report.distance_table(1e6).to_pylist()[0]["flange_wear_note"] == NOT_EXTRAPOLATED
    lower = replace(report, surface=replace(report.surface, pressure_by_part=np.full((1, 2), 1e9)))
    assert lower.to_table().to_pylist()[0]["flange_wear_note"] == ""


@pytest.mark.parametrize(
    ("given", "known", "message"),
    [
        ({"normal": "hertz"}, True, "normal = 'hertz'; known: strips, ellipse, halfspace"),
        ({"normal": "strips"}, False, "needs the profiles of the run"),
        ({"normal": "halfspace"}, False, "needs the profiles of the run"),
        ({"normal": "strips", "theory": "fastsim"}, True, "goes with theory fastrip, not 'fastsim'"),
        ({"normal": "halfspace", "theory": "fastrip"}, True, "goes with theory halfspace, not 'fastrip'"),
        ({"pressure_limit": 1e9}, True, "pressure_limit = 1000 MPa needs normal = 'halfspace', not 'strips'"),
        ({"normal": "halfspace", "pressure_limit": -1.0}, True, "pressure_limit = -1.0 Pa must be > 0 Pa"),
    ],
)
def test_refusals(
    given: dict[str, Any],
    known: bool,
    message: str,
    make_log: Callable[..., pyarrow.Table],
    contact: WheelRailModel,
) -> None:
    with pytest.raises(ValueError, match=message):
        assess(make_log(), contact=contact if known else None, **given)


def test_choice_of_the_contact(contact: WheelRailModel) -> None:
    hertz = contact._replace(normal=1)
    assert chosen_contact(None, None, contact) == ("strips", "fastrip")
    assert chosen_contact(None, None, hertz) == ("ellipse", "fastrip")
    assert chosen_contact(None, None, None) == ("ellipse", "fastrip")
    assert chosen_contact(None, "halfspace", hertz) == ("halfspace", "halfspace")
    assert chosen_contact(None, "halfspace", None) == ("ellipse", "halfspace")
    assert chosen_contact(None, "fastsim", contact) == ("ellipse", "fastsim")
    with pytest.raises(ValueError, match="made without coupled strips"):
        chosen_contact("strips", None, hertz)


def test_poses_of_other_profiles_are_refused(
    make_log: Callable[..., pyarrow.Table], contact: WheelRailModel
) -> None:
    """A wheel in the air above its rail: the log is not of these profiles."""
    log = log_of(make_log, LEFT, [TREAD_STATE])
    height = log["centre_z"].to_numpy() + 5e-3
    lifted = log.set_column(log.schema.get_field_index("centre_z"), "centre_z", pyarrow.array(height))
    with pytest.raises(ValueError, match="do not touch at y_wheel"):
        solve(lifted, contact)
    without = log.drop_columns(["centre_z"])
    with pytest.raises(ValueError, match="centre_z"):
        solve(without, contact)
    assert len(astuple(solve(without, None).bad_rows)) > 0  # the ellipse needs no pose
