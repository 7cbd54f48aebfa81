"""Places and accelerations of points: where they are on the wagon, and rigid motion with known values."""

import math
from pathlib import Path

import numpy as np
import pytest
from made_up_run import made_up_run

from hh_exudyn.assessment.accelerations import Place, body_places, bogie_places, point_accelerations
from hh_exudyn.conventions import GRAVITY
from vehicles.catalogue import vehicle


def test_places_of_the_wagon() -> None:
    wagon = vehicle("iore_wagon_loaded")
    plate = wagon.dimensions["centre_plate_distance"] / 2
    for place, x in zip(body_places(wagon), (plate, -plate), strict=True):
        assert place.body == "car_body"
        assert place.offset[:2] == pytest.approx([x, 0.0])
        assert place.offset[2] < 0.0  # on the centre plate, below the centre of mass
    frames = {place.name: place.offset for place in bogie_places(wagon)}
    assert len(frames) == 8
    half = wagon.dimensions["wheelbase"] / 2
    assert frames["side_frame_2R over wheelset_4"][0] == pytest.approx(-half)


def test_yaw_gives_a_point_its_share(tmp_path: Path) -> None:
    """Yaw acceleration times lever is lateral; what is centripetal is longitudinal."""
    rate = 2.0 * math.pi
    run = made_up_run(
        tmp_path / "run",
        lambda wheelset, side, t: 1e5 + 0.0 * t,
        lambda wheelset, side, t: 0.0 * t,
        yaw_rate=lambda t: 1e-3 * np.sin(rate * t),
        end=100.0,
    )
    places = [Place(f"{x:g} m", "car_body", np.array([x, 0.0, 1.0])) for x in (0.0, 3.0, -3.0)]
    found = point_accelerations(run, places)
    inside = slice(10, -10)
    expected = 1e-3 * rate * np.cos(rate * found.time)[inside]
    for i, lever in enumerate((0.0, 3.0, -3.0)):
        assert found.lateral[inside, i] == pytest.approx(lever * expected, abs=2e-5)
        assert found.s[:, i] == pytest.approx(found.s[:, 0] + lever)
    assert np.abs(found.vertical).max() < 1e-9 * GRAVITY


def test_a_body_that_is_not_there_is_refused(tmp_path: Path) -> None:
    run = made_up_run(tmp_path / "run", lambda w, side, t: 0 * t, lambda w, side, t: 0 * t, end=50.0)
    with pytest.raises(ValueError, match="body roof is not at all 625 times of the motion log"):
        point_accelerations(run, [Place("roof", "roof", np.zeros(3))])
