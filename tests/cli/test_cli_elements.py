"""Tables by element of the track: every wheel of a few elements, the largest of many, and all as a table."""

import pytest
from rich.table import Table

from damage.summary import WheelsetSummary
from hh_exudyn.assessment.sections import AssessedSection
from hh_exudyn.cli import elements
from hh_exudyn.cli.elements import OfElement, print_elements, to_table


def wheelset(number: int, load: float, attack: float) -> WheelsetSummary:
    """The left wheel carries `load`, the right one 10 kN less, at its least 40 kN less."""
    pair = (load, load - 10e3)
    small = (2e3, 1e3)
    return WheelsetSummary(
        vehicle=1, wheelset=number, Q=pair, Y=small, y_over_q=(0.02, 0.01), Q_peak=pair, Y_peak=small,
        y_over_q_peak=(0.03, 0.02), Q_least=(load, load - 40e3), angle_of_attack=attack, lateral=attack,
        p_max=(1e9, 2e9), wear_number=(10.0, 20.0), fatigue_share=(0.0, 0.5),
    )  # fmt: skip


def found(count: int) -> list[OfElement]:
    """Elements of 100 m, the odd ones curves, with two wheelsets."""
    return [
        OfElement(
            AssessedSection("curve", 100.0 * i, 100.0 * (i + 1), -1 / 450)
            if i % 2
            else AssessedSection("straight", 100.0 * i, 100.0 * (i + 1)),
            [wheelset(1, 100e3 + 1e3 * i, 1e-3), wheelset(2, 90e3, -2e-3)],
            100e3,
        )
        for i in range(count)
    ]


@pytest.fixture
def tables(monkeypatch: pytest.MonkeyPatch) -> list[Table]:
    shown: list[Table] = []
    monkeypatch.setattr(elements.output, "print_table", shown.append)
    return shown


def cells(table: Table) -> list[list[str]]:
    return [list(row) for row in zip(*(list(column.cells) for column in table.columns), strict=True)]


def test_every_wheel_of_a_few_elements(tables: list[Table]) -> None:
    print_elements(found(2))
    forces, contact = map(cells, tables)
    assert [row[0] for row in forces] == [
        "straight", "0 to 100 m", "", "", "curve R 450 m", "right-hand", "100 to 200 m", "",
    ]  # fmt: skip
    assert [row[1] for row in forces] == 2 * ["1L", "1R", "2L", "2R"]
    assert forces[5][2:] == ["91.0", "91.0", "1.0", "1.0", "0.010", "0.020", "0.39"]
    assert contact[4][2:] == ["1.00", "1.00", "1000", "10", "0"]
    assert contact[5][2:] == ["", "", "2000", "20", "50"]  # numbers of the wheelset stand once


def test_the_largest_of_many_elements(tables: list[Table]) -> None:
    print_elements(found(8))
    forces, contact = map(cells, tables)
    assert len(forces) == len(contact) == 8
    assert forces[3] == ["curve R 450 m right", "300", "103.0 1L", "2.0 1L", "2.0 1L", "0.030 1L", "0.50 2R"]
    assert contact[0][2:4] == ["-2.00 2", "-2.00 2"]  # of either sign


def test_all_as_a_table() -> None:
    rows = to_table(found(3)).to_pylist()
    assert len(rows) == 3 * 2 * 2
    assert rows[5]["element"] == "curve R 450 m right"
    assert (rows[5]["start_m"], rows[5]["wheelset"], rows[5]["side"]) == (100.0, 1, "R")
    assert rows[5]["q_mean_N"] == pytest.approx(91e3)
    assert rows[5]["unloading_peak"] == pytest.approx(0.39)
