"""Irregular track in a run: the rails lie where it says, the wheels carry the weight, left mirrors right."""

import numpy as np
import pytest
from run_tables import table

from hh_exudyn.case import Case
from hh_exudyn.case.errors import CaseError
from hh_exudyn.contact.geometry.rail_tables import gauge_point_at
from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import BODY_COORDINATES, workspace
from hh_exudyn.multibody.simulate import simulate
from hh_exudyn.multibody.system import evaluate_bundle
from vehicles.catalogue import vehicle
from vehicles.start import start_front


def straight(demo: Case, length: float = 160.0, **track: object) -> Case:
    sections = [{"kind": "straight", "length_m": length, "gauge_mm": 1445.0}]
    return demo.with_changes(track={"sections": sections, **track})


def test_rails_lie_and_rise_as_the_irregularities_say(demo: Case) -> None:
    """Level up, alignment to the left, gauge wide, cross-level right rail up; the rails run that way."""
    case = straight(demo, irregularity="erri_high", irregularity_seed=5, flexibility="rigid")
    wagon = vehicle(case.vehicle)
    model = assemble(wagon, case)
    work = workspace(model)
    state = equilibrium(wagon, model, work)
    irregular = case.track.irregular(start_front(wagon), case.alignment().length)
    assert irregular is not None
    q = state.q.copy()
    q[: BODY_COORDINATES * len(wagon.bodies) : BODY_COORDINATES] += 75.0  # beyond the fade-in
    assert evaluate_bundle(Bundle(model, work), state.sliders, q, state.v, 0.0, False) == 0
    rails = model.wheel_rail.rails_left
    half_width = 1.445 / 2 + gauge_point_at(rails, 0.0)
    for w in range(4):
        s = work.arc_length[w]
        level, sideways, gauge, cross = (np.interp(s, irregular.s, column) for column in irregular.values.T)
        expected = [[sideways + gauge / 2, level - cross / 2], [sideways - gauge / 2, level + cross / 2]]
        displacement = work.rail_position[w] - [[half_width, 0.0], [-half_width, 0.0]]
        # linear between samples a twelfth of the shortest wave apart: off by a thirtieth of their size
        assert displacement == pytest.approx(np.array(expected), abs=1e-4)
        assert np.abs(displacement).max() > 1e-4
        roll = np.arctan2(work.rail_rotation[w, :, 2, 1], work.rail_rotation[w, :, 2, 2])
        assert roll == pytest.approx(-cross / RAIL_TOP_DISTANCE, abs=1e-4)
    assert (work.rail_velocity == 0.0).all()  # their material rests
    before, direction = work.rail_position.copy(), work.rail_rotation[..., 0].copy()
    q[: BODY_COORDINATES * len(wagon.bodies) : BODY_COORDINATES] += 1e-4
    evaluate_bundle(Bundle(model, work), state.sliders, q, state.v, 0.0, False)
    slope = (work.rail_position - before) / 1e-4
    assert direction[..., 1:] == pytest.approx(slope, abs=1e-4)


@pytest.fixture(scope="module")
def low_and_high(demo: Case, runs):
    return [
        table(simulate(straight(demo, irregularity=name), runs / name), "contact")
        for name in ("erri_low", "erri_high")
    ]


def test_wheels_carry_the_weight_on_the_mean(low_and_high, demo: Case) -> None:
    weight = vehicle(demo.vehicle).mass * GRAVITY
    for log in low_and_high:
        first = log.patch == 0
        total = np.bincount(np.unique(log.time[first], return_inverse=True)[1], weights=log.Q[first])
        assert total.mean() == pytest.approx(weight, rel=0.01)


def test_a_worse_track_shakes_more(low_and_high) -> None:
    """High over low is 1.64 in level (root of the spectra's ratio); the springs' friction makes it other."""
    deviations = []
    for log in low_and_high:
        rough = (log.patch == 0) & (log.time > 4.0)  # faded in
        deviations.append([np.std(log.Q[rough & (log.wheelset == w)]) for w in (1, 2, 3, 4)])
    low, high = np.array(deviations)
    assert (high > 1.2 * low).all()
    assert (high < 2.2 * low).all()
    assert ((low > 1e3) & (high < 30e3)).all()  # of 147 kN


def test_a_mirrored_case_is_the_mirror_image(demo: Case, runs) -> None:
    case = straight(demo, 115.0, irregularity="erri_high", flexibility="rigid")
    one, other = (
        table(simulate(c, runs / n), "contact") for c, n in ((case, "one"), (case.mirrored(), "two"))
    )
    left = np.lexsort((one.patch, one.side, one.wheelset, one.time))
    right = np.lexsort((other.patch, -other.side, other.wheelset, other.time))
    for name, sign in (("Q", 1), ("Y", 1), ("y_wheelset", -1)):
        a, b = getattr(one, name)[left], sign * getattr(other, name)[right]
        assert a == pytest.approx(b, rel=1e-6, abs=1e-6 * np.abs(a).max()), name
    assert np.abs(one.y_wheelset).max() > 1e-3
    assert case.mirrored().mirrored() == case


def test_a_seed_is_a_track(demo: Case) -> None:
    tracks = [straight(demo, irregularity="erri_low", irregularity_seed=seed) for seed in (1, 1, 2)]
    first, again, other = (case.track.irregular(20.0, 160.0) for case in tracks)
    assert first is not None and again is not None and other is not None
    assert (first.values == again.values).all()
    assert np.abs(first.values - other.values).max() > 1e-4
    assert Case.from_toml(tracks[2].to_toml()) == tracks[2]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"irregularity": "erri"}, "erri_low"),
        ({"irregularity": "no/such.csv"}, "cannot be read"),
        ({"irregularity": "erri_low", "irregularity_seed": -1}, "irregularity_seed = -1"),
        ({"irregularity": "erri_low", "irregularity_shortest_m": 0.1}, "irregularity_shortest_m = 0.1 m"),
    ],
)
def test_bad_irregularity_is_named(demo: Case, changes: dict[str, object], message: str) -> None:
    with pytest.raises(CaseError, match=message):
        straight(demo, **changes)


def test_a_track_too_short_for_a_random_one_is_refused(demo: Case) -> None:
    case = straight(demo, 80.0, irregularity="erri_low")
    with pytest.raises(ValueError, match="allowed from 100 m"):
        assemble(vehicle(case.vehicle), case)


def test_measured_irregularities_begin_ahead_of_the_vehicle(demo: Case, tmp_path) -> None:
    s = 0.25 * np.arange(600)
    columns = np.column_stack([1000.0 + s, 4.0 * np.sin(s / 3.0), *(np.zeros((3, s.size)))])
    path = tmp_path / "car.csv"
    header = "position_m,level_mm,alignment_mm,gauge_mm,cross_level_mm"
    np.savetxt(path, columns, delimiter=",", header=header, comments="", fmt="%.6f")
    irregular = straight(demo, irregularity=str(path), irregularity_scale=0.5).track.irregular(20.0, 160.0)
    assert irregular is not None
    assert irregular.s[0] == 20.0
    assert irregular.signal("level") == pytest.approx(2e-3 * np.sin(s / 3.0), abs=1e-8)
