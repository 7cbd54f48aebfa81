"""A wagon that runs over a change of rails: pure before and behind, found again from the log, mirrored."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from energy_ledger import balance
from run_tables import table

from hh_exudyn.case import Case
from hh_exudyn.contact.patch_shape import patch_shape
from hh_exudyn.contact.profile import rail_profile
from hh_exudyn.contact.profiles.spline import spline_evaluate, spline_table
from hh_exudyn.contact.state import from_log_row
from hh_exudyn.contact.types import SplineTable
from hh_exudyn.log.store import Run
from hh_exudyn.multibody.free_wheelset import conical_wheel, free_wheelset
from hh_exudyn.multibody.simulate import simulate

ONE, OTHER = "60E1", "54E2"
CHANGE = 22.0


def straight(demo: Case, *rails: str) -> Case:
    """Straight track, a section of 22 m for each rail but the last."""
    sections: list[dict[str, Any]] = [
        {"kind": "straight", "length_m": CHANGE, "gauge_mm": 1435.0, "rail": rail} for rail in rails
    ]
    sections[-1]["length_m"] = 34.0 - CHANGE * (len(rails) - 1)
    integration = {"output_interval_ms": 4.0}
    return demo.with_changes(track={"sections": sections}, integration=integration)


def columns(run: Run) -> dict[str, np.ndarray]:
    table = run.contact()
    return {name: table[name].to_numpy() for name in table.column_names}


def slope_misfit(rows: dict[str, np.ndarray], inside: np.ndarray, table: SplineTable) -> float:
    """Largest difference of the logged contact angles from the slope of a rail where they are logged.

    Of ellipses: the angle of a run of strips is that of their resultant. It is the mean of wheel and rail.
    """
    places = zip(rows["y_rail"][inside], rows["contact_angle"][inside], strict=True)
    return max(abs(np.arctan(spline_evaluate(table, y)[1]) + angle) for y, angle in places)


def test_each_rail_where_it_lies(demo: Case, runs: Path) -> None:
    """Before the change the run is that on the first rail; the contacts lie on the rail of their place."""
    demo = demo.with_changes(contact={"normal": "hertz"})
    rows = columns(simulate(straight(demo, ONE, OTHER), runs / "change"))
    pure = columns(simulate(straight(demo, ONE), runs / "no_change"))
    arrived = rows["time"][rows["s"] > CHANGE - 1.0].min()
    before, same = rows["time"] < arrived, pure["time"] < arrived
    assert before.sum() > 200
    for name in ("Q", "Y", "y_wheel", "y_rail", "normal_force", "nu_x"):
        scale = np.abs(pure[name]).max()
        np.testing.assert_allclose(rows[name][before], pure[name][same], rtol=0.0, atol=1e-6 * scale)
    tables = {name: spline_table(rail_profile(name, 1 / 30)) for name in (ONE, OTHER)}
    first, second = rows["s"] <= CHANGE - 1.0, rows["s"] >= CHANGE + 1.0
    assert second.sum() > 50
    assert slope_misfit(rows, first, tables[ONE]) < 3e-4
    assert slope_misfit(rows, second, tables[OTHER]) < 3e-4
    assert slope_misfit(rows, second, tables[ONE]) > 1e-3
    # the wheel loads pass the ramp without a blow: the rail tops are level
    leading = (rows["wheelset"] == 1) & (rows["patch"] == 0) & (np.abs(rows["s"] - CHANGE) < 1.5)
    assert leading.sum() > 20
    quiet = pure["Q"][(pure["wheelset"] == 1) & (pure["patch"] == 0)]
    assert np.ptp(rows["Q"][leading]) < np.ptp(quiet) + 0.02 * quiet.mean()


@pytest.mark.parametrize("before", ["54E2", "54E1"])
def test_the_train_lifts_and_lowers_a_wheelset_over_a_change(demo: Case, runs: Path, before: str) -> None:
    """A cone stands lower or higher on another rail: the ledger holds that height and nothing else."""
    sections = [
        {"kind": "straight", "length_m": length, "gauge_mm": 1435.0, "rail": rail}
        for length, rail in ((CHANGE, before), (20.0, ONE))
    ]
    case = demo.with_changes(
        wheel_profile=conical_wheel(runs / f"cone_on_{before}.txt"),
        track={"sections": sections, "flexibility": "rigid"},
        integration={"output_interval_ms": 0.4},
    )
    energy = table(simulate(case, runs / f"from_{before}", vehicle=free_wheelset()), "energy")
    given, gained = balance(energy)
    height = energy.potential_energy[-1]
    assert abs(height) > 0.5  # J, 25 um of two tonnes
    assert given[-1] == pytest.approx(gained[-1], abs=0.02 * abs(height))  # and what the contact springs hold


def test_patches_on_changing_rails_are_found_again(demo: Case, runs: Path) -> None:
    """Strips are rebuilt from the log on the rail of each row's arc length, in the ramp too."""
    case = straight(demo, ONE, OTHER).with_changes(contact={"normal": "kik_piotrowski"})
    run = simulate(case, runs / "strips_change")
    model = Case.from_toml(run.case_text, folder=run.directory).contact_model()
    rows = run.contact().to_pylist()
    inside = [row for row in rows if abs(row["s"] - CHANGE) < 1.0 and row["normal_force"] > 2e4]
    behind = [row for row in rows if row["s"] > CHANGE + 1.0 and row["normal_force"] > 2e4]
    assert len(inside) > 40 and len(behind) > 40
    for row in (*inside[:: len(inside) // 15], *behind[:: len(behind) // 15]):
        shape = patch_shape(model, from_log_row(row))
        assert [shape.a, shape.b] == pytest.approx([row["a"], row["b"]], rel=0.02)
        assert shape.pressure.max() == pytest.approx(row["p_max"], rel=0.03)


def test_high_and_low_rails_mirrored(short_case: Case, runs: Path) -> None:
    """A left-hand curve with its own rails and its mirror image: the same forces on the exchanged wheels."""
    sections = [section.model_dump() for section in short_case.track.sections]
    sections[2] |= {"rail_high": "MB1_like", "rail_low": "MB4_like"}
    case = short_case.with_changes(track={"sections": sections}, integration={"output_interval_ms": 20.0})
    left, right = (
        columns(simulate(c, runs / n)) for c, n in ((case, "high_low"), (case.mirrored(), "mirror"))
    )
    order = [np.lexsort((r["patch"], sign * r["side"], r["wheelset"], r["time"]))
             for r, sign in ((left, 1), (right, -1))]  # fmt: skip
    assert left["s"].max() > 32.0  # in the curve
    for name in ("Q", "Y", "y_rail", "contact_angle"):
        np.testing.assert_allclose(
            right[name][order[1]], left[name][order[0]], rtol=0.0, atol=1e-5 * np.abs(left[name]).max()
        )
