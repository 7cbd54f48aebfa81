"""Stand-ins for the profiles of the Malmbanan line; the drawings are not public.

EVERY NUMBER IS ASSUMED but the flange measures of Table 1-8. They stand, with ranges, in
``hh_exudyn/data/line_profiles.toml``, and were found by a search for shapes that satisfy

* what Hossein-Nia (thesis, KTH 2018) says: flange measures (Table 1-8), which pairs of rails have the highest
  conicity at 1435 and 1445 mm (Fig. 1-13), which rail spreads the contact most and which least (Fig. 1-14),
  two points of contact on the outer wheel with the ground rails, no contact on the gauge corner of MB1
  (section 1.1.4);
* what a grinding train and 100,000 t of traffic leave: no lateral radius below 60 mm up to 24 mm from the
  axis of the rail, where the gauge corner begins;
* a largest pressure between 1.0 and 2.0 GPa under a wheel of 150 kN (coupled strips, friction 0.35) in all
  poses that the loaded wagon (WP4_like) and the locomotive (WPL9_like) take in curves of 400 to 600 m, the
  high rail MB1_like, the low one MB4_like or 60E1.

Where fatigue comes out was no part of the search. Wheel and rail are chains of arcs with common tangents, as
drawings are.

==============  =======================================================================================
``WP4_like``    wagon wheel: flange 26.89 mm thick, 29.08 mm high, qR 10.07 mm (Table 1-8, new wheel)
``WPL9_like``   locomotive wheel: nothing said but its name; the wagon wheel's tread and root with the
                flange of a new S1002 (32.5 and 28 mm, UIC 510-2)
``MB4_like``    "the standard UIC60 rail with a slight gauge corner relief"
``MB1_like``    "more ground at the gauge corner to avoid any contact": on it no wheel touches the corner
==============  =======================================================================================

What the statements leave free is the range of each number in the data file; its head says how pressure,
conicity and places of contact spread over the shapes that satisfy them.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import fsolve

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.standard import head_coordinates, rail_head
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE
from hh_exudyn.sourced import load_parameters

LINE_WHEELS = ("WP4_like", "WPL9_like")
LINE_RAILS = ("MB4_like", "MB1_like")

_STEP_MM = 0.1  # point spacing along the line
_FIELD_EDGE_MM = -62.0
_BACK_ANGLE = 88.0  # degrees
_FLANGE_MEASURE_MM = 10.0  # below the running circle: where Sd is measured and qR begins
_TIP_MEASURE_MM = 2.0  # above the flange tip: where qR ends
_FLANK_SLOPE = 20.0  # of a 60E1, 1:20
_FLANK_LENGTH_MM = 12.0


class _Flange(NamedTuple):
    """Measures of a flange after EN 15313 [mm]."""

    thickness: float  # Sd, 10 mm below the running circle
    height: float  # Sh
    gradient: float  # qR, between 10 mm below the running circle and 2 mm above the flange tip


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
    numbers = load_parameters("hh_exudyn", "line_profiles").table(name)
    flange = _Flange(numbers["flange_thickness"], numbers["flange_height"], numbers["flange_gradient"])
    free = fsolve(lambda x: _misfit(flange, *x), [-8.0, 5.0, 15.0])
    y, z = _wheel_line(*free)
    return y * 1e-3, z * 1e-3


def _misfit(flange: _Flange, cone_end: float, face: float, shoulder_radius: float) -> list[float]:
    """Missing millimetres of Sd, Sh and qR of a wheel, for an end of the field cone, a length of the
    flange's face and a radius of its shoulder [mm]."""
    y, z = _wheel_line(cone_end, face, shoulder_radius)
    front = slice(int(np.searchsorted(y, 0.0)), int(np.argmin(z)) + 1)
    height = -float(z.min())
    first, last = np.interp([_FLANGE_MEASURE_MM, height - _TIP_MEASURE_MM], -z[front], y[front])
    return [
        1e3 * FLANGE_BACK_TO_RUNNING_CIRCLE - first - flange.thickness,
        height - flange.height,
        last - first - flange.gradient,
    ]


def _wheel_line(cone_end: float, face: float, shoulder_radius: float) -> tuple[FloatArray, FloatArray]:
    """The chain of arcs and straights, its running circle at z = 0 [mm]."""
    numbers = load_parameters("hh_exudyn", "line_profiles").table("wheel")
    cone = math.radians(numbers["cone"])
    angles, lengths = [cone, cone], [(cone_end - _FIELD_EDGE_MM) / math.cos(cone)]
    for arc in ("tread", "throat", "root", "hollow_face"):
        angles.append(math.radians(numbers[f"{arc}_end"]))
        lengths.append(numbers[f"{arc}_radius"] * (angles[-1] - angles[-2]))
    shoulder_end = math.radians(numbers["shoulder_end"])
    lengths += [
        face,
        shoulder_radius * (angles[-1] - shoulder_end),
        numbers["tip_radius"] * shoulder_end,
    ]
    y, z = _chain(_FIELD_EDGE_MM, 0.0, [*angles, angles[-1], shoulder_end, 0.0], lengths)
    # over the tip a quarter circle, nearly upright where it meets the flange back
    back = np.radians(np.linspace(0.0, _BACK_ANGLE, 80)[1:])
    radius = (1e3 * FLANGE_BACK_TO_RUNNING_CIRCLE - y[-1]) / math.sin(back[-1])
    over_y, over_z = y[-1] + radius * np.sin(back), z[-1] + radius * (1.0 - np.cos(back))
    z_origin = np.interp(0.0, y, z)
    return np.concatenate([y, over_y]), np.concatenate([z, over_z]) - z_origin


def _chain(y: float, z: float, angles: list[float], lengths: list[float]) -> tuple[FloatArray, FloatArray]:
    """Arcs and straights with common tangents from a point on: angles downwards at their ends (one more than
    lengths) [rad], lengths [mm]."""
    knots = np.concatenate([[0.0], np.cumsum(lengths)])
    along = np.linspace(0.0, knots[-1], math.ceil(knots[-1] / _STEP_MM) + 1)
    # the mean direction of each step is that of its middle: exact for straights, 1e-6 of a step for arcs
    angle = np.interp(0.5 * (along[1:] + along[:-1]), knots, angles)
    step = along[1]
    return (
        y + np.concatenate([[0.0], np.cumsum(step * np.cos(angle))]),
        z - np.concatenate([[0.0], np.cumsum(step * np.sin(angle))]),
    )


def line_rail_coordinates(name: str) -> tuple[FloatArray, FloatArray]:
    """An upright rail head of the line, ground on its gauge side, crown at the origin.

    A 60E1 up to where grinding begins; from there two arcs and a corner, which goes into the flank of the
    60E1: that is where the second arc ends.

    Parameters
    ----------
    name : str
        One of `LINE_RAILS`.

    Returns
    -------
    y, z : FloatArray
        Side coordinates [m], y increasing; spacing about 0.1 mm along the head.
    """
    numbers = load_parameters("hh_exudyn", "line_profiles").table(name)
    drawing = rail_head("60E1")
    new_y, new_z = (1e3 * line for line in head_coordinates(drawing))
    begin = numbers["start"]
    field = new_y < begin - 0.5 * _STEP_MM
    start = math.asin(begin / drawing.radii[0])
    first_end, flank = math.radians(numbers["first_end"]), math.atan(_FLANK_SLOPE)
    radii = numbers["first_radius"], numbers["second_radius"], numbers["corner_radius"]
    height = drawing.radii[0] * (math.cos(start) - 1.0)
    last = _second_end(
        new_y[-1] + new_z[-1] / _FLANK_SLOPE - begin - height / _FLANK_SLOPE, start, first_end, radii
    )
    angles = [start, first_end, last, flank]
    lengths = [
        radius * (end - begun) for radius, begun, end in zip(radii, angles[:-1], angles[1:], strict=True)
    ]
    y, z = _chain(begin, height, [*angles, flank], [*lengths, _FLANK_LENGTH_MM])
    return 1e-3 * np.concatenate([new_y[field], y]), 1e-3 * np.concatenate([new_z[field], z])


def _second_end(reach: float, start: float, first_end: float, radii: tuple[float, float, float]) -> float:
    """Angle where the second arc ends, so that the flank lies `reach` beyond the start [rad], [mm].

    A flank is where its line y + z/20 meets the height of the start; an arc of radius R between the angles a
    and b moves it by R (f(b) - f(a)), f(x) = sin x + cos(x)/20 = sqrt(1 + 1/400) sin(x + atan(1/20)).
    """
    lean = math.atan(1.0 / _FLANK_SLOPE)

    def moved(angle: float) -> float:
        return math.sin(angle + lean) / math.cos(lean)

    first, second, corner = radii
    missing = (
        reach
        - first * (moved(first_end) - moved(start))
        + second * moved(first_end)
        - corner / math.cos(lean)
    )
    return math.asin(math.cos(lean) * missing / (second - corner)) - lean
