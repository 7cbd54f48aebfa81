"""The contact of reference models: two creep coefficients and a conicity, nothing else."""

import numpy as np
import pytest
from straight_rails import no_forces, straight_rails

from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.contact.tangential.given import given_contact_model
from hh_exudyn.contact.types import GivenCreep, WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces

CREEP = GivenCreep(1.2e7, 0.9e7, 0.15)
HALF, RADIUS, SPEED = 0.716, 0.46, 20.0


def wrench(lateral=0.0, yaw=0.0, velocity=(SPEED, 0.0, 0.0), yaw_rate=0.0, gauge=1.435):
    """Force and moment on a wheelset pressed 20 um into its rails."""
    model = given_contact_model(CREEP, HALF, RADIUS)
    axle = np.array([[-np.sin(yaw), np.cos(yaw), 0.0]])
    motion = WheelsetMotion(
        position=np.array([[0.0, lateral, RADIUS - 20e-6]]),
        axle=axle,
        velocity=np.array([velocity]),
        angular_velocity=SPEED / RADIUS * axle + [0.0, 0.0, yaw_rate],
        creep_lag=np.zeros((1, 2, 2)),
    )
    rails, forces = straight_rails(model, np.array([gauge])), no_forces(1)
    assert wheel_rail_forces(model, motion, rails, constant_friction([[0.3, 0.3]]), forces) == 0
    return forces.wrench[0]


def test_displacement_yaws_by_conicity_and_nothing_else():
    """Moment -2 f11 a conicity y/r0; no lateral force: neither gravity nor roll hold a cylinder."""
    force = wrench(lateral=1e-3)
    assert force[5] == pytest.approx(
        -2 * CREEP.longitudinal * HALF * CREEP.conicity * 1e-3 / RADIUS, rel=1e-3
    )
    assert abs(force[1]) < 1.0


def test_attack_pushes_sideways_and_motion_is_damped():
    """F_y = 2 f22 (psi - y'/V) and M_z = -2 f11 a^2 psi'/V."""
    assert wrench(yaw=1e-3)[1] == pytest.approx(2 * CREEP.lateral * 1e-3, rel=1e-3)
    assert wrench(velocity=(SPEED, 0.02, 0.0))[1] == pytest.approx(-2 * CREEP.lateral * 1e-3, rel=1e-3)
    damped = wrench(yaw_rate=0.02)
    assert damped[5] == pytest.approx(-2 * CREEP.longitudinal * HALF**2 * 1e-3, rel=1e-3)


def test_the_half_distance_belongs_to_nominal_gauge():
    """On track wider by 10 mm the contacts lie 5 mm further out: more arm against yawing."""
    wide = wrench(yaw_rate=0.02, gauge=1.445)[5]
    assert wide == pytest.approx(-2 * CREEP.longitudinal * (HALF + 0.005) ** 2 * 1e-3, rel=2e-3)


def test_the_flange_stops_a_wheelset_that_has_gone_too_far():
    assert wrench(lateral=5e-3)[1] == pytest.approx(0.0, abs=10.0)
    assert wrench(lateral=9e-3)[1] < -1e4


def test_a_half_distance_out_of_range_is_refused():
    with pytest.raises(ValueError, match="back_to_back"):
        given_contact_model(CREEP, 0.2, RADIUS)
