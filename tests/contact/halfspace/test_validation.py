"""The table of comparisons: complete, and every row within what is allowed."""

import pytest

from hh_exudyn.contact.comparison import Comparison
from hh_exudyn.contact.halfspace.validation import creep_coefficients, halfspace_table
from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.tangential.kalker import kalker_coefficients


def test_a_comparison() -> None:
    row = Comparison("force [N]", "by hand", 101.0, 100.0, 0.02)
    assert row.deviation == pytest.approx(0.01)
    assert row.holds
    assert not Comparison("force [N]", "by hand", 97.0, 100.0, 0.02).holds
    assert not Comparison("error", "by hand", 0.03, 0.0, 0.02).holds


def test_kalkers_table() -> None:
    """His three digits, interpolated."""
    found = creep_coefficients(1.0, STEEL, (40, 52, 64, 76, 88))
    wanted = kalker_coefficients(1.0, STEEL.poisson_ratio)
    assert found[:3] == pytest.approx(wanted[:3], rel=5e-3)
    assert found[3] == pytest.approx(wanted[3], rel=0.015)


@pytest.mark.slow
def test_every_comparison_holds() -> None:
    rows = halfspace_table()
    assert len(rows) == 21
    assert [row.quantity for row in rows if not row.holds] == []
