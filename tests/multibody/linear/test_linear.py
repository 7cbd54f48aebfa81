"""Modes and critical speeds of the reference vehicles against closed forms, published and own equations."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from track_sections import straight

from hh_exudyn.contact.geometry.rail_tables import with_origin
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.tangential.registry import GIVEN
from hh_exudyn.contact.types import GivenCreep
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE, NOMINAL_GAUGE
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.free_wheelset import conical_wheel
from hh_exudyn.multibody.linear.hunting import lateral_motion
from hh_exudyn.multibody.linear.modes import LinearVehicle, critical_speed, root_locus
from hh_exudyn.multibody.validation import cooperrider_rows, suspended_wheelset_rows, vertical_mode_rows
from vehicles.catalogue import VEHICLES, parameters, vehicle
from vehicles.couplings import AxleBoxPad, Bushing
from vehicles.models.suspended_wheelset import stated_critical_speed


def closed_form(conicity=None, **spin):
    return stated_critical_speed(parameters("suspended_wheelset"), conicity, **spin)


def test_suspended_wheelset_becomes_unstable_at_the_closed_form(wheelset):
    """73.39 m/s and 6.27 Hz; the full model on rails is asked to come within 0.05 %."""
    rows = suspended_wheelset_rows()
    assert rows[0].wanted == pytest.approx(73.39, abs=0.01)
    assert [row.quantity for row in rows if not row.holds] == []
    assert wheelset.growth(rows[0].found)[1].largest(wheelset.names) == "wheelset_1 y"


@pytest.mark.parametrize("share", [0.98, 1.02])
def test_motion_in_time_decays_just_below_and_grows_just_above(wheelset, share):
    """At the rate and frequency of the mode: the nonlinear run and the eigenvalue are of the same model."""
    speed = share * closed_form()[0]
    _, mode = wheelset.growth(speed)
    motion = lateral_motion(wheelset, speed, 1.5, 1e-4, step=2e-4)  # third order: at 0.4 ms 0.6 %
    rate = motion.growth_rate(0.4)
    assert rate * (share - 1.0) > 0.0
    assert rate == pytest.approx(mode.eigenvalue.real, rel=1e-3)
    assert motion.frequency(0.4) == pytest.approx(mode.frequency, rel=1e-3)


@pytest.mark.parametrize("speed", [41.5, 46.0])
def test_growth_in_time_is_the_eigenvalues_with_gyroscopic_moments(given_case, tmp_path, speed):
    """Cones of 0.3 on 60E1, FaStrip: either side of the critical speed, 43.8 m/s, within 0.04 %.

    Without the moments the eigenvalue would be off by 0.55 1/s, some 40 and 100 % of these two (the lateral
    place of the equilibrium, within its tolerance, decides on the rest). Motions must be small: 10 um at the
    start change the growth by 1 %. The eigenvalue is of a run in the same steps, in which the creepage
    follows later; third order, steps of 0.4 ms would leave 0.0014 1/s.
    """
    case = given_case.with_changes(
        wheel_profile=conical_wheel(tmp_path / "cones.txt", 0.3),
        contact={"theory": "fastrip"},
        track={"sections": straight(60.0, 1450.0), "inclination": "1:40"},
    )
    coned = LinearVehicle(vehicle("suspended_wheelset"), case)
    _, mode = coned.growth(speed, step=2e-4)
    motion = lateral_motion(coned, speed, 2.0, 1e-6, step=2e-4)
    assert motion.growth_rate(0.5) == pytest.approx(mode.eigenvalue.real, rel=1e-3)
    assert motion.frequency(0.5) == pytest.approx(mode.frequency, rel=5e-3)


class OnCones(LinearVehicle):
    """The suspended wheelset with its stated creep coefficients, but on cones that roll it."""

    CROWN = 0.03  # m, radius of the rail heads: tight, so that the contact stays where it is

    def at(self, speed, step=0.0):
        stated, slope = self.vehicle.contact, self.vehicle.contact.conicity
        y = np.arange(-0.05, 0.045, 0.25e-3)
        cone = Profile("cone", "wheel", y, -slope * y - 0.028 * np.clip((y - 0.03) / 0.015, 0.0, None) ** 3)
        y = np.arange(-0.034, 0.0341, 0.25e-3)
        z = np.sqrt(self.CROWN**2 - np.minimum(np.abs(y), 0.8 * self.CROWN) ** 2) - self.CROWN
        z -= 4.0 / 3.0 * np.clip(np.abs(y) - 0.8 * self.CROWN, 0.0, None)
        crown = Profile("crown", "rail", y, z)
        contact = wheel_rail_model(
            cone,
            cone,
            crown,
            crown,
            nominal_radius=self.vehicle.wheelsets[0].radius,
            back_to_back=2.0 * (stated.half_distance - FLANGE_BACK_TO_RUNNING_CIRCLE),
            theory="linear",
        )
        # contact at the running circle, where the crown is as steep as the cone
        offset = stated.half_distance - 0.5 * NOMINAL_GAUGE + self.CROWN * np.sin(np.arctan(slope))
        contact = contact._replace(
            rails_left=with_origin(contact.rails_left, offset),
            rails_right=with_origin(contact.rails_right, offset),
            theory=GIVEN,
            given=GivenCreep(
                stated.longitudinal, stated.lateral, 0.0
            ),  # cones have their conicity themselves
        )
        model, work, _ = super().at(speed, step)
        model = model._replace(wheel_rail=contact)
        return model, work, equilibrium(self.vehicle, model, work)


def spinning(inertia):
    """The suspended wheelset with another spin inertia [kg m^2]."""
    described = vehicle("suspended_wheelset")
    bodies = [
        replace(body, inertia=(body.inertia[0], inertia, body.inertia[2]))
        if body.kind == "wheelset"
        else body
        for body in described.bodies
    ]
    return replace(described, bodies=tuple(bodies))


def test_gyroscopic_moments_raise_the_critical_speed_as_the_closed_form_says(given_case):
    """On cones of 0.1 by 3.1 % for 100 kg m^2 and by 10 % for 300: within 0.1 and 0.4 % of the closed form.

    The more of it, the more the contact springs give way in roll, which the closed form holds rigid.
    """
    p = parameters("suspended_wheelset")
    slope, radius, half = p["contact.conicity"], p["wheelset.radius"], p["contact.half_distance"]
    roll = slope / half / (1.0 - radius * slope / half)
    conicity = slope * (1.0 + radius * roll + OnCones.CROWN * roll)  # contacts move on wheel and rail

    def closed(inertia):
        return closed_form(conicity=conicity, roll=roll, spin_inertia=inertia)

    still = critical_speed(OnCones(spinning(1.0), given_case), low=60.0, step=15.0).speed
    assert still == pytest.approx(closed(1.0)[0], rel=2e-3)
    for inertia, tolerance in ((100.0, 1e-3), (300.0, 4e-3)):
        found = critical_speed(OnCones(spinning(inertia), given_case), low=60.0, step=15.0)
        speed, frequency = closed(inertia)
        assert found.speed / still == pytest.approx(speed / closed(1.0)[0], rel=tolerance)
        assert found.mode.frequency == pytest.approx(frequency, rel=tolerance)


def test_root_locus_follows_hunting_over_speed(wheelset):
    """One mode changes its sign of growth, in the pair of speeds about the critical one."""
    speeds = np.linspace(65.0, 80.0, 4)
    locus = root_locus(wheelset, speeds)
    crossing = [column for column in locus.T if column[0].real < 0.0 < column[-1].real]
    assert len(crossing) == 1
    assert [value.real > 0.0 for value in crossing[0]] == [False, False, True, True]


def test_modes_damped_and_not_of_a_wheelset_held_by_its_springs(wheelset):
    """Without creep the wheelset swings on each spring alone."""
    p = parameters("suspended_wheelset")
    frequencies = [mode.frequency for mode in wheelset.modes(20.0, undamped=True)]
    for stiffness, mass in (
        (p["suspension.lateral_stiffness"], p["wheelset.mass"]),
        (p["suspension.yaw_stiffness"], p["wheelset.yaw_inertia"]),
        (p["suspension.longitudinal_stiffness"], p["wheelset.mass"]),
    ):
        wanted = np.sqrt(stiffness / mass) / (2 * np.pi)
        assert min(abs(f / wanted - 1.0) for f in frequencies) < 1e-3


def vermeulen_johnson(along, across, poisson_ratio):
    """Constants k of longitudinal and lateral creep = 3 mu N/(G pi a b) k [1 - (1 - F/mu N)^(1/3)].

    From the half-space: the gradient of the displacement under a traction like Hertz's pressure, by the
    integral over directions of chords through a point (own derivation).
    """

    def constant(slope):
        def part(t):
            chord = np.cos(t) ** 2 / along**2 + np.sin(t) ** 2 / across**2
            return ((1 - poisson_ratio) + poisson_ratio * slope(t) ** 2) * np.sin(t) ** 2 / chord**1.5

        return quad(part, 0.0, np.pi)[0] / (2 * along * across**2)

    return constant(np.cos), constant(np.sin)


def test_which_of_the_creep_constants_is_the_longitudinal_one():
    """Kaas-Petersen's ellipse gives his two numbers, 0.54219 along the track and 0.60252 across it."""
    assert vermeulen_johnson(6.578e-3, 3.934e-3, 0.3) == pytest.approx((0.54219, 0.60252), rel=5e-4)
    p = parameters("cooperrider_bogie")
    assert p["contact.longitudinal_creep"] == pytest.approx(6.563e6 / 0.54219, rel=1e-6)
    assert p["contact.lateral_creep"] == pytest.approx(6.563e6 / 0.60252, rel=1e-6)


@pytest.mark.parametrize("exchanged", [False, True])
def test_cooperriders_bogie_begins_to_hunt(exchanged):
    """65.29 m/s by the seven equations; Hassard's published 68.66 with the two constants exchanged."""
    speed, frequency = cooperrider_rows(exchanged)
    assert speed.wanted == (68.66 if exchanged else 65.29)
    assert speed.holds and frequency.holds


SOFT = 1e3  # N/m, lengthwise: keeps the bodies in their places and does nothing else


def vertical_springs_alone(coach):
    """What acts lengthwise taken off, and the load of the springs, which tilts with them; axle loads kept."""
    couplings = []
    for c in coach.couplings:
        if isinstance(c, AxleBoxPad | Bushing):
            c = replace(c, stiffness=(min(c.stiffness[0], SOFT), *c.stiffness[1:]))
        if isinstance(c, Bushing):
            c = replace(
                c, rotational_stiffness=(c.rotational_stiffness[0], 0.0, 0.0), preload=(0.0, 0.0, 0.0)
            )
        couplings.append(c)
    axle_load = sum(body.weight for body in coach.bodies) / 4
    bodies = [
        replace(body, deflection=0.0, held_weight=axle_load if body.kind == "wheelset" else 0.0)
        for body in coach.bodies
    ]
    return replace(coach, bodies=tuple(bodies), couplings=tuple(couplings))


@pytest.mark.parametrize(("whole", "tolerance"), [(False, 2e-3), (True, 6e-3)])
def test_vertical_modes_of_manchester_vehicle_1(whole, tolerance):
    """Bounce and pitch of body and frames, without dampers and creep, on rigid track.

    The reference knows vertical springs alone. With the others bounce stays; pitch drags bogies and wheelsets
    lengthwise by rods and guides that lie off its centre, and the load of the springs tilts with the frames.
    """
    coach = vehicle("manchester_vehicle_1")
    rows = vertical_mode_rows(coach if whole else vertical_springs_alone(coach), tolerance)
    assert len(rows) == 6
    assert [row.quantity for row in rows if not row.holds] == []


def test_reference_vehicles_say_where_their_numbers_are_from():
    for name in ("suspended_wheelset", "cooperrider_bogie", "manchester_vehicle_1"):
        assert name in VEHICLES
        assert all(parameter.unit for parameter in parameters(name).parameters)


def test_a_vehicle_without_stated_contact_is_refused(given_case):
    with pytest.raises(ValueError, match="vehicle manchester_vehicle_1 states no contact"):
        LinearVehicle(vehicle("manchester_vehicle_1"), given_case)


def test_speeds_in_disorder_are_refused(wheelset):
    with pytest.raises(ValueError, match="needed 0 < low < high"):
        critical_speed(wheelset, low=50.0, high=20.0)
