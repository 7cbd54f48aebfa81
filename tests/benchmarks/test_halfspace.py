"""Time of the half-space solver on 40 x 40 elements, of a wheel on a rail (``pytest tests/benchmarks``)."""

from typing import Any

import numpy as np
import pytest

from hh_exudyn.contact.halfspace.ellipse import hertz_pressure
from hh_exudyn.contact.halfspace.influence import Grid, Influence
from hh_exudyn.contact.halfspace.normal import normal_contact, quadratic_overlap
from hh_exudyn.contact.halfspace.pose import wheel_above_rail
from hh_exudyn.contact.halfspace.rolling import rigid_slip, rolling_contact
from hh_exudyn.contact.halfspace.wheel_rail import conformal_contact
from hh_exudyn.contact.hertz import hertz_patch
from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.conventions import RIGHT

LOAD, CELLS, A, B = 1e5, 40, 6e-3, 4e-3


@pytest.mark.parametrize("warm", [False, True])
def test_normal(benchmark: Any, warm: bool) -> None:
    patch = hertz_patch(LOAD, 1.0, 2.0, STEEL)
    influence = Influence(Grid(44, 44, 2.2 * patch.a / 44, 2.2 * patch.b / 44), STEEL)
    overlap = quadratic_overlap(influence.grid, 1.0, 2.0)
    start = normal_contact(influence, 1.01 * overlap, load=LOAD).pressure if warm else None
    found = benchmark(normal_contact, influence, overlap, load=LOAD, start=start)
    assert found.pressure.max() == pytest.approx(patch.max_pressure, rel=5e-3)


@pytest.mark.parametrize("warm", [False, True])
@pytest.mark.parametrize("creepage", [(1e-3, 5e-4, 0.3), (3e-3, -2e-3, 1.0)])
def test_rolling(benchmark: Any, creepage: tuple[float, float, float], warm: bool) -> None:
    influence = Influence(Grid(CELLS, CELLS, 2.0 * A / CELLS, 2.0 * B / CELLS), STEEL)
    bound = 0.3 * hertz_pressure(influence, A, B, LOAD)
    slip = rigid_slip(influence, *creepage)
    start = rolling_contact(influence, bound, 1.01 * slip).traction if warm else None
    found = benchmark(rolling_contact, influence, bound, slip, start=start)
    assert found.residual <= 1e-4


@pytest.mark.parametrize("spacing", [(0.25e-3, 0.35e-3), (0.5e-3, 0.6e-3)])
def test_wheel_on_rail(benchmark: Any, spacing: tuple[float, float]) -> None:
    pair = wheel_above_rail(
        wheel_profile("S1002"), rail_profile("60E1", 1.0 / 30.0), RIGHT,
        lateral=-10e-3, height=0.4575, radius=0.4575, gauge=1.445,
    )  # fmt: skip
    found = benchmark(conformal_contact, pair, load=LOAD, spacing=spacing)
    assert np.isclose(found.vertical, LOAD)
