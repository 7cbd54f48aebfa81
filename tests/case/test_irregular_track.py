"""Gauge, cant and direction of a track with irregularities are held to the limits of its sections."""

from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.case import Case
from hh_exudyn.case.irregular import require_possible_track
from track.irregularity.irregularity import Irregularity


@pytest.fixture
def demo() -> Case:
    return Case.from_toml((resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8"))


def irregular(**signals: np.ndarray | float) -> Irregularity:
    names = ("level", "alignment", "gauge", "cross_level")
    values = np.column_stack([np.broadcast_to(signals.get(name, 0.0), 801) for name in names])
    return Irregularity(20.0, 0.25, values)


def check(demo, found: Irregularity) -> None:
    require_possible_track(demo, demo.alignment(), found)


def test_moderate_irregularities_pass(demo) -> None:
    s = np.arange(801)
    check(demo, irregular(gauge=0.01 * np.sin(0.1 * s), cross_level=0.01, alignment=0.01 * np.cos(0.1 * s)))


@pytest.mark.parametrize(
    ("signals", "message"),
    [
        ({"gauge": -0.035}, "gauge with irregularity is 1410 mm .*allowed above 1425.0 up to 1470 mm"),
        ({"gauge": 0.040}, "gauge with irregularity is 1485 mm at s = "),
        ({"cross_level": 0.2}, "cant with irregularity is .* mm at s = .* allowed -180 to 180 mm"),
        ({"alignment": np.where(np.arange(801) < 400, 0.0, 0.095)}, "slope of the alignment irregularity"),
    ],
)  # the demo's gauge is 1445 mm
def test_beyond_the_limits(demo, signals, message) -> None:
    with pytest.raises(ValueError, match=f"track.irregularity: {message}"):
        check(demo, irregular(**signals))


def test_samples_beyond_the_track_do_not_count(demo) -> None:
    length = demo.alignment().length
    s = 20.0 + 0.25 * np.arange(4001)
    values = np.zeros((4001, 4))
    values[s > length, 2] = -0.1
    require_possible_track(demo, demo.alignment(), Irregularity(20.0, 0.25, values))


def test_a_case_with_such_a_file_is_refused_before_a_run(demo, tmp_path: Path) -> None:
    """1410 mm once ran with contact pressures of 6.6 GPa."""
    from hh_exudyn.multibody.assembly import assemble
    from vehicles.catalogue import vehicle

    rows = "\n".join(f"{0.25 * i},{i % 2},{i % 2},-35,{i % 2}" for i in range(1200))
    (tmp_path / "narrow.csv").write_text(rows + "\n")
    case = demo.with_changes(track={"irregularity": str(tmp_path / "narrow.csv")})
    with pytest.raises(ValueError, match="gauge with irregularity is 1410 mm"):
        assemble(vehicle(case.vehicle), case)
