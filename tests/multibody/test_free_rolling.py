"""Rolling without a train: down a gradient by gravity alone, wheels turning along; what a case allows."""

from pathlib import Path

import numpy as np
import pyarrow.dataset as dataset
import pytest

from hh_exudyn.case import Case, CaseError
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle

SLOPE = 0.01


@pytest.fixture(scope="module")
def rolling(demo: Case) -> Case:
    sections = [{"kind": "straight", "length_m": 70.0, "gauge_mm": 1435.0}]
    return demo.with_changes(
        vehicle="gz18",
        speed_km_h=60.0,
        free_rolling=True,
        friction=0.4,
        track={
            "sections": sections,
            "grades": [{"length_m": 70.0, "gradient_per_mille": -1e3 * SLOPE}],
            "flexibility": "rigid",
        },
    )


def test_it_gains_the_speed_that_gravity_gives_its_mass_and_its_wheels(rolling: Case, tmp_path: Path) -> None:
    run = simulate(rolling, tmp_path / "run")
    body = dataset.dataset(str(run.directory / "motion")).to_table(filter=dataset.field("body") == "car_body")
    time, speed = body["time"].to_numpy(), body["vx"].to_numpy()
    late = time > 0.5
    gained = np.polyfit(time[late], speed[late], 1)[0]
    train = vehicle("gz18")
    spinning = sum(train.body(w.body).inertia[1] / w.radius**2 for w in train.wheelsets)
    expected = GRAVITY * SLOPE * train.mass / (train.mass + spinning)
    assert gained == pytest.approx(expected, rel=0.03)
    force = dataset.dataset(str(run.directory / "energy")).to_table()["coupler_force"].to_numpy()
    assert np.abs(force).max() == 0.0


@pytest.mark.parametrize(
    "changes", [{"train": {"draft_kN": 100.0}}, {"vehicle": "iore_locomotive"}], ids=["train", "drives"]
)
def test_it_has_no_train_and_no_drives(rolling: Case, changes: dict[str, object]) -> None:
    with pytest.raises(CaseError, match="free_rolling = true: allowed without train"):
        rolling.with_changes(**changes)
