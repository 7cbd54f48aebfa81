"""A start place given by the case: the whole vehicle stands that much further along, in the same state."""

import numpy as np
import pytest

from hh_exudyn.case import Case
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import workspace
from vehicles.catalogue import vehicle
from vehicles.start import start_middle

COACH = vehicle("manchester_vehicle_1")


@pytest.fixture(scope="module")
def straight(demo: Case) -> Case:
    sections = [{"kind": "straight", "length_m": 120.0, "gauge_mm": 1435.0}]
    return demo.with_changes(vehicle=COACH.name, track={"sections": sections, "flexibility": "rigid"})


def test_the_vehicle_stands_there(straight: Case) -> None:
    states = []
    for case in (straight, straight.with_changes(start_m=start_middle(COACH) + 50.0)):
        model = assemble(COACH, case)
        work = workspace(model)
        states.append((equilibrium(COACH, model, work), work.arc_length.copy()))
    (near, here), (far, there) = states
    assert there - here == pytest.approx(50.0, abs=1e-6)
    moved = (far.q - near.q)[: 6 * len(COACH.bodies)].reshape(-1, 6)
    assert moved[:, 0] == pytest.approx(50.0, abs=1e-6)
    assert np.abs(moved[:, 2]).max() < 1e-5
    assert (
        np.abs(moved[:, 3:]).max() < 1e-4
    )  # the forces of a lateral place are within their tolerance anywhere


def test_it_stands_on_the_track(straight: Case) -> None:
    with pytest.raises(ValueError, match=r"start_m = 5 m: the rear end .* allowed from 13.2 m"):
        assemble(COACH, straight.with_changes(start_m=5.0))
