"""Runs that several tests look at, made once a session."""

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from track_sections import into_left_curve

from hh_exudyn.case import Case
from hh_exudyn.log.store import Run
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import BODY_COORDINATES, workspace
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle


@pytest.fixture(scope="session")
def demo() -> Case:
    return Case.from_toml(files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def demo_run(demo: Case, tmp_path_factory: pytest.TempPathFactory) -> Run:
    return simulate(demo, tmp_path_factory.mktemp("runs") / "demo")


@pytest.fixture(scope="session")
def short_case(demo: Case) -> Case:
    """The first second of a tighter entry: 15 m straight, 15 m transition, 20 m curve."""
    return demo.with_changes(track={"sections": into_left_curve((15.0, 15.0, 20.0), 450.0, 1445.0)})


@pytest.fixture(scope="session")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("short_runs")


@pytest.fixture(scope="session")
def rest(demo: Case) -> tuple[np.ndarray, Rotation]:
    """Positions and rotations of the loaded wagon in static equilibrium."""
    wagon = vehicle(demo.vehicle)
    model = assemble(wagon, demo)
    state = equilibrium(wagon, model, workspace(model))
    q = state.q[: BODY_COORDINATES * len(wagon.bodies)].reshape(-1, BODY_COORDINATES)
    return q[:, :3], Rotation.from_rotvec(q[:, 3:])
