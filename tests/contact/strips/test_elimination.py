"""Elimination of a part of the unknowns, and of all, against numpy."""

import numpy as np
import pytest

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.elimination import PADDING, reduce_rows, solve_few, substitute_back
from hh_exudyn.kernel import kernel


@kernel
def few(n: int, rows: FloatArray, factors: FloatArray) -> None:
    solve_few(n, rows, factors)


@kernel
def reduced(
    pivots: int, end: int, more: int, order: FloatArray, count: int, rows: FloatArray, factors: FloatArray
) -> None:
    """Rows up to `end`, then those up to `more` as well."""
    reduce_rows(pivots, 0, end, order, count, rows, factors)
    reduce_rows(pivots, end, more, order, count, rows, factors)


@kernel
def back(pivots: int, order: FloatArray, factors: FloatArray, values: FloatArray) -> None:
    substitute_back(pivots, order, factors, values)


def system(n: int, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Influences that fall with the distance, a right-hand side, and memory with NaN wherever none is set."""
    numbers = np.random.default_rng(seed)
    apart = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    rows = numbers.uniform(0.5, 2.0, n)[:, None] / (0.3 + apart)  # not symmetric, as those of strips
    memory = np.full((n + 1, n + PADDING), np.nan)
    memory[:n, :n], memory[n, :n] = rows, numbers.uniform(-1.0, 1.0, n)
    return rows, memory[n, :n].copy(), memory


@pytest.mark.parametrize("n", [1, 2, 3, 8, 9, 20, 47])
def test_whole_system(n: int) -> None:
    rows, values, memory = system(n, n)
    factors = np.full_like(memory, np.nan)
    few(n, memory, factors)
    assert factors[n, :n] == pytest.approx(np.linalg.solve(rows.T, values), rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("pivots", [[], [1], [0, 3], [2, 3, 4], [1, 2, 3, 4, 5, 6, 7, 9, 10, 11]])
def test_part_of_a_system(pivots: list[int]) -> None:
    """What remains is the system of the other unknowns; of it and of the multiples follow the eliminated."""
    n = 13
    rows, values, memory = system(n, 1)
    factors = np.full_like(memory, np.nan)
    others = [k for k in range(n) if k not in pivots]
    # a later call reduces the last of them
    order = np.array([*pivots, *others[:-1], n, others[-1]], dtype=float)
    reduced(len(pivots), n, n + 1, order, n, memory, factors)
    exact = np.linalg.solve(rows.T, values)
    left, right = memory[np.ix_(others, others)], memory[n, others]
    assert np.linalg.solve(left.T, right) == pytest.approx(exact[others], rel=1e-10, abs=1e-12)
    multiples = factors[n].copy()
    for k in others:
        multiples -= exact[k] * factors[k]
    back(len(pivots), order, factors, multiples)
    assert multiples[pivots] == pytest.approx(exact[pivots], rel=1e-10, abs=1e-12)
