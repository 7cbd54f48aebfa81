"""Friction of every patch by itself: zones, sections, sides, wheelsets, slip, through the contact kernel."""

import math

import numpy as np
import pytest
from straight_rails import no_forces, straight_rails

from hh_exudyn.contact.friction import FrictionTable, constant_friction, friction_at
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import WheelRailModel, WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model
from track.friction import Falling, Friction, FrictionSection, Zones

R0, GAUGE, SPEED = 0.46, 1.435, 15.0
TREAD_TO_FLANGE = Zones(0.4, 0.25, 0.1)
LIFTS = [-300e-6, 80e-6, 280e-6, 600e-6, 750e-6, 1000e-6]  # m, of a wheelset that climbs the flange


def model(normal: str = "hertz") -> WheelRailModel:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    return wheel_rail_model(wheel, wheel, rail, rail, nominal_radius=R0, normal=normal, cells=(15, 15))


MODELS = {normal: model(normal) for normal in ("hertz", "analyn", "kik_piotrowski")}


def solve(
    table: FrictionTable,
    places: np.ndarray,
    arc_length: np.ndarray,
    normal: str = "hertz",
    mirror: float = 1.0,
) -> np.ndarray:
    """Patches (n, 2, MAX_PATCHES, PATCH_COLUMNS) of wheelsets at lateral place, height and yaw, rolling."""
    n = len(places)
    y, z, yaw = places.T * np.array([[mirror], [1.0], [mirror]])
    axle = np.column_stack([-np.sin(yaw), np.cos(yaw), np.zeros(n)])
    velocity = np.tile([SPEED, 0.0, 0.0], (n, 1))
    position = np.column_stack([np.zeros(n), y, R0 + z])
    motion = WheelsetMotion(position, axle, velocity, axle * SPEED / R0, np.zeros((n, 2, 2)))
    rails, forces = straight_rails(MODELS[normal], np.full(n, GAUGE), arc_length), no_forces(n)
    assert wheel_rail_forces(MODELS[normal], motion, rails, table, forces) == 0
    return forces.patches


def places(yaw: float = 3e-3) -> np.ndarray:
    """From flange to flange over two-point contact and the tread, at some 100 kN a wheel."""
    half = np.concatenate([np.linspace(0.0002, 0.0064, 32), np.linspace(0.0067, 0.0069, 5)])
    y = np.concatenate([-half[::-1], half])
    lift = np.interp(np.abs(y), [0.0, 0.0053, 0.0058, 0.0064, 0.0067, 0.0069], LIFTS)
    return np.column_stack([y, lift, np.where(y > 0.0, -yaw, yaw)])


def loaded(patches: np.ndarray) -> np.ndarray:
    return patches[patches[..., Patch.NORMAL_FORCE] > 0.0]


def utilisation(rows: np.ndarray) -> np.ndarray:
    return np.hypot(rows[:, Patch.FORCE_X], rows[:, Patch.FORCE_Y]) / rows[:, Patch.NORMAL_FORCE]


@pytest.mark.parametrize("normal", MODELS)
def test_equal_zones_are_constant_friction(normal: str) -> None:
    """To the last bit: every zone, section and surface 0.3, or no table of zones at all."""
    where = places()
    n = len(where)
    even = Zones.even(0.3)
    sections = tuple(FrictionSection(start, even, even) for start in (0.0, 10.0, 20.0))
    table = Friction(sections, ramp=4.0).table([("top_of_rail",) if i % 2 else () for i in range(n)])
    found = solve(table, where, np.linspace(0.0, 30.0, n), normal)
    assert (loaded(found)[:, Patch.FRICTION] == 0.3).all()
    expected = solve(constant_friction(np.full((n, 2), 0.3)), where, np.zeros(n), normal)
    assert (found == expected).all()


@pytest.mark.parametrize("normal", MODELS)
def test_a_greased_flange_slides_while_the_tread_holds(normal: str) -> None:
    where = places(yaw=20e-3)
    n = len(where)
    greased = Friction.everywhere(TREAD_TO_FLANGE).table([()] * n)
    rows = loaded(solve(greased, where, np.zeros(n), normal))
    angle = np.degrees(rows[:, Patch.CONTACT_ANGLE])
    flange, tread = angle > 55.0, angle < 10.0
    assert flange.sum() >= 6
    assert tread.sum() >= 20
    assert rows[flange, Patch.FRICTION] == pytest.approx(0.1, abs=1e-12)
    assert rows[tread, Patch.FRICTION] == pytest.approx(0.4, abs=1e-12)
    assert (utilisation(rows) <= rows[:, Patch.FRICTION] * (1.0 + 1e-9)).all()
    assert utilisation(rows[flange]).max() > 0.095  # a yaw of 20 mrad saturates it
    assert utilisation(rows[tread]).max() > 0.3  # and the tread carries more than the flange may
    # what is between is neither: the flange root
    between = ~flange & ~tread
    assert ((rows[between, Patch.FRICTION] >= 0.1) & (rows[between, Patch.FRICTION] <= 0.4)).all()


def test_two_patches_of_a_wheel_have_their_own_friction() -> None:
    where = places()
    n = len(where)
    patches = solve(Friction.everywhere(TREAD_TO_FLANGE).table([()] * n), where, np.zeros(n))
    two = patches[(patches[:, :, :2, Patch.NORMAL_FORCE] > 0.0).all(axis=2)]
    angles = np.degrees(two[:, :2, Patch.CONTACT_ANGLE])
    # tread and gauge corner; further out, root (49 degrees) and flange carry together
    apart = two[(angles.max(axis=1) > 16.0) & (angles.min(axis=1) < 10.0)]
    assert len(apart) >= 4
    for wheel in apart:
        flat, steep = sorted(wheel[:2], key=lambda row: row[Patch.CONTACT_ANGLE])
        assert flat[Patch.FRICTION] == pytest.approx(0.4, abs=1e-12)  # at 7 degrees, on the tread
        assert 0.25 <= steep[Patch.FRICTION] < 0.303  # 65 % of the change are done at 16 degrees


def test_left_and_right_are_mirror_images() -> None:
    """Other friction on the other rail, section by section, and everything changes sides."""
    one, other = Zones(0.5, 0.3, 0.15), Zones(0.2, 0.2, 0.1)
    rails = ((one, other), (other, one), (one, one))
    where = places()
    s = np.linspace(-5.0, 25.0, len(where))

    def table(swap: bool) -> FrictionTable:
        sections = tuple(
            FrictionSection(10.0 * i, *(pair[::-1] if swap else pair)) for i, pair in enumerate(rails)
        )
        return Friction(sections, Falling(0.4, 0.6), ramp=5.0).table([()] * len(where))

    left, right = solve(table(False), where, s), solve(table(True), where, s, mirror=-1.0)
    odd = [Patch.NU_Y, Patch.PHI, Patch.FORCE_Y, Patch.MOMENT_Z, Patch.CENTRE_Y]
    swapped = left[:, ::-1].copy()
    swapped[..., odd] *= -1
    np.testing.assert_allclose(right, swapped, rtol=1e-8, atol=1e-9)
    assert len(np.unique(loaded(left)[:, Patch.FRICTION])) > 50


def test_a_section_begins_on_one_rail_over_its_ramp() -> None:
    """The same wheelset further and further along: the left wheel's force rises with its friction."""
    dry, damp = Zones.even(0.5), Zones.even(0.2)
    sections = (FrictionSection(0.0, damp, damp), FrictionSection(100.0, dry, damp))
    s = np.linspace(97.0, 103.0, 601)
    where = np.tile([0.0, -300e-6, 15e-3], (s.size, 1))  # saturated
    patches = solve(Friction(sections, ramp=4.0).table([()] * s.size), where, s)
    left, right = patches[:, 0, 0], patches[:, 1, 0]
    assert np.ptp(right[:, [Patch.FORCE_X, Patch.FORCE_Y, Patch.FRICTION]], axis=0) == pytest.approx(0.0)
    assert left[[0, 100, 300, 500, -1], Patch.FRICTION] == pytest.approx([0.2, 0.2, 0.35, 0.5, 0.5])
    force = utilisation(left)
    assert force == pytest.approx(left[:, Patch.FRICTION], rel=0.05)
    assert (np.diff(force) > -1e-12).all()
    steepest = 1.5 * 0.3 / 4.0 * 0.01  # of the ramp, between two of these places
    assert np.diff(force).max() < 1.02 * steepest


def test_a_wheelset_that_carries_grease_does_not_grease_the_others() -> None:
    where = np.repeat(places(), 2, axis=0)
    n = len(where)
    own = [(), ("flange_lubrication",)] * (n // 2)
    rows = solve(Friction.everywhere(Zones.even(0.4)).table(own), where, np.zeros(n))
    dry, greased = rows[::2], rows[1::2]
    assert (loaded(dry)[:, Patch.FRICTION] == 0.4).all()
    pairs = dry[..., Patch.NORMAL_FORCE] > 0.0
    angle, friction = (np.degrees(greased[pairs][:, k]) if k == Patch.CONTACT_ANGLE else greased[pairs][:, k]
                       for k in (Patch.CONTACT_ANGLE, Patch.FRICTION))  # fmt: skip
    assert friction[angle > 55.0] == pytest.approx(0.15, abs=1e-12)
    assert friction[angle < 10.0] == pytest.approx(0.4, abs=1e-12)
    same = (angle < 10.0).nonzero()[0]
    assert (dry[pairs][same] == greased[pairs][same]).all()


@pytest.mark.parametrize("normal", MODELS)
def test_falling_friction_is_polachs_at_the_logged_creepage(normal: str) -> None:
    """mu0 ((1 - A) exp(-B v) + A), v from the patch's own creepages; 30 mrad of yaw are 0.45 m/s here."""
    zones, ratio, decrease = TREAD_TO_FLANGE, 0.4, 0.6
    slipping = 0.0
    for yaw in (0.0, 3e-3, 30e-3):
        where = places(yaw)
        own = [()] * len(where)
        falls = Friction.everywhere(zones, Falling(ratio, decrease)).table(own)
        at_rest = Friction.everywhere(zones).table(own)
        for row in loaded(solve(falls, where, np.zeros(len(where)), normal)):
            v = SPEED * math.hypot(row[Patch.NU_X], row[Patch.NU_Y])
            still = friction_at(at_rest, 0, 0, 0.0, row[Patch.CONTACT_ANGLE], 0.0)
            expected = still * ((1.0 - ratio) * math.exp(-decrease * v) + ratio)
            assert row[Patch.FRICTION] == pytest.approx(expected, rel=1e-12)
            used = math.hypot(row[Patch.FORCE_X], row[Patch.FORCE_Y]) / row[Patch.NORMAL_FORCE]
            assert used <= row[Patch.FRICTION] * (1.0 + 1e-9)
            slipping = max(slipping, v)
    assert slipping > 0.4
