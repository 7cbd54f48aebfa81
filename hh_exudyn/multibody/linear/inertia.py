"""Inertia of a model: its mass matrix, and the gyroscopic moments of its spinning wheelsets."""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.multibody.model import BODY_COORDINATES, SystemModel, coordinates, first_creep, first_track


def masses(model: SystemModel) -> FloatArray:
    """Diagonal of the mass matrix [kg], [kg m^2]; 1 for the creep coordinates.

    Parameters
    ----------
    model : masses and inertias are read
    """
    result = np.ones(coordinates(model))
    for i in range(model.mass.size):
        k = BODY_COORDINATES * i
        result[k : k + 3] = model.mass[i]
        result[k + 3 : k + 6] = model.inertia[i]
    if model.flexible:
        result[first_track(model) : first_creep(model)] = np.tile(model.track_mass, len(model.wheelsets))
    return result


def gyroscopic_moments(model: SystemModel, v: FloatArray) -> FloatArray:
    """Matrix G (n, n) of the moments M q'' + G q' = F of wheelsets that spin, at the velocities v.

    A wheelset's coordinates are those of the frame that follows its axle but does not spin: yaw and roll of
    the axle, and their rates, as Exudyn's local ones are at rotation angle zero. With the angular velocity
    (p, W + w, r) the frame turns by (p, 0, r), and of the angular momentum (I p, J (W + w), I r) in it

        I p' - J W r = M_x,        J w' = M_y,        I r' + J W p = M_z

    remain to first order. Exudyn has these moments in its rigid bodies, not in the force kernel. Wheelsets
    are bodies of revolution (equal roll and yaw inertia); no other body spins.

    Parameters
    ----------
    model : inertias of the wheelsets are read
    v : (coordinates,) velocities; those of the wheelsets' pitch are read
    """
    result = np.zeros((v.size, v.size))
    for i in model.wheelsets:
        k = BODY_COORDINATES * int(i)
        momentum = model.inertia[i, 1] * v[k + 4]
        result[k + 3, k + 5] = -momentum
        result[k + 5, k + 3] = momentum
    return result
