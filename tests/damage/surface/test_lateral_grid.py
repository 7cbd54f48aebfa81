"""Bins along the arc of a wheel profile, and sums that scale: distance, weights."""

import math
from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pyarrow
import pytest

from damage.model import DamageModel
from damage.report import assess
from damage.surface.accumulate import accumulate
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.wheel_surface import WheelSurface
from damage.wear.archard import archard
from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile

MakeLog = Callable[..., pyarrow.Table]
ANGLE = math.radians(60.0)


def wedge() -> Profile:
    """A flat tread with a flange of 60 degrees from y = 30 mm on."""
    y = np.linspace(-0.06, 0.05, 111)
    return Profile("wedge", "wheel", y, -np.tan(ANGLE) * np.maximum(y - 0.03, 0.0))


def test_arc_of_a_wedge() -> None:
    grid = LateralGrid.along(wedge())
    place, stretch = grid.place([-0.01, 0.0, 0.03, 0.04], [0.0, 0.0, 0.0, ANGLE])
    np.testing.assert_allclose(place, [-0.01, 0.0, 0.03, 0.05], atol=1e-12)
    np.testing.assert_array_equal(stretch, 1.0)
    np.testing.assert_allclose(grid.place(grid.lateral, np.zeros(grid.count))[0], grid.centres, atol=1e-12)
    assert np.min(np.abs(grid.edges)) < 1e-12  # an edge at the running circle
    np.testing.assert_array_equal(LateralGrid().lateral, LateralGrid().centres)


def test_arc_of_s1002_is_longer_than_it_is_wide() -> None:
    profile = wheel_profile("S1002")
    grid = LateralGrid.along(profile)
    tread, _ = grid.place([-0.04], [0.0])
    assert -0.0401 < tread[0] < -0.04  # slopes up to 1:15 or so
    tip, _ = grid.place([0.055], [0.0])
    assert 0.065 < tip[0] < 0.075  # 28 mm of height on a flange some 20 mm wide to its tip
    assert grid.edges[0] <= profile.y[0]
    assert LateralGrid.along(profile) == grid
    assert hash(LateralGrid.along(profile)) == hash(grid)
    assert LateralGrid.along(wedge()) != grid


def test_depth_on_a_flange_of_60_degrees(make_log: MakeLog) -> None:
    """The same patch on the tread and on the flange: over the arc the same depth and area; over the lateral
    coordinate its shadow is half as wide, with the same depth and, the surface being twice as wide, area."""
    state = {"nu_x": 0.03, "b": 4e-3}
    tread, flange = make_log(**state, y_wheel=0.0), make_log(**state, y_wheel=0.04, contact_angle=ANGLE)
    arc, flat = LateralGrid.along(wedge(), 0.5e-3), LateralGrid(step=0.5e-3, count=280)
    law = archard(hardness=2.65e9)  # p0 = 1.99 GPa: on ER7 (235 HB) the middle would seize, a step in depth
    along = {
        name: accumulate(log, DamageModel(law=law, grid=arc)) for name, log in (("t", tread), ("f", flange))
    }
    np.testing.assert_allclose(  # 50 mm further on
        np.roll(along["t"].depth[0], 100), along["f"].depth[0], atol=1e-9 * along["t"].depth.max()
    )
    shadow = accumulate(flange, DamageModel(law=law, grid=flat))
    assert shadow.depth.max() == pytest.approx(along["f"].depth.max(), rel=0.02)
    worn = along["f"].worn_area.sum()
    assert worn == pytest.approx(along["f"].depth.sum() * arc.step, rel=1e-12)
    assert shadow.worn_area.sum() == pytest.approx(worn, rel=1e-12)
    assert shadow.depth.sum() * flat.step == pytest.approx(0.5 * worn, rel=1e-12)
    middle = np.average(arc.lateral, weights=along["f"].depth[0])
    assert middle == pytest.approx(0.04, abs=1e-4)


def test_worn_volume_is_the_integral_over_the_arc(random_log: pyarrow.Table) -> None:
    surface = assess(random_log, profile=wheel_profile("S1002"), cells=(20, 20)).surface
    around = 2.0 * math.pi * 0.46
    volume = surface.depth.sum(axis=1) * surface.grid.step * around
    np.testing.assert_allclose(volume, surface.worn_volume.sum(axis=1), rtol=1e-12)


def _sums(surface: WheelSurface) -> dict[str, np.ndarray]:
    kept = ("grid", "patch_grid", "wheels", "rows", "pressure_by_part")
    return {f.name: np.asarray(getattr(surface, f.name)) for f in fields(surface) if f.name not in kept}


def test_a_hundred_times_the_distance_is_a_hundred_times_the_damage(random_log: pyarrow.Table) -> None:
    """And so is the log a hundred times over: here three times, as it costs time."""
    once = assess(random_log, cells=(10, 10)).surface
    far = once.scaled(100.0 * once.distance)
    for name, values in _sums(once).items():
        np.testing.assert_allclose(_sums(far)[name], 100.0 * values, rtol=1e-13, err_msg=name)
    assert far.rows == once.rows
    np.testing.assert_array_equal(far.pressure_by_part, once.pressure_by_part)
    time = random_log["time"].to_numpy()
    period = 40 * 0.01  # 40 output times of 10 ms
    again = [random_log.set_column(0, "time", pyarrow.array(time + i * period)) for i in range(3)]
    thrice = assess(pyarrow.concat_tables(again), cells=(10, 10)).surface
    for name, values in _sums(once.scaled(thrice.distance)).items():
        np.testing.assert_allclose(
            _sums(thrice)[name], values, rtol=1e-9, atol=1e-12 * np.abs(values).max(), err_msg=name
        )


def test_weights_of_a_load_collective(make_log: MakeLog) -> None:
    """A third of the way on one place, the rest on another: depths per distance weigh in as their shares."""
    one = accumulate(make_log(nu_x=5e-3, y_wheel=-0.02), DamageModel())
    two = accumulate(make_log(nu_x=5e-3, y_wheel=0.02, speed=30.0), DamageModel())
    total = 0.25 * one.scaled(1e6) + 0.75 * two.scaled(1e6)
    assert total.distance == pytest.approx(1e6)
    np.testing.assert_allclose(total.depth_per_km, 0.25 * one.depth_per_km + 0.75 * two.depth_per_km)
    assert total.rows == 2
    for bad in (-1.0, math.nan):
        with pytest.raises(ValueError, match="weight ="):
            bad * one
        with pytest.raises(ValueError, match="distance ="):
            one.scaled(bad)
    with pytest.raises(ValueError, match="have not rolled"):
        WheelSurface.zero((), LateralGrid()).scaled(1.0)


def test_grids_are_checked(make_log: MakeLog) -> None:
    surface = WheelSurface.zero((), LateralGrid())
    for other in (
        WheelSurface.zero((), LateralGrid.along(wedge())),
        WheelSurface.zero((), LateralGrid(), PatchGrid(count=41)),
    ):
        with pytest.raises(ValueError, match="different grids"):
            surface + other
    with pytest.raises(ValueError, match="is a rail's; damage needs a wheel's"):
        assess(make_log(), profile=rail_profile("60E1"))
    with pytest.raises(ValueError, match="step = 0"):
        LateralGrid.along(wedge(), 0.0)
    with pytest.raises(ValueError, match=r"step = -1\.0 m: step must"):
        PatchGrid(step=-1.0)
    with pytest.raises(ValueError, match="count = 0"):
        PatchGrid(count=0)
    with pytest.raises(ValueError, match="both a grid and a profile"):
        assess(make_log(), grid=LateralGrid(), profile=wedge())
