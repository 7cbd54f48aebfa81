"""Lenoir suspension and double link: closed forms of their loops, and no energy out of nothing."""

import math
from dataclasses import replace

import numpy as np
import pytest

from hh_exudyn.conventions import GRAVITY
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.couplings.dispatch import coupling_forces
from hh_exudyn.multibody.model import Ledger, workspace
from vehicles.catalogue import vehicle
from vehicles.freight_couplings import DoubleLink, LenoirSuspension

Y25 = vehicle("y25_wagon_loaded")
NAMES = [body.name for body in Y25.bodies]
LENOIR = next(c for c in Y25.couplings if isinstance(c, LenoirSuspension))
# a two-axle wagon's: 22.5 t axle load, initial stiffness and friction as of measured links (assumed)
LINK = DoubleLink(
    "link", LENOIR.body_a, LENOIR.body_b, LENOIR.point, 1.0e6, 2.0e6, 0.04, 0.08, 6e6, 0.35, 0.5, 0.04, 0.05,
    3e6, 1e4, 0.02, 0.02, 2e7,
)  # fmt: skip
ON_BOX = (Y25.mass - 4 * 1300.0) * GRAVITY / 8


class Box:
    """One suspension between its frame, which stands still, and its wheelset, moved by hand."""

    def __init__(self, coupling, case):
        model = assemble(replace(Y25, couplings=(coupling,)), case)
        self.couplings, self.work = model.couplings, workspace(model)
        self.sliders = np.zeros_like(self.work.new_sliders)
        self.number = NAMES.index(coupling.body_b)
        self.drawing = np.array([body.position for body in Y25.bodies])

    def force(self, place, rate=(0.0, 0.0, 0.0), settle=False):
        """On the wheelset, displaced from the drawing."""
        work = self.work
        for array in (work.force, work.torque, work.ledger, work.velocity, work.angular_velocity):
            array[:] = 0.0
        work.position[:], work.rotation[:] = self.drawing, np.eye(3)
        work.position[self.number] += place
        work.velocity[self.number] = rate
        coupling_forces(self.couplings, self.sliders, settle, work)
        return work.force[self.number].copy()

    def commit(self):
        self.sliders[:] = self.work.new_sliders

    def loop(self, path, speed=1e-4):
        """Forces along the second round of a closed path (n, 3), and what the ledger lost [J]."""
        lost, forces = 0.0, []
        way = np.diff(path, axis=0, prepend=path[:1])
        for _ in range(2):
            lost, forces = 0.0, []
            for place, step in zip(path, way, strict=True):
                size = np.linalg.norm(step)
                rate = speed * step / size if size > 0.0 else step
                forces.append(self.force(place, rate))
                power = self.work.ledger[Ledger.FRICTION_POWER] + self.work.ledger[Ledger.DAMPER_POWER]
                lost += power * size / speed
                self.commit()
        return np.array(forces), lost


def springs(c, compression):
    beyond = max(compression - c.second_from, 0.0)
    return c.first_stiffness * max(compression, 0.0) + (c.second_stiffness - c.first_stiffness) * beyond


def energy(c, compression):
    beyond = max(compression - c.second_from, 0.0)
    first = c.first_stiffness * max(compression, 0.0) ** 2
    return (first + (c.second_stiffness - c.first_stiffness) * beyond**2) / 2


def stored(c, place, sliders):
    """Elastic energy of springs, stops and sticking faces [J]."""
    x, y, z = place
    across = max(abs(y) - c.lateral_clearance, 0.0)
    total = c.stop_stiffness * across**2 / 2
    if isinstance(c, LenoirSuspension):
        off = c.direction * x
        total += (1 - c.link_share) * energy(c, z)
        total += c.link_share * energy(c, z + math.tan(c.link_angle) * off)
        total += c.guide_stiffness * max(-off, 0.0) ** 2 / 2
        total += c.stop_stiffness * max(off - c.longitudinal_clearance, 0.0) ** 2 / 2
        total += c.horizontal_stiffness * (x**2 + y**2) / 2
        return total + c.stick_stiffness * ((y - sliders[0]) ** 2 + (z - sliders[1]) ** 2) / 2
    total += c.stop_stiffness * max(abs(x) - c.longitudinal_clearance, 0.0) ** 2 / 2
    total += energy(c, z + x**2 / (2 * c.longitudinal_length) + y**2 / (2 * c.lateral_length))
    total += c.link_stick_stiffness * ((x - sliders[0]) ** 2 + (y - sliders[1]) ** 2) / 2
    return total + c.leaf_stick_stiffness * (z - sliders[2]) ** 2 / 2


BOTH = pytest.mark.parametrize("coupling", [LENOIR, LINK], ids=["lenoir", "link"])


@BOTH
def test_forces_without_friction_are_those_of_an_energy(demo, coupling):
    """Its gradient, in all directions, on both stages and against the stops."""
    names = ("friction", "leaf_friction", "longitudinal_friction", "lateral_friction", "longitudinal_damping")
    smooth = replace(coupling, **{name: 0.0 for name in names if hasattr(coupling, name)})
    box = Box(smooth, demo)
    rng = np.random.default_rng(1)
    for _ in range(50):
        place = np.array([0.006, 0.015, 0.02]) * rng.uniform(-1, 1, 3) + [0.0, 0.0, 0.035]
        force = box.force(place)
        sliders = box.work.new_sliders[0]
        steps = 1e-7 * np.eye(3)
        rise = [stored(smooth, place + h, sliders) - stored(smooth, place - h, sliders) for h in steps]
        assert force == pytest.approx(-np.array(rise) / 2e-7, rel=1e-5, abs=1.0)


@BOTH
def test_no_path_gets_energy_out(demo, coupling):
    """A hundred fast and slow steps anyhow: what was put in is at least what springs and faces hold.

    The elastic energy is convex, so that the inequality is exact for forces at the end of a step.
    """
    for seed in range(8):
        box, rng = Box(coupling, demo), np.random.default_rng(seed)
        place = np.array([0.0, 0.0, 0.045])
        box.force(place, settle=True)
        box.commit()
        start = stored(coupling, place, box.sliders[0])
        work, size = 0.0, 0.0
        for _ in range(100):
            way = 10.0 ** rng.uniform(-6.0, -3.0) * rng.uniform(-1, 1, 3)
            place = place + way
            force = box.force(place, way / 10.0 ** rng.uniform(-4.0, 0.0))
            box.commit()
            work -= force @ way
            size += np.abs(force) @ np.abs(way)
            assert work >= stored(coupling, place, box.sliders[0]) - start - 1e-9 * size


def there_and_back(low, high, points=1001):
    there = np.linspace(low, high, points)
    return np.concatenate([there, there[-2::-1]])


def deflection(c, load):
    """Compression of the springs under a load [m]."""
    grid = np.linspace(0.0, 0.2, 20001)
    return float(np.interp(load, [springs(c, z) for z in grid], grid))


def test_lenoir_friction_goes_with_the_load(demo):
    """Vertically F (1 +- 2 mu s tan a) while box and guide rub as much as the plunger; laden and empty.

    The wheelset stands where plunger and guide balance, as it does without a longitudinal force.
    """
    c = replace(LENOIR, horizontal_stiffness=0.0)
    tangent = math.tan(c.link_angle)
    share = 2 * c.friction * c.link_share * tangent
    assert share == pytest.approx(0.09, abs=0.005)
    for load in (ON_BOX, 23e3):
        middle = deflection(c, load)
        z = there_and_back(0.8 * middle, 1.2 * middle)
        hung = np.array([c.link_share * springs(c, height) for height in z])
        path = np.column_stack([-c.direction * tangent * hung / c.guide_stiffness, 0 * z, z])
        force, lost = Box(c, demo).loop(path)
        load_of = np.array([springs(c, height) for height in z])
        up = np.gradient(z) > 0.0
        near = np.abs(z - middle) < 0.1 * middle
        for way, sign in ((up, 1.0), (~up, -1.0)):
            # the guide gives by 0.4 mm, which lets the hung springs go a little
            assert -force[way & near, 2] / load_of[way & near] == pytest.approx(1.0 + sign * share, rel=0.01)
            assert force[way & near, 0] == pytest.approx(0.0, abs=0.02 * load * tangent)
        area = np.trapezoid(-force[:, 2], z) + np.trapezoid(-force[:, 0], path[:, 0])
        assert lost == pytest.approx(area, rel=0.01)


def test_lenoir_box_leaves_its_guide(demo):
    """Longitudinally stiff on the guide; against the plunger it yields at N, up to the stop."""
    c = replace(LENOIR, horizontal_stiffness=0.0, friction=0.0)
    z = deflection(c, ON_BOX)
    push = math.tan(c.link_angle) * c.link_share * springs(c, z)
    off = np.linspace(-0.001, 1.5 * c.longitudinal_clearance, 1001)
    path = np.column_stack([c.direction * off, 0 * off, 0 * off + z])
    force = c.direction * Box(c, demo).loop(path)[0][:, 0]
    slope = np.gradient(force, off)
    on_guide, free = np.abs(off + 5e-4) < 4.5e-4, (off > 2e-5) & (off < 0.99 * c.longitudinal_clearance)
    hung = c.link_share * c.second_stiffness * math.tan(c.link_angle) ** 2
    damping = 2 * c.longitudinal_damping * 1e-4  # N
    assert slope[on_guide] == pytest.approx(-c.guide_stiffness - hung, rel=1e-3)
    assert slope[free] == pytest.approx(-hung, rel=1e-2)
    assert np.interp(0.0, off, force) == pytest.approx(-push, rel=1e-3, abs=damping)
    assert force.min() < -push - 0.4 * c.longitudinal_clearance * c.stop_stiffness


def test_lenoir_yields_laterally_at_its_friction(demo):
    """Sheared in the faces' plane: stiff up to 2 mu N, then with the coils."""
    z = deflection(LENOIR, ON_BOX)
    tangent = math.tan(LENOIR.link_angle)
    push = tangent * LENOIR.link_share * ON_BOX
    y = there_and_back(-0.008, 0.008)
    path = np.column_stack([0 * y - LENOIR.direction * push / LENOIR.guide_stiffness, y, 0 * y + z])
    force, lost = Box(LENOIR, demo).loop(path)
    bound = 2 * LENOIR.friction * push
    assert lost == pytest.approx(4 * bound * (0.008 - bound / LENOIR.stick_stiffness), rel=0.01)
    assert np.trapezoid(-force[:, 1], y) == pytest.approx(lost, rel=0.01)


def test_double_link_is_a_pendulum_with_friction(demo):
    """Longitudinally and laterally: weight over length, and a Coulomb slider behind a spring."""
    z = deflection(LINK, ON_BOX)
    for axis, length, ratio in (
        (0, LINK.longitudinal_length, LINK.longitudinal_friction),
        (1, LINK.lateral_length, LINK.lateral_friction),
    ):
        path = np.zeros((2001, 3))
        path[:, axis] = there_and_back(-0.015, 0.015)
        path[:, 2] = z - path[:, axis] ** 2 / (2 * length)  # the frame rises, its load stays
        force, lost = Box(replace(LINK, leaf_friction=0.0), demo).loop(path)
        bound = ratio * ON_BOX
        assert lost == pytest.approx(4 * bound * (0.015 - bound / LINK.link_stick_stiffness), rel=0.01)
        sliding = (np.gradient(path[:, axis]) > 0) & (path[:, axis] > 0.0) & (path[:, axis] < 0.014)
        slope = np.polyfit(path[sliding, axis], -force[sliding, axis], 1)[0]
        assert slope == pytest.approx(ON_BOX / length, rel=0.01)
        middle = np.interp(0.0, path[:1001, axis], -force[:1001, axis])
        assert middle == pytest.approx(bound, rel=0.01)


def test_leaf_spring_rubs_with_its_load(demo):
    """Up and down F (1 +- mu), stiffer by the sticking leaves after every turn."""
    middle = deflection(LINK, ON_BOX)
    path = np.zeros((2001, 3))
    path[:, 2] = there_and_back(middle - 0.01, middle + 0.01)
    force, lost = Box(LINK, demo).loop(path)
    up = np.gradient(path[:, 2]) > 0.0
    near = np.abs(path[:, 2] - middle) < 0.003
    load = np.array([springs(LINK, z) for z in path[:, 2]])
    for way, sign in ((up, 1.0), (~up, -1.0)):
        assert -force[way & near, 2] == pytest.approx((1.0 + sign * LINK.leaf_friction) * load[way & near])
    top = int(np.argmax(path[:, 2]))
    back = (force[top + 10, 2] - force[top, 2]) / (path[top + 10, 2] - path[top, 2])
    assert -back == pytest.approx(LINK.second_stiffness + LINK.leaf_stick_stiffness, rel=1e-3)
    assert np.trapezoid(-force[:, 2], path[:, 2]) == pytest.approx(lost, rel=0.01)


@pytest.mark.parametrize(
    ("coupling", "changes", "message"),
    [
        (LENOIR, {"link_angle": 0.9}, r"Lenoir suspension suspension_1L: link_share 0\.5 must be 0..1"),
        (LENOIR, {"guide_stiffness": 0.0}, r"guide_stiffness 0\.0 N/m must be > 0"),
        (LINK, {"lateral_length": 0.0}, r"double link link: lateral_length 0\.0 m must be > 0"),
        (LINK, {"leaf_friction": -0.1}, r"leaf_friction -0\.1 must be >= 0"),
    ],
)
def test_nonsense_is_refused(coupling, changes, message):
    with pytest.raises(ValueError, match=message):
        replace(coupling, **changes)
