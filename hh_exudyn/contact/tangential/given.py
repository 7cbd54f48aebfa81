"""Contact with given creep coefficients and conicity, as linear reference models state them.

A reference model of hunting (suspended wheelset, Cooperrider's bogie) has a rolling radius r0 + conicity * y
and creep forces F_x = -f11 nu_x, F_y = -f22 nu_y, nothing else. So the wheels here are cylinders on crowned
rails, and only the rolling radius grows with the place of the contact on the wheel,

    r = r0 + conicity * y_wheel,                                                                     (1)

without lift or roll. Further effects of a real cone of the same conicity are omitted as in those models: the
wheelset's roll by conicity / half distance (the largest effect: the contact moves laterally 1 + r0 conicity /
half distance times as far as the axle), the gravitational stiffness of yaw and lateral motion, spin creepage.
Cones of 0.1 with the same coefficients give the suspended wheelset a critical speed of 73.15 instead of 73.40
m/s and a frequency of 6.35 instead of 6.27 Hz. There is no friction limit, and creep forces follow the
creepage without delay. Cylinder and rail head carry the load after Hertz, and a flange 8 mm from the rail
limits the lateral motion.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.rail_tables import with_origin
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.tangential.registry import GIVEN
from hh_exudyn.contact.types import GivenCreep, WheelRailModel
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE, NOMINAL_GAUGE

_CROWN_RADIUS = 0.3  # m, of the rail head: that of a 60E1
_CROWN_END = 0.025  # m, from the middle of the head
_FLANGE_START = 0.030  # m, from the running circle
_HEAD_DROP, _HEAD_WIDTH = 0.020, 0.009  # m, of the rail beyond its crown
_FLANGE_HEIGHT, _FLANGE_WIDTH = 0.028, 0.015  # m


def given_contact_model(
    creep: GivenCreep, half_distance: float, nominal_radius: float, damping: float = 0.0
) -> WheelRailModel:
    """The contact of a reference model.

    Cylinders that roll on crowned rails, with creep forces and conicity by the coefficients.

    Parameters
    ----------
    creep : GivenCreep
        Coefficients of one wheel, and conicity.
    half_distance : float
        Half the lateral distance of the contacts on track of nominal gauge [m], 0.4 .. 1.1.
    nominal_radius : float
        Wheel radius r0 [m], 0.2 .. 1.
    damping : float
        d of the normal force N (1 + d * approach rate) [s/m].

    Raises
    ------
    ValueError
        A number out of its range.
    """
    wheel, rail = _cylinder(), _crowned_rail()
    model = wheel_rail_model(
        wheel,
        wheel,
        rail,
        rail,
        nominal_radius=nominal_radius,
        back_to_back=2.0 * (half_distance - FLANGE_BACK_TO_RUNNING_CIRCLE),
        damping=damping,
        theory="linear",
    )
    offset = half_distance - 0.5 * NOMINAL_GAUGE
    return model._replace(
        rails_left=with_origin(model.rails_left, offset),
        rails_right=with_origin(model.rails_right, offset),
        theory=GIVEN,
        given=creep,
    )


def _cylinder() -> Profile:
    y = np.arange(-0.050, _FLANGE_START + _FLANGE_WIDTH, 0.25e-3)
    return Profile("cylinder", "wheel", y, -_fall(y - _FLANGE_START, _FLANGE_HEIGHT, _FLANGE_WIDTH))


def _crowned_rail() -> Profile:
    end = _CROWN_END + _HEAD_WIDTH
    y = np.arange(-end, end + 1e-9, 0.25e-3)
    crown = _CROWN_RADIUS - np.sqrt(_CROWN_RADIUS**2 - y**2)
    return Profile("crown", "rail", y, -crown - _fall(np.abs(y) - _CROWN_END, _HEAD_DROP, _HEAD_WIDTH))


def _fall(beyond: FloatArray, depth: float, width: float) -> FloatArray:
    """A cubic that begins level and curvature-free and reaches `depth` at `width` [m]."""
    return depth * np.clip(beyond / width, 0.0, None) ** 3
