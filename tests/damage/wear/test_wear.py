"""Archard's law: closed forms, tendencies, and its map."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pyarrow
import pytest

from damage.model import DamageModel
from damage.surface.accumulate import accumulate
from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import WheelSurface
from damage.wear.archard import archard
from damage.wear.jendel import JENDEL_REGIMES, JendelMap, wear_coefficient, wear_regime

MakeLog = Callable[..., pyarrow.Table]
DRY = JendelMap(hardness=2.65e9)
A, B, LOAD, RADIUS = 8e-3, 6e-3, 100e3, 0.46
SLIDING = {"a": A, "b": B, "normal_force": LOAD, "rolling_radius": RADIUS, "nu_x": 0.06, "speed": 15.0}


def wear(
    table: pyarrow.Table,
    wear_map: JendelMap = DRY,
    cells: tuple[int, int] = (50, 50),
    theory: str = "fastrip",
    grid: LateralGrid = LateralGrid(),  # noqa: B008 (frozen)
) -> WheelSurface:
    return accumulate(
        table, DamageModel(law=archard(wear_map=wear_map), theory=theory, cells=cells, grid=grid)
    )


@pytest.mark.parametrize("angle", [0.0, 0.3, -0.2])
def test_full_slip_is_archard_by_hand(make_log: MakeLog, angle: float) -> None:
    """Far beyond saturation the slip is the creepage everywhere, so dz(y) = k/H nu p0 a pi/2 (1 - (y/b)^2).

    Per metre rolled the volume is k/H N nu (Archard), and the wheel takes dz once in 2 pi r.
    """
    centre = 2.3e-3
    surface = wear(make_log(**SLIDING, y_wheel=centre, contact_angle=angle), cells=(100, 100))
    rate = DRY.mild_fast / DRY.hardness * 0.06  # |s| V = 0.9 m/s, p0 = 0.99 GPa < 0.8 H
    assert surface.distance == 15.0
    volume = surface.worn_volume[0] / surface.distance
    assert volume[JENDEL_REGIMES.index("mild, fast")] == volume.sum()
    # measured: 0.03 % too much volume on 100 x 100 cells
    assert volume.sum() == pytest.approx(rate * LOAD, rel=1e-3)
    peak = rate * 0.5 * np.pi * A * 1.5 * LOAD / (np.pi * A * B) / (2.0 * np.pi * RADIUS)  # m per m rolled

    def integral(y: np.ndarray) -> np.ndarray:
        """Of the parabola 1 - u^2 from the middle to y, u = (y - centre)/(b cos angle)."""
        u = np.clip((y - centre) / (B * np.cos(angle)), -1.0, 1.0)
        return B * np.cos(angle) * (u - u**3 / 3.0)

    expected = peak * np.diff(integral(surface.grid.edges)) / surface.grid.step
    np.testing.assert_allclose(surface.depth_per_km[0] / 1e3, expected, atol=2e-3 * peak)
    # the depth is normal to the surface, whose width in a bin is step / cos(angle)
    area = surface.depth[0].sum() * surface.grid.step / np.cos(angle)
    assert surface.worn_area[0].sum() == pytest.approx(area, rel=1e-12)


def test_the_cells_converge_to_the_closed_form(make_log: MakeLog) -> None:
    exact = DRY.mild_fast / DRY.hardness * 0.06 * LOAD
    errors = []
    for cells in (10, 20, 40, 80):
        surface = wear(make_log(**SLIDING), cells=(cells, cells))
        errors.append(abs(surface.worn_volume.sum() / surface.distance / exact - 1.0))
    assert all(finer < 0.5 * coarser for coarser, finer in pairwise(errors))


def test_worn_volume_is_the_integral_of_the_depth(random_log: pyarrow.Table) -> None:
    """Volume = worn cross-section times circumference, wheel by wheel, whatever the strips and bins."""
    surface = wear(random_log)
    around = 2.0 * np.pi * 0.46
    np.testing.assert_allclose(
        surface.worn_volume.sum(axis=1), surface.worn_area.sum(axis=1) * around, rtol=1e-12
    )
    assert np.all(surface.worn_volume.sum(axis=1) > 0.0)


@pytest.mark.parametrize("step", [0.1e-3, 0.37e-3, 5e-3])
def test_worn_area_does_not_depend_on_the_bins(random_log: pyarrow.Table, step: float) -> None:
    other = LateralGrid(start=-0.0701, step=step, count=int(0.14 / step) + 2)
    np.testing.assert_allclose(
        wear(random_log, cells=(20, 20), grid=other).worn_area_per_km,
        wear(random_log, cells=(20, 20)).worn_area_per_km,
        rtol=1e-12,
    )


def test_twice_the_run_is_twice_the_wear_and_the_same_per_km(random_log: pyarrow.Table) -> None:
    later = random_log.set_column(0, "time", pyarrow.array(random_log["time"].to_numpy() + 0.4))
    once = wear(random_log, cells=(20, 20))
    twice = wear(pyarrow.concat_tables([random_log, later]), cells=(20, 20))
    np.testing.assert_allclose(twice.depth, 2.0 * once.depth, rtol=1e-10, atol=1e-25)
    np.testing.assert_allclose(twice.depth_per_km, once.depth_per_km, rtol=1e-10, atol=1e-25)
    assert twice.distance == pytest.approx(2.0 * once.distance)


def test_twice_the_load_sliding_is_twice_the_volume(make_log: MakeLog) -> None:
    single = wear(make_log(**SLIDING))
    double = wear(make_log(**{**SLIDING, "normal_force": 2.0 * LOAD}))
    assert double.worn_volume.sum() == pytest.approx(2.0 * single.worn_volume.sum(), rel=1e-10)


def test_lubrication_divides_the_wear(random_log: pyarrow.Table) -> None:
    dry = wear(random_log, cells=(20, 20))
    lubricated = wear(random_log, DRY.divided(6.0), cells=(20, 20))
    np.testing.assert_allclose(lubricated.depth, dry.depth / 6.0, rtol=1e-12)


@pytest.mark.parametrize("theory", ["fastrip", "fastsim"])
def test_right_wheel_is_the_mirror_of_the_left(make_log: MakeLog, theory: str) -> None:
    """Seen in side coordinates a mirrored state wears the same places: y, nu_y and spin change sign."""
    state = {"nu_x": 1e-3, "y_wheel": 0.01, "contact_angle": 0.2}
    left = wear(make_log(**state, nu_y=2e-3, phi=0.6, side=1), theory=theory)
    right = wear(make_log(**state, nu_y=-2e-3, phi=-0.6, side=-1), theory=theory)
    np.testing.assert_allclose(right.depth, left.depth, rtol=1e-9, atol=1e-9 * left.depth.max())


@pytest.mark.parametrize("side", [1, -1])
def test_strips_lie_on_the_right_side_of_the_patch(make_log: MakeLog, side: int) -> None:
    """The rigid slip nu_x - phi y is larger at y > 0 here: to the left, which is outwards of a left wheel."""
    surface = wear(make_log(nu_x=0.03, phi=-4.0, side=side, speed=1.0))  # one coefficient: |s| V < 0.2 m/s
    middle = np.average(surface.grid.centres, weights=surface.depth[0])
    assert side * middle < -0.1e-3


@pytest.mark.parametrize(
    ("pressure", "velocity", "regime"),
    [(1e9, 0.19, 0), (1e9, 0.2, 1), (1e9, 0.7, 1), (1e9, 0.71, 2), (2.13e9, 0.01, 3), (2.11e9, 0.01, 0)],
)
def test_regions_of_the_map(pressure: float, velocity: float, regime: int) -> None:
    """Limits 0.2 and 0.7 m/s and 0.8 H = 2.12 GPa; coefficients within the published ranges."""
    assert wear_regime(pressure, velocity, DRY.values) == regime
    low, high = [(1e-4, 10e-4), (30e-4, 40e-4), (1e-4, 10e-4), (300e-4, 400e-4)][regime]
    assert wear_coefficient(regime, DRY.values) == pytest.approx(0.5 * (low + high))


def test_bad_maps_are_refused() -> None:
    with pytest.raises(ValueError, match=r"hardness = 0\.0"):
        JendelMap(hardness=0.0)
    with pytest.raises(ValueError, match="must lie below severe_to"):
        JendelMap(severe_from=0.8)
    with pytest.raises(ValueError, match="divisor = -1"):
        DRY.divided(-1)
