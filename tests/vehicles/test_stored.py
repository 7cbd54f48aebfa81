"""A vehicle as JSON comes back as it was."""

import json
from dataclasses import replace

import pytest

from vehicles.catalogue import VEHICLES, vehicle
from vehicles.couplings import BumpStop, Bushing, Rod
from vehicles.stored import from_json, to_json


@pytest.mark.parametrize("name", VEHICLES)
def test_there_and_back(name):
    wagon = vehicle(name)
    assert from_json(to_json(wagon)) == wagon


def test_couplings_of_every_shape():
    """Tables, two points and fields with defaults; two classes with the same fields stay apart."""
    wagon = vehicle("iore_wagon_loaded")
    ends = ("bolster_1", "car_body")
    more = (
        Bushing("bushing", *ends, (3.0, 0.5, 0.8), (1e6, 2e6, 3e6), (1e3,) * 3),
        Rod("rod", *ends, (3.0, 0.0, 0.8), (1.0, 0.0, 0.9), 1e6, 0.0),
        BumpStop("stop", *ends, (3.0, 0.0, 0.8), (0.0, 1.0, 0.0), ((0.02, 0.0), (0.03, 1e4)), True),
    )
    wagon = replace(wagon, couplings=(*wagon.couplings, *more))
    again = from_json(to_json(wagon))
    assert again == wagon
    assert [type(c) for c in again.couplings] == [type(c) for c in wagon.couplings]


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"name": "a", "wings": 2}'])
def test_something_else_is_refused(text):
    with pytest.raises(ValueError, match="not the description of a vehicle"):
        from_json(text)


@pytest.mark.parametrize("place", ["bodies", "couplings", "wheelsets"])
def test_an_unknown_key_is_refused(place):
    data = json.loads(to_json(vehicle("iore_wagon_loaded")))
    data[place][0]["wings"] = 2
    with pytest.raises(ValueError, match=r"not the description of a vehicle.*wings"):
        from_json(json.dumps(data))
