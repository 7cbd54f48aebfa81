"""Patches near one another: continuous forces as they merge, part and fade; what they press down."""

import math

import numpy as np
import pytest
from strip_bench import NU, RADIUS, G

from hh_exudyn.contact.geometry.rail_tables import rail_at
from hh_exudyn.contact.geometry.search import APPROACH, CONTACT_COLUMNS, MAX_MAXIMA, OVERLAP, POINT, STIFFNESS
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.normal.neighbours import find_patches
from hh_exudyn.contact.normal.non_elliptic import minimum, patch_strips
from hh_exudyn.contact.normal.registry import NORMAL_THEORIES
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.tangential.strips import STRIP_COLUMNS
from hh_exudyn.contact.wheel_rail import wheel_rail_model

STRIPS = ("analyn", "kik_piotrowski")
WHEEL, RAIL = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
MODEL = wheel_rail_model(WHEEL, WHEEL, RAIL, RAIL, nominal_radius=RADIUS)
RAIL_TABLE, GAUGE_POINT = rail_at(MODEL.rails_left, 0.0)


def wheel_at(y: float, height: float) -> WheelRailPair:
    """The left wheel, with 4 mrad of yaw."""
    return wheel_rail_pair(
        MODEL.wheel_left, RAIL_TABLE, 1.0, MODEL.running_circle_distance, RADIUS,
        np.array([0.0, y - 0.7175 - GAUGE_POINT, height]), np.array([-4e-3, math.sqrt(1 - 16e-6), 0.0]),
    )  # fmt: skip


def solve(normal: str, pair: WheelRailPair) -> tuple[np.ndarray, np.ndarray]:
    """Contact rows and normal forces of all patches."""
    rows, strips = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS)), np.zeros((20, STRIP_COLUMNS))
    number = NORMAL_THEORIES[normal]
    count = find_patches(number, pair, rows, G, NU, strips)
    found = rows[:count].copy()
    forces = []
    for row in rows[:count]:
        low = minimum(number, pair, row, G, NU)
        forces.append(patch_strips(pair, row, low, row[STIFFNESS], strips)[0])
    return found, np.array(forces)


def highest(y: float) -> float:
    """The height at which the wheel just touches."""
    low, high = RADIUS - 1e-3, RADIUS + 5e-3
    rows, strips = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS)), np.zeros((20, STRIP_COLUMNS))
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        touches = find_patches(1, wheel_at(y, middle), rows, G, NU, strips) > 0
        low, high = (middle, high) if touches else (low, middle)
    return low


@pytest.mark.parametrize("normal", STRIPS)
@pytest.mark.parametrize(("start", "end", "sunk"), [(-0.6e-3, 0.9e-3, 60e-6), (4.4e-3, 5.6e-3, 60e-6)])
def test_force_is_continuous_from_one_patch_to_two_and_back(
    normal: str, start: float, end: float, sunk: float
) -> None:
    """Over the conformal tread (two minima in one region) and from the tread to the gauge corner."""
    step = 1e-6
    places = np.arange(start, end, step)
    coarse = np.arange(start, end + 51e-6, 50e-6)
    heights = np.interp(places, coarse, [highest(y) for y in coarse]) - sunk
    counts, forces = [], []
    for y, height in zip(places, heights, strict=True):
        _, normal_forces = solve(normal, wheel_at(y, height))
        counts.append((normal_forces > 0).sum())
        forces.append(normal_forces.sum())
    assert {1, 2} <= set(counts)
    total = np.array(forces)
    # The path itself climbs the gauge corner with 0.3 um a step, 0.3 % of the force. A patch counted twice
    # or lost would be a jump of 10 % and more.
    assert np.abs(np.diff(total)).max() < 5e-3 * total.max()


@pytest.mark.parametrize("normal", STRIPS)
def test_neighbour_presses_down(normal: str) -> None:
    """Two patches on tread and gauge corner: equation 2 with the forces and places that were found."""
    y = next(
        y
        for y in np.arange(4.6e-3, 5.4e-3, 2e-5)
        if len(solve(normal, wheel_at(y, highest(y) - 30e-6))[0]) > 1
    )
    pair = wheel_at(y, highest(y) - 30e-6)
    rows, forces = solve(normal, pair)
    compliance = (1 - NU) / (math.pi * G)
    assert len(rows) == 2
    for k, j in ((0, 1), (1, 0)):
        rigid = rows[k, OVERLAP]
        pressed = rigid - rows[k, APPROACH]
        distance = np.linalg.norm(rows[k, POINT : POINT + 3] - rows[j, POINT : POINT + 3])
        tilt = math.cos(rows[k, 2] - rows[j, 2])
        assert pressed == pytest.approx(compliance * forces[j] * tilt / distance, rel=0.1, abs=2e-8)
        assert pressed > 0.0


def test_python_and_compiled_agree() -> None:
    """The kernels of one patch as plain Python, which also shows that they are no more than that."""
    pair = wheel_at(-2e-3, highest(-2e-3) - 50e-6)
    rows, strips = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS)), np.zeros((12, STRIP_COLUMNS))
    assert find_patches(1, pair, rows, G, NU, strips) == 1
    low = minimum(1, pair, rows[0], G, NU)
    other = strips.copy()
    row = rows[0].copy()
    plain = getattr(patch_strips, "py_func", patch_strips)(pair, row, low, 0.0, other)
    compiled = patch_strips(pair, rows[0], low, 0.0, strips)
    assert plain == pytest.approx(compiled, rel=1e-12)
    np.testing.assert_allclose(other, strips, rtol=1e-9)
