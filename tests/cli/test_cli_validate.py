"""`hh-exudyn validate`: sections, one form of table, verdicts. The rows are held beside their packages."""

from pathlib import Path

import pytest
from command_line import call, refused

from hh_exudyn.cli import validate
from hh_exudyn.contact.comparison import Comparison
from hh_exudyn.contact.halfspace import validation
from hh_exudyn.contact.tangential.validation import contact_table, to_table
from hh_exudyn.contact.validation import coefficient_rows, theory_rows

HOLDS = Comparison("height [mm]", "somebody", 1.004, 1.0, 0.01)
FAILS = Comparison("width of [it]", "nobody", 2.0, 1.0, 0.01)


def test_a_section_prints_every_row_and_a_failing_one_is_exit_code_1(monkeypatch: pytest.MonkeyPatch) -> None:
    """The quick parts of the half-space; all of them run in tests/contact/halfspace/test_validation.py."""
    rows = [*validation._hertz(), FAILS]
    monkeypatch.setattr(validation, "halfspace_table", lambda: rows)
    result = call("validate", "halfspace")
    assert result.exit_code == 1
    assert result.stderr == "hh-exudyn: 1 of 4 comparisons fail\n"
    for row in rows:
        assert row.quantity in result.stdout
    assert result.stdout.count("holds") == 3
    assert result.stdout.count("FAILS") == 1
    monkeypatch.setattr(validation, "halfspace_table", lambda: rows[:-1])
    assert call("validate", "halfspace").exit_code == 0


@pytest.mark.parametrize("words", [("validate",), ("validate", "all")])
def test_all_sections_in_one_form(monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]) -> None:
    for name, (title, _) in list(validate.SECTIONS.items()):
        rows = [HOLDS, FAILS] if name == "vehicles" else [HOLDS]
        monkeypatch.setitem(validate.SECTIONS, name, (title, lambda *_, rows=rows: rows))
    result = call(*words)
    assert result.exit_code == 1
    titles = [line for line in result.stdout.splitlines() if line.endswith("against numbers from outside")]
    assert len(titles) == len(validate.SECTIONS) == 5
    printed = [line.split() for line in result.stdout.splitlines()]
    assert printed.count(["height", "[mm]", "somebody", "1.004", "1", "0.40", "1", "holds"]) == 5
    assert printed.count(["width", "of", "[it]", "nobody", "2", "1", "100.00", "1", "FAILS"]) == 1
    assert "5 of 6 comparisons hold" in result.stdout


def test_contact_prints_its_rows_and_the_table_of_errors() -> None:
    result = call("validate", "contact")
    assert result.exit_code == 0, result.stderr
    assert "…" not in result.stdout  # nothing cut off
    errors = contact_table()
    printed = [line.split() for line in result.stdout.splitlines()]
    for texts in to_table(errors):
        assert " ".join(texts).split() in printed
    for row in (*theory_rows(errors), *coefficient_rows()):
        assert any(row.quantity in line and "holds" in line for line in result.stdout.splitlines())


def test_geometry_prints_what_needs_no_profiles_of_others() -> None:
    result = call("validate", "geometry")
    assert result.exit_code == 0, result.stderr
    assert result.stdout.count("EN 15302, E") == 4
    assert result.stdout.count("holds") == 6


def test_a_missing_folder_of_profiles_is_bad_input(tmp_path: Path) -> None:
    for section in ("geometry", "all"):
        assert "there is no such folder" in refused("validate", section, "--profiles", tmp_path / "none")
    assert "RUIC519A.dat" in refused("validate", "geometry", "--profiles", tmp_path)
