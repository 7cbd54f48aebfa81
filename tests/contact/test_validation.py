"""The rows of ``hh-exudyn validate contact``."""

from dataclasses import replace

import pytest

from hh_exudyn.contact.tangential.validation import TheoryErrors, contact_table
from hh_exudyn.contact.validation import coefficient_rows, theory_rows


@pytest.fixture(scope="module")
def table() -> list[TheoryErrors]:
    return contact_table()


def test_every_theory_holds_what_it_is_held_to(table: list[TheoryErrors]) -> None:
    """Measured: FaStrip 1.06 and 5.7 %, |q| 4.4, slip 18, peak 3.7; half-space 0.07, 0.3, 2.2, 5 %."""
    rows = theory_rows(table)
    assert len(rows) == 15
    assert [row.quantity for row in rows if not row.holds] == []


def test_a_worse_theory_fails(table: list[TheoryErrors]) -> None:
    worse = [replace(row, force_mean=0.2) for row in table]
    assert sum(not row.holds for row in theory_rows(worse)) == 6


def test_kalkers_coefficients() -> None:
    """Measured over the table: 1.1 % (C23 at nu = 0.5: 1.5); C33 1.8 %, and 2.8 at a/b = 10, nu = 0.28."""
    rows = coefficient_rows()
    assert len(rows) == 3 + 4 + 4 + 3
    assert [row.quantity for row in rows if not row.holds] == []
    assert any(f"worst of {4 * 41}" in row.quantity for row in rows)
