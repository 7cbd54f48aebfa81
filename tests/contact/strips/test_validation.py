"""The table of ``hh-exudyn validate strips``."""

from hh_exudyn.contact.strips.validation import strips_table


def test_every_row_holds() -> None:
    rows = strips_table()
    assert len(rows) == 13
    assert [row.quantity for row in rows if not row.holds] == []
