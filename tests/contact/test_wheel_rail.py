"""The whole contact kernel: exact properties, Hertz, small-angle creepages."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from straight_rails import no_forces, straight_rails
from wheelset_state import MODEL, R0, State, model

from hh_exudyn.contact.friction import constant_friction
from hh_exudyn.contact.geometry.rail_tables import rail_at
from hh_exudyn.contact.material import STEEL
from hh_exudyn.contact.normal.hertz import CURVATURE_FLOOR, hertz_patch
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model


def random_state(n: int, seed: int) -> State:
    rng = np.random.default_rng(seed)
    state = State(n)
    state.position += rng.uniform(-1, 1, (n, 3)) * [0.0, 5e-3, 50e-6]
    for i in range(n):
        state.point(rng.uniform(-0.02, 0.02), rng.uniform(-1, 1) * 1e-4, i)
        state.roll_on(rng.uniform(5, 30), rng.uniform(-0.1, 0.1), i=i)
    state.velocity += rng.uniform(-1, 1, (n, 3)) * [0.1, 0.1, 0.02]
    state.angular_velocity += rng.uniform(-1, 1, (n, 3)) * 0.05
    state.rail_displacement[:] = rng.uniform(-1, 1, (n, 2, 2)) * [1e-3, 2e-5]
    state.rail_velocity[:] = rng.uniform(-1, 1, (n, 2, 2)) * [0.02, 0.01]
    state.gauge += rng.uniform(-3e-3, 3e-3, n)
    state.friction[:] = rng.uniform(0.1, 0.5, (n, 2))
    return state


@pytest.mark.parametrize("normal", ["hertz", "analyn", "kik_piotrowski", "equivalent_elastic"])
def test_mirrored_states_give_mirrored_forces(normal: str) -> None:
    n = 60
    state = random_state(n, 1)
    mirrored = State(n)
    flip, axial = np.array([1.0, -1.0, 1.0]), np.array([-1.0, 1.0, -1.0])
    mirrored.position = state.position * flip
    mirrored.axle = state.axle * axial  # the mirrored axle vector points right; +y is its opposite
    mirrored.velocity = state.velocity * flip
    mirrored.angular_velocity = state.angular_velocity * axial
    mirrored.rail_displacement = state.rail_displacement[:, ::-1] * [-1, 1]
    mirrored.rail_velocity = state.rail_velocity[:, ::-1] * [-1, 1]
    mirrored.gauge, mirrored.friction = state.gauge, state.friction[:, ::-1].copy()
    for array in ("position", "axle", "velocity", "angular_velocity", "rail_displacement", "rail_velocity"):
        setattr(mirrored, array, np.ascontiguousarray(getattr(mirrored, array)))
    damped = model(damping=2.0, normal=normal)
    assert state.solve(damped).status == mirrored.solve(damped).status == 0
    np.testing.assert_allclose(mirrored.wrench[:, :3], state.wrench[:, :3] * flip, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(mirrored.wrench[:, 3:], state.wrench[:, 3:] * axial, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(mirrored.rail_force, state.rail_force[:, ::-1] * [-1, 1], rtol=1e-9, atol=1e-6)
    odd = [Patch.NU_Y, Patch.PHI, Patch.FORCE_Y, Patch.MOMENT_Z, Patch.CENTRE_Y]
    swapped = state.patches[:, ::-1].copy()
    swapped[..., odd] *= -1
    np.testing.assert_allclose(mirrored.patches, swapped, rtol=1e-8, atol=1e-9)
    assert (state.patches[..., Patch.NORMAL_FORCE] > 0).sum() > n


@pytest.mark.parametrize("y", [-0.003, 0.002, 0.0045, 0.0075])
def test_static_normal_force_is_hertz(y: float) -> None:
    state = State(height=R0 + 0.01)
    state.position[0, 1] = y
    low, high = R0 - 1e-3, R0 + 0.02
    for _ in range(60):  # the height of 50 um approach on the left wheel
        state.position[0, 2] = 0.5 * (low + high)
        rows = state.solve().rows()
        low, high = (state.position[0, 2], high) if len(rows) and rows[0, Patch.APPROACH] > 50e-6 else (
            low, state.position[0, 2],
        )  # fmt: skip
    (row,) = state.rows()
    _, wheel_slope, wheel_second = spline_evaluate(MODEL.wheel_left, row[Patch.Y_WHEEL])
    _, rail_slope, rail_second = spline_evaluate(rail_at(MODEL.rails_left, 0.0)[0], row[Patch.Y_RAIL])
    angle = -0.5 * (math.atan(wheel_slope) + math.atan(rail_slope))
    assert row[Patch.CONTACT_ANGLE] == pytest.approx(angle, abs=1e-9)
    # parallel but for the turn of the mean normal: equation 2 of `normal_overlap` without yaw and roll
    turn = 0.5 * (wheel_second / (1 + wheel_slope**2) + rail_second / (1 + rail_slope**2))
    overlap = row[Patch.APPROACH] / math.cos(angle)
    assert wheel_slope - rail_slope == pytest.approx(overlap * math.tan(angle) * turn, abs=1e-8)
    lateral = 0.5 * (wheel_second / (1 + wheel_slope**2) ** 1.5 - rail_second / (1 + rail_slope**2) ** 1.5)
    patch = hertz_patch(
        row[Patch.NORMAL_FORCE], 0.5 * math.cos(angle) / row[Patch.ROLLING_RADIUS], lateral, STEEL
    )
    assert row[Patch.APPROACH] == pytest.approx(50e-6, rel=1e-6)
    assert patch.approach == pytest.approx(50e-6, rel=1e-4)
    assert [patch.a, patch.b] == pytest.approx([row[Patch.A], row[Patch.B]], rel=1e-4)
    assert patch.max_pressure == pytest.approx(row[Patch.P_MAX], rel=1e-4)
    # Frame C is T rolled by the contact angle; no creepage, no creep force but that of spin at rest: none
    assert row[Patch.FORCE_X] == row[Patch.FORCE_Y] == 0.0
    normal = row[Patch.NORMAL_FORCE]
    np.testing.assert_allclose(
        state.rail_force[0, 0], [normal * math.sin(angle), -normal * math.cos(angle)], rtol=1e-12
    )


def test_creepages_are_the_small_angle_formulas() -> None:
    speed, yaw, yaw_rate, y_dot, radius = 20.0, 2e-4, 4e-3, 3e-3, 0.4601
    state = State()
    state.position[0, 1] = -0.003
    state.point(yaw)
    state.roll_on(speed, yaw_rate, radius)
    state.velocity[0, 1] = y_dot
    state.solve()
    for side in (0, 1):
        sign = 1 - 2 * side
        row = state.rows(0, side)[0]
        r, angle = row[Patch.ROLLING_RADIUS], row[Patch.CONTACT_ANGLE]
        half = 0.75 - row[Patch.Y_WHEEL]
        # equations.md 2.12-2.14; their errors are products of two small quantities
        assert row[Patch.NU_X] == pytest.approx(1 - r / radius - sign * yaw_rate * half / speed, abs=2e-7)
        # 2.13 has y_dot over the cosine, for a wheel that climbs as it moves; here it keeps its height.
        lateral = y_dot / speed * math.cos(angle) - yaw / math.cos(angle)
        assert row[Patch.NU_Y] == pytest.approx(
            lateral, abs=5e-7
        )  # yaw times the longitudinal creepage: 3e-7
        spin = yaw_rate * math.cos(angle) / speed - sign * math.sin(angle) / radius
        assert row[Patch.PHI] == pytest.approx(spin, abs=1e-6)


@pytest.mark.parametrize("normal", ["hertz", "analyn"])
def test_a_wheelset_turned_with_its_rails_feels_the_same(normal: str) -> None:
    """Rails that run to the side, uphill and rolled, and a wheelset that does too: the same patches.

    From tread to flange; wrench and rail forces are turned, and R alone says how the rails run.
    """
    contact = model(normal=normal)
    state = random_state(60, 5)
    state.position[:, 1] *= 1.45  # up to the flanges
    state.rail_displacement[:] = state.rail_velocity[:] = 0.0
    state.solve(contact)
    angles = np.random.default_rng(8).uniform(-1, 1, 3) * [8e-3, 4e-3, 6e-3]
    turn = Rotation.from_euler("ZYX", angles)
    matrix = turn.as_matrix()
    rails = straight_rails(contact, state.gauge)
    origin = np.concatenate([np.zeros((60, 2, 1)), rails.position], axis=2) @ matrix.T
    origin -= origin[..., :1] / matrix[0, 0] * matrix[:, 0]  # to x = 0 along the rail
    turned = rails._replace(position=origin[..., 1:].copy(), rotation=np.tile(matrix, (60, 2, 1, 1)))
    vectors = (state.position, state.axle, state.velocity, state.angular_velocity)
    motion = WheelsetMotion(*(turn.apply(vector) for vector in vectors), state.creep_lag)
    forces = no_forces(60)
    assert wheel_rail_forces(contact, motion, turned, constant_friction(state.friction), forces) == 0
    # creepages and forces but for the cosine in the speed that they refer to
    columns = [column for column in Patch if column not in (Patch.X_SHIFT, Patch.POWER)]
    np.testing.assert_allclose(
        forces.patches[..., columns], state.patches[..., columns], rtol=2e-3, atol=1e-6
    )
    exact = [Patch.Y_WHEEL, Patch.Y_RAIL, Patch.CONTACT_ANGLE, Patch.ROLLING_RADIUS, Patch.APPROACH]
    np.testing.assert_allclose(forces.patches[..., exact], state.patches[..., exact], rtol=1e-8, atol=1e-12)
    for k in (slice(0, 3), slice(3, 6)):
        np.testing.assert_allclose(
            forces.wrench[:, k], turn.apply(state.wrench[:, k]), rtol=2e-3, atol=1e-3 * 1e5
        )
    assert (state.patches[..., Patch.CONTACT_ANGLE] > np.radians(40)).any()


def test_power_balance_and_geometry_of_the_wrench() -> None:
    """Power of all forces on wheelset and rails = -(lost power) - power stored in the elastic contact."""
    n, damping = 60, 3.0
    state = random_state(n, 2)
    state.solve(model(damping=damping))
    distance, total_patches = 0.75, 0
    for i in range(n):
        power = state.wrench[i, :3] @ state.velocity[i] + state.wrench[i, 3:] @ state.angular_velocity[i]
        power += (state.rail_force[i] * state.rail_velocity[i]).sum()
        lost = stored = 0.0
        force = np.zeros(3)
        for side in (0, 1):
            sign = 1 - 2 * side
            for row in state.rows(i, side):
                total_patches += 1
                # The contact point from the wheel's own geometry: axial coordinate and radius
                axle = state.axle[i]
                t = sign * (distance - row[Patch.Y_WHEEL])
                gauge_point = rail_at((MODEL.rails_left, MODEL.rails_right)[side], 0.0)[1]
                p_y = sign * (state.gauge[i] / 2 + gauge_point - row[Patch.Y_RAIL])
                p_y += state.rail_displacement[i, side, 0] - state.position[i, 1]
                p_x = row[Patch.X_SHIFT]
                p_z = -math.sqrt(row[Patch.ROLLING_RADIUS] ** 2 + t**2 - p_x**2 - p_y**2)
                point = np.array([p_x, p_y, p_z])
                assert point @ axle == pytest.approx(t, abs=1e-9)
                angle = sign * row[Patch.CONTACT_ANGLE]
                normal = np.array([0.0, -math.sin(angle), math.cos(angle)])
                across = np.array([0.0, math.cos(angle), math.sin(angle)])
                slip = state.velocity[i] + np.cross(state.angular_velocity[i], point)
                slip -= [0.0, *state.rail_velocity[i, side]]
                rate = -slip @ normal
                assert row[Patch.NU_X] * state.velocity[i, 0] == pytest.approx(slip[0], abs=1e-9)
                assert row[Patch.NU_Y] * state.velocity[i, 0] == pytest.approx(slip @ across, abs=1e-9)
                elastic = row[Patch.NORMAL_FORCE] / (1 + damping * rate)
                lost += row[Patch.POWER]
                stored += elastic * rate
                assert row[Patch.POWER] >= 0.0
                force += [row[Patch.FORCE_X], 0, 0]
                force += row[Patch.FORCE_Y] * across + row[Patch.NORMAL_FORCE] * normal
        scale = abs(lost) + abs(stored) + 1.0
        assert power == pytest.approx(-lost - stored, abs=1e-8 * scale + 1e-5)
        np.testing.assert_allclose(state.wrench[i, :3], force, rtol=1e-10, atol=1e-6)
    assert total_patches > n


def test_damping_acts_on_approach_and_never_pulls() -> None:
    rest, moving = State(), State()
    rest.friction[:] = moving.friction[:] = 1e-6  # the normal forces alone
    rest.solve()
    moving.velocity[0, 2] = -0.05
    damped = model(damping=4.0)
    factor = moving.solve(damped).wrench[0, 2] / rest.wrench[0, 2]
    assert factor == pytest.approx(1 + 4.0 * 0.05, rel=2e-3)  # less the cosine of the contact angle
    moving.velocity[0, 2] = 1.0
    moving.solve(damped)
    assert (moving.wrench == 0).all()
    assert (moving.patches == 0).all()


def test_two_points_near_the_flange_and_conformal_contact_is_counted() -> None:
    state = State()
    counts, floored = [], 0
    for y in np.arange(0.0, 0.0068, 2e-5):
        state.position[0, 1] = y
        rows = state.solve().rows()
        counts.append(len(rows))
        floored += int(rows[:, Patch.FLOORED].sum())
        assert np.isfinite(rows).all()
    assert 2 in counts
    # S1002 meets 60E1 upright in places conformally: there the floor must be seen, and the patch be finite
    upright = model(rail_profile("60E1", 0.0))
    flags = []
    for y in np.arange(-0.008, 0.0078, 5e-5):  # beyond, root and flange sink in by 2 mm at this height
        state.position[0, 1] = y
        rows = state.solve(upright).rows()
        flags += list(rows[:, Patch.FLOORED])
        b = rows[rows[:, Patch.FLOORED] == 1, Patch.B]
        assert (b < 0.03).all()
    assert 1.0 in flags
    assert 0.0 in flags
    assert CURVATURE_FLOOR > 0


@pytest.mark.parametrize("wheel", [0, 3, 6])
def test_status_names_the_wheel(wheel: int) -> None:
    state = State(4)
    array = state.rail_displacement if wheel % 2 else state.position
    array[(wheel // 2, 1, 1) if wheel % 2 else (wheel // 2, 1)] = np.nan
    assert state.solve().status == 1 + wheel


def test_model_checks_its_input() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    for options, message in (
        ({"nominal_radius": 460.0}, "nominal_radius = 460.0 m"),
        ({"back_to_back": 1360.0}, "back_to_back"),
        ({"damping": -1.0}, "damping"),
        ({"theory": "magic"}, "fastrip"),
        ({"normal": "magic"}, "kik_piotrowski"),
        ({"normal": "analyn", "theory": "polach"}, "'fastrip'"),
        ({"cells": (0, 15)}, "cells"),
    ):
        with pytest.raises(ValueError, match=message):
            wheel_rail_model(wheel, wheel, rail, rail, **({"nominal_radius": R0} | options))
    with pytest.raises(ValueError, match="rail_left"):
        wheel_rail_model(wheel, wheel, wheel, rail, nominal_radius=R0)
