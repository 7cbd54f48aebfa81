"""Threshold counting by hand: areas of ellipses, Burstow's limits, energy of the creepages."""

import math
from collections.abc import Callable

import numpy as np
import pyarrow
import pytest

from damage.material import ER7, WheelMaterial
from damage.model import DamageModel
from damage.patch_strips import FLANGE, TREAD
from damage.rcf.burstow import Burstow
from damage.rcf.miner import kabo_damage
from damage.rcf.subsurface import LEVEL_STEP, LEVELS, level_of, revolutions_above
from damage.report import assess
from damage.surface.accumulate import accumulate
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.tables import level_table
from damage.surface.wheel_surface import WheelSurface
from hh_exudyn.contact.tangential.api import traction_field

MakeLog = Callable[..., pyarrow.Table]
A, B, LOAD, RADIUS, SPEED, FRICTION = 8e-3, 6e-3, 120e3, 0.46, 15.0, 0.4
STATE = {"a": A, "b": B, "normal_force": LOAD, "rolling_radius": RADIUS, "speed": SPEED, "friction": FRICTION}
SLIDING = STATE | {"nu_x": 0.06}  # full slip: E = mu p nu_x
P0 = 1.5 * LOAD / (math.pi * A * B)
TURNS = SPEED / (2.0 * math.pi * RADIUS)  # a log of one time stands for a second
BURSTOW = Burstow.of(ER7)
FREE = Burstow(520e6, 880e6, creepages=(0.5, 0.6, 1.0), area=1.0)  # thresholds out of reach


def judged(table: pyarrow.Table, **options: object) -> WheelSurface:
    return accumulate(table, DamageModel(**{"burstow": BURSTOW, "cells": (80, 80)} | options))  # type: ignore[arg-type]


def total(numbers: np.ndarray, surface: WheelSurface) -> float:
    """Integral over the bins [m^2]."""
    return float(numbers.sum()) * surface.grid.step * surface.patch_grid.step


@pytest.mark.parametrize("theory", ["fastrip", "full_slip", "fastsim_elliptic"])
@pytest.mark.parametrize("angle", [0.0, 0.2])
def test_full_slip_counts_the_ellipse_where_friction_exceeds_k(
    make_log: MakeLog, theory: str, angle: float
) -> None:
    """mu p0 sqrt(1 - r^2) > k inside r^2 = 1 - (k / mu p0)^2: the ellipse pi a b r^2, each revolution."""
    share = 1.0 - (ER7.shear_yield / (FRICTION * P0)) ** 2
    assert 0.1 < share < 0.9
    surface = judged(make_log(**SLIDING, contact_angle=angle, y_wheel=3e-4), theory=theory, burstow=FREE)
    area = math.pi * A * B * share * math.cos(angle)  # over the lateral coordinate
    assert total(surface.rcf_number, surface) == pytest.approx(TURNS * area, rel=3e-3)
    np.testing.assert_array_equal(surface.corrected_rcf_number, surface.rcf_number)
    assert surface.rcf_number[0, TREAD].max() == pytest.approx(TURNS)  # inside, every revolution counts
    lateral, along = np.nonzero(surface.rcf_number[0, TREAD])
    half = math.sqrt(share)
    reach = 1e3 * A * half
    assert surface.patch_grid.edges[along.min()] * 1e3 == pytest.approx(-reach, abs=1.0)
    assert surface.patch_grid.edges[along.max() + 1] * 1e3 == pytest.approx(reach, abs=1.0)
    across = surface.grid.edges[[lateral.min(), lateral.max() + 1]] - 3e-4
    np.testing.assert_allclose(across, [-half * B * math.cos(angle), half * B * math.cos(angle)], atol=1e-3)


def test_the_area_does_not_depend_on_the_bins(make_log: MakeLog) -> None:
    """Nor do coarse cells, longer than the bins are."""
    log = make_log(**STATE, nu_x=2e-3, nu_y=-1e-3, phi=0.4)
    for cells in ((80, 80), (7, 9)):
        one = judged(log, cells=cells)
        other = judged(
            log,
            cells=cells,
            grid=LateralGrid(-0.0303, 0.7e-3, 90),
            patch_grid=PatchGrid(-0.0101, 0.37e-3, 60),
        )
        for name in ("rcf_number", "corrected_rcf_number", "energy"):
            area = total(getattr(one, name), one)
            assert area > 0.0
            assert total(getattr(other, name), other) == pytest.approx(area, rel=1e-12)


@pytest.mark.parametrize("theory", ["fastrip", "fastsim"])
def test_energy_is_that_of_the_creepages(make_log: MakeLog, theory: str) -> None:
    """(3.34) summed over the patch is F.nu + M phi of the field's own forces, per metre rolled."""
    creepage = {"nu_x": 1e-3, "nu_y": -2e-3, "phi": 0.5}
    surface = judged(make_log(**STATE, **creepage), theory=theory)
    field = traction_field(theory, A, B, LOAD, *creepage.values(), FRICTION, cells=(80, 80))
    area = 4.0 * A * B / 80**2 * np.sqrt(1.0 - (field.y[:, :1] / B) ** 2)
    rigid_x, rigid_y = 1e-3 - 0.5 * field.y, -2e-3 + 0.5 * field.x
    lost = -float(np.sum((field.q_x * rigid_x + field.q_y * rigid_y) * area))
    assert total(surface.energy, surface) == pytest.approx(TURNS * lost, rel=1e-10)
    # and on the wheel: density times area of the surface is the work
    around = 2.0 * math.pi * RADIUS
    work = float(surface.energy_density.sum()) * surface.grid.step * around
    assert work == pytest.approx(lost * SPEED, rel=1e-10)


def test_thresholds_of_er7() -> None:
    """Equation 3.33 with 520 and 880 MPa and 100 mm^2: 40, 121 and 404 N."""
    np.testing.assert_allclose(BURSTOW.energies, [40.4, 121.2, 404.1], atol=0.05)


def corrected(table: pyarrow.Table, burstow: Burstow) -> float:
    """Share of the counts that the correction leaves."""
    surface = judged(table, burstow=burstow)
    return float(surface.corrected_rcf_number.sum() / surface.rcf_number.sum())


def threshold(low: float, high: float, area: float = 1.0) -> Burstow:
    """Limits with E_1/A = low and E_2/A = high [Pa]."""
    strength = 1400e6 / (2.0 * math.sqrt(3.0))
    return Burstow(520e6, 880e6, creepages=(low / strength, high / strength, 1.0), area=area)


def test_correction_between_its_limits(make_log: MakeLog) -> None:
    """In full slip E = mu p nu: unchanged below E_1, nothing above E_2, by hand in between."""
    log = make_log(**SLIDING)
    least, most = ER7.shear_yield * 0.06, FRICTION * P0 * 0.06  # E where |q| = k, and in the middle
    assert corrected(log, threshold(1.01 * most, 1.02 * most)) == pytest.approx(1.0)
    assert corrected(log, threshold(0.5 * least, 0.99 * least)) == 0.0
    # a count of (most - E)/(most - least) over the ellipse: E = most sqrt(1 - r^2), r^2 uniform in the area
    inner = 1.0 - (least / most) ** 2
    mean = most * (1.0 - (least / most) ** 3) * 2.0 / 3.0 / inner
    expected = (most - mean) / (most - least)
    assert corrected(log, threshold(least, most)) == pytest.approx(expected, rel=0.01)


def test_a_patch_above_the_global_limit_counts_nothing(make_log: MakeLog) -> None:
    """The patch loses mu N nu = 2880 N; sticking cells count no more than slipping ones."""
    log = make_log(**SLIDING)
    energy = FRICTION * LOAD * 0.06
    most = FRICTION * P0 * 0.06
    for factor, left in ((1.02, 1.0), (0.98, 0.0)):
        burstow = threshold(2.0 * most, 3.0 * most, factor * energy / (3.0 * most))
        assert burstow.energies[1] == pytest.approx(factor * energy)
        assert corrected(log, burstow) == left


def test_cells_that_stick_are_not_corrected(make_log: MakeLog) -> None:
    """With E_2 below every energy only sticking cells remain, and those are ahead of the slipping ones."""
    log = make_log(**STATE, nu_x=2.5e-3)
    surface = judged(log, burstow=threshold(1.0, 2.0, area=1e12))
    kept, counted = surface.corrected_rcf_number[0, TREAD], surface.rcf_number[0, TREAD]
    assert 0.0 < kept.sum() < counted.sum()
    middle = 0.5 * (surface.patch_grid.edges[1:] + surface.patch_grid.edges[:-1])
    assert np.average(middle, weights=kept.sum(axis=0)) > np.average(
        middle, weights=(counted - kept).sum(axis=0)
    )
    field = traction_field("fastrip", A, B, LOAD, 2.5e-3, 0.0, 0.0, FRICTION, cells=(80, 80))
    area = 4.0 * A * B / 80**2 * np.sqrt(1.0 - (field.y / B) ** 2)
    beyond = np.hypot(field.q_x, field.q_y) > ER7.shear_yield
    sticks = beyond & (field.slip_x == 0.0) & (field.slip_y == 0.0)
    assert total(kept, surface) == pytest.approx(TURNS * area[sticks].sum(), rel=1e-10)


@pytest.mark.parametrize("side", [1, -1])
def test_flange_is_apart_and_sides_mirror(make_log: MakeLog, side: int) -> None:
    state = STATE | {"nu_x": 1e-3, "nu_y": side * 2e-3, "phi": side * 0.6, "side": side, "y_wheel": 0.01}
    tread, flange = judged(make_log(**state)), judged(make_log(**state, contact_angle=0.5))
    assert tread.rcf_number[:, FLANGE].sum() == 0.0
    assert flange.rcf_number[:, TREAD].sum() == 0.0
    assert flange.rcf_number[:, FLANGE].sum() > 0.0
    left = judged(make_log(**state | {"nu_y": 2e-3, "phi": 0.6, "side": 1}))
    np.testing.assert_allclose(tread.rcf_number, left.rcf_number, atol=1e-9 * left.rcf_number.max())


def test_miner_sum_by_hand(make_log: MakeLog) -> None:
    """In full slip FI_local = mu - k/p is largest at x = 0: mu - k/p0 in the middle strip; FI^4/10.04."""
    index = FRICTION - ER7.shear_yield / P0
    assert index > 0.1
    assert float(kabo_damage(index)) == pytest.approx(index**4 / 10.04, rel=1e-3)
    assert kabo_damage(-1.0) == kabo_damage(-math.inf) == 0.0
    surface = judged(make_log(**SLIDING), grid=LateralGrid(-0.07, 0.1e-3, 1400))
    assert surface.crack_damage[0, TREAD].max() == pytest.approx(TURNS * index**4 / 10.04, rel=5e-3)
    assert surface.ratchet_revolutions[0, TREAD].max() == pytest.approx(TURNS)
    assert surface.contact_revolutions[0, TREAD].max() == pytest.approx(TURNS)


def test_global_miner_sum_by_hand(make_log: MakeLog) -> None:
    """FI_surf = Q/P - 2 pi a b k / (3 P) (3.16): the same damage in every bin that the patch covers."""
    index = FRICTION - 2.0 / 3.0 * math.pi * A * B * ER7.shear_yield / LOAD
    surface = judged(make_log(**SLIDING, force_x=-FRICTION * LOAD), grid=LateralGrid(-0.07, 0.1e-3, 1400))
    damage = surface.global_crack_damage[0, TREAD]
    assert damage.max() == pytest.approx(TURNS * (index / 1.78) ** 4, rel=1e-12)
    inside = np.abs(surface.grid.centres - surface.grid.centres[damage > 0.0].mean()) < B - 0.1e-3
    np.testing.assert_allclose(damage[inside], damage.max(), rtol=1e-12)
    assert damage.sum() * surface.grid.step == pytest.approx(2.0 * B * damage.max(), rel=1e-12)
    assert (damage >= surface.crack_damage[0, TREAD] * (1.0 - 1e-12)).all()  # local: largest in the middle
    twice = surface + surface.scaled(3.0 * surface.distance)
    np.testing.assert_allclose(twice.global_crack_damage, 4.0 * surface.global_crack_damage, rtol=1e-15)


def test_revolutions_by_level_of_the_subsurface_index(make_log: MakeLog) -> None:
    """FI_sub = P (1 + (Q/P)^2) / (4 pi a b) = p0/6 (1 + mu^2) in full slip, in its level of 25 MPa."""
    index = P0 / 6.0 * (1.0 + FRICTION**2)
    surface = judged(make_log(**SLIDING, force_x=-FRICTION * LOAD))
    turns = surface.subsurface_revolutions[0, TREAD]
    assert turns[int(index / LEVEL_STEP)] == turns.sum() == pytest.approx(TURNS)
    assert surface.subsurface_revolutions[0, FLANGE].sum() == 0.0
    for limit, above in ((225e6, TURNS), (250e6, 0.0), (230e6, 0.8 * TURNS)):
        assert revolutions_above(turns, limit) == pytest.approx(above)
    assert 225e6 < index < 250e6
    assert level_of([-1.0, 0.0, 24.9e6, 25e6, 5e9]).tolist() == [0, 0, 0, 1, LEVELS - 1]
    table = level_table(surface).to_pylist()
    assert [(row["part"], row["level_Pa"]) for row in table] == [("tread", 225e6)]
    with pytest.raises(ValueError, match=r"fatigue_limit = 2000000000\.0 Pa, allowed above 0 to 9\.75e\+08"):
        revolutions_above(turns, 2e9)
    with pytest.raises(ValueError, match=r"revolutions of shape \(3,\), needed \(\.\.\., 40\)"):
        revolutions_above(np.zeros(3), 2e8)


def test_global_and_local_sum_differ_in_partial_slip(make_log: MakeLog) -> None:
    """FI_surf is below zero where a part of the patch slips at mu p > k: then the local one alone counts."""
    bearing = 2.0 / 3.0 * math.pi * A * B * ER7.shear_yield  # Q at which FI_surf is 0
    surface = judged(make_log(**STATE, nu_x=1.5e-3, force_x=-0.9 * bearing))
    assert surface.global_crack_damage.sum() == 0.0
    assert surface.crack_damage.sum() > 0.0


def test_bad_thresholds_and_materials(make_log: MakeLog) -> None:
    with pytest.raises(ValueError, match=r"creepages = \(0.003, 0.001, 0.01\)"):
        Burstow(520e6, 880e6, creepages=(0.003, 0.001, 0.01))
    with pytest.raises(ValueError, match=r"tensile_strength = 1000000\.0 Pa must be at least"):
        Burstow(520e6, 1e6)
    with pytest.raises(ValueError, match="area = 0"):
        Burstow(520e6, 880e6, area=0.0)
    steel = WheelMaterial("own", 600e6)
    with pytest.raises(ValueError, match="'own' has no tensile_strength, which Burstow"):
        Burstow.of(steel)
    report = assess(make_log(**SLIDING), material=steel, cells=(10, 10))
    assert "rcf_number_per_km" in report.to_table().column_names
    assert "corrected_rcf_number_per_km" not in report.to_table().column_names
