"""Creep forces of strips with their own slip: the ellipse's on a flat patch, continuity, fields."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hh_exudyn.contact.strips.creep import strip_creep_forces, strip_fields
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.tangential.fastrip import field_on_strips, force_on_strips
from hh_exudyn.contact.tangential.strips import STRIP_COLUMNS
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel, memory, shaped

G, NU, CELLS = 82e9, 0.28, 32
_STATE = ROWS * CAPACITY


@kernel
def _solve(rows: np.ndarray, count: int, fields: Fields) -> None:
    """Creep forces into the rows, and the fields."""
    state = memory(_STATE)
    s = shaped(state, (ROWS, CAPACITY))
    for row in range(ROWS):
        for j in range(count):
            s[row, j] = rows[row, j]
    strip_creep_forces(count, G, NU, CELLS, state)
    strip_fields(count, G, NU, state, fields)
    for row in range(ROWS):
        for j in range(count):
            rows[row, j] = s[row, j]


def flat(patch: RollingPatch, count: int) -> tuple[np.ndarray, np.ndarray]:
    """An ellipse in strips: rows of `Row`, and rows as `force_on_strips` takes them."""
    rows, strips = np.zeros((ROWS, CAPACITY)), np.zeros((count, STRIP_COLUMNS))
    place = -1.0 + (2.0 * np.arange(count) + 1.0) / count
    root, width = np.sqrt(1.0 - place**2), 2.0 * patch.b / count
    peak = 1.5 * patch.normal_force / (math.pi * patch.a * patch.b)
    strips[:] = np.column_stack((patch.b * place, np.full(count, width), patch.a * root, peak * root))
    used = slice(0, count)
    rows[Row.WIDTH, used], rows[Row.HALF_LENGTH, used] = width, patch.a * root
    rows[Row.PRESSURE, used], rows[Row.A, used], rows[Row.B, used] = peak * root, patch.a, patch.b
    rows[Row.LOAD, used] = 0.5 * math.pi * width * patch.a * peak * root**2
    rows[Row.PEAK, used], rows[Row.CENTRE, 1:count] = 0.5 * math.pi * patch.a * peak, 1.0
    rows[Row.NU_X, used] = patch.nu_x - patch.phi * strips[:, 0]
    rows[Row.NU_Y, used], rows[Row.PHI, used] = patch.nu_y, patch.phi
    rows[Row.MEAN_X, used], rows[Row.MEAN_Y, used], rows[Row.TURN_X, used] = (
        patch.nu_x,
        patch.nu_y,
        patch.nu_x,
    )
    rows[Row.FRICTION, used] = patch.friction
    return rows, strips


def _above_rounding(value: float) -> float:
    """Zero below 1e-9: slip is a difference of speeds, of which the last digit is then the whole."""
    return 0.0 if abs(value) < 1e-9 else value


CREEPAGES = st.one_of(st.just(0.0), st.floats(-0.02, 0.02).map(_above_rounding))


@settings(max_examples=100, deadline=None)
@given(
    CREEPAGES,
    CREEPAGES,
    st.floats(-3.0, 3.0).map(_above_rounding),
    st.floats(-1.5, 1.5),
    st.integers(4, 100),
)
def test_flat_patch_is_the_ellipse(nu_x: float, nu_y: float, phi: float, ratio: float, count: int) -> None:
    """The spin counts once: as slip that falls across and as slip along each strip."""
    a, b = 6e-3 * math.exp(0.5 * ratio), 6e-3 * math.exp(-0.5 * ratio)
    patch = RollingPatch(a, b, 1e5, nu_x, nu_y, phi, 0.4, G, NU)
    rows, strips = flat(patch, count)
    load = rows[Row.LOAD].sum()  # the midpoint rule's, which `force_on_strips` scales to the whole
    exact = np.array(force_on_strips(strips, count, patch._replace(normal_force=1e5), CELLS)) * load / 1e5
    fields, of_strips = (Fields(*np.zeros((5, count, CELLS))) for _ in range(2))
    _solve(rows, count, fields)
    field_on_strips(strips, count, patch, of_strips)
    moment = rows[Row.MOMENT_Z, :count] - strips[:, 0] * rows[Row.FORCE_X, :count]
    found = np.array([rows[Row.FORCE_X].sum(), rows[Row.FORCE_Y].sum(), moment.sum()])
    if nu_x or nu_y or phi:
        assert found == pytest.approx(exact, rel=1e-6, abs=1e-6 * 0.4 * 1e5)
        for one, other in zip(fields, of_strips, strict=True):
            assert one == pytest.approx(other, rel=1e-6, abs=1e-6 * max(np.abs(other).max(), 1e-12))


def test_more_strips_than_a_block() -> None:
    patch = RollingPatch(4e-3, 9e-3, 1e5, 2e-3, 1e-3, 0.4, 0.4, G, NU)
    forces = []
    for count in (64, 65, 150):
        rows, _ = flat(patch, count)
        _solve(rows, count, Fields(*np.zeros((5, count, CELLS))))
        forces.append([rows[Row.FORCE_X].sum(), rows[Row.FORCE_Y].sum()])
    assert forces[1] == pytest.approx(forces[0], rel=1e-3)
    assert forces[2] == pytest.approx(forces[0], rel=2e-3)


def test_without_friction_there_is_no_force() -> None:
    rows, _ = flat(RollingPatch(6e-3, 6e-3, 1e5, 1e-3, 0.0, 0.0, 0.4, G, NU), 16)
    rows[Row.FRICTION] = 0.0
    _solve(rows, 16, Fields(*np.zeros((5, 16, CELLS))))
    assert not rows[Row.FORCE_X].any()
    assert not rows[Row.FORCE_Y].any()
