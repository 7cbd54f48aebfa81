"""Energy in the load springs of a wagon on three-piece bogies, from the motion log of its run."""

from types import SimpleNamespace

import numpy as np
from scipy.spatial.transform import Rotation

from vehicles.couplings import Coupling, SpringNest, Wedge
from vehicles.description import Vehicle


def spring_energy(vehicle: Vehicle, motion: SimpleNamespace) -> np.ndarray:
    """Energy of nests and wedge springs in vertical compression at every output [J].

    Wedges by the middle of their two lines: what warp and roll add is some joules of thirty thousand.
    """
    energy = np.zeros(np.unique(motion.time).size)
    for coupling in vehicle.couplings:
        if isinstance(coupling, SpringNest):
            compression = -_displacement(vehicle, motion, coupling)[:, 2]
            beyond = np.maximum(compression - coupling.second_from, 0.0)
            energy += 0.5 * coupling.first_stiffness * compression**2
            energy += 0.5 * (coupling.second_stiffness - coupling.first_stiffness) * beyond**2
        elif isinstance(coupling, Wedge):
            ahead, _, up = _displacement(vehicle, motion, coupling).T
            face, toe = np.tan(coupling.slope), np.tan(coupling.toe)
            along = (coupling.direction * ahead - up * face) / (face - toe)
            energy += 0.5 * coupling.spring_stiffness * (coupling.compression + along) ** 2
    return energy


def _displacement(vehicle: Vehicle, motion: SimpleNamespace, coupling: Coupling) -> np.ndarray:
    """(outputs, 3) of the coupling's point on B relative to A in the axes of A [m]."""
    point = np.array(coupling.point)
    arm_a, arm_b = (point - vehicle.body(name).position for name in (coupling.body_a, coupling.body_b))
    place_a, turn_a = _pose(motion, coupling.body_a)
    place_b, turn_b = _pose(motion, coupling.body_b)
    return turn_a.inv().apply(place_b + turn_b.apply(arm_b) - place_a) - arm_a


def _pose(motion: SimpleNamespace, body: str) -> tuple[np.ndarray, Rotation]:
    own = motion.body == body
    place = np.column_stack([motion.x[own], motion.y[own], motion.z[own]])
    turn = np.column_stack([motion.qx[own], motion.qy[own], motion.qz[own], motion.qw[own]])
    return place, Rotation.from_quat(turn)
