"""Friction that changes under a running wagon: what the log says each patch had, and what it did."""

import numpy as np
import pytest
from run_tables import steady, table, wheel_means
from track_sections import into_left_curve

from hh_exudyn.contact.tangential.api import creep_force
from hh_exudyn.conventions import GRAVITY, RAIL_TOP_DISTANCE
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.linear.stability import MARGIN, eigenvalues, largest_stable_step
from hh_exudyn.multibody.model import workspace
from hh_exudyn.multibody.simulate import simulate
from track.friction import climate, falling
from vehicles.catalogue import vehicle

STEP_AT, RAMP = 33.0, 4.0  # m, where friction drops, and over what length
FRICTION = {
    "climate": "cold_dry",
    "falling": "polach_dry",
    "lubricated_wheelsets": [1],
    "ramp_m": RAMP,
    "sections": [{"start_m": STEP_AT, "climate": "humid", "left": {"climate": "dry"}}],
}
LEVELS = {1: ("cold_dry", "dry"), -1: ("cold_dry", "humid")}  # side: before and behind the step


@pytest.fixture(scope="module")
def case(short_case):
    return short_case.with_changes(friction=FRICTION)


@pytest.fixture(scope="module")
def contact(case, runs):
    return table(simulate(case, runs / "friction"), "contact")


def test_the_log_has_the_friction_of_place_zone_and_slip(contact):
    """Of the wheelsets without grease: smooth over the ramp, Polach's formula over the logged creepage.

    To 0.2 %: every strip has the friction of its own ellipse's slip, the row their mean.
    """
    fall = falling("polach_dry")
    slip = contact.speed * np.hypot(contact.nu_x, contact.nu_y)
    reduced = (1.0 - fall.ratio) * np.exp(-fall.decrease * slip) + fall.ratio
    passed = np.clip((contact.s - STEP_AT) / RAMP + 0.5, 0.0, 1.0)
    weight = passed**2 * (3.0 - 2.0 * passed)
    for side, (before, behind) in LEVELS.items():
        rows = (contact.side == side) & (contact.wheelset > 1)
        still = climate(before).tread + weight[rows] * (climate(behind).tread - climate(before).tread)
        assert contact.friction[rows] == pytest.approx(still * reduced[rows], rel=2e-3)
        on_the_ramp = rows & (weight > 0.05) & (weight < 0.95)
        assert on_the_ramp.sum() > 20
    assert reduced.min() < 0.98  # it does fall


def test_only_the_first_wheelset_is_greased(contact):
    """It has reached the flange root, and nothing on its tread changes."""
    own = contact.wheelset == 1
    root = own & (contact.contact_angle > np.radians(20.0))
    assert root.sum() > 20
    assert np.median(contact.friction[root]) <= 0.25
    assert contact.friction[root].max() <= 0.3  # of a run of strips that begins on the tread
    others = ~own & (contact.contact_angle > np.radians(20.0)) & (contact.s < STEP_AT - RAMP)
    assert contact.friction[others].min(initial=1.0) > 0.7


def test_the_forces_are_those_of_the_logged_friction(case, runs):
    """The patches solved again from their rows: the same force, whatever friction they had; of ellipses."""
    ellipses = case.with_changes(contact={"normal": "hertz"})
    contact = table(simulate(ellipses, runs / "ellipses"), "contact")
    rows = np.arange(contact.time.size)[:: max(1, contact.time.size // 100)]
    for i in rows:
        found = creep_force(
            case.contact.theory, contact.a[i], contact.b[i], contact.normal_force[i], contact.nu_x[i],
            contact.nu_y[i], contact.phi[i], contact.friction[i], cells=case.contact.cells,
        )  # fmt: skip
        limit = contact.friction[i] * contact.normal_force[i]
        assert found.x == pytest.approx(contact.force_x[i], abs=1e-6 * limit)
        assert found.y == pytest.approx(contact.force_y[i], abs=1e-6 * limit)
    used = np.hypot(contact.force_x, contact.force_y)
    assert (used <= contact.friction * contact.normal_force * (1.0 + 1e-9)).all()


def test_the_mirror_image(case, contact, runs):
    """Left and right exchanged, friction with them, and the run is the mirror image."""
    other = table(simulate(case.mirrored(), runs / "friction_mirrored"), "contact")
    here = np.lexsort((contact.patch, contact.side, contact.wheelset, contact.time))
    there = np.lexsort((other.patch, -other.side, other.wheelset, other.time))
    for name, sign in {"Q": 1, "Y": 1, "friction": 1, "force_x": 1, "force_y": -1, "y_wheelset": -1}.items():
        a, b = getattr(contact, name)[here], sign * getattr(other, name)[there]
        assert a == pytest.approx(b, rel=1e-6, abs=1e-6 * np.abs(a).max()), name


def test_falling_friction_leaves_the_step_as_it_is(case):
    """At rest nothing slips, so the largest stable step hardly knows of the fall."""
    wagon = vehicle(case.vehicle)
    limits = []
    for name in ("polach_dry", None):
        model = assemble(wagon, case.with_changes(friction={"falling": name}))
        work = workspace(model)
        limits.append(MARGIN * largest_stable_step(eigenvalues(model, work, equilibrium(wagon, model, work))))
    assert limits[0] == pytest.approx(limits[1], rel=0.01)
    assert limits[0] >= 0.4e-3


def test_slip_beyond_saturation_on_falling_friction_goes_on(demo, runs):
    """A curve of 250 m: the leading outer flange root slides at 0.1 m/s, within 10 % of the falling bound.

    The force falls with the slip there. (Over 0.3 m/s, as it was, came of ellipses that jumped to the
    flange.) The run ends by itself, no force exceeds the bound, and the wheels carry the weight.
    """
    sections = into_left_curve((15.0, 25.0, 40.0), 250.0, 1445.0)
    tight = demo.with_changes(
        friction={"climate": "dry", "falling": "polach_dry"}, track={"sections": sections}
    )
    run = simulate(tight, runs / "falling")
    assert run.status["finished"] is True
    contact = table(run, "contact")
    slip = contact.speed * np.hypot(contact.nu_x, contact.nu_y)
    used = np.hypot(contact.force_x, contact.force_y) / (contact.friction * contact.normal_force)
    sliding = (slip > 0.08) & (used > 0.9)
    assert sliding.sum() > 50
    assert contact.friction[sliding].max() < 0.98 * climate("dry").flange
    assert used.max() <= 1.0 + 1e-9
    curve = steady(contact, 1.0)
    speed, roll = 60.0 / 3.6, np.arcsin(0.065 / RAIL_TOP_DISTANCE)
    weight = GRAVITY * np.cos(roll) + speed**2 / 250.0 * np.sin(roll)
    assert wheel_means(curve, "Q").sum() == pytest.approx(vehicle(demo.vehicle).mass * weight, rel=0.03)
