"""Nothing writes to the model after it is assembled: not the equilibrium, not a run, not its controllers."""

import hashlib
from importlib.resources import files
from typing import Any

import numpy as np
import pytest

from hh_exudyn.case import Case, read_case
from hh_exudyn.multibody import simulate as runner
from hh_exudyn.multibody.assembly import assemble


def arrays(value: Any) -> list[np.ndarray]:
    """All arrays of nested tuples."""
    if isinstance(value, np.ndarray):
        return [value]
    return [array for part in value for array in arrays(part)] if isinstance(value, tuple) else []


def read_only(value: Any) -> Any:
    """Nested tuples with read-only copies of their arrays."""
    if isinstance(value, np.ndarray):
        value = value.copy()
        value.flags.writeable = False
    elif isinstance(value, tuple):
        parts = [read_only(part) for part in value]
        value = type(value)._make(parts) if hasattr(value, "_make") else tuple(parts)
    return value


def digest(model: Any) -> str:
    return hashlib.sha256(b"".join(array.tobytes() for array in arrays(model))).hexdigest()


@pytest.fixture
def driven() -> Case:
    """A second of the steered locomotive, uphill into a curve."""
    case = read_case(str(files("hh_exudyn") / "data" / "locomotive.toml"))
    sections = [
        {"kind": "straight", "length_m": 25.0, "gauge_mm": 1440.0},
        {"kind": "transition", "length_m": 10.0, "gauge_mm": 1440.0},
        {
            "kind": "curve",
            "length_m": 5.0,
            "radius_m": 450.0,
            "hand": "left",
            "cant_mm": 60.0,
            "gauge_mm": 1440.0,
        },
    ]
    grades = [{"length_m": 40.0, "gradient_per_mille": 6.0}]
    track = {"sections": sections, "grades": grades}
    return case.with_changes(track=track, steering={"gain": 0.5, "softening": 0.5})


@pytest.fixture
def models(monkeypatch):
    """The models that `simulate` assembles."""
    found: list[Any] = []

    def watched(*arguments):
        found.append(assemble(*arguments))
        return found[-1]

    monkeypatch.setattr(runner, "assemble", watched)
    return found


def test_a_run_with_controllers_changes_no_number_of_its_model(driven, models, tmp_path):
    before = digest(assemble(driven.described_vehicle(), driven))
    run = runner.simulate(driven, tmp_path / "run")
    assert np.ptp(run.read("control")["torque"].to_numpy()) > 0.0
    assert digest(models[0]) == before


@pytest.mark.slow
def test_a_read_only_model_is_enough(driven, monkeypatch, tmp_path):
    """Read-only arrays are types of their own to the compiler, which refuses every kernel that writes.

    The rails' tables stay as they are: a kernel gives one of them or a blend of two, which must be one type.
    """

    def guarded(*arguments):
        model = assemble(*arguments)
        rails = {"rails_left": model.wheel_rail.rails_left, "rails_right": model.wheel_rail.rails_right}
        fixed = read_only(model)
        return fixed._replace(wheel_rail=fixed.wheel_rail._replace(**rails))

    monkeypatch.setattr(runner, "assemble", guarded)
    run = runner.simulate(driven, tmp_path / "run")
    assert run.status["finished"]
