"""Master and slave with their drawbar: at rest two single wagons, in a curve nearly so."""

import numpy as np
import pytest
from run_tables import table
from track_sections import into_left_curve

from hh_exudyn.case import Case, CaseError
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import Ledger, workspace
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.couplings import Rod

SIDES = (1, -1)


def on_straight(demo: Case, name: str, **changes: object) -> Case:
    track = {"flexibility": "rigid", "sections": [{"kind": "straight", "length_m": 60.0, "gauge_mm": 1440.0}]}
    return demo.with_changes(vehicle=name, track=track, **changes)


def wheel_loads(demo: Case, name: str) -> np.ndarray:
    case = on_straight(demo, name)
    described = vehicle(name)
    model = assemble(described, case)
    work = workspace(model)
    equilibrium(described, model, work)
    return -work.rail_force[:, :, 1]


def in_curve(demo: Case, name: str) -> Case:
    """On rigid track, which has no masses to ring; into a curve of 450 m and on in it."""
    sections = into_left_curve((23.0, 30.0, 47.0), 450.0, 1440.0)
    return demo.with_changes(
        vehicle=name, track={"flexibility": "rigid", "sections": sections}, contact={"cells": [16, 8]}
    )


@pytest.mark.parametrize("load", ["loaded", "empty"])
def test_each_unit_stands_as_a_single_wagon(demo, load):
    single = wheel_loads(demo, f"iore_wagon_{load}")
    pair = wheel_loads(demo, f"iore_wagon_pair_{load}")
    # wheels roll with a small creep for which the couplers pull; it shifts some newtons
    assert pair == pytest.approx(np.vstack([single, single]), abs=2.0)


@pytest.mark.parametrize("draft", [400e3, -300e3])
def test_the_drawbar_passes_on_what_the_train_pulls(demo, draft):
    """In draft the bar is longer by force over stiffness; loads stay, all couplers are at one height.

    The vehicle is longer by as much, half of it at either head, and the springs of the train hold that back.
    """
    case = on_straight(demo, "iore_wagon_pair_loaded", train={"draft_kN": 1e-3 * draft})
    described = case.described_vehicle()
    model = assemble(described, case)
    work = workspace(model)
    equilibrium(described, model, work)
    assert abs(work.ledger[Ledger.COUPLER_FORCE]) < 100.0  # what comes in at the front goes out behind
    rod = next(i for i, c in enumerate(described.couplings) if isinstance(c, Rod))
    ends = [
        work.position[body] + work.rotation[body] @ arm
        for body, arm in (
            (model.couplings.body_a[rod], model.couplings.point_a[rod]),
            (model.couplings.body_b[rod], model.couplings.point_b[rod]),
        )
    ]
    bar = described.couplings[rod]
    assert isinstance(bar, Rod)
    stretch = np.linalg.norm(ends[1] - ends[0]) - bar.length
    held_back = described.coupler.stiffness / 2 * stretch / 2
    assert stretch == pytest.approx((draft - held_back) / bar.stiffness, rel=1e-3)
    assert -work.rail_force[:, :, 1].sum() == pytest.approx(240e3 * GRAVITY, rel=1e-5)
    assert -work.rail_force[:, :, 1] == pytest.approx(np.full((8, 2), 30e3 * GRAVITY / 2), rel=0.01)


def test_nothing_passes_through_a_locomotive(demo):
    with pytest.raises(CaseError, match="no force passes through vehicle iore_locomotive"):
        on_straight(demo, "iore_locomotive", train={"draft_kN": 100.0})


def test_the_pair_is_two_wagons_and_a_drawbar():
    pair, single = vehicle("iore_wagon_pair_loaded"), vehicle("iore_wagon_loaded")
    assert pair.mass == pytest.approx(2 * single.mass)
    heads = [point[0] for point in pair.coupler.points]
    assert np.ptp(heads) == pytest.approx(2 * 10.29)
    assert [(w.unit, w.bogie) for w in pair.wheelsets] == [
        (unit, bogie) for unit in (1, 2) for bogie in (1, 2) for _ in range(2)
    ]
    assert [pair.unit_of(w.body) for w in pair.wheelsets] == [w.unit for w in pair.wheelsets]
    (drawbar,) = (c for c in pair.couplings if isinstance(c, Rod))
    assert {pair.unit_of(drawbar.body_a), pair.unit_of(drawbar.body_b)} == {1, 2}


def test_in_a_curve_it_runs_as_two_wagons(demo, runs):
    """The drawbar pulls along the chord between its pins; nothing else ties the units."""
    pair = table(simulate(in_curve(demo, "iore_wagon_pair_loaded"), runs / "pair_in_curve"), "contact")
    single = table(simulate(in_curve(demo, "iore_wagon_loaded"), runs / "single_in_curve"), "contact")
    assert sorted(set(pair.vehicle)) == [1, 2]

    def means(log, unit, name):
        """Of every wheel over the stretch in which both runs have all its wheelsets in the full curve."""
        found = []
        for wheelset in (1, 2, 3, 4):
            for side in SIDES:
                mine = (log.vehicle == unit) & (log.wheelset == wheelset) & (log.side == side)
                mine &= (log.patch == 0) & (log.s > 66.0) & (log.s < 76.0)
                found.append(getattr(log, name)[mine].mean())
        return np.array(found)

    alone = means(single, 1, "Q")
    for unit in (1, 2):
        assert means(pair, unit, "Q") == pytest.approx(alone, abs=0.02 * 147e3)
        assert means(pair, unit, "Y") == pytest.approx(means(single, 1, "Y"), abs=4e3)
        attack = means(single, 1, "angle_of_attack")
        assert means(pair, unit, "angle_of_attack") == pytest.approx(attack, abs=0.3e-3)
