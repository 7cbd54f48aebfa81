"""Force laws against closed forms: two-stage spring, dry friction, wedge statics."""

import math

import numpy as np
import pytest

from vehicles.couplings import Wedge
from vehicles.force_laws import WedgeFaces, clearance_stop, dry_friction, two_stage_spring, wedge

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


def example_wedge(friction, slope_friction=0.0, toe=0.0, wear=0.0, constant_damping=False):
    return Wedge(
        "wedge", "a", "b", (0.0, 0.0, 0.0), 1, 4e5, 0.0, math.radians(36.3), toe, 0.2, wear, friction,
        slope_friction, STIFF, 1e4, constant_damping,
    )  # fmt: skip


def faces_of(c):
    angle = c.slope - c.toe
    angles = math.sin(angle), math.cos(angle), math.cos(c.slope), math.cos(c.toe)
    return WedgeFaces(*angles, c.friction, c.slope_friction, c.stick_stiffness, c.stick_damping)


def pressed(c, spring, rub):
    """Normal forces of column and slope, by the equilibrium of the forces on the wedge as they stand.

    Directions as (towards the column, down): the wedge goes down its column along (-sin t, cos t), the
    bolster slips on the slope along (sin a, -cos a).
    """
    a, t = c.slope, c.toe
    column, slope = np.array([-math.cos(t), -math.sin(t)]), np.array([math.cos(a), math.sin(a)])
    friction = rub.slope * np.array([math.sin(a), -math.cos(a)])
    friction -= rub.down * np.array([-math.sin(t), math.cos(t)])
    return np.linalg.solve(np.column_stack([column, slope]), np.array([0.0, spring]) - friction)


@pytest.mark.parametrize(
    ("friction", "loading", "unloading"),
    [(0.1, 1.576, 1.198), (0.3, 2.301, 0.967), (0.45, 3.514, 0.844)],
)
def test_wedge_statics(friction, loading, unloading):
    """Column force over spring force for a slope of 36.3 deg: vehicles.md 1.3."""
    c, spring = example_wedge(friction, slope_friction=0.3), 2.0e4
    for motion, expected in ((1, loading), (-1, unloading)):
        rub = wedge((motion * 0.02, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), spring, faces_of(c))
        column, _ = pressed(c, spring, rub)
        assert column / spring == pytest.approx(expected, abs=6e-4)
        assert rub.down == pytest.approx(motion * friction * column, rel=1e-9)
        assert rub.slope == 0.0
        assert c.normal_force(spring, motion) == pytest.approx(column, rel=1e-9)


@pytest.mark.parametrize("toe", [0.0, math.radians(1.0), math.radians(-2.0)])
@pytest.mark.parametrize("down", [1, -1])
@pytest.mark.parametrize("slip", [1, 0, -1])
def test_a_wedge_that_slides_on_both_faces(toe, down, slip):
    """Friction of either face is Coulomb's for the normal forces of the equilibrium; squeezed, it is most."""
    c, spring = example_wedge(0.3, slope_friction=0.2, toe=toe), 2.0e4
    rub = wedge((down * 0.02, 0.0, slip * 0.02), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), spring, faces_of(c))
    column, slope = pressed(c, spring, rub)
    assert rub.down == pytest.approx(down * 0.3 * column, rel=1e-9)
    assert rub.slope == pytest.approx(slip * 0.2 * slope, rel=1e-9, abs=1e-9)
    assert c.normal_force(spring, down, slip) == pytest.approx(column, rel=1e-9)
    assert column <= example_wedge(0.3, slope_friction=0.2, toe=toe).normal_force(spring, 1, 1) * (1 + 1e-9)


def test_squeezed_beyond_the_angle_of_friction_a_wedge_jams():
    """35.3 deg against 16.7 + 19.3 deg: it holds elastically, however far; let up it slides."""
    c, spring = example_wedge(0.3, slope_friction=0.35, toe=math.radians(1.0)), 2.0e4
    still = (0.0, 0.0, 0.0)
    for way in (1e-4, 1e-2):
        rub = wedge((way, 0.0, 1.1 * way), still, still, spring, faces_of(c))
        assert (rub.down, rub.slope) == pytest.approx((STIFF * way, 1.1 * STIFF * way))
    rub = wedge((-way, 0.0, -way), still, still, spring, faces_of(c))
    column, slope = pressed(c, spring, rub)
    assert (rub.down, rub.slope) == pytest.approx((-0.3 * column, -0.35 * slope))


def test_wedge_sliding_sideways_gives_up_its_vertical_friction():
    """Friction is two-dimensional: a wedge that slides laterally holds little vertically."""
    c, still = example_wedge(0.3), (0.0, 0.0, 0.0)
    rub = wedge((0.0, 0.02, 0.0), still, still, 2e4, faces_of(c))
    assert rub.down == 0.0
    assert rub.across == pytest.approx(0.3 * 2e4 / SLOPE)


def test_loose_wedge_carries_nothing():
    still = (0.0, 0.0, 0.0)
    rub = wedge((0.01, 0.0, 0.02), still, still, 0.0, faces_of(example_wedge(0.3, 0.2)))
    assert rub == (0.0, 0.0, 0.0, (0.01, 0.0, 0.02))


@pytest.mark.parametrize("constant", [False, True])
def test_the_ways_of_a_wedge_close_its_triangle(constant):
    """The bolster's way is the wedge's down the column and its slip on the slope, as vectors."""
    c = example_wedge(0.3, toe=math.radians(2.0), constant_damping=constant)
    for ways, bolster in zip(c.ways, np.eye(2), strict=True):
        column, slope, spring = ways
        a, t = c.slope, c.toe
        by_column = column * np.array([-math.sin(t), math.cos(t)])
        assert by_column + slope * np.array([math.sin(a), -math.cos(a)]) == pytest.approx(bolster)
        assert spring == pytest.approx(by_column[1] - (bolster[1] if constant else 0.0))


def test_a_worn_wedge_rises_and_its_spring_gives_way():
    """10 mm of wear lift the wedge by 10 mm / tan(36.3 deg), and take that off the spring."""
    worn = example_wedge(0.3, wear=0.01)
    assert worn.compression == pytest.approx(-0.01 / SLOPE)
    with pytest.raises(ValueError, match=r"wear -0\.01 m must be >= 0"):
        example_wedge(0.3, wear=-0.01)


def test_jam_by_one_face_is_refused():
    """A wedge of 36.3 deg jams at a friction of 0.735 on either face."""
    with pytest.raises(ValueError, match=r"jams: its column friction 0\.74"):
        example_wedge(0.74)
    with pytest.raises(ValueError, match=r"jams: its slope friction 0\.74"):
        example_wedge(0.3, 0.74)
    example_wedge(0.73, 0.73)
