"""The energy that friction dissipates: in the cells, in the strips, and of the whole patch."""

import numpy as np
import pyarrow
import pytest

from damage.wear.batch import wear_depths
from damage.wear.energy import energy_density, rigid_energy_density, wear_number
from damage.wear.laws import wear_law
from hh_exudyn.contact.tangential.api import cell_areas, creep_force, traction_field

A, B = 6e-3, 5e-3
CREEPAGES = [
    *((1e-3, 0, 0), (0, 2e-3, 0), (1e-3, -2e-3, 0), (6e-2, 0, 0)),
    *((1.5e-3, 1e-3, 0.1), (0, 0, 0.3), (1e-3, -3e-3, 2)),
]


@pytest.mark.parametrize("creepage", CREEPAGES)
@pytest.mark.parametrize("theory", ["fastrip", "fastsim", "fastsim_elliptic", "strip"])
def test_friction_dissipates_the_power_of_the_creepages(
    theory: str, creepage: tuple[float, float, float]
) -> None:
    """(3.29) with the forces of the same cells, to round-off: the elastic slip does no net work. FASTSIM's by
    its march, that of FaStrip and strip theory because their slip is scaled for it. The forces of
    `creep_force`, whose pressure is exact, differ by the cells."""
    patch = (A, B, 100e3, *creepage, 0.4)
    field = traction_field(theory, *patch, cells=(50, 50))
    areas = cell_areas(A, B, 50, 50)
    in_the_field = float(np.sum(energy_density(field) * areas))
    force_x, force_y = np.sum(field.q_x * areas), np.sum(field.q_y * areas)
    moment = np.sum((field.x * field.q_y - field.y * field.q_x) * areas)
    assert in_the_field == pytest.approx(float(wear_number(force_x, force_y, moment, *creepage)), rel=1e-9)
    rigid = np.sum(rigid_energy_density(field, *creepage) * areas)
    assert in_the_field == pytest.approx(rigid, rel=1e-9)
    force = creep_force(theory, *patch, cells=(50, 50))
    lost = float(wear_number(force.x, force.y, force.moment, *creepage))
    assert in_the_field == pytest.approx(lost, rel=0.01)


@pytest.mark.parametrize("creepage", CREEPAGES)
@pytest.mark.parametrize("theory", ["fastrip", "fastsim"])
def test_no_cell_gains_energy_and_stick_loses_none(theory: str, creepage: tuple[float, float, float]) -> None:
    field = traction_field(theory, A, B, 100e3, *creepage, 0.4)
    density = energy_density(field)
    sticks = (field.slip_x == 0.0) & (field.slip_y == 0.0)
    assert not density[sticks].any()
    assert density.min() >= -1e-9 * density.max()


def test_strips_together_lose_the_wear_number(random_log: pyarrow.Table) -> None:
    """Over the rows of a log, with the forces of as many cells: measured at most 0.6 %."""
    rows = wear_depths(wear_law("british_rail"), random_log)
    names = ("a", "b", "normal_force", "nu_x", "nu_y", "phi", "friction")
    columns = [random_log[name].to_numpy() for name in names]
    forces = [creep_force("fastrip", *map(float, row), cells=(50, 50)) for row in zip(*columns, strict=True)]
    force = np.array([(force.x, force.y, force.moment) for force in forces]).T
    lost = wear_number(*force, *columns[3:6])
    np.testing.assert_allclose(rows.energy.sum(axis=1), lost, rtol=0.01)


def test_wear_number_is_positive_for_dissipation(random_log: pyarrow.Table) -> None:
    names = ("force_x", "force_y", "moment_z", "nu_x", "nu_y", "phi")
    assert np.all(wear_number(*(random_log[name].to_numpy() for name in names)) > 0.0)
