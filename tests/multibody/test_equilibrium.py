"""Static equilibrium: statics of the wagon, settling in time where the root search stalls, what has none."""

import time as clock
from dataclasses import replace

import numpy as np
import pytest

from hh_exudyn.contact.state import Patch
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.control import vehicle_control
from hh_exudyn.multibody.equilibrium import FORCE_TOLERANCE, TIME_LIMIT, NoEquilibrium, equilibrium
from hh_exudyn.multibody.model import Ledger, workspace
from hh_exudyn.multibody.validation import rest_rows
from hh_exudyn.sourced import load_parameters
from vehicles.catalogue import vehicle


def settle(case):
    wagon = vehicle(case.vehicle)
    model = assemble(wagon, case)
    work = workspace(model)
    return wagon, work, equilibrium(wagon, model, work)


@pytest.fixture(scope="module", params=["iore_wagon_loaded", "iore_wagon_empty"])
def settled(request, demo):
    return settle(demo.with_changes(vehicle=request.param))


def drop(wagon, state, name):
    """How far a body is below the drawing [m]."""
    i = [body.name for body in wagon.bodies].index(name)
    return wagon.bodies[i].position[2] - state.q[6 * i + 2]


@pytest.mark.parametrize("name", ["iore_wagon_loaded", "iore_wagon_empty"])
def test_wheel_loads_carry_the_weight(demo, name):
    """Their sum within 1e-6, each within 1e-3 of the lever rule; no more force left than the tolerance."""
    rows = rest_rows(name, demo)
    assert rows[0].wanted == pytest.approx(vehicle(name).mass * GRAVITY * 1e-3)
    assert [row.quantity for row in rows if not row.holds] == []


def test_left_and_right_are_mirror_images(settled):
    _, work, _ = settled
    assert np.abs(work.frame_position[:, 1]).max() < 1e-9
    left, right = work.patches[:, 0, 0], work.patches[:, 1, 0]
    odd = [Patch.NU_Y, Patch.PHI, Patch.FORCE_Y, Patch.MOMENT_Z, Patch.CENTRE_Y]
    right[:, odd] *= -1.0
    assert left == pytest.approx(right, rel=1e-6, abs=1e-6)


def test_load_springs_deflect_as_their_law_says(settled):
    """Nest and wedges of one side carry a quarter of the sprung weight: closed form of the two stages."""
    wagon, _, state = settled
    p = load_parameters("vehicles", "iore_wagon")
    sprung = sum(body.mass for body in wagon.bodies if body.kind in ("car_body", "bolster"))
    # a column that closes by its toe drives the wedge further down than the bolster, and its lift grows alike
    toe, slope = np.radians([p["wedge.toe"], p["wedge.slope"]])
    drive = 1 / (1 - np.tan(toe) / np.tan(slope))
    load = sprung * GRAVITY / 4 - 2 * p["wedge.preload"] * drive
    wedges = 2 * p["wedge.spring_stiffness"] * drive**2
    first = p["spring_nest.first_stiffness"] + wedges
    second = p["spring_nest.second_stiffness"] + wedges
    touch = p["spring_nest.second_from"]
    deflection = load / first if load < first * touch else touch + (load - first * touch) / second
    found = drop(wagon, state, "bolster_1") - drop(wagon, state, "side_frame_1L")
    assert found == pytest.approx(deflection, rel=1e-3)


def test_deflections_are_plausible(demo):
    """Loaded 60..80 mm, empty 7..16 mm in the springs, of which the control springs, 20 mm longer than the
    others, carry a third of an empty wagon; 1..3 mm of track; a pad under 1 mm.
    """
    for name, low, high in (("iore_wagon_loaded", 0.060, 0.080), ("iore_wagon_empty", 0.007, 0.016)):
        wagon, work, state = settle(demo.with_changes(vehicle=name))
        springs = drop(wagon, state, "bolster_1") - drop(wagon, state, "side_frame_1L")
        assert low < springs < high
        pads = drop(wagon, state, "side_frame_1L") - drop(wagon, state, "wheelset_1")
        assert 0.0 < pads < 1e-3
        if name == "iore_wagon_loaded":
            assert 1e-3 < -work.rail_position[0, 0, 1] < 3e-3


def test_wheels_roll_and_the_train_hardly_pulls(settled):
    """On straight track only spin creepage and normal damping cost anything: below 10 N of coupler force."""
    _, work, _ = settled
    assert abs(work.ledger[Ledger.COUPLER_FORCE]) < 10.0
    assert np.abs(work.patches[:, :, 0, Patch.NU_X]).max() < 1e-5  # strips of unequal radius, in balance


def test_a_track_that_begins_in_a_curve_is_refused(demo):
    curve = {"kind": "curve", "length_m": 60.0, "radius_m": 450.0, "hand": "left"}
    case = demo.with_changes(track={"sections": [curve]})
    with pytest.raises(ValueError, match=r"first 11\.3 m must be straight"):
        settle(case)


def straight(demo, gauge, **changes):
    track = changes.pop("track", {}) | {
        "sections": [{"kind": "straight", "length_m": 60.0, "gauge_mm": gauge}],
    }
    return demo.with_changes(track=track, **changes)


STALLS = {  # in these the contact of a centred wheel lies where it goes from the tread to the flange root
    "WP4_like on 60E1": (1435.0, {"wheel_profile": "WP4_like"}),
    "rigid, 1:40": (1434.0, {"track": {"flexibility": "rigid", "inclination": "1:40"}}),
    "54E2, slope": (
        1434.0,
        {"track": {"rail": "54E2", "grades": [{"length_m": 60.0, "gradient_per_mille": 10.0}]}},
    ),
    "empty on MB4_like": (
        1435.0,
        {
            "vehicle": "iore_wagon_empty",
            "wheel_profile": "WP4_like",
            "track": {"rail": "MB4_like", "flexibility": "rigid"},
        },
    ),
    "locomotive": (
        1436.0,
        {
            "vehicle": "iore_locomotive",
            "wheel_profile": "WP4_like",
            "track": {"rail": "MB1_like", "flexibility": "rigid"},
        },
    ),
}


@pytest.mark.parametrize("name", STALLS)
def test_where_the_root_search_stalls_the_vehicle_settles_in_time(demo, name):
    """Carried by its wheels, alike left and right, at rest within the tolerance, and soon."""
    gauge, changes = STALLS[name]
    settle(demo)  # compiled
    begun = clock.thread_time()
    wagon, work, state = settle(straight(demo, gauge, **changes))
    taken = clock.thread_time() - begun
    slope = 1e-3 * sum(grade["gradient_per_mille"] for grade in changes.get("track", {}).get("grades", ()))
    loads = -work.rail_force[:, :, 1]
    assert loads.sum() == pytest.approx(wagon.mass * GRAVITY * np.cos(np.arctan(slope)), rel=1e-5)
    assert loads[:, 0] == pytest.approx(loads[:, 1], rel=1e-3)
    assert np.abs(work.generalized_force).max() <= FORCE_TOLERANCE
    spinning = [6 * i + 4 for i, body in enumerate(wagon.bodies) if body.kind == "wheelset"]
    assert state.v[spinning] == pytest.approx(demo.speed / wagon.wheelsets[0].radius, rel=5e-3)
    assert taken < TIME_LIMIT


@pytest.mark.parametrize(
    ("name", "track"),
    [
        ("iore_wagon_loaded", {"grades": [{"length_m": 60.0, "gradient_per_mille": 20.0}]}),
        ("iore_wagon_pair_empty", {}),
        ("iore_locomotive", {"flexibility": "rigid"}),
        ("manchester_vehicle_1", {}),
    ],
)
def test_settling_and_root_search_find_the_same(demo, monkeypatch, name, track):
    case = straight(demo, 1440.0, vehicle=name, track=track)
    _, searched, first = settle(case)
    loads = searched.rail_force[:, :, 1].copy()
    monkeypatch.setattr("hh_exudyn.multibody.equilibrium._SEARCH_LIMIT", -1.0)  # no time for it
    _, settled, second = settle(case)
    assert settled.rail_force[:, :, 1] == pytest.approx(loads, rel=1e-6)
    assert second.q == pytest.approx(first.q, abs=1e-9)
    assert second.v == pytest.approx(first.v, rel=1e-6, abs=1e-9)


def test_settling_alone_comes_as_near(demo, monkeypatch):
    """Without any root search: some seconds of damped motion leave less than the tolerance."""
    case = straight(demo, 1440.0)
    _, searched, _ = settle(case)
    loads = searched.rail_force[:, :, 1].copy()
    monkeypatch.setattr("hh_exudyn.multibody.equilibrium._balance", lambda *_: False)
    _, settled, _ = settle(case)
    assert settled.rail_force[:, :, 1] == pytest.approx(loads, rel=1e-4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda wagon: without(wagon, "centre_plate", "side_bearer"),
            r"on car_body upwards .*nothing holds it",
        ),
        (
            lambda wagon: without(wagon, "axle_box_wheelset_1"),
            r"N m remains on side_frame_1[LR] in pitch .*axle_box",
        ),
        (
            lambda wagon: moved(wagon, "car_body", (0.0, 0.9, 0.0)),
            r"on car_body .*(side_bearer|centre_plate)_",
        ),
    ],
)
def test_what_has_no_equilibrium_says_where_and_soon(demo, change, message):
    settle(straight(demo, 1440.0))  # compiled
    wagon = change(vehicle("iore_wagon_loaded"))
    model = assemble(wagon, straight(demo, 1440.0))
    begun = clock.thread_time()
    with pytest.raises(NoEquilibrium, match=message) as caught:
        equilibrium(wagon, model, workspace(model))
    assert clock.thread_time() - begun < 10.0
    assert "allowed 5" in str(caught.value)


def test_a_locomotive_without_adhesion_has_no_equilibrium(demo):
    """Two units and 68 wagons on 6 per mille ask for 0.16, friction is 0.03."""
    track = {"grades": [{"length_m": 60.0, "gradient_per_mille": 6.0}]}
    case = straight(demo, 1440.0, vehicle="iore_locomotive", friction=0.03, track=track)
    locomotive = vehicle(case.vehicle)
    model = assemble(locomotive, case)
    work = workspace(model)
    vehicle_control(case, locomotive, model, work)
    with pytest.raises(
        NoEquilibrium, match=r"iore_locomotive at 60 km/h.*creep forces at their bound on \d+ wheels"
    ):
        equilibrium(locomotive, model, work)


def test_a_load_off_the_middle_is_carried_by_moments(demo):
    """Car body 0.2 m to the left: the moment of its weight about the track, and of the roll that it makes."""
    wagon = moved(vehicle("iore_wagon_loaded"), "car_body", (0.0, 0.2, 0.0))
    model = assemble(wagon, straight(demo, 1440.0))
    work = workspace(model)
    equilibrium(wagon, model, work)
    loads = -work.rail_force[:, :, 1].sum(axis=0)
    centre = (model.weight @ work.position[:, 1]) / model.weight.sum()  # where the weight has gone
    contact = 0.75  # m, about half the distance of the contacts
    assert loads.sum() == pytest.approx(model.weight.sum(), abs=8 * FORCE_TOLERANCE)
    assert centre > 0.2 * wagon.body("car_body").mass / wagon.mass
    assert (loads[0] - loads[1]) / loads.sum() == pytest.approx(centre / contact, rel=0.02)


def moved(wagon, name, way):
    bodies = [
        replace(b, position=tuple(np.add(b.position, way))) if b.name == name else b for b in wagon.bodies
    ]
    return replace(wagon, bodies=tuple(bodies))


def without(wagon, *names):
    kept = [c for c in wagon.couplings if not c.name.startswith(names)]
    return replace(wagon, couplings=tuple(kept))
