"""The log of couplings in a run: forces that carry the body, their names, and units in the files."""

from pathlib import Path

import numpy as np
import pyarrow.parquet
import pytest
from two_axle_wagon import two_axle_wagon

from hh_exudyn.case import Case
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.log.parts import part_paths
from hh_exudyn.multibody.simulate import simulate

CASE = Case(
    name="springs",
    speed_km_h=60,
    friction=0.35,
    track={"sections": [{"kind": "straight", "length_m": 30.0}]},
    integration={"logged_couplings": ["front*", "rearL"]},
)


def test_springs_carry_the_body(tmp_path: Path) -> None:
    """Half the body's weight on the front pair; a link's force follows from its displacement and rate."""
    run = simulate(CASE, tmp_path / "run", vehicle=two_axle_wagon())
    log = run.read("couplings")
    names = np.array(log["coupling"].to_pylist())
    assert set(names) == {"frontL", "frontR", "rearL"}
    times = log["time"].to_numpy()[names == "frontL"]
    assert times.size == run.read("energy").num_rows
    vertical = {name: log["force_z"].to_numpy()[names == name] for name in set(names)}  # on the wheelset
    weight = two_axle_wagon().body("body").weight
    assert vertical["frontL"] + vertical["frontR"] == pytest.approx(-weight / 2, rel=2e-3)
    deflection = log["displacement_z"].to_numpy()[names == "rearL"]
    rate = np.gradient(deflection, times)
    expected = -(1.2e6 * deflection + 30e3 * rate)
    assert vertical["rearL"][1:-1] == pytest.approx(expected[1:-1], abs=10.0)
    assert weight == pytest.approx(17.4e3 * GRAVITY)
    schema = pyarrow.parquet.read_schema(part_paths(run.directory, "couplings")[0])
    assert schema.field("force_z").metadata == {b"unit": b"N", b"meaning": b"force on B"}


def test_a_name_that_no_coupling_has_is_refused(tmp_path: Path) -> None:
    case = CASE.with_changes(integration={"logged_couplings": ["wedge*"]})
    with pytest.raises(ValueError, match=r"'wedge\*' names no coupling of two_axle_wagon; it has frontL"):
        simulate(case, tmp_path / "run", vehicle=two_axle_wagon())
    assert list(tmp_path.iterdir()) == []
