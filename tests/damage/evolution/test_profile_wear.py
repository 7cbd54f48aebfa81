"""Wear by wheel, and as the mean of those that wear together."""

from dataclasses import replace

import numpy as np
import pytest

from damage.evolution.profile_wear import ProfileWear, mean_wear, profile_wear
from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.contact.profile import wheel_profile

WHEELS = tuple(Wheel(1, 1 + (number > 2), number, side) for number in (1, 2, 3, 4) for side in (-1, 1))


def surface(depths: list[float], wheels: tuple[Wheel, ...] = WHEELS) -> WheelSurface:
    """A wagon that rolled 2 km, each wheel worn evenly by its depth [m]."""
    zero = WheelSurface.zero(wheels, LateralGrid.along(wheel_profile("S1002")))
    depth = np.repeat(np.array(depths)[:, None], zero.grid.count, axis=1)
    return replace(zero, depth_by_part=np.stack([depth, np.zeros_like(depth)], axis=1), distance=2e3)


def rate(wear: ProfileWear) -> float:
    """The depth per kilometre at the running circle."""
    return float(wear.at(0.0))


@pytest.mark.parametrize(
    ("together", "partners"),
    [
        ("wheel", [(1, 1)]),
        ("wheelset", [(1, 1), (1, -1)]),
        ("directions", [(1, 1), (4, 1)]),
        ("both", [(1, 1), (1, -1), (4, 1), (4, -1)]),
    ],
)
def test_who_wears_together(together: str, partners: list[tuple[int, int]]) -> None:
    depths = {(w.wheelset, w.side): 2.0 ** (2 * w.wheelset + w.side) * 1e-9 for w in WHEELS}
    found = profile_wear(surface(list(depths.values())), together)
    expected = np.mean([depths[partner] for partner in partners]) / 2.0
    assert rate(found[Wheel(1, 1, 1, 1)]) == pytest.approx(expected, rel=1e-12)
    total = sum(rate(wear) for wear in found.values())
    assert total == pytest.approx(sum(depths.values()) / 2.0, rel=1e-12)


def test_mean_of_all_wheels() -> None:
    assert rate(mean_wear(surface([1e-9 * n for n in range(8)]))) == pytest.approx(1.75e-9, rel=1e-12)


def test_a_mean_needs_its_partners() -> None:
    half = surface([1e-9, 1e-9], WHEELS[:2])
    assert rate(profile_wear(half, "both")[WHEELS[0]]) == pytest.approx(0.5e-9)  # its own other end
    with pytest.raises(ValueError, match=r"wears together \('wheelset'\) .* lacks some of them"):
        profile_wear(surface([1e-9], WHEELS[:1]), "wheelset")


def test_bad_input() -> None:
    worn = surface([1e-9] * 8)
    with pytest.raises(ValueError, match=r"together = 'axle', allowed are 'wheel', 'wheelset'"):
        profile_wear(worn, "axle")
    with pytest.raises(ValueError, match="is not a wheel of the surface"):
        profile_wear(worn, wheels=[Wheel(2, 1, 1, 1)])
    with pytest.raises(ValueError, match="has not rolled"):
        profile_wear(replace(worn, distance=0.0))
    with pytest.raises(ValueError, match="has not rolled"):
        mean_wear(replace(worn, distance=0.0))
