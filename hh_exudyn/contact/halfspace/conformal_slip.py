"""Rigid slip over a curved contact, and the forces of its tractions.

Every strip has its own rolling radius and normal, so longitudinal creepage and spin vary over a conformal
patch. The wheel's material is taken where the strip's silhouette lies, moved along x in the plane of contact:
there the deformed surfaces meet.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.halfspace.wheel_rail import ConformalContact

_SPIN_SHIFT = 1.0 / 6.0  # of an element: as in `rolling.rigid_slip`


def conformal_slip(
    contact: ConformalContact, velocity: FloatArray, angular_velocity: FloatArray, speed: float
) -> FloatArray:
    """Rigid slip over the speed of every element, (2, ny, nx) along x and across [-].

    Parameters
    ----------
    contact : ConformalContact
        Where wheel and rail touch.
    velocity, angular_velocity : ndarray, (3,)
        Of the wheelset's centre [m/s] and of the wheelset [rad/s], pitch included, in axes of the rail's
        frame R, less the rail's own velocity.
    speed : float
        V [m/s], > 0.

    Raises
    ------
    ValueError
        If a number is out of range.
    """
    v, omega = np.asarray(velocity, dtype=np.float64), np.asarray(angular_velocity, dtype=np.float64)
    if not (math.isfinite(speed) and speed > 0.0):
        raise ValueError(f"speed = {speed} m/s; it must be finite and > 0 m/s")
    if v.shape != (3,) or omega.shape != (3,) or not (np.all(np.isfinite(v)) and np.all(np.isfinite(omega))):
        raise ValueError("velocity [m/s] and angular_velocity [rad/s] must be three finite numbers each")
    x = contact.x + _SPIN_SHIFT * contact.influence.grid.dx
    y, z = contact.point_y[:, None], contact.point_z[:, None]
    cosine, sine = np.cos(contact.angle)[:, None], contact.side * np.sin(contact.angle)[:, None]
    slip = np.empty((2, *contact.pressure.shape))
    slip[0] = v[0] + omega[1] * z - omega[2] * y
    lateral, upward = v[1] + omega[2] * x - omega[0] * z, v[2] + omega[0] * y - omega[1] * x
    slip[1] = cosine * lateral - sine * upward  # across, in C: normal cross x
    return slip / speed


def slip_of_creepages(
    contact: ConformalContact, axle: tuple[float, float], creepages: tuple[float, float, float]
) -> FloatArray:
    """Rigid slip of every element, (2, ny, nx) [-], of a wheel whose mean creepages are known.

    They are the means over the pressure, as a row of the contact log has them. The wheel is a rigid body: it
    turns about its axle with (1 - nu_x)/r per metre and about the vertical with what phi has beyond that
    (`contact.strips.rebuilt`, which does the same for strips).

    Parameters
    ----------
    contact : ConformalContact
        Where wheel and rail touch.
    axle : tuple of float
        Components of the axle's direction along y and z of the rail's frame R [-].
    creepages : tuple of float
        nu_x [-], nu_y [-], phi [1/m].
    """
    nu_x, nu_y, phi = creepages
    weight = contact.pressure / contact.pressure.sum()
    load, x = weight.sum(axis=1), contact.x
    cosine, sine = np.cos(contact.angle), -contact.side * np.sin(contact.angle)  # positive on a left flange
    along = axle[1] * cosine - axle[0] * sine
    radius, middle = float(load @ contact.radius), float(weight.sum(axis=0) @ x)
    rolling = (1.0 - nu_x) / radius
    turning = (phi - rolling * float(load @ along)) / float(load @ cosine)
    direction = np.array([load @ cosine, load @ sine])
    lateral, vertical = nu_y * direction / np.hypot(direction[0], direction[1])
    ahead = x + _SPIN_SHIFT * contact.influence.grid.dx - middle
    slip = np.empty((2, *contact.pressure.shape))
    slip[0] = (nu_x - rolling * (contact.radius - radius))[:, None]
    slip[1] = (cosine * lateral + sine * vertical)[:, None]
    slip[1] += (cosine * turning - sine * rolling)[:, None] * ahead
    return slip


def force_on_wheel(contact: ConformalContact, traction: FloatArray | None = None) -> FloatArray:
    """Force of pressure and tractions on the wheel in axes of R [N], (3,).

    Parameters
    ----------
    contact : ConformalContact
        With the pressure.
    traction : ndarray, (2, ny, nx), optional
        On the wheel, of `rolling.rolling_contact` [Pa].
    """
    area = contact.influence.grid.area
    cosine, sine = np.cos(contact.angle), contact.side * np.sin(contact.angle)
    normal = contact.pressure.sum(axis=1) * area
    force = np.array([0.0, normal @ sine, normal @ cosine])
    if traction is not None:
        along, across = (part.sum(axis=1) * area for part in traction)
        force += np.array([along.sum(), across @ cosine, -(across @ sine)])
    return force
