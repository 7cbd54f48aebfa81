"""Time of the contact kernels, called from compiled code as the dynamics does.

The compiled Fortran of shared/reference/timing.md takes 110 us for FaStrip's stress and slip fields at 50 x
50 cells and 74 us for FASTSIM's; asked: forces in 11, fields in 27 us. Measured on one core of an AMD EPYC
(AVX-512): FaStrip's force 0.63 us at 11 x 11, 1.2 at 20 x 20, 4.2 at 50 x 50 (8.3 where the whole patch
slips), its field at 50 x 50 8.5 us (12.7); as strips the same; FASTSIM 0.6, 1.3, 6.2 and 17.

Run: pytest tests/benchmarks -p benchmark --override-ini addopts="--import-mode=importlib"
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.normal.hertz import normal_contact
from hh_exudyn.contact.tangential import fastrip
from hh_exudyn.contact.tangential.kalker import coefficients
from hh_exudyn.contact.tangential.registry import FASTRIP, FASTSIM, field_kernel, force_kernel
from hh_exudyn.contact.tangential.strips import HALF_LENGTH, PRESSURE, STRIP_COLUMNS, WIDTH, Y
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import inlined_kernel, kernel

CALLS = 1000


# given at run time and another in every call, so that the compiler can work out nothing beforehand
PATCH = RollingPatch(5e-3, 4e-3, 1e5, 1e-3, 1e-3, 0.15, 0.3, 82e9, 0.28)


@inlined_kernel
def another(patch: RollingPatch, i: int) -> RollingPatch:
    a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio = patch
    change = 1e-6 * (i & 1023)
    return RollingPatch(
        a + change, b, normal_force, nu_x + change, nu_y, phi, friction, shear_modulus, poisson_ratio
    )


@kernel
def many_forces(theory: int, patch: RollingPatch, cells: int, calls: int) -> float:
    total = 0.0
    for i in range(calls):
        x, y, m = force_kernel(theory, another(patch, i), cells, cells)
        total += x + y + m
    return total


@kernel
def many_forces_on_strips(strips: FloatArray, patch: RollingPatch, cells: int, calls: int) -> float:
    total = 0.0
    for i in range(calls):
        x, y, m = fastrip.force_on_strips(strips, len(strips), another(patch, i), cells)
        total += x + y + m
    return total


@kernel
def many_fields(theory: int, patch: RollingPatch, fields: Fields, calls: int) -> None:
    for i in range(calls):
        field_kernel(theory, another(patch, i), fields)


@kernel
def many_contacts(calls: int) -> float:
    total = 0.0
    for i in range(calls):
        force, a, b, p = normal_contact(1e-5 + 1e-8 * (i & 1023), 1.1, 0.5 + 1e-3 * (i & 511), 82e9, 0.28)
        total += force + a + b + p
    return total


@kernel
def many_coefficients(calls: int) -> float:
    total = 0.0
    for i in range(calls):
        c11, c22, c23, c33 = coefficients(0.2 + 4e-3 * (i & 1023), 0.28)
        total += c11 + c22 + c23 + c33
    return total


@pytest.mark.parametrize("cells", [11, 15, 20, 50])
@pytest.mark.parametrize("theory", [FASTRIP, FASTSIM])
def test_force(benchmark: Callable[..., Any], theory: int, cells: int) -> None:
    """A thousand creep forces."""
    many_forces(theory, PATCH, cells, 1)
    assert np.isfinite(benchmark(many_forces, theory, PATCH, cells, CALLS))


@pytest.mark.parametrize("cells", [11, 20, 50])
def test_force_on_strips(benchmark: Callable[..., Any], cells: int) -> None:
    """A thousand creep forces of a patch given as strips."""
    lateral = -1.0 + (2.0 * np.arange(cells) + 1.0) / cells
    strips = np.zeros((cells, STRIP_COLUMNS))
    strips[:, Y], strips[:, WIDTH] = 4e-3 * lateral, 8e-3 / cells
    strips[:, HALF_LENGTH] = 5e-3 * np.sqrt(1.0 - lateral**2)
    strips[:, PRESSURE] = 2.387e9 * np.sqrt(1.0 - lateral**2)
    many_forces_on_strips(strips, PATCH, cells, 1)
    assert np.isfinite(benchmark(many_forces_on_strips, strips, PATCH, cells, CALLS))


def test_normal_contact(benchmark: Callable[..., Any]) -> None:
    """A thousand Hertz contacts."""
    many_contacts(1)
    assert np.isfinite(benchmark(many_contacts, CALLS))


def test_coefficients(benchmark: Callable[..., Any]) -> None:
    """A thousand sets of Kalker's coefficients."""
    many_coefficients(1)
    assert np.isfinite(benchmark(many_coefficients, CALLS))


@pytest.mark.parametrize("theory", [FASTRIP, FASTSIM])
def test_field(benchmark: Callable[..., Any], theory: int) -> None:
    """A hundred fields of 50 x 50 cells."""
    fields = Fields(*np.zeros((5, 50, 50)))
    many_fields(theory, PATCH, fields, 1)
    benchmark(many_fields, theory, PATCH, fields, 100)
    assert np.isfinite(fields.q_x).all()
