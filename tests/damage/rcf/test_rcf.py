"""Surface fatigue index against published and recomputed numbers."""

from collections.abc import Callable

import numpy as np
import pyarrow
import pytest
from hypothesis import given
from hypothesis import strategies as st

from damage.material import ER7
from damage.patch_strips import FLANGE, TREAD
from damage.rcf.subsurface import (
    defect_fatigue_index,
    defect_fatigue_limit,
    subsurface_fatigue_index,
)
from damage.rcf.surface_index import (
    fatigue_area_index,
    fatigue_probability,
    shortest_distance_index,
    surface_fatigue_index,
)
from damage.report import assess
from damage.shakedown import point_contact_limit


@pytest.mark.parametrize(
    ("a", "b", "load", "utilised", "published"),
    [(7.5e-3, 2.9e-3, 142668.0, 0.355, 0.2590), (7.1e-3, 3.9e-3, 147886.0, 0.0665, -0.0511)],
)
def test_table_3_2(a: float, b: float, load: float, utilised: float, published: float) -> None:
    """Hossein-Nia (2018), Table 3-2, k = 300 MPa; Q/P was worked out to its three digits: within 5e-4."""
    index = surface_fatigue_index(0.6 * utilised * load, -0.8 * utilised * load, load, a, b, ER7.shear_yield)
    assert float(index) == pytest.approx(published, abs=5e-4)


def test_index_is_the_distance_to_the_surface_limit() -> None:
    """FI_surf = Q/P - k/p0: zero where p0/k = 1/(Q/P), on the surface branch of the diagram."""
    a, b, load, k = 6e-3, 5e-3, 120e3, 300e6
    p_max = 1.5 * load / (np.pi * a * b)
    for utilised in (0.31, 0.4, 0.55):
        index = surface_fatigue_index(utilised * load, 0.0, load, a, b, k)
        assert float(index) == pytest.approx(utilised - k / p_max, rel=1e-12)
        critical = k * float(point_contact_limit(utilised))
        load_there = critical * np.pi * a * b / 1.5
        index = surface_fatigue_index(utilised * load_there, 0.0, load_there, a, b, k)
        assert float(index) == pytest.approx(0.0, abs=1e-12)


def test_no_load_no_fatigue() -> None:
    assert surface_fatigue_index(0.0, 0.0, 0.0, 0.0, 0.0, 300e6) == -np.inf
    with pytest.raises(ValueError, match="normal_force must be >= 0 N; 2 values are not"):
        surface_fatigue_index(0.0, 0.0, np.array([1.0, -1.0, np.nan]), 1e-3, 1e-3, 300e6)


def test_shares_of_tread_and_flange(make_log: Callable[..., pyarrow.Table]) -> None:
    """Four equal intervals by hand: on the tread FI 0.1, -0.1, 0.1, -k/p0; on the flange 0.3 once."""
    a, b, load = 6e-3, 5e-3, 120e3
    limit = ER7.shear_yield * np.pi * a * b / 1.5 / load  # k/p0
    log = make_log(
        time=np.array([0.0, 0.1, 0.2, 0.3, 0.3]),
        patch=np.array([0, 0, 0, 0, 1]),
        contact_angle=np.array([0.05, 0.05, 0.05, 0.05, 1.0]),
        y_wheel=np.array([0.0, 0.0, 0.0, 0.0, 0.036]),
        force_x=load * np.array([limit + 0.1, limit - 0.1, limit + 0.1, 0.0, limit + 0.3]),
        a=a,
        b=b,
        normal_force=load,
        friction=0.6,
    )
    surface = assess(log, cells=(10, 10)).surface
    np.testing.assert_allclose(surface.fatigue_share[0, [TREAD, FLANGE]], [0.5, 1.0])
    np.testing.assert_allclose(surface.fatigue_area_index[0], [0.2 / (4 * 0.6), 0.3 / 0.6])
    np.testing.assert_allclose(surface.flange_share, [0.2])
    np.testing.assert_allclose(surface.fatigue_time[0].max(axis=1), [0.2, 0.1])
    np.testing.assert_allclose(
        surface.fatigue_time[0].sum(axis=1) * 1e-3, 2 * b * np.array([0.2 * np.cos(0.05), 0.1 * np.cos(1)])
    )


def indices(utilised: object, pressure: object) -> tuple[np.ndarray, np.ndarray]:
    """FI_surf and FI_ssurf of working points (Q/P, p0/k), through forces and axes that lead there."""
    utilised, pressure = np.asarray(utilised, dtype=float), np.asarray(pressure, dtype=float)
    a, b, k = 6e-3, 5e-3, 300e6
    load = pressure * k * np.pi * a * b / 1.5
    forces = (0.8 * utilised * load, -0.6 * utilised * load, load, a, b, k)
    return surface_fatigue_index(*forces), shortest_distance_index(*forces)


def test_shortest_distance_by_hand() -> None:
    """From (t, 1/t) on the curve along its normal (1/t, t): the way gone is the distance.

    (1/2, 2) with the normal (2, 1/2), 0.1 times: (0.7, 2.05) and (0.3, 1.95), both sqrt(4.25)/10 away.
    (1/4, 4) with the normal (4, 1/4), 0.05 times: (0.45, 4.0125), sqrt(16.0625)/20 away.
    """
    _, shortest = indices([0.7, 0.3, 0.45], [2.05, 1.95, 4.0125])
    expected = [np.sqrt(4.25) / 10.0, -np.sqrt(4.25) / 10.0, np.sqrt(16.0625) / 20.0]
    np.testing.assert_allclose(shortest, expected, rtol=1e-12)
    # on the line of symmetry the nearest point is (1, 1), and the origin is sqrt 2 from it
    np.testing.assert_allclose(indices([0.9, 1e-9], [0.9, 1e-9])[1], [-0.1 * np.sqrt(2.0), -np.sqrt(2.0)])
    # below the diagonal the coordinates change places
    np.testing.assert_allclose(indices(2.05, 0.7)[1], np.sqrt(4.25) / 10.0, rtol=1e-12)
    np.testing.assert_allclose(indices([0.25, 0.8], [4.0, 1.25])[1], 0.0, atol=1e-12)


@given(st.floats(1e-3, 1.5), st.floats(1e-2, 12.0))
def test_shortest_distance_is_the_shortest(utilised: float, pressure: float) -> None:
    """Sign of FI_surf, never farther than the horizontal distance, and as near as any of many points."""
    surface, shortest = (float(index) for index in indices(utilised, pressure))
    assert abs(shortest) <= abs(surface) * (1.0 + 1e-9) + 1e-12
    if abs(surface) > 1e-9:
        assert np.sign(shortest) == np.sign(surface)
    t = np.geomspace(1e-3, 1e2, 20001)
    nearest = float(np.hypot(utilised - t, pressure - 1.0 / t).min())
    assert abs(shortest) <= nearest + 1e-12
    assert abs(shortest) == pytest.approx(nearest, abs=1e-2)


def test_shortest_distance_without_load_and_without_axes() -> None:
    given_ = shortest_distance_index(1.0, 0.0, np.array([0.0, 100e3]), 6e-3, 5e-3, 300e6)
    assert given_[0] == -np.inf
    assert np.isfinite(given_[1])
    with pytest.raises(ValueError, match="semi-axes a and b must be > 0 m"):
        shortest_distance_index(1.0, 0.0, 100e3, 0.0, 5e-3, 300e6)
    with pytest.raises(ValueError, match=r"shear_yield = -1\.0 Pa"):
        shortest_distance_index(1.0, 0.0, 100e3, 6e-3, 5e-3, -1.0)


def test_area_and_probability_by_hand() -> None:
    """FI 0.1 for 1 s, -0.2 for 2 s, 0.3 for 1 s, no contact for 4 s, at friction 0.5."""
    index, interval = np.array([0.1, -0.2, 0.3, -np.inf]), np.array([1.0, 2.0, 1.0, 4.0])
    assert fatigue_area_index(index, interval, 0.5) == pytest.approx(0.4 / 4.0)
    assert fatigue_area_index(index, interval, 0.75) == pytest.approx(0.4 / 6.0)
    assert fatigue_probability(index, interval) == pytest.approx(0.25)
    assert fatigue_probability(index) == pytest.approx(0.5)
    assert fatigue_probability([]) == 0.0
    assert fatigue_area_index([], [], 0.4) == 0.0
    # finer sampling of the same course changes nothing
    twice = np.repeat(index, 2), np.repeat(0.5 * interval, 2)
    assert fatigue_area_index(*twice, 0.5) == pytest.approx(0.1)
    with pytest.raises(ValueError, match="index is NaN 1 times"):
        fatigue_probability([0.1, np.nan])
    with pytest.raises(ValueError, match="interval must be >= 0; 1 values are not"):
        fatigue_area_index([0.1, 0.2], [0.1, -0.1], 0.4)


def test_series_and_surface_agree(make_log: Callable[..., pyarrow.Table]) -> None:
    """The sums of `WheelSurface` are those of the functions on the same course."""
    generator = np.random.default_rng(2)
    a, b, load, count = 6e-3, 5e-3, 120e3, 30
    force = load * generator.uniform(0.1, 0.6, count)
    log = make_log(time=0.1 * np.arange(count), force_x=force, a=a, b=b, normal_force=load, friction=0.6)
    index = surface_fatigue_index(force, 0.0, load, a, b, ER7.shear_yield)
    surface = assess(log, cells=(10, 10)).surface
    assert surface.fatigue_share[0, TREAD] == pytest.approx(fatigue_probability(index))
    assert surface.fatigue_area_index[0, TREAD] == pytest.approx(fatigue_area_index(index, 0.1, 0.6))
    assert 0.0 < fatigue_probability(index) < 1.0


def test_subsurface_index_is_a_sixth_of_the_pressure() -> None:
    a, b, load = 6e-3, 5e-3, 120e3
    p_max = 1.5 * load / (np.pi * a * b)
    assert float(subsurface_fatigue_index(load, a, b, 0.0)) == pytest.approx(p_max / 6.0)
    assert float(subsurface_fatigue_index(load, a, b, 0.5)) == pytest.approx(1.25 * p_max / 6.0)
    compressed = subsurface_fatigue_index(load, a, b, 0.0, residual_stress=-60e6, hydrostatic_weight=0.5)
    assert float(compressed) == pytest.approx(p_max / 6.0 - 30e6)
    with pytest.raises(ValueError, match="hydrostatic_weight = None"):
        subsurface_fatigue_index(load, a, b, 0.0, residual_stress=-60e6)
    with pytest.raises(ValueError, match="semi-axes"):
        subsurface_fatigue_index(load, 0.0, b, 0.0)


def test_a_defect_64_times_larger_halves_the_limit() -> None:
    limit = defect_fatigue_limit(200e6, np.array([1e-4, 1e-3, 64e-3]), 1e-3)
    np.testing.assert_allclose(limit, [200e6, 200e6, 100e6])
    np.testing.assert_allclose(defect_fatigue_index(150e6, 200e6, [1e-3, 64e-3], 1e-3), [-50e6, 50e6])
    with pytest.raises(ValueError, match=r"reference_size = 0\.0 m"):
        defect_fatigue_limit(200e6, 1e-3, 0.0)
    with pytest.raises(ValueError, match="defect_size must be > 0 m; 1 values are not"):
        defect_fatigue_limit(200e6, [1e-3, -1.0], 1e-3)
