"""A run of a variant: it runs with the changed numbers, and keeps them when the vehicle file changes."""

from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.case import Case, read_case
from hh_exudyn.log.store import Run
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import workspace
from hh_exudyn.multibody.once import simulate_once
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.statics import axle_loads
from vehicles.stored import from_json
from vehicles.variants import variant_of_table

TRACK = {"sections": [{"kind": "straight", "length_m": 30.0}]}


def settled_loads(case: Case, wagon) -> np.ndarray:
    """Vertical forces of the wheelsets on the track in the static equilibrium [N]."""
    model = assemble(wagon, case)
    work = workspace(model)
    equilibrium(wagon, model, work)
    return -work.rail_force[:, :, 1].sum(axis=1)


def test_statics_are_those_of_the_equilibrium(demo: Case) -> None:
    """A payload that is changed and out of the middle: axle loads of the lever rule."""
    half = variant_of_table({"name": "half", "base": "iore_wagon_loaded", "wagon": {"payload": 5e4}}, "test")
    for wagon in (half.vehicle(), vehicle("iore_wagon_empty")):
        assert settled_loads(demo, wagon) == pytest.approx(axle_loads(wagon), rel=1e-3)


@pytest.fixture(scope="module")
def worn_run(demo: Case, tmp_path_factory: pytest.TempPathFactory) -> tuple[Run, Case, Path]:
    folder = tmp_path_factory.mktemp("variant")
    file = folder / "worn.toml"
    file.write_text('base = "iore_wagon_loaded"\nwagon.payload = 60000\nwheelset.radius = 0.44\n')
    case = demo.with_changes(vehicle=str(file), track=TRACK)
    return simulate(case, folder / "run"), case, file


def test_run_has_the_changed_numbers(worn_run) -> None:
    run, case, _ = worn_run
    contact = run.contact()
    first = contact["patch"].to_numpy() == 0  # Q is repeated on the others
    loads = contact["Q"].to_numpy()[first]
    assert loads.mean() == pytest.approx((21_600 + 60_000) * 9.81 / 8, rel=0.02)
    motion = run.motion()
    wheelsets = np.char.startswith(motion["body"].to_numpy(zero_copy_only=False).astype(str), "wheelset")
    assert motion["wy"].to_numpy()[wheelsets] == pytest.approx(case.speed / 0.44, rel=2e-3)


def test_run_does_not_follow_the_file(worn_run) -> None:
    run, case, file = worn_run
    ran = case.described_vehicle()
    file.write_text('base = "iore_wagon_loaded"\nwagon.payload = 10000\n')
    assert from_json(run.vehicle_text) == ran
    stored = Case.from_toml(run.case_text, folder=run.directory)
    assert stored.described_vehicle() == ran
    assert stored.with_changes(vehicle=case.vehicle) == case
    assert stored.described_vehicle() == ran
    assert simulate_once(case, run.directory).directory == run.directory  # the same case: not run again
    with pytest.raises(FileExistsError):
        simulate_once(case.with_changes(vehicle=str(file)), run.directory)


def test_a_given_vehicle_is_kept_too(demo: Case, tmp_path: Path) -> None:
    """The case names another one; playback must draw the one that ran."""
    empty = vehicle("iore_wagon_empty")
    case = demo.with_changes(track=TRACK)
    run = simulate(case, tmp_path / "run", vehicle=empty)
    assert from_json(run.vehicle_text) == empty
    again = simulate(read_case(run.directory / "case.toml"), tmp_path / "again")  # runs the one that ran
    assert again.contact() == run.contact()
    assert simulate_once(case, run.directory, vehicle=empty) == run
    with pytest.raises(FileExistsError, match="other case, vehicle or files"):
        simulate_once(case, run.directory)
