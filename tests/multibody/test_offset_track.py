"""A track 95 mm beside its design line, both rails: the run goes on, and its wheels stay on their rails."""

import math
from pathlib import Path

from run_tables import table

from hh_exudyn.multibody.simulate import simulate


def test_a_track_beside_its_design_line_is_no_derailment(demo, tmp_path: Path) -> None:
    """The lateral limit of 80 mm is the wheelset's to its rails; it was once that to the design line."""
    length, rise = 170.0, 80.0

    def offset(s: float) -> float:
        return 95.0 * 0.5 * (1.0 - math.cos(math.pi * min(s / rise, 1.0)))

    rows = (
        f"{0.5 * i},{0.1 * (-1) ** i},{offset(0.5 * i)},{0.1 * (-1) ** i},{0.1 * (-1) ** i}"
        for i in range(600)
    )
    (tmp_path / "offset.csv").write_text("\n".join(rows) + "\n")
    case = demo.with_changes(
        name="offset",
        speed_km_h=100.0,
        track={
            "flexibility": "rigid",
            "irregularity": str(tmp_path / "offset.csv"),
            "sections": [{"kind": "straight", "length_m": length, "gauge_mm": 1445.0}],
        },
        contact={"theory": "polach", "normal": "hertz"},
    )
    run = simulate(case, tmp_path / "run")
    contact = table(run, "contact")
    assert contact.y_wheelset.max() > 0.085
    assert run.status["finished"] is True
    assert run.status["wheel_climb"] == []
    assert all(wheel["lift_mm"] < 2.0 for wheel in run.status["watch"])
