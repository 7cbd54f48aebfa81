"""Shapes of all bodies of a vehicle, each about its own centre of mass, made from its description.

An ore wagon is drawn as hopper and three-piece bogies; other vehicles as boxes, frames and motors of the
sizes of `vehicles.outline`. Wheels are turned from their profile with their true
radius. No dynamics reads shapes.
"""

from collections.abc import Mapping

import numpy as np
import trimesh

from hh_exudyn.arrays import FloatArray
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.playback.shapes.boxy import bogie_frame, car_body, motor, plain_box
from hh_exudyn.playback.shapes.dimensions import WagonDimensions, is_ore_wagon, wagon_dimensions
from hh_exudyn.playback.shapes.hopper import hopper, ore_heap
from hh_exudyn.playback.shapes.three_piece_bogie import bolster, side_frame
from hh_exudyn.playback.shapes.wheelset import wheelset_shape
from vehicles.description import Body, Vehicle
from vehicles.outline import RUNNING_CIRCLE, attachments


def vehicle_shapes(
    vehicle: Vehicle, tread: FloatArray, own: Mapping[str, tuple[FloatArray, FloatArray]] | None = None
) -> dict[str, trimesh.Trimesh]:
    """Shapes by entity below the vehicle: the names of its bodies, and ``<car body>/ore`` of a loaded wagon.

    Parameters
    ----------
    vehicle
        Any vehicle.
    tread
        (n, 2) wheel profile (y, z) in side coordinates, from the field side to the flange back [m].
    own
        Such profiles of the left and the right wheel, by body of the wheelsets that have others.
    """
    size = wagon_dimensions(vehicle) if is_ore_wagon(vehicle) else None
    wheels = {wheelset.body: wheelset.radius for wheelset in vehicle.wheelsets}
    middle = vehicle.dimensions.get("running_circle_distance", RUNNING_CIRCLE)
    shapes = {}
    for body in vehicle.bodies:
        if body.name in wheels:
            treads = (own or {}).get(body.name, (tread, tread))
            shapes[body.name] = wheelset_shape(wheels[body.name], _journal(vehicle, body), treads, middle)
        elif size is not None:
            shapes |= _of_wagon(size, body)
        else:
            shapes[body.name] = _of_any(vehicle, body)
    return shapes


def _journal(vehicle: Vehicle, wheelset: Body) -> float:
    """Half the distance of a wheelset's bearings, which are at its outermost couplings [m]."""
    outermost = [abs(point[1]) for name, point in attachments(vehicle) if name == wheelset.name]
    return max(outermost, default=0.0)


def _of_wagon(size: WagonDimensions, body: Body) -> dict[str, trimesh.Trimesh]:
    """A body of an ore wagon, with its load."""
    if body.kind == "bolster":
        return {body.name: bolster(size)}
    if body.kind == "side_frame":
        return {body.name: side_frame(size, LEFT if body.position[1] > 0.0 else RIGHT)}
    shapes = {body.name: hopper(size)}
    if size.ore_depth > 0.0:
        shapes[f"{body.name}/ore"] = ore_heap(size)
    for shape in shapes.values():
        shape.apply_translation((0.0, 0.0, -size.car_body_height))
    return shapes


def _of_any(vehicle: Vehicle, body: Body) -> trimesh.Trimesh:
    """A body of any other vehicle."""
    made = {"car_body": car_body, "bogie_frame": bogie_frame, "motor": motor}.get(body.kind, plain_box)
    mesh = made(vehicle, body)
    mesh.apply_translation(-np.array(body.position))
    return mesh
