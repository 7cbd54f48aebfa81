"""The patches of a run are found again from its case and its contact log."""

from pathlib import Path

import pytest

from hh_exudyn.case import Case
from hh_exudyn.contact.patch_shape import patch_shape, traction_on_shape
from hh_exudyn.contact.state import from_log_row
from hh_exudyn.log.store import open_run
from hh_exudyn.multibody.simulate import simulate


def test_strips_of_a_run_are_found_again(short_case: Case, runs: Path) -> None:
    contact = {"normal": "kik_piotrowski"}
    integration = {"output_interval_ms": 100.0}
    simulate(short_case.with_changes(contact=contact, integration=integration), runs / "strips")
    run = open_run(runs / "strips")
    model = Case.from_toml(run.case_text, folder=run.directory).contact_model()
    rows = run.contact().to_pylist()
    assert len({(row["wheelset"], row["side"]) for row in rows}) == 8
    for row in rows[:: max(1, len(rows) // 40)]:
        state = from_log_row(row)
        shape = patch_shape(model, state)
        assert shape.normal_force() == pytest.approx(row["normal_force"], rel=1e-9)
        assert [shape.a, shape.b] == pytest.approx([row["a"], row["b"]], rel=0.02)
        assert shape.pressure.max() == pytest.approx(row["p_max"], rel=0.02)
        field = traction_on_shape(model, state, shape)
        area = (2.0 * shape.half_length * shape.width / field.x.shape[1])[:, None]
        limit = row["friction"] * row["normal_force"]
        assert (field.q_x * area).sum() == pytest.approx(row["force_x"], abs=0.02 * limit)
        assert (field.q_y * area).sum() == pytest.approx(row["force_y"], abs=0.02 * limit)
