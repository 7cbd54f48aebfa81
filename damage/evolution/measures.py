"""Measures of a wheel over its life: flange, hollow, diameter, equivalent conicity."""

from dataclasses import dataclass, field

import numpy as np

from hh_exudyn.contact.functions import TAPE_DISTANCE, equivalent_conicity
from hh_exudyn.contact.profile import Profile, rail_profile
from hh_exudyn.contact.profiles.measures import (
    flange_angle,
    flange_height,
    flange_steepness,
    flange_thickness,
    tread_hollow,
)
from hh_exudyn.conventions import NOMINAL_GAUGE


def _standard_rail() -> Profile:
    return rail_profile("60E1", 1 / 30)


@dataclass(frozen=True)
class ConicityTrack:
    """Track and amplitude for the equivalent conicity (EN 15302), with the same wheel on both sides.

    Attributes
    ----------
    rail_left, rail_right
        The rails; 60E1 1:30 by default.
    gauge
        [m].
    tape_distance
        Between the running circles [m].
    amplitude
        Half the peak-to-peak displacement of the wheelset [m].
    """

    rail_left: Profile = field(default_factory=_standard_rail)
    rail_right: Profile = field(default_factory=_standard_rail)
    gauge: float = NOMINAL_GAUGE
    tape_distance: float = TAPE_DISTANCE
    amplitude: float = 3e-3


@dataclass(frozen=True)
class WheelMeasures:
    """Measures of one wheel profile, lengths [m].

    Attributes
    ----------
    diameter
        At the running circle.
    flange_height, flange_thickness, flange_steepness
        Sh, Sd and qR of EN 15313.
    flange_angle
        Largest angle of the flange face [rad].
    hollow
        Depth of a hollow tread.
    conicity
        Equivalent conicity [-]; NaN where there is none at that amplitude.
    """

    diameter: float
    flange_height: float
    flange_thickness: float
    flange_steepness: float
    flange_angle: float
    hollow: float
    conicity: float


def measure(wheel: Profile, radius: float, track: ConicityTrack) -> WheelMeasures:
    """Measure a wheel of some radius at its running circle [m].

    Parameters
    ----------
    wheel
        The wheel profile.
    radius
        At the running circle [m].
    track
        Rails, gauge and amplitude for the equivalent conicity.

    Raises
    ------
    ValueError
        The profile is a rail's, or a number of the track is out of its range.
    """
    conicity = equivalent_conicity(
        wheel, track.rail_left, wheel, track.rail_right, gauge=track.gauge, tape_distance=track.tape_distance,
        radius_left=radius, radius_right=radius, amplitudes=np.array([track.amplitude]),
    )  # fmt: skip
    return WheelMeasures(
        diameter=2.0 * radius,
        flange_height=flange_height(wheel),
        flange_thickness=flange_thickness(wheel),
        flange_steepness=flange_steepness(wheel),
        flange_angle=flange_angle(wheel),
        hollow=tread_hollow(wheel),
        conicity=float(conicity[0]),
    )
