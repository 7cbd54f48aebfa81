"""The theory "halfspace" of `creep_force` and `traction_field`."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hh_exudyn.contact.halfspace.ellipse import ellipse_field
from hh_exudyn.contact.tangential.api import cell_areas, creep_force, traction_field
from hh_exudyn.contact.tangential.registry import (
    FIELD_THEORIES,
    PATCH_FIELD_THEORIES,
    PATCH_THEORIES,
    RUN_THEORIES,
    TANGENTIAL,
    THEORIES,
)
from hh_exudyn.contact.tangential.validation import exact_fields, exact_forces, force_error
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.contact.wheel_rail import wheel_rail_model

A, B, N, MU = 7.5e-3, 2.9e-3, 142668.0, 0.37
LOG_RATIO = st.floats(-3.5, 3.5)
CREEPAGE = st.one_of(st.floats(-0.1, 0.1), st.floats(-1e-4, 1e-4))
SPIN = st.one_of(st.floats(-30.0, 30.0), st.just(0.0))


def test_it_is_known_where_people_ask_and_not_in_kernels() -> None:
    record = next(theory for theory in TANGENTIAL if theory.name == "halfspace")
    assert not record.in_runs
    assert not record.in_kernels
    assert "halfspace" in PATCH_THEORIES
    assert "halfspace" in PATCH_FIELD_THEORIES
    for names in (THEORIES, FIELD_THEORIES, RUN_THEORIES):
        assert "halfspace" not in names


def test_a_run_refuses_it_by_name() -> None:
    from hh_exudyn.contact.profile import rail_profile, wheel_profile

    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1.0 / 40.0)
    with pytest.raises(ValueError, match="'halfspace'"):
        wheel_rail_model(wheel, wheel, rail, rail, nominal_radius=0.46, theory="halfspace")


def test_exact_forces_every_fifth() -> None:
    """All of them stand in `validate halfspace`: 0.08 % of mu N in the mean, 0.32 at most, good to 0.2."""
    errors = [force_error("halfspace", exact, (40, 40)) for exact in exact_forces()[::5]]
    assert len(errors) == 37
    assert np.mean(errors) <= 0.003
    assert max(errors) <= 0.01


@settings(max_examples=40)
@given(LOG_RATIO, CREEPAGE, CREEPAGE, SPIN, st.integers(5, 20))
def test_limit_and_mirror(log_ratio: float, nu_x: float, nu_y: float, phi: float, cells: int) -> None:
    a, b = 5e-3 * math.exp(0.5 * log_ratio), 5e-3 * math.exp(-0.5 * log_ratio)
    one = creep_force("halfspace", a, b, N, nu_x, nu_y, phi, MU, cells=(cells, cells))
    assert math.hypot(one.x, one.y) <= MU * N * (1.0 + 1e-9)
    other = creep_force("halfspace", a, b, N, nu_x, -nu_y, -phi, MU, cells=(cells, cells))
    if nu_y != 0.0 or phi != 0.0:
        assert (other.x, other.y, other.moment) == (one.x, -one.y, -one.moment)


def test_scaling() -> None:
    one = creep_force("halfspace", A, B, N, 1e-3, 5e-4, 0.2, MU)
    twice = creep_force("halfspace", 2.0 * A, 2.0 * B, 4.0 * N, 1e-3, 5e-4, 0.1, MU)
    assert (twice.x, twice.y) == pytest.approx((4.0 * one.x, 4.0 * one.y), rel=1e-6)
    assert twice.moment == pytest.approx(8.0 * one.moment, rel=1e-6)


@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0])
def test_more_creepage_is_more_force(ratio: float) -> None:
    a, b = 5e-3 * math.sqrt(ratio), 5e-3 / math.sqrt(ratio)
    creepages = np.linspace(0.0, 0.03, 40)
    forces = [-creep_force("halfspace", a, b, N, nu_x, 0.0, 0.0, MU).x for nu_x in creepages]
    assert np.all(np.diff(forces) >= -1e-4 * MU * N)
    assert forces[0] == 0.0
    assert forces[1] > 0.0
    assert forces[-1] == pytest.approx(MU * N, rel=2e-3)


@pytest.mark.parametrize(
    "creepage", [(3e-3, 1e-3, 0.15), (1e-4, 5e-5, 0.01), (0.01, -0.02, 3.0), (0.0, 0.0, 1.0)]
)
def test_the_field(creepage: tuple[float, float, float]) -> None:
    """Its forces are those of its grid; the force is extrapolated from that and a coarser one."""
    nu_x, nu_y, phi = creepage
    field = traction_field("halfspace", A, B, N, *creepage, MU)
    areas = cell_areas(A, B, 50, 50)
    force = creep_force("halfspace", A, B, N, *creepage, MU, cells=(50, 50))
    moment = np.sum((field.x * field.q_y - field.y * field.q_x) * areas)
    assert np.sum(field.pressure * areas) == pytest.approx(N, rel=2e-3)
    assert np.sum(field.q_x * areas) == pytest.approx(force.x, abs=0.02 * MU * N)
    assert np.sum(field.q_y * areas) == pytest.approx(force.y, abs=0.02 * MU * N)
    assert moment == pytest.approx(force.moment, abs=0.02 * MU * N * math.sqrt(A * B))
    traction, slip = np.hypot(field.q_x, field.q_y), np.hypot(field.slip_x, field.slip_y)
    assert np.all(traction <= MU * field.pressure * (1.0 + 1e-9))
    against = field.q_x * field.slip_x + field.q_y * field.slip_y
    assert np.all(against <= 1e-9 * traction * slip)
    power = (np.sum(field.q_x * areas) * nu_x + np.sum(field.q_y * areas) * nu_y) + moment * phi
    if slip.any():
        assert np.sum(against * areas) == pytest.approx(power, rel=1e-6)


def test_the_field_is_mirrored() -> None:
    one = traction_field("halfspace", A, B, N, 2e-3, 1e-3, 0.3, MU, cells=(20, 20))
    other = traction_field("halfspace", A, B, N, 2e-3, -1e-3, -0.3, MU, cells=(20, 20))
    assert other.q_x[::-1] == pytest.approx(one.q_x, rel=1e-9)
    assert other.q_y[::-1] == pytest.approx(-one.q_y, rel=1e-9)
    assert other.slip_x[::-1] == pytest.approx(one.slip_x, rel=1e-9)


def test_the_exact_field_on_its_own_cells() -> None:
    spin = next(field for field in exact_fields() if field.case.name == "spin")
    found = traction_field("halfspace", *spin.case.arguments, cells=(80, 80))
    middle = np.abs(found.y[:, 0]).argmin()
    row = np.abs(spin.y - found.y[middle, 0]).argmin()
    ours = np.interp(spin.x, found.x[middle], found.q_y[middle], left=0.0, right=0.0)
    assert np.abs(ours - spin.q_y[row]).sum() <= 0.01 * np.abs(spin.q_y[row]).sum()


def test_nothing_from_nothing() -> None:
    for values in (
        (A, B, N, 0.0, 0.0, 0.0, MU),
        (A, B, 0.0, 1e-3, 0.0, 0.0, MU),
        (A, B, N, 1e-3, 0.0, 0.1, 0.0),
    ):
        force = creep_force("halfspace", *values)
        assert (force.x, force.y, force.moment) == (0.0, 0.0, 0.0)
        field = traction_field("halfspace", *values, cells=(8, 8))
        assert not field.q_x.any()
    rigid = traction_field("halfspace", A, B, N, 1e-3, 2e-3, 0.1, 0.0, cells=(8, 8))
    assert rigid.slip_x == pytest.approx(1e-3 - 0.1 * rigid.y)


def test_a_start_changes_nothing() -> None:
    """A log in time: each patch from the one before, mirrored ones among them."""
    start = None
    for step in range(6):
        turn = math.cos(0.6 * step)
        patch = RollingPatch(A, B * (1.0 + 0.02 * step), N, 2e-3, 1e-3 * turn, 0.3 * turn, MU, 82e9, 0.28)
        found, wanted = Fields(*np.zeros((5, 20, 20))), Fields(*np.zeros((5, 20, 20)))
        start = ellipse_field(patch, found, start)
        ellipse_field(patch, wanted)
        for ours, other in zip(found[1:3], wanted[1:3], strict=True):
            assert ours == pytest.approx(other, abs=1e-3 * MU * wanted.pressure.max())
    assert start.shape == (2, 20, 20)
