"""The ore wagon's description against thesis Table 1-1, and the parameter file's own rules."""

from dataclasses import replace

import numpy as np
import pytest

from hh_exudyn.sourced import KINDS, load_parameters
from vehicles import catalogue
from vehicles.catalogue import VEHICLES, vehicle
from vehicles.models.wagon import ore_wagon


def test_masses_of_table_1_1():
    loaded, empty = vehicle("iore_wagon_loaded"), vehicle("iore_wagon_empty")
    assert loaded.mass == pytest.approx(120_000.0, rel=1e-9)  # 4 x 30 t
    assert empty.mass == pytest.approx(21_600.0, rel=1e-9)
    for wagon in (loaded, empty):
        bogie = sum(b.mass for b in wagon.bodies if b.kind != "car_body") / 2
        assert bogie == pytest.approx(4650.0, abs=0.5)
        assert all(b.mass == 1341.0 for b in wagon.bodies if b.kind == "wheelset")


def test_dimensions_of_table_1_1():
    wagon = vehicle("iore_wagon_loaded")
    wheelsets = [wagon.body(w.body).position for w in wagon.wheelsets]
    x = [position[0] for position in wheelsets]
    assert np.diff(x)[[0, 2]] == pytest.approx(-1.778)
    assert (x[0] + x[1]) / 2 - (x[2] + x[3]) / 2 == pytest.approx(6.77)
    assert {w.radius for w in wagon.wheelsets} == {0.4575}
    heads = [point[0] for point in wagon.coupler.points]
    assert max(heads) - min(heads) == pytest.approx(10.29)


def test_wagon_is_symmetric():
    """Every coupling has its mirror image in y, and the bodies' masses lie on the middle."""
    wagon = vehicle("iore_wagon_loaded")
    points = sorted(tuple(np.round(c.point, 9)) for c in wagon.couplings)
    mirrored = sorted((x, -y if y else 0.0, z) for x, y, z in points)
    assert np.array(points) == pytest.approx(np.array(mirrored))
    centre = sum(b.mass * np.array(b.position) for b in wagon.bodies) / wagon.mass
    assert centre[:2] == pytest.approx([0.0, 0.0], abs=1e-12)


def test_every_number_has_unit_and_source():
    parameters = load_parameters("vehicles", "iore_wagon")
    assert all(p.unit and p.kind in KINDS for p in parameters.parameters)
    for p in parameters.parameters:  # a guess may stand alone, a claim says where from
        assert p.kind == "assumed" or p.source.split(":", 1)[1].strip(), p.name
    assert {p.name for p in parameters.of_kind("published")} >= {"wheelset.mass", "wagon.tare"}
    assert catalogue.parameters("iore_wagon_empty").name == "iore_wagon"


def test_unknown_names_say_what_is_known():
    with pytest.raises(ValueError, match="iore_wagon_loaded"):
        vehicle("iore_wagon")
    with pytest.raises(KeyError, match=r"wedge\.friction"):
        load_parameters("vehicles", "iore_wagon")["wedge.fricton"]


def test_overload_is_refused():
    with pytest.raises(ValueError, match="102000 kg"):
        ore_wagon("wagon", load_parameters("vehicles", "iore_wagon"), 110e3)


def test_all_vehicles_can_be_made():
    for name in VEHICLES:
        assert vehicle(name).name == name


def test_shoes_press_the_treads_from_within_the_bogies():
    """One on every wheel, at the height of the axle and its radius away, held by the side frame beside it."""
    wagon = vehicle("iore_wagon_pair_empty")
    assert len(wagon.shoes) == 2 * len(wagon.wheelsets)
    for shoe in wagon.shoes:
        axle, frame = wagon.body(shoe.wheelset).position, wagon.body(shoe.carrier).position
        assert abs(shoe.point[0] - axle[0]) == pytest.approx(0.4575)
        assert shoe.point[2] == axle[2]
        assert abs(shoe.point[0] - frame[0]) < abs(axle[0] - frame[0])
        assert shoe.point[1] * frame[1] > 0.0


def test_a_shoe_cannot_sit_on_a_wheelset():
    wagon = vehicle("iore_wagon_loaded")
    wrong = replace(wagon.shoes[0], carrier="wheelset_2")
    with pytest.raises(ValueError, match="brake shoe of wheelset_2 on wheelset_1"):
        replace(wagon, shoes=(wrong,))
