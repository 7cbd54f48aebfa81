"""Axle loads of a vehicle at rest on level track, from its bodies and couplings alone."""

import math
from collections.abc import Iterator

import numpy as np

from vehicles.couplings import BumpStop, Rod
from vehicles.description import Vehicle
from vehicles.passenger_bogie import Damper, SeriesDamper

TOLERANCE = 1e-6  # of the weight: largest force or moment out of balance


def axle_loads(vehicle: Vehicle) -> list[float]:
    """Static vertical forces of the wheelsets on the track [N], in the order of `Vehicle.wheelsets`.

    Every coupling that can carry weight does so at its point, so that force and pitching moment of every body
    balance. Where that is statically indeterminate, the forces with the least sum of squares are taken,
    as of equal springs. Exact for bogie vehicles, whose loads do not depend on stiffness, and for vehicles
    symmetric front to rear.

    Raises
    ------
    ValueError
        The couplings cannot hold the vehicle by vertical forces: a body is not supported.
    """
    rows = {body.name: 2 * i for i, body in enumerate(vehicle.bodies)}
    count = len(vehicle.wheelsets)
    columns = list(_supports(vehicle))
    balance = np.zeros((2 * len(rows), count + len(columns)))
    for k, wheelset in enumerate(vehicle.wheelsets):
        balance[rows[wheelset.body], k] = 1.0
    for k, (body_a, body_b, x) in enumerate(columns, start=count):
        for name, sign in ((body_a, -1.0), (body_b, 1.0)):  # the force acts on B upwards, on A downwards
            row = rows[name]
            balance[row, k] += sign
            balance[row + 1, k] += sign * (x - vehicle.body(name).position[0])
    weights = np.zeros(2 * len(rows))
    weights[::2] = [body.weight for body in vehicle.bodies]
    forces, *_ = np.linalg.lstsq(balance, weights, rcond=None)
    if np.abs(balance @ forces - weights).max() > TOLERANCE * sum(body.weight for body in vehicle.bodies):
        raise ValueError(f"vehicle {vehicle.name}: its couplings cannot carry its bodies by vertical forces")
    return [float(force) for force in forces[:count]]


def _supports(vehicle: Vehicle) -> Iterator[tuple[str, str, float]]:
    """Bodies and place of every coupling that carries weight at rest.

    Left out are bump stops, dampers, elements without vertical stiffness, and rods nearer to horizontal than
    vertical.
    """
    for coupling in vehicle.couplings:
        if isinstance(coupling, BumpStop | Damper | SeriesDamper):
            continue
        if isinstance(coupling, Rod):
            (xa, ya, za), (xb, yb, zb) = coupling.point_a, coupling.point_b
            if abs(zb - za) > math.hypot(xb - xa, yb - ya) and coupling.stiffness > 0.0:
                yield coupling.body_a, coupling.body_b, xb
            continue
        stiffness = getattr(coupling, "stiffness", 1.0)
        if (stiffness[2] if isinstance(stiffness, tuple) else stiffness) > 0.0:
            yield coupling.body_a, coupling.body_b, coupling.point[0]
