"""A vehicle's couplings alone, with poses and velocities put in by hand."""

from dataclasses import fields, replace

import numpy as np
from scipy.spatial.transform import Rotation

from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.couplings.dispatch import coupling_forces
from hh_exudyn.multibody.model import SLIDERS, workspace
from vehicles.catalogue import vehicle

WAGON = vehicle("iore_wagon_loaded")
NUMBERS = {body.name: i for i, body in enumerate(WAGON.bodies)}
DRAWING = np.array([body.position for body in WAGON.bodies])
SIZE = len(WAGON.bodies)
STILL = np.zeros((SIZE, 3))


class Bench:
    """A vehicle's couplings with poses and velocities put in by hand."""

    def __init__(self, wagon, case):
        model = assemble(wagon, case)
        self.couplings, self.work = model.couplings, workspace(model)
        self.sliders = np.zeros_like(self.work.new_sliders)
        self.place(DRAWING, Rotation.identity(SIZE))

    def place(self, position, rotation):
        self.work.position[:] = position
        self.work.rotation[:] = rotation.as_matrix()

    def forces(self, velocity=STILL, angular_velocity=STILL):
        """Global force and torque on every body, (n, 3) each."""
        work = self.work
        work.velocity[:], work.angular_velocity[:] = velocity, angular_velocity
        for array in (work.force, work.torque, work.ledger):
            array[:] = 0.0
        coupling_forces(self.couplings, self.sliders, False, work)
        return work.force.copy(), work.torque.copy()

    def relax(self):
        """Put sliders where the equilibrium has them: wedges without vertical friction, the rest sticking."""
        self.sliders[:] = 0.0
        coupling_forces(self.couplings, self.sliders, True, self.work)
        self.commit()

    def commit(self):
        self.sliders[:] = self.work.new_sliders

    def displaced(self, name, offset=(0.0, 0.0, 0.0), turn=(0.0, 0.0, 0.0)):
        """Force and torque on one body, moved off the drawing."""
        position, rotation = DRAWING.copy(), np.zeros((SIZE, 3))
        position[NUMBERS[name]] += offset
        rotation[NUMBERS[name]] = turn
        self.place(position, Rotation.from_rotvec(rotation))
        force, torque = self.forces()
        return force[NUMBERS[name]], torque[NUMBERS[name]]


def only(*kinds, **changes):
    """The wagon with couplings of these kinds alone, and with changed numbers."""
    couplings = [replace(c, **changes) for c in WAGON.couplings if isinstance(c, kinds)]
    return replace(WAGON, couplings=tuple(couplings))


def without_loss():
    """The wagon without dry friction and dampers."""
    couplings = []
    for coupling in WAGON.couplings:
        names = [field.name for field in fields(coupling)]
        lossy = [name for name in names if name == "friction" or name.endswith("damping")]
        zero = {name: 0.0 * np.array(getattr(coupling, name)) for name in lossy}
        couplings.append(replace(coupling, **zero))
    return replace(WAGON, couplings=tuple(couplings))


def first(kind):
    return next(coupling for coupling in WAGON.couplings if isinstance(coupling, kind))


def random_state(rest, seed, length=3e-3, angle=2e-3, speed=0.1):
    """A state near equilibrium; wheelsets are turned anyhow about their axles, and spin."""
    rng = np.random.default_rng(seed)
    position = rest[0] + length * rng.uniform(-1, 1, (SIZE, 3))
    spin = np.zeros((SIZE, 3))
    turns = np.zeros((SIZE, 3))
    for wheelset in WAGON.wheelsets:
        turns[NUMBERS[wheelset.body], 1] = rng.uniform(-3, 3)
        spin[NUMBERS[wheelset.body], 1] = 40.0
    small = Rotation.from_rotvec(angle * rng.uniform(-1, 1, (SIZE, 3)))
    velocity = speed * rng.uniform(-1, 1, (SIZE, 3))
    angular_velocity = speed * rng.uniform(-1, 1, (SIZE, 3)) + small.apply(spin)
    sliders = 1e-3 * rng.uniform(-1, 1, (len(WAGON.couplings), SLIDERS))
    return position, small * rest[1] * Rotation.from_rotvec(turns), velocity, angular_velocity, sliders
