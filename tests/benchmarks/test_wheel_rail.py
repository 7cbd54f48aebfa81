"""Time of the contact search and of the whole contact kernel (run with ``pytest tests/benchmarks``)."""

from typing import Any

import numpy as np
import pytest

from hh_exudyn.contact.profile import gauge_point, rail_profile, wheel_profile
from hh_exudyn.contact.profile_spline import spline_table
from hh_exudyn.contact.search import CONTACT_COLUMNS, MAX_MINIMA, find_contacts
from hh_exudyn.contact.silhouette import wheel_rail_pair
from hh_exudyn.contact.types import MAX_PATCHES, PATCH_COLUMNS, SplineTable
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model
from hh_exudyn.kernel import kernel

SEARCHES = 1000


@kernel
def _search_many(
    wheel: SplineTable,
    rail: SplineTable,
    rail_y: float,
    position: Any,
    axle: Any,
    amplitude: float,
    rows: Any,
) -> int:
    """Searches with the wheelset moving from side to side, as many as `SEARCHES`."""
    found = 0
    centre = position[1]
    for i in range(SEARCHES):
        position[1] = centre + amplitude * np.sin(0.01 * i)
        found += find_contacts(
            wheel_rail_pair(wheel, rail, 1.0, 0.75, 0.46, position, axle, rail_y, 0.0), rows
        )
    position[1] = centre
    return found


@pytest.mark.parametrize(("centre", "amplitude"), [(-0.003, 0.002), (0.0, 0.006)])
def test_search_per_1000_wheels(benchmark: Any, centre: float, amplitude: float) -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    position, axle = np.array([0.0, centre, 0.46 - 250e-6]), np.array([-3e-3, np.sqrt(1 - 9e-6), 0.0])
    tables = spline_table(wheel), spline_table(rail)
    rows = np.zeros((MAX_MINIMA, CONTACT_COLUMNS))
    rail_y = 0.7175 + gauge_point(rail)
    found = benchmark(_search_many, *tables, rail_y, position, axle, amplitude, rows)
    assert found > 0


@pytest.mark.parametrize("theory", ["fastsim", "fastrip"])
def test_four_wheelsets(benchmark: Any, theory: str) -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    model = wheel_rail_model(wheel, wheel, rail, rail, nominal_radius=0.46, theory=theory)
    n = 4
    position = np.tile([0.0, 0.0, 0.46 - 250e-6], (n, 1))
    position[:, 1] = [-0.002, -0.001, 0.0, 0.001]
    axle = np.tile([0.0, 1.0, 0.0], (n, 1))
    velocity = np.tile([20.0, 0.01, 0.0], (n, 1))
    patches = np.zeros((n, 2, MAX_PATCHES, PATCH_COLUMNS))
    displacement, rail_velocity, creep_lag, rail_force = (np.zeros((n, 2, 2)) for _ in range(4))
    status = benchmark(
        wheel_rail_forces, model, position, axle, velocity, axle * 20.0 / 0.46, displacement, rail_velocity,
        creep_lag, np.full(n, 1.435), np.full((n, 2), 0.3), np.zeros((n, 6)), rail_force, patches,
    )  # fmt: skip
    assert status == 0
    assert (patches[:, :, 0, 5] > 0).all()  # all eight wheels in contact
