"""What holds for every theory of the tangential contact: symmetry, limits, energy, borders."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.tangential.api import cell_areas, creep_force, traction_field
from hh_exudyn.contact.tangential.registry import FIELD_THEORIES, THEORIES, field_kernel, force_kernel
from hh_exudyn.contact.types import Fields, RollingPatch

A, B, N, MU = 7.5e-3, 2.9e-3, 142668.0, 0.37
SATURATING = [name for name in THEORIES if name != "linear"]
theories = pytest.mark.parametrize("theory", list(THEORIES))
saturating = pytest.mark.parametrize("theory", SATURATING)
with_field = pytest.mark.parametrize("theory", FIELD_THEORIES)
LOG_RATIO = st.floats(-3.5, 3.5)
CREEPAGE = st.one_of(st.floats(-0.1, 0.1), st.floats(-1e-4, 1e-4))
SPIN = st.one_of(st.floats(-30.0, 30.0), st.just(0.0))


@pytest.fixture(scope="module", autouse=True)
def compiled() -> None:
    """Compile before the first property is timed."""
    creep_force("fastrip", A, B, N, 1e-3, 0.0, 0.0, MU)
    traction_field("fastrip", A, B, N, 1e-3, 0.0, 0.0, MU, cells=(5, 5))


@given(st.sampled_from(SATURATING), LOG_RATIO, CREEPAGE, CREEPAGE, SPIN, st.integers(5, 24))
def test_friction_limits_the_force(
    theory: str, log_ratio: float, nu_x: float, nu_y: float, phi: float, cells: int
) -> None:
    a, b = 5e-3 * math.exp(0.5 * log_ratio), 5e-3 * math.exp(-0.5 * log_ratio)
    force = creep_force(theory, a, b, N, nu_x, nu_y, phi, MU, cells=(cells, cells))
    assert math.hypot(force.x, force.y) <= MU * N * (1.0 + 1e-9)
    assert abs(force.moment) <= MU * N * max(a, b)


@given(st.sampled_from(list(THEORIES)), LOG_RATIO, CREEPAGE, CREEPAGE, SPIN)
def test_mirror(theory: str, log_ratio: float, nu_x: float, nu_y: float, phi: float) -> None:
    a, b = 5e-3 * math.exp(0.5 * log_ratio), 5e-3 * math.exp(-0.5 * log_ratio)
    one = creep_force(theory, a, b, N, nu_x, nu_y, phi, MU)
    other = creep_force(theory, a, b, N, nu_x, -nu_y, -phi, MU)
    assert (other.x, other.y, other.moment) == pytest.approx(
        (one.x, -one.y, -one.moment), rel=1e-9, abs=1e-9 * MU * N
    )


@given(st.sampled_from(list(THEORIES)), LOG_RATIO, CREEPAGE, CREEPAGE, SPIN, st.floats(0.1, 10.0))
def test_scaling(theory: str, log_ratio: float, nu_x: float, nu_y: float, phi: float, scale: float) -> None:
    """All lengths times s, pressures kept: forces times s^2, moments times s^3."""
    a, b = 5e-3 * math.exp(0.5 * log_ratio), 5e-3 * math.exp(-0.5 * log_ratio)
    one = creep_force(theory, a, b, N, nu_x, nu_y, phi, MU)
    other = creep_force(theory, scale * a, scale * b, scale**2 * N, nu_x, nu_y, phi / scale, MU)
    expected = (one.x * scale**2, one.y * scale**2, one.moment * scale**3)
    # a strip at the very limit of sticking may fall on either side
    assert (other.x, other.y) == pytest.approx(expected[:2], rel=1e-6, abs=1e-6 * MU * N * scale**2)
    assert other.moment == pytest.approx(expected[2], rel=1e-6, abs=1e-6 * MU * N * scale**3 * max(a, b))


@theories
@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0])
def test_more_longitudinal_creepage_is_more_force(theory: str, ratio: float) -> None:
    a, b = 5e-3 * math.sqrt(ratio), 5e-3 / math.sqrt(ratio)
    creepages = np.linspace(0.0, 0.03, 120)
    forces = [-creep_force(theory, a, b, N, nu_x, 0.0, 0.0, MU).x for nu_x in creepages]
    assert np.all(np.diff(forces) >= -1e-9 * MU * N)
    assert forces[1] > 0.0


@theories
@given(nu_x=CREEPAGE, nu_y=CREEPAGE)
def test_without_spin_the_force_opposes_the_creepage(theory: str, nu_x: float, nu_y: float) -> None:
    force = creep_force(theory, A, B, N, nu_x, nu_y, 0.0, MU)
    assert force.x * nu_x <= 0.0
    assert force.y * nu_y <= 0.0


@saturating
def test_large_creepage_is_full_friction(theory: str) -> None:
    force = creep_force(theory, A, B, N, 3.0, 0.0, 0.0, MU)
    assert (force.x, force.y) == pytest.approx((-MU * N, 0.0), rel=2e-3, abs=1e-6)


@with_field
@pytest.mark.parametrize(
    "creepage", [(3e-3, 1e-3, 0.15), (1e-4, 5e-5, 0.01), (0.01, -0.02, 3.0), (0.0, 0.0, 1.0)]
)
def test_the_field_adds_up_to_the_force(theory: str, creepage: tuple[float, float, float]) -> None:
    nu_x, nu_y, phi = creepage
    field = traction_field(theory, A, B, N, *creepage, MU)
    areas = cell_areas(A, B, 50, 50)
    force = creep_force(theory, A, B, N, *creepage, MU, cells=(50, 50))
    moment = np.sum((field.x * field.q_y - field.y * field.q_x) * areas)
    assert np.sum(areas) == pytest.approx(math.pi * A * B, rel=2e-3)
    assert np.sum(field.pressure * areas) == pytest.approx(N, rel=2e-3)
    assert np.sum(field.q_x * areas) == pytest.approx(force.x, abs=3e-3 * MU * N)
    assert np.sum(field.q_y * areas) == pytest.approx(force.y, abs=3e-3 * MU * N)
    assert moment == pytest.approx(force.moment, abs=3e-3 * MU * N * math.sqrt(A * B))
    # steady rolling: the elastic part does no net work, so friction dissipates the power of the creepages
    dissipated = np.sum((field.q_x * field.slip_x + field.q_y * field.slip_y) * areas)
    force_x, force_y = np.sum(field.q_x * areas), np.sum(field.q_y * areas)
    slips = bool(field.slip_x.any() or field.slip_y.any())  # some slip zones are shorter than a cell
    if slips:
        assert dissipated == pytest.approx(force_x * nu_x + force_y * nu_y + moment * phi, rel=1e-6)
    power = force.x * nu_x + force.y * nu_y + force.moment * phi
    unit = MU * N * (abs(nu_x) + abs(nu_y) + math.sqrt(A * B) * abs(phi))
    assert dissipated == pytest.approx(power, abs=(3e-3 if slips else 1e-2) * unit)


@given(st.sampled_from(FIELD_THEORIES), LOG_RATIO, CREEPAGE, CREEPAGE, SPIN)
def test_slip_opposes_traction_and_stick_does_not_slip(
    theory: str, log_ratio: float, nu_x: float, nu_y: float, phi: float
) -> None:
    a, b = 5e-3 * math.exp(0.5 * log_ratio), 5e-3 * math.exp(-0.5 * log_ratio)
    field = traction_field(theory, a, b, N, nu_x, nu_y, phi, MU, cells=(20, 20))
    for values in (field.pressure, field.q_x, field.q_y, field.slip_x, field.slip_y):
        assert np.all(np.isfinite(values))
    traction, slip = np.hypot(field.q_x, field.q_y), np.hypot(field.slip_x, field.slip_y)
    assert np.all(traction <= MU * field.pressure * (1.0 + 1e-9))
    # nowhere does friction drive
    assert np.all(field.q_x * field.slip_x + field.q_y * field.slip_y <= 1e-9 * traction * slip)


@with_field
def test_slow_creepage_sticks_in_front(theory: str) -> None:
    field = traction_field(theory, A, B, N, 2e-3, 0.0, 0.0, MU)
    middle = 25
    assert np.all(field.slip_x[middle, 40:] == 0.0)
    assert np.all(field.slip_x[middle, :3] > 0.0)
    assert np.all(np.diff(field.x[middle]) > 0.0)


@theories
def test_nothing_from_nothing(theory: str) -> None:
    for values in (
        (A, B, N, 0.0, 0.0, 0.0, MU),
        (A, B, 0.0, 1e-3, 0.0, 0.0, MU),
        (0.0, 0.0, 0.0, 1e-3, 1e-3, 0.1, MU),
        (A, B, N, 1e-3, 1e-3, 0.1, 0.0),
    ):
        force = creep_force(theory, *values)
        assert (force.x, force.y, force.moment) == (0.0, 0.0, 0.0)
        if theory not in FIELD_THEORIES:
            continue
        field = traction_field(theory, *values, cells=(8, 8))
        assert not field.q_x.any()
        assert not field.q_y.any()
        assert np.all(np.isfinite(field.slip_x))


@with_field
def test_without_friction_the_patch_slips_rigidly(theory: str) -> None:
    field = traction_field(theory, A, B, N, 1e-3, 2e-3, 0.1, 0.0, cells=(8, 8))
    assert np.sum(field.pressure * cell_areas(A, B, 8, 8)) == pytest.approx(N, rel=0.03)
    assert field.slip_x == pytest.approx(1e-3 - 0.1 * field.y)
    assert field.slip_y == pytest.approx(2e-3 + 0.1 * field.x)


def test_an_unknown_theory_names_the_known_ones() -> None:
    with pytest.raises(ValueError, match="carter, linear, strip, fastsim"):
        creep_force("vermeulen", A, B, N, 0.0, 0.0, 0.0, MU)
    patch, fields = RollingPatch(A, B, N, 1e-3, 0.0, 0.0, MU, 82e9, 0.28), Fields(*np.zeros((5, 3, 4)))
    assert all(math.isnan(value) for value in force_kernel(99, patch, 5, 5))
    field_kernel(99, patch, fields)
    assert np.all(np.isnan(fields))


@pytest.mark.parametrize(
    ("change", "name"),
    [
        ({"a": 0.0}, "a = 0.0 m"),
        ({"b": -1e-3}, "b = -0.001 m"),
        ({"normal_force": -1.0}, "normal_force"),
        ({"friction": -0.1}, "friction"),
        ({"nu_x": math.nan}, "nu_x"),
        ({"phi": math.inf}, "phi"),
        ({"cells": (0, 5)}, "cells"),
        ({"cells": (20, 10**9)}, "from 1 to 2000"),
        ({"cells": (math.inf, 20)}, "cells"),
    ],
)
def test_bad_input_is_named(change: dict[str, object], name: str) -> None:
    values: dict[str, object] = {
        "a": A, "b": B, "normal_force": N, "nu_x": 0.0, "nu_y": 0.0, "phi": 0.0, "friction": MU,
    }  # fmt: skip
    with pytest.raises(ValueError, match=name):
        creep_force("fastrip", **(values | change))
    with pytest.raises(ValueError, match=name):
        traction_field("fastrip", **(values | change), material=STEEL)
