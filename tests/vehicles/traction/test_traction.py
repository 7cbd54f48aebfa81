"""Traction laws: the characteristic, resistance of the train, speed control, slip control, over-slip."""

from dataclasses import replace

import numpy as np
import pytest

from hh_exudyn.conventions import GRAVITY
from vehicles.catalogue import vehicle
from vehicles.traction.control import Actuators, Measurement
from vehicles.traction.driver import DrivenUnits, Driver, DriverOrders
from vehicles.traction.effort import (
    OverSlip,
    SlipControl,
    SlipLimits,
    SpeedControl,
    SpeedControlGains,
    TractionEquipment,
)
from vehicles.traction.train import TrailingTrain, locomotive_resistance, wagon_resistance

LOCOMOTIVE = vehicle("iore_locomotive")
EQUIPMENT = LOCOMOTIVE.traction
INTERVAL = 0.01
SAMPLE = 0.05  # s, of the long rides: ten minutes of a train


def train(grade=lambda s: 0.0 * s, wagons=68, locomotives=1, curvature=lambda s: 0.0 * s):
    return TrailingTrain(locomotives, 180e3, 22.89, wagons, 120e3, 10.29, grade, curvature)


def unit():
    wheelset = LOCOMOTIVE.body(LOCOMOTIVE.wheelsets[0].body)
    return DrivenUnits(1, 180e3, 6, 0.625, wheelset.inertia[1], EQUIPMENT, LOCOMOTIVE.coupler.stiffness)


def test_characteristic_is_the_published_one():
    """600 kN to 32 km/h, 5400 kW above; 648 kN for two units at 60 km/h."""
    assert EQUIPMENT.largest_effort(0.0) == 600e3
    assert EQUIPMENT.largest_effort(32.0 / 3.6) == 600e3
    for speed in (10.0, 16.0, 60 / 3.6, 80 / 3.6):
        assert EQUIPMENT.largest_effort(speed) * speed == pytest.approx(5.4e6)
    assert 2 * EQUIPMENT.largest_effort(60 / 3.6) == pytest.approx(648e3)
    assert EQUIPMENT.reflected_inertia == pytest.approx(6.267**2 * 5.0)


def test_impossible_equipment_is_refused():
    with pytest.raises(ValueError, match=r"power -1\.0 must be > 0"):
        TractionEquipment(600e3, -1.0, 300e3, 5e6, 6.0, 5.0)


def test_resistance_of_the_ore_train():
    """sources/vehicles.md 7: 1.30 kgf/t at 30 t per axle and 60 km/h, 104 kN for 8160 t."""
    assert wagon_resistance(60 / 3.6, 30.0) / GRAVITY == pytest.approx(1.30, abs=1e-9)
    assert train(locomotives=0).resisting_force(0.0, 60 / 3.6) == pytest.approx(104e3, rel=2e-3)
    assert wagon_resistance(60 / 3.6, 5.4) / GRAVITY == pytest.approx(1.0 + 2.64 + 0.864)
    assert locomotive_resistance(60 / 3.6) / GRAVITY == pytest.approx(1.9 + 0.48 + 0.9)


def test_every_wagon_is_on_its_own_grade():
    """Uphill from s = 0 on: half the train on 10 per mille weighs half as much down the slope."""

    def grade(places):
        return np.where(places > 0.0, 0.01, 0.0)

    one = train(grade, locomotives=0)
    level = train(locomotives=0).resisting_force(0.0, 15.0)
    assert one.length == pytest.approx(68 * 10.29)
    for share in (0.0, 0.25, 0.5, 1.0):
        slope = one.resisting_force(share * one.length, 15.0) - level
        assert slope == pytest.approx(share * one.mass * GRAVITY * 0.01, abs=1e-6)


def test_the_curve_resistance_of_the_wagons_can_be_chosen():
    """68 wagons on R 450 m: 1.65 and 0.61 per mille of 8160 t; the second unit stays with Roeckl."""
    weight = 8160e3 * GRAVITY

    def resisting(kind, locomotives=0):
        behind = replace(
            train(locomotives=locomotives, curvature=lambda s: 0.0 * s + 1 / 450), curve_resistance=kind
        )
        return behind.resisting_force(0.0, 15.0)

    level = train(locomotives=0).resisting_force(0.0, 15.0)
    assert resisting("none") == pytest.approx(level, rel=1e-12)
    assert resisting("roeckl") - level == pytest.approx(weight * 0.650 / 395.0, rel=1e-9)
    assert resisting("simulated") - level == pytest.approx(weight * 0.610e-3, rel=1e-9)
    behind = train(locomotives=1).resisting_force(0.0, 15.0)
    assert resisting("simulated", 1) - behind == pytest.approx(
        weight * 0.610e-3 + 180e3 * GRAVITY * 0.650 / 395.0, rel=1e-9
    )
    assert resisting("none", 1) == pytest.approx(behind, rel=1e-12)


def point_mass(driver, wheel, duration, mass=180e3, speed=60 / 3.6, grade=0.0):
    """The driver on a locomotive that is a mass with ideal adhesion, on its coupler: speeds and efforts."""
    place = 0.0
    actuators = Actuators(np.zeros(6), 0.0, speed, np.zeros(6), np.ones(6))
    coupler = driver.coupler_force
    found = []
    for step in range(round(duration / SAMPLE)):
        speeds = np.full(6, speed)
        measured = Measurement(step * SAMPLE, speed, speeds, speeds, np.zeros(6), np.zeros(6), coupler)
        driver.act(measured, actuators, SAMPLE)
        for _ in range(5):  # the coupler is too stiff for the controller's interval
            coupler = LOCOMOTIVE.coupler.stiffness * (actuators.train_place - place)
            coupler += LOCOMOTIVE.coupler.damping * (actuators.train_speed - speed)
            force = actuators.torques.sum() / wheel + coupler - mass * GRAVITY * grade
            speed += 0.2 * SAMPLE * force / mass
            place += 0.2 * SAMPLE * speed
            actuators.train_place += 0.2 * SAMPLE * actuators.train_speed
        found.append((speed, driver.demand, coupler))
    return np.array(found)


def test_driver_starts_in_balance():
    """The train's force at the start leaves neither the unit nor the train an acceleration."""
    behind = train(lambda s: 0.0 * s + 0.005)
    driver = Driver(unit(), behind, DriverOrders(60 / 3.6, 500e3), 60 / 3.6, 0.0, 0.005)
    whole = behind.resisting_force(0.0, 60 / 3.6) + 180e3 * GRAVITY * 0.005
    whole += 180.0 * locomotive_resistance(60 / 3.6)
    assert driver.demand == pytest.approx(whole / 2)
    found = point_mass(driver, 0.625, 20.0, grade=0.005)
    assert found[:, 0] == pytest.approx(60 / 3.6, rel=1e-6)
    assert found[:, 1] == pytest.approx(driver.demand, rel=1e-4)


@pytest.mark.parametrize("per_mille", [-5.0, 5.0])
def test_speed_control_takes_a_change_of_set_speed(per_mille):
    """From 60 to 55 km/h and to 62: within 1 % after three minutes, without an offset, within the bounds."""
    behind = train(lambda s: 0.0 * s + 1e-3 * per_mille)
    for target in (55 / 3.6, 61 / 3.6):
        driver = Driver(unit(), behind, DriverOrders(target, 500e3), 60 / 3.6, 0.0, 1e-3 * per_mille)
        found = point_mass(driver, 0.625, 240.0, grade=1e-3 * per_mille)
        assert found[-1, 0] == pytest.approx(target, rel=1e-3)
        assert found[:, 1].max() <= EQUIPMENT.largest_effort(found[:, 0].min()) + 1.0
        assert found[:, 1].min() >= -250e3 - 1.0
        assert found[:, 0].max() < 61.5 / 3.6  # the integral does not wind up


def test_ten_per_mille_is_beyond_two_units():
    """68 x 120 t on 10 per mille need about 950 kN, two units give 648 kN at 60 km/h.

    The train slows down to the speed at which resistance and characteristic meet, here solved for apart.
    """
    behind = train(lambda s: 0.0 * s + 0.01)
    driver = Driver(unit(), behind, DriverOrders(60 / 3.6, 500e3), 60 / 3.6, 0.0, 0.01)
    assert driver.demand == EQUIPMENT.largest_effort(60 / 3.6)

    def surplus(speed):
        own = 180.0 * locomotive_resistance(speed) + 180e3 * GRAVITY * 0.01
        return 2 * EQUIPMENT.largest_effort(speed) - own - behind.resisting_force(0.0, speed)

    speeds = np.linspace(8.0, 17.0, 2000)
    balance = speeds[np.argmin([abs(surplus(speed)) for speed in speeds])]
    found = point_mass(driver, 0.625, 900.0, grade=0.01)
    assert found[0, 0] == pytest.approx(60 / 3.6, rel=1e-3)
    assert found[-1, 0] == pytest.approx(balance, rel=5e-3)
    assert 40 < 3.6 * balance < 43


def test_brake_keeps_to_the_limit_of_both_units():
    behind = train(lambda s: 0.0 * s - 0.01)
    driver = Driver(unit(), behind, DriverOrders(60 / 3.6, 500e3), 60 / 3.6, 0.0, -0.01)
    assert driver.demand == -250e3
    found = point_mass(driver, 0.625, 30.0, grade=-0.01)
    assert found[:, 1].min() == pytest.approx(-250e3)
    assert found[-1, 0] > 60.5 / 3.6  # the electro-dynamic brake alone does not hold this train


def wheel_on_rail(control, torque, friction, duration, load=294e3, speed=10.0, inertia=626.0):
    """One wheelset at constant speed, creep force C nu up to the friction bound: slips and torques."""
    radius, wheel, found = 0.625, 10.0, []
    for step in range(round(duration / INTERVAL)):
        given = control(np.array([wheel]), np.array([speed]))[0]
        bound = friction(step) * load
        for _ in range(50):
            force = min(max(40.0 * load * (wheel - speed) / speed, -bound), bound)
            wheel += radius * (given - force * radius) / inertia * INTERVAL / 50
        found.append((wheel - speed, given))
    return np.array(found)


def test_slip_control_catches_a_wheelset_that_loses_its_rail():
    """Friction falls from 0.4 to 0.1 at 2 s: without control the wheel races, with it it keeps its grip."""
    torque = 0.2 * 294e3 * 0.625
    slip_control = SlipControl(1, SlipLimits())

    def controlled(wheels, speeds):
        return torque * slip_control.step(wheels, speeds, 1.0, INTERVAL)

    def friction(step):
        return 0.4 if step < 200 else 0.1

    held = wheel_on_rail(controlled, torque, friction, 20.0)
    free = wheel_on_rail(lambda wheels, speeds: np.full(1, torque), torque, friction, 20.0)
    bound = 0.1 * 294e3 * 0.625
    assert free[-1, 0] > 100.0
    assert held[:200, 1] == pytest.approx(torque)  # nothing is taken while there is grip
    assert held[:, 0].max() < 1.5
    assert 0.75 * bound < held[400:, 1].mean() < bound


def test_slip_control_is_the_same_in_braking():
    torque = 0.2 * 294e3 * 0.625
    control = SlipControl(1, SlipLimits())
    other = SlipControl(1, SlipLimits())

    def friction(step):
        return 0.1

    pulling = wheel_on_rail(lambda w, v: torque * control.step(w, v, 1.0, INTERVAL), torque, friction, 5.0)
    braking = wheel_on_rail(lambda w, v: -torque * other.step(w, v, -1.0, INTERVAL), torque, friction, 5.0)
    assert braking == pytest.approx(-pulling, abs=1e-6 * torque)


def test_over_slip_holds_the_slip_it_is_told():
    """dv of 4 % at any friction: the torque is then that of saturated friction."""
    for friction in (0.2, 0.3):
        control = OverSlip(0.04, 0.625, 626.0, np.array([10e3]))
        found = wheel_on_rail(
            lambda w, v, control=control: control.step(w, v, 80e3, INTERVAL),
            0.0,
            lambda step, friction=friction: friction,
            10.0,
        )
        assert found[-1, 0] == pytest.approx(0.4, rel=1e-3)
        assert found[-1, 1] == pytest.approx(friction * 294e3 * 0.625, rel=1e-3)


def test_speed_control_does_not_wind_up():
    """Ten minutes at the bound, the speed too low; the effort leaves the bound when the speed is there."""
    control = SpeedControl(15.0, 1e6, 0.0, SpeedControlGains())
    for _ in range(6000):
        control.step(10.0, -1e5, 1e5, 1e7, 0.1)
    assert control.step(15.3, -1e5, 1e5, 1e7, 0.1) < 0.0
