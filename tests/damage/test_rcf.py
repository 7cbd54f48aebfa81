"""Surface fatigue index against published and recomputed numbers."""

from collections.abc import Callable

import numpy as np
import pyarrow
import pytest

from damage.material import ER7
from damage.rcf import surface_fatigue_index
from damage.report import assess
from damage.shakedown import point_contact_limit
from damage.wheel_surface import FLANGE, TREAD


@pytest.mark.parametrize(
    ("a", "b", "load", "utilised", "published"),
    [(7.5e-3, 2.9e-3, 142668.0, 0.355, 0.2590), (7.1e-3, 3.9e-3, 147886.0, 0.0665, -0.0511)],
)
def test_table_3_2(a: float, b: float, load: float, utilised: float, published: float) -> None:
    """Hossein-Nia (2018), Table 3-2, k = 300 MPa; Q/P was worked out to its three digits: within 5e-4."""
    index = surface_fatigue_index(0.6 * utilised * load, -0.8 * utilised * load, load, a, b, ER7.shear_yield)
    assert float(index) == pytest.approx(published, abs=5e-4)


def test_shear_yield_of_er7() -> None:
    """300 MPa after von Mises fits Table 3-2; Tresca's 260 MPa is equation 3.1 of the same thesis."""
    assert ER7.shear_yield == pytest.approx(300e6, rel=1e-3)
    assert ER7.shear_yield_tresca == pytest.approx(260e6)


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
