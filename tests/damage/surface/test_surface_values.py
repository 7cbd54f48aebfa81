"""Surfaces as values: stored and read back bit for bit, added, scaled, compared, turned into tables."""

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.stored import BrokenFile, load, pack, parts_of, save
from damage.surface.tables import SUMS, differences, labelled, patch_table, profile_table, wheel_table
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.contact.profile import wheel_profile

WHEELS = (Wheel(1, 1, 1, -1), Wheel(1, 1, 1, 1), Wheel(1, 1, 2, 1))


def some(seed: int, grid: LateralGrid | None = None) -> WheelSurface:
    """Random sums."""
    zero = WheelSurface.zero(WHEELS, grid or LateralGrid(-0.01, 0.002, 10), PatchGrid(-0.004, 0.002, 4))
    draw = np.random.default_rng(seed)
    return replace(
        zero,
        rows=seed,
        time=2.0,
        distance=30.0,
        **{name: draw.random(getattr(zero, name).shape) for name in SUMS},
    )


def test_every_sum_has_its_axes() -> None:
    arrays = [
        field.name for field in fields(WheelSurface) if isinstance(getattr(some(1), field.name), np.ndarray)
    ]
    assert set(SUMS) == set(arrays)
    for name in SUMS:
        array = labelled(some(1), name)
        assert array.values.shape == tuple(axis.labels.size for axis in array.axes), name


@pytest.mark.parametrize("grid", [None, LateralGrid.along(wheel_profile("S1002"), 0.002)])
def test_stored_and_read_back_bit_for_bit(grid: LateralGrid | None, tmp_path: Path) -> None:
    surface = some(3, grid)
    save(surface, tmp_path / "a.npz")
    back = load(tmp_path / "a.npz")
    assert (back.grid, back.patch_grid, back.wheels) == (surface.grid, surface.patch_grid, surface.wheels)
    assert all(np.array_equal(getattr(back, name), getattr(surface, name)) for name in SUMS)
    assert (back.rows, back.time, back.distance) == (3, 2.0, 30.0)
    assert pack(*parts_of(back)) == (tmp_path / "a.npz").read_bytes()
    assert all(one.largest == 0.0 for one in differences(back, surface).values())


def test_any_flipped_byte_or_cut_is_refused_or_changes_nothing(tmp_path: Path) -> None:
    surface = some(4)
    save(surface, tmp_path / "a.npz")
    content = (tmp_path / "a.npz").read_bytes()
    refused = 0
    for place in range(0, len(content), 37):
        (tmp_path / "b.npz").write_bytes(
            content[:place] + bytes([content[place] ^ 0x55]) + content[place + 1 :]
        )
        try:
            back = load(tmp_path / "b.npz")
        except BrokenFile:
            refused += 1
            continue
        assert all(one.largest == 0.0 for one in differences(back, surface).values())
    assert refused > 0.8 * len(range(0, len(content), 37))
    (tmp_path / "b.npz").write_bytes(content[: len(content) // 2])
    with pytest.raises(BrokenFile, match=r"b\.npz"):
        load(tmp_path / "b.npz")


def test_sum_and_both_sides_of_a_weight() -> None:
    one, two = some(1), some(2)
    total = sum([one, two])
    assert isinstance(total, WheelSurface)
    assert np.array_equal(total.worn_area, one.worn_area + two.worn_area)
    for product in (0.3 * one, one * 0.3, np.float64(0.3) * one, one * np.float64(0.3)):
        assert np.array_equal(product.energy, 0.3 * one.energy)
        assert product.rows == one.rows
    with pytest.raises(TypeError):
        sum([one], start=1)
    with pytest.raises(ValueError, match="weight = nan"):
        one * float("nan")


def test_differences_name_the_sum_that_differs() -> None:
    one = some(1)
    work = one.work.copy()
    work[2] += 0.5
    found = differences(one, replace(one, work=work))
    assert {name for name, difference in found.items() if difference.largest > 0.0} == {"work"}
    assert found["work"].largest == pytest.approx(0.5)
    assert found["work"].relative == pytest.approx(0.5 / work.max())
    with pytest.raises(ValueError, match="another grid"):
        differences(one, some(1, LateralGrid(-0.01, 0.001, 20)))


def test_tables_hold_every_sum_once() -> None:
    surface = some(5)
    wheels, places, patches = wheel_table(surface), profile_table(surface), patch_table(surface)
    assert places.num_rows == 3 * 10
    assert patches.num_rows == 3 * 2 * 10 * 4
    row = places.to_pylist()[10 * 1 + 7]
    assert (row["wheelset"], row["side"]) == (1, 1)
    assert row["s_m"] == pytest.approx(-0.01 + 7.5 * 0.002)
    assert row["depth_flange_m"] == surface.depth_by_part[1, 1, 7]
    for table, column, values in (
        (wheels, "work_J", surface.work),
        (wheels, "worn_volume_2_m3", surface.worn_volume[:, 1]),
        (wheels, "friction_area_s", surface.friction_area),
        (places, "worn_area_m2", surface.worn_area),
        (patches, "energy_Pa", surface.energy),
    ):
        assert np.sum(table[column].to_numpy()) == pytest.approx(values.sum(), rel=1e-12)
    with pytest.raises(ValueError, match="no sum 'wear'; it has depth_by_part"):
        labelled(surface, "wear")
