"""Stand-ins for the profiles of the Malmbanan line; the drawings are not public.

EVERY NUMBER HERE IS ASSUMED, chosen so that the statements of Hossein-Nia (thesis, KTH 2018, section 1.1.4
and Table 1-8) on the profiles hold; nothing else is known of them. A wheel is a chain of arcs and straights
with common tangents, as drawings are; a rail is a 60E1 with a gauge corner ground off by a smooth depth.

==============  =======================================================================================
``WP4_like``    wagon wheel: flange 26.89 mm thick, 29.08 mm high, qR 10.07 mm (Table 1-8, new wheel)
``WPL9_like``   locomotive wheel: only its name is known; the wagon wheel's tread with the flange of a
                new S1002 (32.5 and 28 mm, UIC 510-2)
``MB4_like``    "the standard UIC60 rail with a slight gauge corner relief"
``MB1_like``    "more ground at the gauge corner to avoid any contact": on it no wheel touches the corner
==============  =======================================================================================
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import fsolve

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.standard import rail_head_coordinates
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE

_STEP_MM = 0.1  # point spacing along the line


class _Wheel(NamedTuple):
    """Parameters of a wheel, all assumed except those of Table 1-8 [mm], [degrees]."""

    flange_thickness: float  # Sd, 10 mm below the running circle
    flange_height: float  # Sh
    flange_gradient: float  # qR, between 10 mm below the running circle and 2 mm above the flange tip
    cone: float  # angle of the cone on the field side
    tread_radius: float  # of the hollow arc between cone and throat
    throat_start: float  # angle where tread arc and throat arc join
    throat_radius: float
    root_start: float  # angle where throat and root join
    root_radius: float
    flange_angle: float
    shoulder_end: float  # angle where the shoulder of the flange passes into its tip
    tip_radius: float


class _Pass(NamedTuple):
    """One pass of grinding, all assumed: depth below a 60E1 over the distance from its axis [mm]."""

    start: float  # distance at which it begins
    full: float  # distance from which it has its full depth
    depth: float


_WHEELS = {
    "WP4_like": _Wheel(26.89, 29.08, 10.07, 2.0, 1225.0, 3.3, 134.0, 17.0, 15.0, 70.0, 26.0, 12.0),
    "WPL9_like": _Wheel(32.5, 28.0, 10.8, 2.0, 1225.0, 3.3, 134.0, 17.0, 15.0, 70.0, 26.0, 12.0),
}
_GRINDING = {
    "MB4_like": (_Pass(-14.8, 6.3, 0.15), _Pass(12.2, 36.0, 0.9)),
    "MB1_like": (_Pass(8.0, 36.0, 2.5),),
}
LINE_WHEELS = tuple(_WHEELS)
LINE_RAILS = tuple(_GRINDING)

_FIELD_EDGE_MM = -62.0
_BACK_ANGLE = 88.0  # degrees
_FLANGE_MEASURE_MM = 10.0  # below the running circle: level of Sd and of one end of qR
_TIP_MEASURE_MM = 2.0  # above the flange tip: level of the other end of qR


def line_wheel_coordinates(name: str) -> tuple[FloatArray, FloatArray]:
    """A wheel of the line, from the field side to the flange back.

    Parameters
    ----------
    name : str
        One of `LINE_WHEELS`.

    Returns
    -------
    y, z : FloatArray
        Side coordinates [m], y increasing; spacing about 0.1 mm.
    """
    wheel = _WHEELS[name]
    free = fsolve(lambda x: _misfit(wheel, *x), [-25.0, 5.0, 15.0])
    y, z = _wheel_line(wheel, *free)
    return y * 1e-3, z * 1e-3


def _misfit(wheel: _Wheel, cone_end: float, face: float, shoulder_radius: float) -> list[float]:
    """Missing millimetres of Sd, Sh and qR of a wheel, for an end of the field cone, a length of the
    flange's face and a radius of its shoulder [mm]."""
    y, z = _wheel_line(wheel, cone_end, face, shoulder_radius)
    front = slice(int(np.searchsorted(y, 0.0)), int(np.argmin(z)) + 1)
    height = -float(z.min())
    first, last = np.interp([_FLANGE_MEASURE_MM, height - _TIP_MEASURE_MM], -z[front], y[front])
    return [
        1e3 * FLANGE_BACK_TO_RUNNING_CIRCLE - first - wheel.flange_thickness,
        height - wheel.flange_height,
        last - first - wheel.flange_gradient,
    ]


def _wheel_line(
    wheel: _Wheel, cone_end: float, face: float, shoulder_radius: float
) -> tuple[FloatArray, FloatArray]:
    """The chain of arcs and straights, its running circle at z = 0 [mm]."""
    down = np.radians(
        [wheel.cone, wheel.throat_start, wheel.root_start, wheel.flange_angle, wheel.shoulder_end, 0.0]
    )
    lengths = np.array(
        [
            (cone_end - _FIELD_EDGE_MM) / math.cos(down[0]),
            wheel.tread_radius * (down[1] - down[0]),
            wheel.throat_radius * (down[2] - down[1]),
            wheel.root_radius * (down[3] - down[2]),
            face,
            shoulder_radius * (down[3] - down[4]),
            wheel.tip_radius * down[4],
        ]
    )
    angles = down[[0, 0, 1, 2, 3, 3, 4, 5]]
    knots = np.concatenate([[0.0], np.cumsum(lengths)])
    along = np.linspace(0.0, knots[-1], math.ceil(knots[-1] / _STEP_MM) + 1)
    # the mean direction of each step is that of its middle: exact for straights, 1e-6 of a step for arcs
    angle = np.interp(0.5 * (along[1:] + along[:-1]), knots, angles)
    step = along[1]
    y = _FIELD_EDGE_MM + np.concatenate([[0.0], np.cumsum(step * np.cos(angle))])
    z = -np.concatenate([[0.0], np.cumsum(step * np.sin(angle))])
    # over the tip a quarter circle, nearly upright where it meets the flange back
    back = np.radians(np.linspace(0.0, _BACK_ANGLE, 80)[1:])
    radius = (1e3 * FLANGE_BACK_TO_RUNNING_CIRCLE - y[-1]) / math.sin(back[-1])
    over_y, over_z = y[-1] + radius * np.sin(back), z[-1] + radius * (1.0 - np.cos(back))
    z_origin = np.interp(0.0, y, z)
    return np.concatenate([y, over_y]), np.concatenate([z, over_z]) - z_origin


def line_rail_coordinates(name: str) -> tuple[FloatArray, FloatArray]:
    """An upright rail head of the line, one of `LINE_RAILS`, ground on its gauge side, crown at the origin.

    Coordinates as those of `line_wheel_coordinates`, the spacing along the head.
    """
    y, z = rail_head_coordinates("60E1")
    depth = np.zeros(len(y))
    for start, full, deep in _GRINDING[name]:
        depth += 1e-3 * deep * _smooth_step((1e3 * y - start) / (full - start))
    return y, z - depth


def _smooth_step(x: FloatArray) -> FloatArray:
    """From 0 to 1 between x = 0 and 1, with continuous curvature."""
    t = np.clip(x, 0.0, 1.0)
    return np.asarray(t**3 * (10.0 - 15.0 * t + 6.0 * t**2))
