"""Direction of the rails on a cant ramp: each with its own slope, or both along the centre line."""

import numpy as np
import pytest

from hh_exudyn.case import Case
from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.model import BODY_COORDINATES, coordinates, workspace
from hh_exudyn.multibody.system import evaluate
from track.course.alignment import inclined_frame
from vehicles.catalogue import vehicle

COACH = vehicle("manchester_vehicle_1")
CANT, LENGTH, BEGIN = 0.12, 40.0, 50.0  # m


@pytest.mark.parametrize("sloped", [True, False])
def test_rails_rise_and_fall_with_the_ramp_or_not(demo: Case, sloped: bool) -> None:
    """The leading wheelset in the middle of a linear ramp to the right; the others on the straight before."""
    sections = [
        {"kind": "straight", "length_m": BEGIN, "gauge_mm": 1435.0},
        {"kind": "transition", "length_m": LENGTH, "shape": "clothoid"},
        {"kind": "curve", "length_m": 60.0, "radius_m": 600.0, "hand": "right", "cant_mm": 1e3 * CANT},
    ]
    track = {"sections": sections, "flexibility": "rigid", "cant_ramp_slope": sloped}
    model = assemble(COACH, demo.with_changes(vehicle=COACH.name, track=track))
    work, q = workspace(model), np.zeros(coordinates(model))
    for i, body in enumerate(COACH.bodies):
        q[BODY_COORDINATES * i : BODY_COORDINATES * i + 3] = np.add(body.position, (20.0, 0.0, 0.0))
    leading = BODY_COORDINATES * int(model.wheelsets[0])
    s = BEGIN + 0.5 * LENGTH
    x, y, z, *_ = inclined_frame(model.alignment, s)
    q[leading : leading + 3] = x, y, z + COACH.wheelsets[0].radius
    work.arc_length[: len(model.wheelsets)] = s, 20.0, 20.0, 20.0
    evaluate(model, work, np.zeros_like(work.new_sliders), q, np.zeros_like(q), 0.0, True)
    assert work.arc_length[0] == pytest.approx(s, abs=0.05)
    rise = 0.5 * CANT / LENGTH if sloped else 0.0  # of the left rail, on the outside
    half = work.rail_position[0, :, 0] / (0.5 * RAIL_TOP_DISTANCE)
    assert work.rail_rotation[0, :, 2, 0] == pytest.approx(rise * half, abs=2e-5)
    assert work.rail_rotation[1, :, 2, 0] == pytest.approx(0.0, abs=1e-12)
