"""The contact search: against the distance of the two surfaces in space, and continuity of what it finds."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize

from hh_exudyn.contact.geometry import search
from hh_exudyn.contact.geometry.search import CONTACT_COLUMNS, MAX_MAXIMA, find_contacts
from hh_exudyn.contact.geometry.silhouette import wheel_rail_pair
from hh_exudyn.contact.normal.hertz import normal_contact
from hh_exudyn.contact.profile import gauge_point, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.contact.types import SplineTable

R0, D, GAUGE = 0.46, 0.75, 1.435
WHEEL = spline_table(wheel_profile("S1002"))


def axle(yaw: float, roll: float = 0.0) -> np.ndarray:
    return np.array([-math.sin(yaw) * math.cos(roll), math.cos(yaw) * math.cos(roll), math.sin(roll)])


class Pair:
    """S1002 on a rail, one side."""

    def __init__(self, name: str = "60E1", inclination: float = 1 / 40, side: float = 1.0) -> None:
        rail = rail_profile(name, inclination)
        self.rail, self.side = spline_table(rail), side
        self.rail_y = side * (GAUGE / 2 + gauge_point(rail))

    def contacts(self, y: float, z: float, yaw: float = 0.0, roll: float = 0.0) -> np.ndarray:
        rows = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS))
        centre = np.array([0.0, y - self.rail_y, z])
        pair = wheel_rail_pair(WHEEL, self.rail, self.side, D, R0, centre, axle(yaw, roll))
        return rows[: find_contacts(pair, rows)]

    def touching_height(self, y: float, yaw: float = 0.0, roll: float = 0.0) -> float:
        low, high = R0 - 5e-3, R0 + 30e-3
        for _ in range(45):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if len(self.contacts(y, middle, yaw, roll)) else (low, middle)
        return low


def scipy_spline(table: SplineTable) -> CubicSpline:
    """The same spline, evaluated by others."""
    y = table.start + table.step * np.arange(len(table.z))
    return CubicSpline(y, table.z, bc_type=((2, table.second[0]), (2, table.second[-1])))


def least_gap_in_space(pair: Pair, y: float, z: float, l_vector: np.ndarray) -> tuple[float, np.ndarray]:
    """Minimum over the whole wheel surface (profile, angle) of its height above the rail, and where."""
    wheel, rail = scipy_spline(WHEEL), scipy_spline(pair.rail)
    u = np.array([1.0, 0.0, 0.0]) - l_vector[0] * l_vector
    u /= np.linalg.norm(u)
    up = np.cross(u, l_vector)
    low, high = pair.rail.start, pair.rail.start + pair.rail.step * (len(pair.rail.z) - 1)

    def gap(y_wheel: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, ...]:
        radius, t = R0 - wheel(y_wheel), pair.side * (D - y_wheel)
        point = np.array([0.0, y, z]) + np.multiply.outer(t, l_vector)
        point += np.multiply.outer(radius * np.sin(angle), u) - np.multiply.outer(radius * np.cos(angle), up)
        y_rail = pair.side * (pair.rail_y - point[..., 1])
        inside = (y_rail > low) & (y_rail < high)
        return np.where(inside, point[..., 2] - rail(np.clip(y_rail, low, high)), 1.0), point

    ys, angles = np.meshgrid(np.arange(-35, 55, 0.25) * 1e-3, np.linspace(-0.12, 0.12, 241), indexing="ij")
    coarse, _ = gap(ys, angles)
    best = np.unravel_index(np.argmin(coarse), coarse.shape)
    scale = np.array([1e-3, 1e-2])
    found = minimize(
        lambda x: float(gap(np.array(x[0] * scale[0]), np.array(x[1] * scale[1]))[0]) * 1e3,
        np.array([ys[best], angles[best]]) / scale,
        method="Nelder-Mead",
        options={"xatol": 1e-7, "fatol": 1e-13, "maxiter": 4000},
    )
    value, point = gap(np.array(found.x[0] * scale[0]), np.array(found.x[1] * scale[1]))
    return float(value), np.array([found.x[0] * scale[0], *point])


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(
    ("y", "yaw", "roll"),
    [
        (-0.004, 0.0, 0.0),
        (-0.004, 0.005, 0.001),
        (0.003, 0.010, -0.001),
        (0.0075, 0.0, 0.002),
        (0.0075, 0.010, 0.0),
        (0.0075, 0.025, -0.002),
        (0.0085, -0.025, 0.0),
    ],
)
def test_deepest_contact_is_the_minimum_distance_in_space(
    side: float, y: float, yaw: float, roll: float
) -> None:
    """Where the wheel just touches (10 nm): the deeper it sinks, the further the largest overlap along the
    normal lies from the smallest vertical gap, on a flange by a millimetre at 100 um.
    """
    pair = Pair(side=side)
    z = pair.touching_height(side * y, yaw, roll) - 10e-9
    (deepest,) = pair.contacts(side * y, z, yaw, roll)
    depth = deepest[search.OVERLAP] / np.cos(deepest[search.CONTACT_ANGLE])
    gap, (y_wheel, x, y_point, z_point) = least_gap_in_space(pair, side * y, z, axle(yaw, roll))
    assert gap == pytest.approx(-10e-9, abs=1e-10)
    assert depth == pytest.approx(-gap, abs=1e-10)
    assert deepest[search.Y_WHEEL] == pytest.approx(y_wheel, abs=2e-6)
    assert deepest[search.POINT] == pytest.approx(x, abs=2e-6)
    assert deepest[search.POINT + 1] == pytest.approx(y_point - side * y, abs=2e-6)
    assert deepest[search.POINT + 2] == pytest.approx(z_point - z, abs=3e-6)


def test_flange_contact_moves_ahead_with_the_angle_of_attack() -> None:
    """The left flange touches ahead of the axle when the wheelset is steered into the left rail."""
    pair = Pair()
    yaw, y = 0.02, 0.008
    flange = pair.contacts(y, pair.touching_height(y, yaw) - 20e-6, yaw)[0]
    slope = math.tan(flange[search.CONTACT_ANGLE])
    ahead = flange[search.POINT] - (-math.sin(yaw) * (D - flange[search.Y_WHEEL]))
    assert flange[search.CONTACT_ANGLE] > 1.0
    # equation 1 of `silhouette` to first order: R tan(contact angle) yaw
    assert ahead == pytest.approx(flange[search.RADIUS] * slope * yaw, rel=5e-3)


def test_patches_are_ordered_and_curvature_is_that_of_the_arcs() -> None:
    pair = Pair("60E1", 1 / 40)
    contact = pair.contacts(-0.001, pair.touching_height(-0.001) - 30e-6)[0]
    assert abs(contact[search.Y_RAIL]) < 9e-3  # on the R300 crown
    assert contact[search.RAIL_CURVATURE] == pytest.approx(1 / 0.3, rel=2e-3)
    for y in np.arange(0.0, 0.0066, 0.0002):
        rows = Pair("60E1", 1 / 20).contacts(y, R0 - 30e-6)
        assert (np.diff(rows[:, search.APPROACH]) <= 0).all()


@pytest.mark.parametrize(("inclination", "most"), [(1 / 40, 2), (1 / 20, 3)])
def test_several_contacts_of_one_wheel(inclination: float, most: int) -> None:
    """Near the flange tread and flange touch at once; on 1:20 also the gauge corner."""
    pair = Pair("60E1", inclination)
    counts = [
        len(pair.contacts(y, pair.touching_height(y) - 60e-6)) for y in np.arange(0.0045, 0.0068, 20e-6)
    ]
    assert max(counts) >= most
    assert min(counts) >= 1


def test_no_contact_when_lifted() -> None:
    assert len(Pair().contacts(0.0, R0 + 1e-3)) == 0


@pytest.mark.parametrize(("name", "inclination"), [("60E1", 1 / 30), ("60E1", 1 / 20), ("54E1", 1 / 30)])
@pytest.mark.parametrize("yaw", [0.0, 0.01])
def test_forces_are_continuous_where_patches_merge_and_change_places(
    name: str, inclination: float, yaw: float
) -> None:
    """Follow the wheel across the rail at a constant depth; halve the largest steps until nothing is left."""
    pair = Pair(name, inclination)
    nodes = np.linspace(-0.003, 0.0066, 120)
    heights = np.array([pair.touching_height(y, yaw) for y in nodes]) - 60e-6

    def force(y: float) -> np.ndarray:
        rows = pair.contacts(y, float(np.interp(y, nodes, heights)), yaw)
        total = np.zeros(2)
        for row in rows:
            angle = row[search.CONTACT_ANGLE]
            lateral = max(0.5 * (row[search.WHEEL_CURVATURE] + row[search.RAIL_CURVATURE]), 0.25)
            normal = normal_contact(
                row[search.APPROACH], 0.5 * math.cos(angle) / row[search.RADIUS], lateral, 82e9, 0.28
            )[0]
            total += normal * np.array([math.sin(angle), math.cos(angle)])
        return total

    ys = np.linspace(nodes[0], nodes[-1], 1500)
    forces = np.array([force(y) for y in ys])
    assert forces[:, 1].min() > 500.0  # in contact all the way
    for component in range(2):
        steps = np.abs(np.diff(forces[:, component]))
        for i in np.argsort(steps)[-8:]:
            assert _largest_jump(force, ys[i], ys[i + 1], component) < 1.0  # N, of up to 1e5


def _largest_jump(force: Callable[[float], np.ndarray], low: float, high: float, component: int) -> float:
    """Follow the half with the larger change."""
    for _ in range(36):
        middle = 0.5 * (low + high)
        a, b, c = (force(y)[component] for y in (low, middle, high))
        low, high = (low, middle) if abs(b - a) > abs(c - b) else (middle, high)
    return float(abs(force(high)[component] - force(low)[component]))
