"""The wagon on gradients and through every form of alignment: statics and energy."""

import numpy as np
import pytest
from energy_ledger import balance
from run_tables import steady, table, wheel_means
from spring_energy import spring_energy

from hh_exudyn.case import Case
from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import BODY_COORDINATES, Ledger, workspace
from hh_exudyn.multibody.simulate import simulate
from hh_exudyn.playback.wheels import contact_frames, wheel_rows
from vehicles.catalogue import vehicle

WAGON = vehicle("iore_wagon_loaded")
GAUGE = {"gauge_mm": 1445.0}
STRAIGHT = {"kind": "straight", "length_m": 150.0, **GAUGE}
LEVEL = {"length_m": 30.0, "gradient_per_mille": 0.0}
SAG = {"length_m": 50.0, "gradient_per_mille": 0.0, "end_per_mille": 10.0}  # R = 5000 m
SHORT = {"length_m": 5.0, "gradient_per_mille": 0.0, "end_per_mille": 4.0}
RADIUS, CANT, SLOPE = 450.0, 0.065, 0.008


def on_track(demo: Case, sections: list[dict], *grades: dict) -> Case:
    """Rigid and smooth; a coarse grid, for forces on bodies do not ask for a fine one."""
    track = {"flexibility": "rigid", "sections": sections, "grades": list(grades)}
    return demo.with_changes(track=track, contact={"cells": [16, 8]})


def transition(length: float, **changes: object) -> dict:
    return {"kind": "transition", "length_m": length, **changes}


def curve(length: float, radius: float, hand: str, cant: float) -> dict:
    return {"kind": "curve", "length_m": length, "radius_m": radius, "hand": hand, "cant_mm": cant, **GAUGE}


@pytest.mark.parametrize("per_mille", [-10.0, 10.0, 50.0])
def test_the_train_holds_the_wagon_on_a_slope(demo, per_mille):
    """m g sin along the track but for the resistance of rolling, m g cos across; one turned drawing."""
    case = on_track(demo, [STRAIGHT], {"length_m": 150.0, "gradient_per_mille": per_mille})
    model = assemble(WAGON, case)
    work = workspace(model)
    state = equilibrium(WAGON, model, work)
    angle = np.arctan(per_mille * 1e-3)
    weight = WAGON.mass * GRAVITY
    assert work.ledger[Ledger.COUPLER_FORCE] == pytest.approx(weight * np.sin(angle), abs=2.0)
    assert -work.rail_force[:, :, 1].sum() == pytest.approx(weight * np.cos(angle), abs=5.0)
    assert np.abs(work.frame_position[:, 1]).max() < 1e-9
    assert np.ptp(work.frame_position[:, 2]) < 1e-4
    # wheelsets roll at the speed along the slope, which is that of the train in plan over the cosine
    assert work.frame_velocity[:, 0] == pytest.approx(case.speed / np.cos(angle), rel=1e-12)
    assert np.abs(work.frame_velocity[:, 2]).max() < 1e-12
    body = BODY_COORDINATES * model.train.bodies[0]
    assert state.q[body + 4] == pytest.approx(-angle, abs=2e-3)  # springs give by a millimetre or two


@pytest.mark.parametrize(
    ("grades", "message"),
    [
        ([SAG], r"first 11\.3 m must have one gradient.* goes from .* to 2\.26 per mille"),
        ([{"length_m": 5.0, "gradient_per_mille": 0.0}, SAG], r"goes from -?0 to 1\.26 per mille"),
        (
            [SHORT, SHORT | {"gradient_per_mille": 4.0, "end_per_mille": 0.0}],
            r"goes from .* to [34]\.\d* per mille",
        ),
    ],
)
def test_a_start_on_a_vertical_curve_is_refused(demo, grades, message):
    with pytest.raises(ValueError, match=message):
        assemble(WAGON, on_track(demo, [STRAIGHT], *grades))


def test_the_coupler_lifts_the_wagon_over_a_vertical_curve(demo, runs):
    """Coupler work = m g h + losses + gain of speed, at every moment; at last the force is m g sin."""
    run = simulate(on_track(demo, [STRAIGHT], LEVEL, SAG), runs / "vertical_curve")
    energy = table(run, "energy")
    given, gained = balance(energy)
    # what lies between is the elastic energy of suspension and contacts: tens of J; 0.9 MJ are lifted
    assert given == pytest.approx(gained, abs=150.0)
    assert given[-1] == pytest.approx(gained[-1], rel=1e-5)
    end = energy.time > energy.time[-1] - 1.0
    height = 0.5 * 50.0 * 0.010 + (energy.s[-1] - 80.0) * 0.010  # of the parabola and the slope behind it
    assert energy.potential_energy[-1] == pytest.approx(WAGON.mass * GRAVITY * height, rel=1e-3)
    weight = WAGON.mass * GRAVITY
    assert energy.coupler_force[end].mean() == pytest.approx(weight * np.sin(np.arctan(0.010)), rel=1e-3)
    contact = table(run, "contact")
    inside = (contact.s > 40.0) & (contact.s < 75.0)
    loads = np.array([contact.Q[inside & (contact.wheelset == w)].mean() for w in (1, 2, 3, 4)])
    pressed = 1.0 + demo.speed**2 / 5000.0 / GRAVITY  # by 0.57 %
    assert 8.0 * loads.mean() / weight == pytest.approx(pressed, abs=5e-4)


def test_a_canted_curve_on_a_slope_is_steady_as_statics_say(demo, runs):
    """Left-hand curve on 8 per mille: Y, Q and the coupler's force in track axes.

    Y within 1 %, which is a sway at 1.4 Hz that dies away. What the roll of the curve entry does to the
    springs counts: a wedge resists going down by mu/(tan - mu) of its spring force and going up by only
    mu/(tan + mu), so a wagon that rolls to and fro comes to rest higher, by little, as they mostly stick.
    """
    sections = [STRAIGHT | {"length_m": 15.0}, transition(50.0), curve(160.0, RADIUS, "left", 1e3 * CANT)]
    run = simulate(
        on_track(demo, sections, {"length_m": 9.0, "gradient_per_mille": 1e3 * SLOPE}), runs / "up"
    )
    contact, energy = steady(table(run, "contact"), 4.0), steady(table(run, "energy"), 4.0)
    roll, angle = np.arcsin(CANT / RAIL_TOP_DISTANCE), np.arctan(SLOPE)
    pull = contact.speed.mean() ** 2 / RADIUS
    down = GRAVITY * np.cos(angle)
    to_the_left = (wheel_means(contact, "Y") * [1, -1]).sum()
    expected = WAGON.mass * (down * np.sin(roll) - pull * np.cos(roll))
    assert expected < -20e3  # the outer, right rail carries the cant deficiency
    assert to_the_left == pytest.approx(expected, rel=0.01)
    loads = wheel_means(contact, "Q").sum()
    assert loads == pytest.approx(WAGON.mass * (down * np.cos(roll) + pull * np.sin(roll)), rel=1e-5)
    lost = (energy.contact_power + energy.friction_power + energy.damper_power).mean()
    uphill = WAGON.mass * GRAVITY * np.sin(angle) + lost / contact.speed.mean()
    assert energy.coupler_force.mean() == pytest.approx(uphill, rel=1e-3)
    whole = table(run, "energy")
    given, gained = balance(whole)
    stored = spring_energy(WAGON, table(run, "motion"))
    assert stored[0] == pytest.approx(33.95e3, rel=0.01)  # 21.6 kJ in the nests, 12.3 kJ in the wedges
    assert -2e3 < stored[-1] - stored[0] < -50.0
    missing = gained + stored - stored[0] - given  # elastic energy of pads and contacts: tens of J
    assert np.abs(missing).max() < 150.0  # of 1.7 MJ, the cant ramp included


@pytest.fixture(scope="module")
def snake(demo, runs):
    """All shapes of transition, a ramp, gauge at the middle of a transition, a sag and a crest at once."""
    sections = [
        STRAIGHT | {"length_m": 12.0, "gauge_mm": 1435.0},
        transition(20.0, gauge_mm=1442.0),
        curve(15.0, 600.0, "left", 40.0),
        transition(20.0, shape="helmert"),
        curve(15.0, 400.0, "left", 70.0),
        transition(50.0, shape="bloss"),
        curve(15.0, 500.0, "right", 50.0),
        {"kind": "ramp", "length_m": 25.0, "radius_m": [-500.0, 0.0], "cant_mm": [50.0, 0.0],
         "gauge_mm": [1445.0, 1435.0]},
        STRAIGHT | {"length_m": 15.0, "gauge_mm": 1435.0},
    ]  # fmt: skip
    grades = [
        {"length_m": 12.0, "gradient_per_mille": -5.0},
        {"length_m": 60.0, "gradient_per_mille": -5.0, "end_per_mille": 6.0},
        {"length_m": 30.0, "gradient_per_mille": 6.0},
        {"length_m": 60.0, "gradient_per_mille": 6.0, "end_per_mille": 0.0},
    ]
    case = on_track(demo, sections, *grades)
    return case, simulate(case, runs / "snake")


def test_compound_and_reverse_curves_run_through(snake):
    _, run = snake
    assert run.status["finished"]
    contact, energy = table(run, "contact"), table(run, "energy")
    given, gained = balance(energy)
    assert given[-1] == pytest.approx(gained[-1], abs=0.02 * np.abs(gained).max())
    # never far from rolling: no wheel is unloaded by more than the curves and ramps explain
    first = contact.patch == 0
    assert contact.Q[first].min() > 0.6 * WAGON.mass * GRAVITY / 8
    assert contact.Q[first].max() < 1.4 * WAGON.mass * GRAVITY / 8
    assert np.abs(contact.y_wheelset).max() < 0.012


def test_the_playback_puts_contacts_under_their_wheelsets(snake):
    """Frames of playback and of the run agree: along the track a contact is `x_shift` ahead of its axle."""
    case, run = snake
    motion = table(run, "motion")
    times = np.unique(motion.time)
    for wheel in wheel_rows(run.read("contact"), times, 1):
        frames = contact_frames(wheel, case.alignment(), case.track.rail_course(wheel.side))
        own = motion.body == f"wheelset_{wheel.name[:-1]}"
        row = np.searchsorted(times, wheel.columns["time"])
        axle = np.column_stack([motion.x[own], motion.y[own], motion.z[own]])[row]
        ahead = ((frames.position - axle) * frames.rotation.apply((1.0, 0.0, 0.0))).sum(axis=1)
        assert ahead == pytest.approx(wheel.columns["x_shift"], abs=1e-9)
