"""The strips of a wheel: fixed on its profile, along the arc, narrower in flange root and flange.

A strip is a ring of the wheel. It lies where it lies on the wheel whatever the pose, so that every quantity
of a strip is a continuous function of the pose.
"""

import math
from enum import IntEnum

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.types import SplineTable, WheelStrips

TREAD_WIDTH, FLANGE_WIDTH = 1.25e-3, 0.75e-3  # m, of strips
_TREAD_END = 0.020  # m, y on the wheel profile where flange root begins and strips become narrower
CAPACITY = 192  # strips of one wheel at most; a multiple of 8, for vector instructions
_SAMPLING = 20e-6  # m, of the arc length


class Row(IntEnum):
    """Quantities of the strips of one wheel during an evaluation, rows of an array (ROWS, CAPACITY).

    Only strips whose undeformed surface lies inside the rail have a column, in the order of the profile.
    """

    NUMBER = 0  # of the strip on the wheel
    OVERLAP = 1  # along the mean normal of wheel and rail [m]
    COSINE = 2  # of the contact angle, the mean of wheel and rail (positive towards the flange)
    SINE = 3
    X = 4  # the strip's point on the wheel from the wheelset's centre, axes of R [m]
    Y = 5
    Z = 6
    Y_RAIL = 7  # place on the rail profile, side coordinates [m]
    ARC = 8  # place along the arc of the wheel profile [m]
    WIDTH = 9  # along the arc [m]
    RADIUS = 10  # rolling radius [m]
    CURVATURE = 11  # half the curvature of the wheel in rolling direction, along the normal [1/m]
    LOAD = 12  # normal force of the strip [N]
    HALF_LENGTH = 13  # [m]
    PRESSURE = 14  # in the strip's middle [Pa]
    A = 15  # semi-axes of the ellipse of which the strip is a part [m]
    B = 16
    PEAK = 17  # load per width in the middle of that ellipse [N/m]
    CENTRE = 18  # 1 where the quantities of the ellipse are those of the strip before, else 0
    NU_X = 19  # creepages at the strip [-], [-], [1/m]
    NU_Y = 20
    PHI = 21
    MEAN_X = 22  # longitudinal and lateral creepage in the middle of the ellipse [-]
    MEAN_Y = 23
    FRICTION = 24
    APPROACH_RATE = 25  # [m/s]
    FORCE_X = 26  # creep force on the wheel and its moment about the strip's normal [N], [N m]
    FORCE_Y = 27
    MOMENT_Z = 28
    HEADING = 29  # of the rail at the strip against R [-]
    SLOPE = 30
    TURN_X = 31  # longitudinal creepage in the middle of the ellipse by the strips' lengths [-]: see `creep`
    REFINED = 32  # pressure in the strip's middle by the second solution [Pa]: for the records alone


ROWS = len(Row)


def wheel_strips(wheel: SplineTable, tread: float = TREAD_WIDTH, flange: float = FLANGE_WIDTH) -> WheelStrips:
    """The strips of a wheel profile.

    Parameters
    ----------
    wheel : SplineTable
        Of the wheel profile, side coordinates.
    tread, flange : float
        Width of the strips along the arc [m], on either side of y = 20 mm; both grow together where there
        would be more than `CAPACITY`.

    Returns
    -------
    WheelStrips
    """
    start, end = wheel.start, wheel.start + wheel.step * (wheel.z.size - 1)
    y = np.linspace(start, end, math.ceil((end - start) / _SAMPLING) + 1)
    z = _evaluate(wheel, y)[0]
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(y), np.diff(z)))])
    change = float(np.interp(min(max(_TREAD_END, start), end), y, arc))
    wide, narrow = math.floor(change / tread), math.floor((arc[-1] - change) / flange)
    while wide + narrow > CAPACITY:
        tread, flange = 1.1 * tread, 1.1 * flange
        wide, narrow = math.floor(change / tread), math.floor((arc[-1] - change) / flange)
    # counted from the change on, so that a profile that ends elsewhere has the same strips
    middle = np.concatenate(
        [change - tread * (np.arange(wide, 0, -1) - 0.5), change + flange * (np.arange(narrow) + 0.5)]
    )
    place = np.interp(middle, arc, y)
    height, slope = _evaluate(wheel, place)
    width = np.concatenate([np.full(wide, tread), np.full(narrow, flange)])
    return WheelStrips(place, height, slope, middle, width)


def _evaluate(wheel: SplineTable, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Height [m] and slope [-] of a profile at many places."""
    values = np.array([spline_evaluate(wheel, float(place))[:2] for place in y])
    return values[:, 0].copy(), values[:, 1].copy()
