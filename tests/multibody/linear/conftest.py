"""The suspended wheelset, on which every analysis of small motions has a closed form."""

import pytest
from track_sections import straight

from hh_exudyn.case import Case
from hh_exudyn.multibody.linear.modes import LinearVehicle
from vehicles.catalogue import vehicle


@pytest.fixture(scope="module")
def given_case(demo: Case) -> Case:
    """Rigid straight track of nominal gauge, contact as the vehicle states it."""
    return demo.with_changes(
        track={"sections": straight(60.0), "flexibility": "rigid"}, contact={"theory": "given"}
    )


@pytest.fixture(scope="module")
def wheelset(given_case: Case) -> LinearVehicle:
    return LinearVehicle(vehicle("suspended_wheelset"), given_case)
