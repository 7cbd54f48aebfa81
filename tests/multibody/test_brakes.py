"""Brake shoes on the treads of a wagon that the train pulls: forces, creep, loads, and the energy."""

import numpy as np
import pytest
from run_tables import table

from hh_exudyn.case import Case, CaseError
from hh_exudyn.contact.state import Patch
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import Ledger, SystemModel, Workspace, workspace
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle

THRUST, FRICTION = 12e3, 0.25  # N of each shoe; as the wagon's data have it
NAME = "iore_wagon_loaded"


def braked(demo: Case, length: float = 40.0, **brake: object) -> Case:
    track = {
        "flexibility": "rigid",
        "sections": [{"kind": "straight", "length_m": length, "gauge_mm": 1440.0}],
    }
    order = {"shoe_force_kN": 1e-3 * THRUST} | brake
    return demo.with_changes(vehicle=NAME, track=track, contact={"cells": [16, 8]}, brake=order)


def at_rest(case: Case) -> tuple[SystemModel, Workspace]:
    described = vehicle(NAME)
    model = assemble(described, case)
    work = workspace(model)
    equilibrium(described, model, work)
    return model, work


def test_the_coupler_pulls_what_the_shoes_hold(demo):
    """Friction at the running circle against rail force at the rolling radius: eight times mu N R / r."""
    _, free = at_rest(braked(demo, shoe_force_kN=0.0))
    _, work = at_rest(braked(demo))
    rolling = work.patches[:, :, 0, Patch.ROLLING_RADIUS].mean()
    pull = work.ledger[Ledger.COUPLER_FORCE] - free.ledger[Ledger.COUPLER_FORCE]
    assert pull == pytest.approx(8 * FRICTION * THRUST * 0.4575 / rolling, rel=2e-3)
    assert -work.wrench[:, 0] == pytest.approx(2 * FRICTION * THRUST * 0.4575 / rolling, rel=0.01)
    # braked wheels turn too slowly, and the rails push them back
    assert (work.patches[:, :, 0, Patch.FORCE_X] < 0.0).all()
    assert (work.patches[:, :, 0, Patch.NU_X] > 0.0).all()
    # steady: what the couplers give goes into shoes and contacts, most of it into the shoes
    given, taken = work.ledger[Ledger.COUPLER_POWER], work.ledger[Ledger.BRAKE_POWER]
    assert given == pytest.approx(taken + work.ledger[Ledger.CONTACT_POWER], rel=1e-3)
    assert 0.98 * given < taken < given


def test_load_goes_to_the_leading_bogie(demo):
    """The couplers pull at a height above the rails that hold back: it pitches the wagon forwards."""
    _, free = at_rest(braked(demo, shoe_force_kN=0.0))
    model, work = at_rest(braked(demo))
    before, after = (-one.rail_force[:, :, 1].sum(axis=1) for one in (free, work))
    assert after.sum() == pytest.approx(before.sum(), rel=1e-5)
    # about the rails; the body also moves ahead on its springs, some millimetres of its weight
    height = work.position[0, 2] + model.train.heads[0, 2]
    tilting = after @ work.arc_length[:4] - model.weight @ work.position[:, 0]
    assert tilting == pytest.approx(work.ledger[Ledger.COUPLER_FORCE] * height, rel=5e-3)
    # within a bogie its friction loads the leading wheelset and lifts the trailing one
    change = after - before
    assert change[0] > change[1] and change[2] > change[3]


def test_one_wheel_alone(demo):
    """Named wheels are braked, and no others; the axle feels the moment all the same."""
    _, work = at_rest(braked(demo, wheels=["2R"]))
    force = -work.wrench[:, 0]
    assert force[1] == pytest.approx(FRICTION * THRUST, rel=0.02)
    assert np.abs(force[[0, 2, 3]]).max() < 0.02 * force[1]


def test_brake_that_comes_on_loses_no_energy(demo, runs):
    case = braked(demo, 42.0, start_s=0.2, build_up_s=0.4)
    energy = table(simulate(case, runs / "brake"), "energy")
    on = energy.time > 0.65
    assert (energy.brake_power[energy.time < 0.2] == 0.0).all()
    assert energy.brake_power[on] == pytest.approx(8 * FRICTION * THRUST * case.speed, rel=0.02)
    rising = (energy.time > 0.25) & (energy.time < 0.55)
    share = (energy.time[rising] - 0.2) / 0.4
    assert energy.brake_power[rising] == pytest.approx(share * energy.brake_power[on].mean(), rel=0.05)
    taken = energy.brake_power + energy.contact_power + energy.friction_power + energy.damper_power
    given = np.trapezoid(energy.coupler_power - taken, energy.time)
    # the couplers' springs and dampers are the train's; those of the wagon keep next to nothing
    stored = energy.kinetic_energy + energy.potential_energy
    braking = np.trapezoid(energy.brake_power, energy.time)
    assert given == pytest.approx(stored[-1] - stored[0], abs=2e-3 * braking)


def test_orders_that_no_shoe_can_follow(demo):
    with pytest.raises(CaseError, match=r"brake\.wheels.*no shoe on 5L"):
        braked(demo, wheels=["5L"])
    with pytest.raises(CaseError, match=r"brake\.wheels.*1L"):
        braked(demo, wheels=["first"])
    with pytest.raises(CaseError, match=r"brake\.shoe_force_kN.*0 to 100"):
        braked(demo, shoe_force_kN=-1.0)
    with pytest.raises(CaseError, match="iore_locomotive has no brake shoes"):
        demo.with_changes(vehicle="iore_locomotive", brake={"shoe_force_kN": 10.0})
