"""A wheel at rest on its rail: the Manchester benchmark A-2.2 against the exact half-space solution.

Where and why Hertz fails: at y = 0 the S1002 follows the 60E1 almost parallel from y_rail = 5 to 17 mm. The
curvature at the deepest point then says nothing about the patch: CONTACT's is 16 mm (10 kN) and 20 mm (60 kN)
wide with its pressure peak at the far end, where the wheel's curvature jumps. Hertz puts the contact 2 mm
off, finds 21 % too little pressure at 60 kN and up to 8.5 % of mu N in the longitudinal force. At 60 kN its
place is still 0.9 mm off at y = 1 mm. From y = 1 mm on all pressures agree within 1 %, on the flange root
(10 kN, right, 1 mm) within 5 %. The flange rows of the reference (1 mm wide, on a grid of 0.2 mm) are not
better than the 3 % by which all three theories lie under them.

Kik and Piotrowski's pressure is proportional to the length of the strip, so it cannot have the local peak of
the row y = 0 at 60 kN: 31 % too low there.
"""

import csv
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from manchester_rail import manchester_rail

from hh_exudyn.contact.patch_shape import patch_shape, traction_on_shape
from hh_exudyn.contact.profile import Profile, rail_profile, wheel_profile
from hh_exudyn.contact.state import ContactState
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.contact.wheelset import WheelOnRail, wheel_on_rail, wheelset_equilibrium
from hh_exudyn.conventions import LEFT, RIGHT

REFERENCE = Path(__file__).parents[1] / "reference" / "wheel_rail_mbench_a22.csv"
ROWS = [
    row
    for row in csv.DictReader(line for line in REFERENCE.read_text().splitlines() if not line.startswith("#"))
    if row["load"] in ("10kN", "60kN")
]
R0 = 0.46
NORMALS = ("hertz", "analyn", "kik_piotrowski")


def name(row: dict[str, str]) -> tuple[str, str, float]:
    return row["load"], row["side"], float(row["y_ws"])


JUMP = ("10kN", "right", 5.0)  # tread and gauge corner at once, merged by the reference into one patch
CONFORMAL = (("60kN", "left", 0.0), ("60kN", "left", 0.5), ("10kN", "left", 0.0), ("10kN", "right", 0.0))


def pose(row: dict[str, str]) -> dict[str, float]:
    """The benchmark has y right, z down: y, yaw and pitch rate change sign, roll does not."""
    return {
        "lateral": -float(row["y_ws"]) * 1e-3,
        "yaw": -float(row["yaw_ws"]),
        "radius": R0,
        "speed": 2.0,
        "pitch_rate": -float(row["vpitch_ws"]),
        "friction": 0.3,
    }


@pytest.fixture(scope="module")
def rail() -> Profile:
    """The benchmark's own rail."""
    return manchester_rail()


Solve = Callable[[int, str], WheelOnRail]


@pytest.fixture(scope="module")
def solve(rail: Profile) -> Solve:
    """Each row of the benchmark with each theory, once."""

    @cache
    def solve_row(number: int, normal: str) -> WheelOnRail:
        row = ROWS[number]
        return wheel_on_rail(
            wheel_profile("S1002"), rail, LEFT if row["side"] == "left" else RIGHT,
            roll=float(row["roll_ws"]), load=float(row["fz_tr"]), normal=normal, **pose(row),
        )  # fmt: skip

    return solve_row


def mean(contacts: tuple[ContactState, ...], what: str) -> float:
    """Mean over the patches, weighted by their force: the reference merges what lies within 3 mm or so."""
    total = sum(c.normal_force for c in contacts)
    return float(sum(c.normal_force * getattr(c, what) for c in contacts) / total)


@pytest.mark.parametrize("normal", NORMALS)
@pytest.mark.parametrize("number", range(len(ROWS)), ids=lambda i: "-".join(str(x) for x in name(ROWS[i])))
def test_manchester_benchmark(number: int, normal: str, solve: Solve) -> None:
    row = ROWS[number]
    wheel = solve(number, normal)
    contacts, sign = wheel.contacts, 1.0 if row["side"] == "left" else -1.0
    force, limit = float(row["fn"]), 0.3 * float(row["fn"])
    vertical = contacts[0].Q
    assert vertical == pytest.approx(float(row["fz_tr"]), rel=1e-6)
    assert sum(c.normal_force for c in contacts) == pytest.approx(force, rel=3e-3)  # asked: 2 %
    if name(row) == JUMP or (normal == "hertz" and name(row) in CONFORMAL):
        return
    # like with like: centre of pressure; the reference's contact point is the centre of interpenetration
    assert mean(contacts, "y_rail") * 1e3 == pytest.approx(sign * float(row["y_pn"]), abs=1.0)
    angle = mean(contacts, "contact_angle")
    assert angle == pytest.approx(sign * float(row["delta_r"]), abs=0.01)
    assert sum(c.force_x for c in contacts) == pytest.approx(-float(row["fx"]), abs=0.04 * limit)
    assert sum(c.force_y for c in contacts) == pytest.approx(float(row["fs"]), abs=0.04 * limit)
    if normal == "kik_piotrowski" and name(row) == ("60kN", "left", 0.0):
        return
    tolerance = 0.06 if normal == "hertz" else 0.08 if normal == "kik_piotrowski" else 0.04  # asked: 10, 15 %
    assert max(c.p_max for c in contacts) == pytest.approx(float(row["pmax"]) * 1e6, rel=tolerance)
    assert abs(wheel.height - (R0 - float(row["z_ws"]) * 1e-3)) < 6e-6


@pytest.mark.parametrize("number", range(len(ROWS)), ids=lambda i: "-".join(str(x) for x in name(ROWS[i])))
def test_manchester_benchmark_by_coupled_strips(number: int, solve: Solve) -> None:
    """Place within 0.13 mm, creep forces within 1.8 % of mu N (4.6 at 60 kN, y = 0), pressure within 7 %.

    On the right flange, 1.4 mm wide, one or two strips carry the load: the pressure is up to 24 % too low.
    """
    row = ROWS[number]
    if name(row) == JUMP:
        return
    wheel, sign = solve(number, "coupled_strips"), 1.0 if row["side"] == "left" else -1.0
    contacts, force = wheel.contacts, float(row["fn"])
    assert sum(c.normal_force for c in contacts) == pytest.approx(force, rel=5e-3)
    assert mean(contacts, "y_rail") * 1e3 == pytest.approx(sign * float(row["y_pn"]), abs=0.15)
    assert mean(contacts, "contact_angle") == pytest.approx(sign * float(row["delta_r"]), abs=0.005)
    assert sum(c.force_x for c in contacts) == pytest.approx(-float(row["fx"]), abs=0.05 * 0.3 * force)
    assert sum(c.force_y for c in contacts) == pytest.approx(float(row["fs"]), abs=0.02 * 0.3 * force)
    narrow = row["side"] == "right" and float(row["y_ws"]) >= 7.0
    tolerance = 0.25 if narrow else 0.14 if name(row) in CONFORMAL else 0.08
    assert max(c.p_max for c in contacts) == pytest.approx(float(row["pmax"]) * 1e6, rel=tolerance)


def test_strips_are_better_than_hertz_in_the_mean(solve: Solve) -> None:
    """Pressure of ANALYN and place of both against Hertz, in the mean and on the conformal rows.

    Mean error of the largest pressure, all rows but the jump and the flange: ANALYN 0.6 %, Hertz 1.0 %; on
    the rows of y < 1 mm 1.9 and 7.3 %. Where Hertz is exact, ANALYN is within 2 % of it.
    """
    used = [i for i, row in enumerate(ROWS) if name(row) != JUMP and abs(float(row["delta_r"])) < 0.3]
    conformal = [i for i in used if name(ROWS[i]) in CONFORMAL]

    def pressure(number: int, normal: str) -> float:
        largest = max(contact.p_max for contact in solve(number, normal).contacts)
        return abs(largest / float(ROWS[number]["pmax"]) * 1e-6 - 1)

    def place(number: int, normal: str) -> float:
        sign = 1.0 if ROWS[number]["side"] == "left" else -1.0
        return abs(mean(solve(number, normal).contacts, "y_rail") - sign * float(ROWS[number]["y_pn"]) * 1e-3)

    def average(error: Callable[[int, str], float], numbers: list[int], normal: str) -> float:
        return float(np.mean([error(number, normal) for number in numbers]))

    assert average(pressure, used, "analyn") < 0.7 * average(pressure, used, "hertz")
    assert average(pressure, conformal, "analyn") < 0.35 * average(pressure, conformal, "hertz")
    assert max(pressure(number, "analyn") for number in used) < 0.04
    for normal in ("analyn", "kik_piotrowski"):
        assert average(place, used, normal) < 0.4 * average(place, used, "hertz")


def test_equilibrium_finds_the_roll_that_the_benchmark_prescribes(rail: Profile) -> None:
    """Its roll is that of rigid contact, of two points on the profiles."""
    wheel = wheel_profile("S1002")
    for row in ROWS[:11:2]:
        rest = wheelset_equilibrium(wheel, rail, wheel, rail, load=20e3, **pose(row))
        assert rest.roll == pytest.approx(float(row["roll_ws"]), abs=2e-6 + 1e-3 * abs(float(row["roll_ws"])))
        assert rest.left.height == pytest.approx(rest.right.height, abs=1e-10)
        loads = [wheel_at_rest.contacts[0].Q for wheel_at_rest in (rest.left, rest.right)]
        assert loads == pytest.approx([10e3, 10e3], rel=1e-6)


def test_equilibrium_is_mirrored_with_the_pose() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    common: dict[str, Any] = {
        "radius": R0,
        "speed": 20.0,
        "pitch_rate": 43.4,
        "friction": 0.3,
        "normal": "analyn",
    }
    one = wheelset_equilibrium(wheel, rail, wheel, rail, lateral=4e-3, yaw=2e-3, load=(9e4, 1.1e5), **common)
    two = wheelset_equilibrium(
        wheel, rail, wheel, rail, lateral=-4e-3, yaw=-2e-3, load=(1.1e5, 9e4), **common
    )
    assert two.height == pytest.approx(one.height, abs=1e-9)
    assert two.roll == pytest.approx(-one.roll, abs=1e-9)
    assert one.roll > 1e-5  # moved to the left, the left wheel climbs: right-hand roll about x is positive
    for ours, theirs in zip(one.left.contacts, two.right.contacts, strict=True):
        for odd in ("nu_y", "phi", "force_y", "moment_z"):
            assert getattr(ours, odd) == pytest.approx(-getattr(theirs, odd), rel=1e-4)
        for even in ("y_rail", "normal_force", "p_max", "a", "b", "force_x", "Q", "Y"):
            assert getattr(ours, even) == pytest.approx(getattr(theirs, even), rel=1e-4)


def test_more_load_sinks_deeper_and_presses_harder() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
    states = [
        wheel_on_rail(
            wheel, rail, LEFT, lateral=-3e-3, yaw=0.0, roll=0.0, load=load, radius=R0, speed=20.0,
            pitch_rate=43.5, friction=0.3, normal="analyn",
        )
        for load in (2e4, 1e5, 1.5e5)
    ]  # fmt: skip
    assert states[0].height > states[1].height > states[2].height
    assert states[0].contacts[0].p_max < states[1].contacts[0].p_max < states[2].contacts[0].p_max


@pytest.mark.parametrize("normal", NORMALS)
def test_patch_of_a_state_is_found_again(normal: str, rail: Profile, solve: Solve) -> None:
    """Strips rebuilt from what the log holds carry the same force; their tractions the creep forces."""
    wheel = wheel_profile("S1002")
    model = wheel_rail_model(wheel, wheel, rail, rail, nominal_radius=R0, normal=normal)
    for number in (0, 1, 13, 16, 22, 24):
        for state in solve(number, normal).contacts:
            shape = patch_shape(model, state, strips=50)
            assert shape.normal_force() == pytest.approx(state.normal_force, rel=1e-9)
            assert [shape.a, shape.b] == pytest.approx([state.a, state.b], rel=4e-3)
            assert shape.pressure.max() == pytest.approx(state.p_max, rel=0.015)
            load = shape.pressure * shape.half_length * shape.width
            assert abs(load @ shape.y / load.sum()) < 10e-6  # the logged place is the centre of pressure
            field = traction_on_shape(model, state, shape)
            area = (2.0 * shape.half_length * shape.width / 50)[:, None]
            limit = 0.3 * state.normal_force
            assert (field.q_x * area).sum() == pytest.approx(state.force_x, abs=0.01 * limit)
            assert (field.q_y * area).sum() == pytest.approx(state.force_y, abs=0.01 * limit)


@pytest.mark.parametrize("normal", ["analyn", "kik_piotrowski"])
def test_a_patch_of_other_profiles_is_not_taken_for_that_of_the_state(
    normal: str, rail: Profile, solve: Solve
) -> None:
    wheel = wheel_profile("S1002")
    state = solve(4, normal).contacts[0]
    model = wheel_rail_model(wheel, wheel, rail, rail, nominal_radius=R0, normal=normal)
    assert patch_shape(model, state).b == pytest.approx(state.b, rel=0.01)
    for name in ("a", "b"):
        other = replace(state, **{name: 2.0 * getattr(state, name)})
        with pytest.raises(ValueError, match=f"but in the state {name} = "):
            patch_shape(model, other)


def test_bad_input() -> None:
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1")
    good: dict[str, Any] = {
        "lateral": 0.0, "yaw": 0.0, "roll": 0.0, "load": 1e5, "radius": R0, "speed": 20.0,
        "pitch_rate": 43.5, "friction": 0.3,
    }  # fmt: skip
    for bad, message in (
        ({"lateral": 5.0}, r"lateral = 5.0 m, allowed -0.1 .. 0.1 m"),
        ({"load": 0.0}, "load = 0.0 N"),
        ({"speed": 0.0}, "speed = 0.0 m/s"),
        ({"friction": float("nan")}, "friction = nan"),
        ({"gauge": 1435.0}, "gauge = 1435.0 m"),
        ({"normal": "hertzian"}, "kik_piotrowski"),
        ({"normal": "analyn", "theory": "polach"}, "'fastrip'"),
        ({"lateral": -0.09}, "no height between"),  # beside the rail
        ({"cells": (20.5, 20)}, "two whole numbers"),
        ({"cells": (20, 20, 20)}, "two whole numbers"),
    ):
        with pytest.raises(ValueError, match=message):
            wheel_on_rail(wheel, rail, LEFT, **(good | bad))
    with pytest.raises(ValueError, match="side = 0"):
        wheel_on_rail(wheel, rail, 0, **good)
    del good["roll"]
    one, two = (
        wheelset_equilibrium(wheel, rail, wheel, rail, **(good | {"load": load}))
        for load in ((9e4, 1.1e5), [9e4, 1.1e5])
    )
    assert one == two
    with pytest.raises(ValueError, match="one number or two"):
        wheelset_equilibrium(wheel, rail, wheel, rail, **(good | {"load": (1e5, 1e5, 1e5)}))
    with pytest.raises(ValueError, match="load of the right wheel"):
        wheelset_equilibrium(wheel, rail, wheel, rail, **(good | {"load": (1e5, -1.0)}))
