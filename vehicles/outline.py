"""Boxes of the bodies of a vehicle on its drawing, derived from its description.

A description has no shapes, so the box of a body follows from other numbers: of a car body from the outline
lengths of the vehicle, if it has them; of side frames, bolsters, bogie frames and bodies in imposed motion
from the points of their couplings; of all others from mass and inertia, as a cuboid of uniform density.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from vehicles.couplings import Coupling, Vector
from vehicles.description import Body, Vehicle

RUNNING_CIRCLE = 0.75  # m, lateral distance of the wheels' middle from the track centre
WHEEL_WIDTH = 0.135  # m
THINNEST = 0.12  # m, shortest edge of a box
COUPLER_REACH = 0.6  # m, from body end to coupler head, where only the length over couplers is known
FLOOR_GAP = 0.05  # m, between wheels and floor, where the height of the floor is not known
_FRAMES = ("side_frame", "bolster", "bogie_frame")  # kinds with a box around their couplings


def body_box(vehicle: Vehicle, body: Body) -> tuple[FloatArray, FloatArray]:
    """Two corners of the box of a body (lowest and highest x, y, z) [m]."""
    if body.kind == "car_body" and (outline := _outline(vehicle, body)) is not None:
        return outline
    points = [point for other, point in attachments(vehicle) if other == body.name]
    if points and (body.kind in _FRAMES or body.held_weight is not None):
        corners = np.array([*points, body.position])
        low, high = corners.min(axis=0), corners.max(axis=0)
        lack = np.maximum(THINNEST - (high - low), 0.0) / 2
        return low - lack, high + lack
    centre = np.array(body.position)
    half = uniform_cuboid(body.mass, body.inertia) / 2
    return centre - half, centre + half


def vehicle_box(vehicle: Vehicle) -> tuple[FloatArray, FloatArray]:
    """Two corners of the box around all bodies, wheels and coupler heads (lowest and highest x, y, z) [m]."""
    corners = [body_box(vehicle, body) for body in vehicle.bodies if body.kind != "wheelset"]
    heads = np.array(vehicle.coupler.points)
    corners.append((heads.min(axis=0), heads.max(axis=0)))
    for wheelset in vehicle.wheelsets:
        reach = np.array([wheelset.radius, RUNNING_CIRCLE + WHEEL_WIDTH, wheelset.radius])
        centre = np.array(vehicle.body(wheelset.body).position)
        corners.append((centre - reach, centre + reach))
    return np.min([low for low, _ in corners], axis=0), np.max([high for _, high in corners], axis=0)


def uniform_cuboid(mass: float, inertia: Vector) -> FloatArray:
    """Edges [m] of the cuboid of uniform density with that mass [kg] and those principal inertias [kg m^2].

    Ix = m (ly^2 + lz^2) / 12 and so on, solved for the edges; no edge is shorter than `THINNEST`, also
    where no cuboid has such inertias (a ring).

    Parameters
    ----------
    mass : [kg]
    inertia : about x, y and z through the centre of mass [kg m^2]
    """
    of = np.array(inertia)
    squares = 6.0 * (of.sum() - 2.0 * of) / mass
    return np.sqrt(np.maximum(squares, THINNEST**2))


def attachments(vehicle: Vehicle) -> list[tuple[str, Vector]]:
    """Every body with every point where something is coupled to it."""
    found = []
    for coupling in vehicle.couplings:
        ends = coupling_ends(coupling)
        found += [(coupling.body_a, ends[0]), (coupling.body_b, ends[-1])]
    return found


def coupling_ends(coupling: Coupling) -> list[Vector]:
    """The point of a coupling, or both ends of a rod."""
    return [getattr(coupling, name) for name in ("point", "point_a", "point_b") if hasattr(coupling, name)]


def _outline(vehicle: Vehicle, body: Body) -> tuple[FloatArray, FloatArray] | None:
    """The car body by the lengths of the description, of a vehicle that gives them for each of its units."""
    if sum(other.kind == "car_body" for other in vehicle.bodies) > len(vehicle.units):
        return None
    given = vehicle.dimensions
    length = given.get("basket_length", given.get("body_length"))
    width = given.get("basket_width", given.get("width"))
    foot = given.get("centre_plate_height", given.get("floor_height"))
    if length is None and "length" in given:
        length = given["length"] - 2 * COUPLER_REACH
    if foot is None and vehicle.wheelsets:
        foot = 2 * max(wheelset.radius for wheelset in vehicle.wheelsets) + FLOOR_GAP
    if length is None or width is None or foot is None or "height" not in given:
        return None
    x, y, _ = body.position
    low, high = (x - length / 2, y - width / 2, foot), (x + length / 2, y + width / 2, given["height"])
    return np.array(low), np.array(high)
