"""Time of the contact search, and of one wheel (search, Hertz, creepages, creep forces) beside FaStrip alone.

Called from compiled code, as the dynamics does.
Run: pytest tests/benchmarks -p benchmark --override-ini addopts="--import-mode=importlib"
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from straight_rails import no_forces, straight_rails

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.friction import FrictionTable, constant_friction
from hh_exudyn.contact.geometry.rail_tables import rail_at
from hh_exudyn.contact.geometry.search import CONTACT_COLUMNS, MAX_MAXIMA, find_contacts
from hh_exudyn.contact.geometry.silhouette import wheel_rail_pair
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.tangential.registry import FASTRIP, force_kernel
from hh_exudyn.contact.types import (
    MAX_PATCHES,
    ContactForces,
    RailMotion,
    RollingPatch,
    SplineTable,
    WheelRailModel,
    WheelsetMotion,
)
from hh_exudyn.contact.wheel_rail import wheel_rail_forces, wheel_rail_model
from hh_exudyn.kernel import kernel

CALLS = 1000
WHEELSETS = 4  # of one call, as in a wagon
RADIUS, GAUGE = 0.46, 1.435
NORMAL_FORCE = int(Patch.NORMAL_FORCE)

# Inclination of a 60E1 rail; how far the wheel stands towards it from the middle of the track, amplitude, and
# depth below the running plane [m]; yaw [rad]. Wheel loads of 100 to 200 kN; near the flange with two points,
# and in the flange root, where wheel and rail are all but parallel.
PLACES = {
    "tread": (1 / 40, -0.0015, 0.0007, 300e-6, 0.5e-3),
    "two points": (1 / 30, 0.0056, 0.0002, -40e-6, 1e-3),
    "flange root": (1 / 40, 0.0063, 0.0001, -450e-6, 2e-3),
    "flange": (1 / 40, 0.0067, 0.0001, -690e-6, 2e-3),
}


@kernel
def many_searches(
    wheel: SplineTable,
    rail: SplineTable,
    rail_y: float,
    centre: FloatArray,
    axle: FloatArray,
    amplitude: float,
    rows: FloatArray,
    calls: int,
) -> int:
    found = 0
    for i in range(calls):
        centre[1] = amplitude * math.sin(0.01 * i) - rail_y
        pair = wheel_rail_pair(wheel, rail, 1.0, 0.75, RADIUS, centre, axle)
        found += find_contacts(pair, rows)
    return found


@kernel
def many_wheelsets(
    model: WheelRailModel,
    wheelsets: WheelsetMotion,
    rails: RailMotion,
    friction: FrictionTable,
    forces: ContactForces,
    amplitude: float,
    calls: int,
) -> int:
    """Calls for wheelsets that move alike; returns how many patches of the first carried load."""
    present = 0
    centre = wheelsets.position[0, 1]
    for i in range(calls):
        wheelsets.position[:, 1] = centre + amplitude * math.sin(0.01 * i)
        wheel_rail_forces(model, wheelsets, rails, friction, forces)
        for side in range(2):
            for patch in range(MAX_PATCHES):
                present += forces.patches[0, side, patch, NORMAL_FORCE] > 0.0
    wheelsets.position[:, 1] = centre
    return present


@kernel
def many_forces(
    a: float, b: float, normal: float, nu_x: float, nu_y: float, phi: float, friction: float, calls: int
) -> float:
    total = 0.0
    for i in range(calls):
        slip = nu_x * (1.0 + 1e-6 * (i & 1023))
        patch = RollingPatch(a, b, normal, slip, nu_y, phi, friction, 82e9, 0.28)
        x, y, m = force_kernel(FASTRIP, patch, 20, 20)
        total += x + y + m
    return total


def wheelset(place: str) -> tuple[tuple[Any, ...], FloatArray, float]:
    """Arguments of `many_wheelsets` but for the last two, patches and amplitude.

    The gauge is such that both wheels stand alike.
    """
    inclination, towards_rail, amplitude, depth, yaw = PLACES[place]
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", inclination)
    model = wheel_rail_model(wheel, wheel, rail, rail, nominal_radius=RADIUS, cells=(20, 20))
    n = WHEELSETS
    axle = np.tile([-math.sin(yaw), math.cos(yaw), 0.0], (n, 1))
    motion = WheelsetMotion(
        position=np.tile([0.0, 0.0, RADIUS - depth], (n, 1)),
        axle=axle,
        velocity=np.tile([20.0, 0.0, 0.0], (n, 1)),
        angular_velocity=axle * 20.0 / RADIUS,
        creep_lag=np.zeros((n, 2, 2)),
    )
    forces = no_forces(n, 0.0)
    rails = straight_rails(model, np.full(n, GAUGE - 2.0 * towards_rail))
    arguments = (model, motion, rails, constant_friction(np.full((n, 2), 0.4)), forces)
    return arguments, forces.patches, amplitude


@pytest.mark.parametrize("place", PLACES)
def test_search(benchmark: Callable[..., Any], place: str) -> None:
    """A thousand wheels."""
    arguments, _, amplitude = wheelset(place)
    model, motion, rails, *_ = arguments
    centre, axle, rail_y = motion.position[0], motion.axle[0], rails.position[0, 0, 0]
    rail, _ = rail_at(model.rails_left, 0.0)
    rows = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS))
    tables = model.wheel_left, rail
    many_searches(*tables, rail_y, centre, axle, amplitude, rows, 1)
    assert benchmark(many_searches, *tables, rail_y, centre, axle, amplitude, rows, CALLS) >= CALLS


@pytest.mark.parametrize("place", PLACES)
def test_wheels(benchmark: Callable[..., Any], place: str) -> None:
    """A thousand wheels, eight a call, at 20 x 20 cells; the patches of a wheel are printed beside."""
    arguments, _, amplitude = wheelset(place)
    many_wheelsets(*arguments, amplitude, 1)
    calls = CALLS // (2 * WHEELSETS)
    present = benchmark(many_wheelsets, *arguments, amplitude, calls)
    assert present >= 2 * calls
    benchmark.extra_info["patches of a wheel"] = present / (2 * calls)


@pytest.mark.parametrize("place", PLACES)
def test_fastrip_alone(benchmark: Callable[..., Any], place: str) -> None:
    """A thousand creep forces on 20 x 20 cells of the first wheel's first patch, to compare."""
    arguments, patches, _ = wheelset(place)
    many_wheelsets(*arguments, 0.0, 1)
    row = patches[0, 0, 0]
    names = (Patch.A, Patch.B, Patch.NORMAL_FORCE, Patch.NU_X, Patch.NU_Y, Patch.PHI, Patch.FRICTION)
    state = [float(row[name]) for name in names]
    many_forces(*state, 1)
    assert np.isfinite(benchmark(many_forces, *state, CALLS))
