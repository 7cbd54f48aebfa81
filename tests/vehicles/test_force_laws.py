"""Force laws against closed forms: two-stage spring, dry friction, wedge statics."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vehicles.couplings import Wedge
from vehicles.force_laws import clearance_stop, dry_friction, two_stage_spring, wedge

STIFF = 1.0e7
SLOPE = math.tan(math.radians(36.3))


def test_two_stage_spring_is_continuous_and_pushes_only():
    assert two_stage_spring(-0.01, 1e6, 4e6, 0.02) == 0.0
    assert two_stage_spring(0.02, 1e6, 4e6, 0.02) == pytest.approx(2.0e4)
    assert two_stage_spring(0.03, 1e6, 4e6, 0.02) == pytest.approx(2.0e4 + 4.0e4)


def test_clearance_stop_is_odd_and_free_within():
    assert clearance_stop(0.009, 0.01, 1e7) == 0.0
    assert clearance_stop(0.011, 0.01, 1e7) == pytest.approx(-1e4)
    assert clearance_stop(-0.011, 0.01, 1e7) == pytest.approx(1e4)


def slide(path, bound):
    """Force on a body that is moved slowly along the path (n, 2), with the slider committed at each point."""
    slider = (0.0, 0.0)
    forces = []
    for u, w in path:
        fu, fw, *slider = dry_friction(u, w, *slider, 0.0, 0.0, STIFF, STIFF, 0.0, 0.0, bound)
        forces.append((fu, fw))
    return np.array(forces)


def test_friction_loop_loses_the_energy_that_coulomb_says():
    """A slow cycle of amplitude u0 loses 4 mu N (u0 - mu N / k), twice the elastic slip off each way."""
    bound, amplitude = 1.0e4, 0.01
    u = np.concatenate(
        [np.linspace(0, amplitude, 500), *[np.linspace(s * amplitude, -s * amplitude, 2001) for s in (1, -1)]]
    )
    path = np.column_stack([u, np.zeros_like(u)])
    force = slide(path, bound)[:, 0]
    cycle = slice(499, None)
    lost = -np.trapezoid(force[cycle], u[cycle])
    assert lost == pytest.approx(4 * bound * (amplitude - bound / STIFF), rel=1e-3)


def test_friction_at_rest_does_not_creep():
    """Held at 90 % of its bound, ten thousand committed steps leave the slider where it is."""
    slider = (0.0, 0.0)
    u = 0.9e4 / STIFF
    for _ in range(10_000):
        fu, _, *slider = dry_friction(u, 0.0, *slider, 0.0, 0.0, STIFF, STIFF, 0.0, 0.0, 1.0e4)
    assert (slider[0], slider[1]) == (0.0, 0.0)
    assert fu == pytest.approx(-0.9e4)


@pytest.mark.parametrize(
    ("friction", "loading", "unloading"),
    [(0.1, 1.576, 1.198), (0.3, 2.301, 0.967), (0.45, 3.514, 0.844)],
)
def test_wedge_statics(friction, loading, unloading):
    """Column force over spring force for a slope of 36.3 deg: vehicles.md 1.3."""
    spring, compression = 4.0e5, 0.05
    for motion, expected in ((1, loading), (-1, unloading)):
        start = compression - motion * 0.02
        column, up, *_ = wedge(compression, 0.0, start, 0.0, 0.0, 0.0, spring, SLOPE, friction, STIFF, 0.0)
        assert column / (spring * compression) == pytest.approx(expected, abs=6e-4)
        assert up == pytest.approx(motion * friction * column, rel=1e-9)
        assert column * SLOPE == pytest.approx(spring * compression + up, rel=1e-9)


def test_wedge_description_agrees_with_the_kernel():
    description = example_wedge(friction=0.3)
    assert description.normal_force(1.0, 1) == pytest.approx(2.301, abs=6e-4)
    assert description.normal_force(1.0, -1) == pytest.approx(0.967, abs=6e-4)


def test_wedge_sliding_sideways_gives_up_its_vertical_friction():
    """Friction is two-dimensional: a wedge that slides laterally holds little vertically."""
    column, up, lateral, *_ = wedge(0.05, 0.02, 0.05, 0.0, 0.0, 0.0, 4e5, SLOPE, 0.3, STIFF, 0.0)
    assert up == 0.0
    assert column == pytest.approx(4e5 * 0.05 / SLOPE)
    assert lateral == pytest.approx(-0.3 * column)


@given(st.floats(0.001, 0.08), st.floats(-0.02, 0.02), st.floats(-0.08, 0.08), st.floats(-0.02, 0.02))
def test_wedge_obeys_coulomb(compression, lateral, slider, slider_lateral):
    spring = 4e5
    column, up, side, *_ = wedge(
        compression, lateral, slider, slider_lateral, 0.0, 0.0, spring, SLOPE, 0.3, STIFF, 0.0
    )
    assert column > 0.0
    assert math.hypot(up, side) <= 0.3 * column * (1 + 1e-9)


def test_loose_wedge_carries_nothing():
    assert wedge(-0.01, 0.0, 0.0, 0.0, 0.0, 0.0, 4e5, SLOPE, 0.3, STIFF, 0.0)[:3] == (0.0, 0.0, 0.0)


def example_wedge(friction, slope_friction=0.0, ratio=0.0, toe=0.0, wear=0.0):
    return Wedge(
        "wedge", "a", "b", (0.0, 0.0, 0.0), 1, 4e5, 0.0, math.radians(36.3), toe, 0.2, wear, friction,
        slope_friction, ratio, 1e7, 1e4,
    )  # fmt: skip


def statics(slope, toe, friction, motion):
    """N2 and N1 cos a over Fs, and friction over N2, from the two equations of equilibrium as they stand."""
    c, s, t = math.cos(toe), math.sin(toe), math.tan(slope)
    rub = motion * friction
    # (N2, N1 cos a): N1 cos a = N2 (c - rub s),  1 + N2 (s + rub c) = N1 cos a tan(slope)
    return np.linalg.solve([[c - rub * s, -1.0], [s + rub * c, -t]], [0.0, -1.0])


@pytest.mark.parametrize("toe", [0.0, math.radians(1.0), math.radians(-2.0)])
@pytest.mark.parametrize("motion", [1, -1])
def test_toe_by_the_equations_of_equilibrium(toe, motion):
    """The closed form with toe against the solved equations; columns that close downwards press more."""
    description = example_wedge(0.3, toe=toe)
    normal, _ = statics(description.slope, toe, 0.3, motion)
    assert description.normal_force(1.0, motion) == pytest.approx(normal, rel=1e-12)
    assert np.sign(normal - example_wedge(0.3).normal_force(1.0, motion)) == np.sign(toe)


def test_a_worn_wedge_rises_and_its_spring_gives_way():
    """10 mm of wear lift the wedge by 10 mm / tan(36.3 deg), and take that off the spring."""
    worn = example_wedge(0.3, wear=0.01)
    assert worn.compression == pytest.approx(-0.01 / SLOPE)
    with pytest.raises(ValueError, match=r"wear -0\.01 m must be >= 0"):
        example_wedge(0.3, wear=-0.01)


def test_jam_is_refused():
    """vehicles.md 1.3: jams at mu1 = 0.3, mu2 = 0.45, r = -1."""
    with pytest.raises(ValueError, match="jams"):
        example_wedge(0.45, 0.3, -1.0)
    example_wedge(0.45, 0.3, 0.0)
