"""The sheet of an assessed run: histories as they are, limits drawn or written, shares by kind."""

from pathlib import Path

import numpy as np
import pytest
from made_up_run import made_up_run

from hh_exudyn.assessment.report import standard_assessment
from hh_exudyn.figures.assessment import assessment_sheet


def test_sheet(tmp_path: Path) -> None:
    run = made_up_run(
        tmp_path / "run",
        lambda wheelset, side, t: 150e3 + 10e3 * np.sin(6.0 * t),
        lambda wheelset, side, t: 5e3 * side * np.sin(6.0 * t),
        lateral_velocity=lambda t: 0.01 * np.sin(6.0 * t),
    )
    found = standard_assessment(run)
    figure = assessment_sheet("a title", found)
    sum_y, y_over_q, q, unloading, lateral, vertical, shares = figure.axes
    history = found.histories["q"]
    assert q.lines[2].get_ydata() == pytest.approx(
        1e-3 * history.values[:, 0]
    )  # after the section's two edges
    assert q.lines[2].get_xdata() == pytest.approx(history.s[:, 0])
    limit = q.lines[-1]
    assert limit.get_ydata() == pytest.approx([200.0, 200.0])
    assert limit.get_linestyle() == "--"  # unconfirmed
    for axes, text in (
        (sum_y, "limit ±91.9, unconfirmed: off this panel"),
        (y_over_q, "limit 0.8: off this panel"),
        (unloading, "limit 0.9, unconfirmed: off this panel"),
        (lateral, "limit ±3, unconfirmed: off this panel"),
        (vertical, "limit ±5, unconfirmed: off this panel"),
    ):
        assert [one.get_text() for one in axes.texts] == [text]
    rows = [label.get_text() for label in shares.get_yticklabels()]
    assert rows == [
        "ΣY", "Y/Q", "Y/Q, Nadal", "Σ|Y/Q|, Weinstock", "ΔQ/Q0", "ΔQ/Q0 quasi-static", "Q", "body lateral",
        "body vertical", "ΣY, f0 ± 2 Hz, rms",
    ]  # fmt: skip
    drawn = shares.lines[rows.index("Q")]
    expected = [100.0 * one.share for one in found.findings if one.quantity == "q"]
    assert drawn.get_xdata() == pytest.approx(expected)
    assert drawn.get_markerfacecolor() == "none"
    assert shares.lines[rows.index("Y/Q")].get_markerfacecolor() != "none"
