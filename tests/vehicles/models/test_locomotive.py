"""The locomotive's description against thesis Table 1-2, and what its guesses were chosen to."""

import dataclasses

import numpy as np
import pytest

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.sourced import KINDS, load_parameters
from vehicles.catalogue import vehicle
from vehicles.couplings import AxleBoxPad, Bushing

LOCOMOTIVE = vehicle("iore_locomotive")


def test_table_1_2():
    assert LOCOMOTIVE.mass == pytest.approx(180e3, rel=1e-12)
    x = np.array([LOCOMOTIVE.body(w.body).position[0] for w in LOCOMOTIVE.wheelsets])
    assert np.diff(x)[[0, 1, 3, 4]] == pytest.approx(-1.92)
    assert x[:3].mean() - x[3:].mean() == pytest.approx(12.89)
    assert {2 * w.radius for w in LOCOMOTIVE.wheelsets} == {1.250}
    heads = [point[0] for point in LOCOMOTIVE.coupler.points]
    assert max(heads) - min(heads) == pytest.approx(22.89)
    assert [w.bogie for w in LOCOMOTIVE.wheelsets] == [1, 1, 1, 2, 2, 2]
    assert len(LOCOMOTIVE.drives) == 6


def test_it_is_symmetric():
    """Every body and coupling has its mirror image in x and in y."""
    for flip in ((-1, 1, 1), (1, -1, 1)):
        for points in (
            [(b.mass, *b.position) for b in LOCOMOTIVE.bodies],
            [(c.stiffness[2], *c.point) for c in LOCOMOTIVE.couplings if isinstance(c, AxleBoxPad | Bushing)],
        ):
            mirrored = [(m, *np.multiply(flip, place)) for m, *place in points]
            assert np.array(sorted(points)) == pytest.approx(
                np.array(sorted((m, *(0.0 + np.array(p))) for m, *p in mirrored)), abs=1e-9
            )


def test_bounce_is_that_of_a_locomotive():
    """Body on its secondary springs, bogies on the primary ones: two masses, two springs, 1.2..1.6 Hz."""
    p = load_parameters("vehicles", "iore_locomotive")
    body = LOCOMOTIVE.body("car_body").mass
    # half of each motor hangs from its bogie frame
    frames = 2 * p["bogie_frame.mass"] + 6 * p["motor.mass"] * p["motor.distance"] / p["motor.nose_distance"]
    primary, secondary = 12 * p["primary.vertical_stiffness"], 4 * p["secondary.vertical_stiffness"]
    stiffness = np.array([[secondary, -secondary], [-secondary, secondary + primary]])
    values = np.linalg.eigvals(np.diag([1 / body, 1 / frames]) @ stiffness)
    assert 1.2 < np.sqrt(values.min()) / (2 * np.pi) < 1.6
    load = (body + frames) * GRAVITY / primary
    assert 0.03 < load < 0.06  # deflection of the primary springs


def test_every_number_has_unit_and_source():
    parameters = load_parameters("vehicles", "iore_locomotive").parameters
    assert all(p.unit and p.kind in KINDS for p in parameters)
    published = {p.name for p in parameters if p.kind == "published"}
    assert published >= {"locomotive.mass", "wheelset.spacing", "wheelset.radius", "traction.power"}


def test_drives_belong_to_wheelsets():
    with pytest.raises(ValueError, match="one for each wheelset, in their order"):
        dataclasses.replace(LOCOMOTIVE, drives=LOCOMOTIVE.drives[::-1])
    with pytest.raises(ValueError, match="drives and their traction equipment go together"):
        dataclasses.replace(LOCOMOTIVE, drives=())
