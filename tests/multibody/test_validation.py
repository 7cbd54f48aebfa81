"""The table of ``hh-exudyn validate vehicles``: what no other test holds of it.

Rest stands in test_equilibrium, the curve of the demo in test_steady_curve, modes and hunting in
linear/test_linear.
"""

import pytest

from hh_exudyn.contact.comparison import Comparison
from hh_exudyn.multibody import validation


def test_a_free_wheelset_sways_in_klingels_wave():
    """On cones of 0.05, by its mode at 10 m/s; in time in test_klingel."""
    (row,) = validation._klingel()
    assert row.wanted == pytest.approx(16.5, abs=0.3)
    assert row.holds


def test_the_table_has_the_rows_of_every_part(monkeypatch):
    rows = [Comparison(f"number {k}", "nobody", 1.0, 1.0, 0.0) for k in range(3)]
    monkeypatch.setattr(validation, "_PARTS", (lambda: rows[:1], lambda: rows[1:]))
    assert validation.vehicles_table() == rows
