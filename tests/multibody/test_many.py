"""Many cases through a pool: what fails says why and stops no other; the environment is as it was."""

import os

from hh_exudyn.case.matrix import matrix
from hh_exudyn.multibody.many import Standing, simulate_many


def test_what_cannot_run_is_reported(demo, tmp_path):
    """Both folders hold something else: real processes, no simulation."""
    cases = matrix(demo, {"friction": [0.3, 0.4]})
    for name in cases:
        (tmp_path / name).mkdir()
        (tmp_path / name / "notes.txt").write_text("mine")
    before = dict(os.environ)
    told: list[Standing] = []
    outcomes = simulate_many(cases, tmp_path, workers=2, progress=told.append)
    assert dict(os.environ) == before
    assert [outcome.name for outcome in outcomes] == list(cases)
    for outcome in outcomes:
        assert not outcome.finished
        assert "holds something other than a run of the case" in outcome.reason
        assert "\n" not in outcome.reason
    assert {standing.ended.name for standing in told if standing.ended} == set(cases)
    assert told[-1].fraction == 1.0
    assert (tmp_path / next(iter(cases)) / "notes.txt").read_text() == "mine"
