"""Time of the contact kernels, called from compiled code as the dynamics does.

Run: pytest tests/benchmarks -p benchmark --override-ini addopts="--import-mode=importlib"
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from hh_exudyn.contact.hertz import normal_contact
from hh_exudyn.contact.kalker import coefficients
from hh_exudyn.contact.theories import FASTRIP, FASTSIM, field_kernel, force_kernel
from hh_exudyn.kernel import kernel

CALLS = 1000


@kernel
def many_forces(theory: int, cells: int, calls: int) -> float:
    total = 0.0
    for i in range(calls):
        nu_x = 1e-3 + 1e-6 * (i & 1023)
        x, y, m = force_kernel(theory, 5e-3, 4e-3, 1e5, nu_x, 1e-3, 0.15, 0.3, 82e9, 0.28, cells, cells)
        total += x + y + m
    return total


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
    many_forces(theory, cells, 1)
    assert np.isfinite(benchmark(many_forces, theory, cells, CALLS))


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
    """One field of 50 x 50 cells."""
    arrays = [np.zeros((50, 50)) for _ in range(5)]
    benchmark(field_kernel, theory, 5e-3, 4e-3, 1e5, 3e-3, 1e-3, 0.15, 0.3, 82e9, 0.28, *arrays)
    assert np.isfinite(arrays[1]).all()
