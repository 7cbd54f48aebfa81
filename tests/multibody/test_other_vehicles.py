"""No three-piece wagon: soft springs find their equilibrium, two units keep their numbers."""

import numpy as np
import pytest

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import BODY_COORDINATES, Ledger, workspace
from hh_exudyn.multibody.recording import LogWriter
from hh_exudyn.multibody.system import evaluate_bundle
from vehicles.couplings import AxleBoxPad, Bushing, Rod
from vehicles.description import Body, Coupler, Vehicle, Wheelset

RADIUS, SPRING = 0.46, 4e5  # m; N/m of an axle box: 10 t on four of them deflect by 61 mm
FLOATING, SLUNG = 10_000.0, 2000.0  # kg


def unit(number, middle):
    """A two-axle wagon with a slung tank: bodies, couplings and wheelsets."""
    frame, tank = f"frame_{number}", f"tank_{number}"
    bodies = [
        Body(frame, "car_body", FLOATING, (1e4, 4e4, 4e4), (middle, 0.0, 1.5)),
        Body(tank, "motor", SLUNG, (5e2, 5e2, 5e2), (middle, 0.0, 1.0)),
    ]
    # preloaded: the tank hangs where it is drawn
    couplings = [
        Bushing(
            f"sling_{number}", frame, tank, (middle, 0.0, 1.2), (2e6,) * 3, (2e4,) * 3, (2e6,) * 3,
            (2e4,) * 3, (0.0, 0.0, SLUNG * GRAVITY),
        )
    ]  # fmt: skip
    wheelsets = []
    for end in (1, -1):
        name = f"wheelset_{number}{'F' if end > 0 else 'R'}"
        place = (middle + 2.5 * end, 0.0, RADIUS)
        bodies.append(Body(name, "wheelset", 1300.0, (800.0, 100.0, 800.0), place))
        for side in (1, -1):
            point = (place[0], side, RADIUS)
            couplings.append(
                AxleBoxPad(
                    f"spring_{name}{side}", frame, name, point, (4e6, 4e6, SPRING), (4e4, 4e4, 2e4), 1e4, 1e4
                )
            )
        wheelsets.append(Wheelset(name, 1, RADIUS, number))
    return bodies, couplings, wheelsets


def pair():
    """Two of them with a drawbar, and a coupler head on either."""
    front, rear = unit(1, 4.0), unit(2, -4.0)
    drawbar = Rod("drawbar", "frame_1", "frame_2", (0.5, 0.0, 1.0), (-0.5, 0.0, 1.0), 5e7, 5e5)
    return Vehicle(
        name="pair",
        bodies=(*front[0], *rear[0]),
        couplings=(*front[1], *rear[1], drawbar),
        wheelsets=(*front[2], *rear[2]),
        coupler=Coupler(("frame_1", "frame_2"), ((8.0, 0.0, 1.0), (-8.0, 0.0, 1.0)), 2e5, 1e5),
        dimensions={},
    )


class Rows:
    """A recorder that keeps the last rows of each log."""

    def __init__(self):
        self.last = {}

    def append_rows(self, log, rows):
        self.last[log] = rows.copy()


@pytest.fixture(scope="module")
def rolling(demo):
    vehicle = pair()
    sections = [{"kind": "straight", "length_m": 60.0, "gauge_mm": 1435.0}]
    model = assemble(vehicle, demo.with_changes(track={"sections": sections, "flexibility": "rigid"}))
    work = workspace(model)
    state = equilibrium(vehicle, model, work)
    assert evaluate_bundle(Bundle(model, work), state.sliders, state.q, state.v, 0.0, False) == 0
    return vehicle, model, work, state


def test_soft_springs_find_their_equilibrium_without_a_guess(rolling):
    """Every frame sinks by the weight on its springs over their stiffness; the preloaded slings stay."""
    vehicle, _, work, state = rolling
    drop = {
        body.name: body.position[2] - state.q[BODY_COORDINATES * i + 2]
        for i, body in enumerate(vehicle.bodies)
    }
    for number in (1, 2):
        springs = drop[f"frame_{number}"] - (drop[f"wheelset_{number}F"] + drop[f"wheelset_{number}R"]) / 2
        assert springs == pytest.approx((FLOATING + SLUNG) * GRAVITY / (4 * SPRING), rel=1e-3)
        assert drop[f"tank_{number}"] - drop[f"frame_{number}"] == pytest.approx(0.0, abs=1e-5)
    assert -work.rail_force[:, :, 1].sum() == pytest.approx(vehicle.mass * GRAVITY, rel=1e-5)
    assert abs(work.ledger[Ledger.COUPLER_FORCE]) < 10.0


def test_each_coupler_head_pulls_at_its_own_body(rolling):
    """A train 10 mm ahead pulls half its force at either head: on the front and on the rear frame."""
    vehicle, model, work, state = rolling
    bundle = Bundle(model, work)
    evaluate_bundle(bundle, state.sliders, state.q, state.v, 0.0, False)
    before = work.generalized_force.copy()
    work.inputs.train_start[:] += 0.01
    evaluate_bundle(bundle, state.sliders, state.q, state.v, 0.0, False)
    work.inputs.train_start[:] -= 0.01
    pull = (work.generalized_force - before)[: BODY_COORDINATES * len(vehicle.bodies)]
    pull = pull.reshape(-1, BODY_COORDINATES)[:, 0]
    expected = [0.5 * 2e5 * 0.01 if body.name.startswith("frame") else 0.0 for body in vehicle.bodies]
    assert pull == pytest.approx(expected, abs=1.0)


def test_units_are_numbered_in_the_contact_log(rolling):
    """Vehicle 1 and 2, one bogie each, wheelsets 1 and 2 in each."""
    vehicle, model, work, state = rolling
    recorder = Rows()
    LogWriter(vehicle, model, work, recorder).write(0.0, state.v)
    rows = np.unique(recorder.last["contact"][:, 2:5], axis=0)
    assert rows.tolist() == [[1, 1, 1], [1, 1, 2], [2, 1, 1], [2, 1, 2]]
