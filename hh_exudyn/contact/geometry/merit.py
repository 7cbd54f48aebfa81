"""Figures of merit of a profile pair on a track: flange clearance, conicity, steering in curves, gauge.

All of it follows from the rolling radius difference of `functions`, without roll as in EN 15302.
"""

import math
from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.conicity import conicity_from_radius_difference
from hh_exudyn.contact.geometry.contact_geometry import (
    SMOOTHING,
    TAPE_DISTANCE,
    WheelsetFunctions,
    wheelset_functions,
)
from hh_exudyn.contact.geometry.functions import CONICITY_STEP, contiguous, equivalent_conicity
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import NOMINAL_GAUGE

FLANGE_ANGLE = math.radians(45.0)  # rad: a contact steeper than this is one of the flange
REFERENCE_AMPLITUDE = 3e-3  # m, of the conicity that EN 14363 asks for (clearances of 7 mm and more)
_REACH = 0.025  # m, displacements that are looked at
_NONLINEARITY_AMPLITUDES = np.array([2e-3, 4e-3])  # m


def flange_clearance(functions: WheelsetFunctions) -> tuple[float, float]:
    """Displacements to the right (negative) and to the left at which a flange begins to touch [m].

    The first with a contact angle above 45 degrees on the outer wheel, as fine as the table is; -inf and
    inf where the table ends before.
    """
    right = functions.right.contact_angle > FLANGE_ANGLE
    left = functions.left.contact_angle > FLANGE_ANGLE
    to_right = functions.lateral[right & (functions.lateral < 0.0)]
    to_left = functions.lateral[left & (functions.lateral > 0.0)]
    return (
        float(to_right.max()) if to_right.size else -math.inf,
        float(to_left.min()) if to_left.size else math.inf,
    )


def radial_steering_index(
    functions: WheelsetFunctions,
    *,
    curve_radius: float,
    radius: float,
    tape_distance: float = TAPE_DISTANCE,
) -> float:
    """Rolling radius difference available in a curve over the one that rolling without slip needs [-].

    Available is the greatest difference before the flange of the outer wheel touches (`flange_clearance`);
    needed is e r0 / R, by which the outer wheel runs the longer way. From 1 on a free wheelset can stand
    radially without its flange.

    Parameters
    ----------
    functions : WheelsetFunctions
        A table that reaches beyond the flange clearance.
    curve_radius : float
        Of the track's centre line, positive in left-hand curves (the right wheel is outside), negative in
        right-hand ones [m], absolute value 50 m and more.
    radius : float
        Mean nominal wheel radius r0 [m], 0.1 .. 2.
    tape_distance : float
        Lateral distance of the running circles e [m], 0.3 .. 3.

    Raises
    ------
    ValueError
        A number out of its range, or the table ends before the outer flange touches.
    """
    if not (math.isfinite(curve_radius) and abs(curve_radius) >= 50.0):
        raise ValueError(f"curve_radius = {curve_radius} m, allowed absolute values from 50 m")
    for name, value, low, high in (("radius", radius, 0.1, 2.0), ("tape_distance", tape_distance, 0.3, 3.0)):
        if not low <= value <= high:
            raise ValueError(f"{name} = {value} m, allowed {low} .. {high} m")
    to_right, to_left = flange_clearance(functions)
    outwards = -1.0 if curve_radius > 0.0 else 1.0
    limit = -to_right if curve_radius > 0.0 else to_left
    if math.isinf(limit):
        raise ValueError(
            f"lateral ends at {1e3 * np.abs(functions.lateral).max():.3g} mm, before the outer flange touches"
        )
    shift = outwards * functions.lateral
    available = (outwards * functions.radius_difference)[(shift >= 0.0) & (shift < limit)]
    return float(np.nanmax(available) * abs(curve_radius) / (tape_distance * radius))


def gauge_sensitivity(
    wheel_left: Profile,
    rail_left: Profile,
    wheel_right: Profile,
    rail_right: Profile,
    *,
    gauges: FloatArray,
    radius: float,
    amplitude: float = REFERENCE_AMPLITUDE,
    tape_distance: float = TAPE_DISTANCE,
    smoothing: float = SMOOTHING,
) -> FloatArray:
    """Equivalent conicity at one amplitude over the track gauge [-].

    Nine arguments: those of `functions.equivalent_conicity`, and so are NaN and errors, with one wheel radius
    [m], one amplitude [m] and (n,) gauges [m]; the result is (n,).
    """
    return np.array(
        [
            equivalent_conicity(
                wheel_left,
                rail_left,
                wheel_right,
                rail_right,
                gauge=float(gauge),
                tape_distance=tape_distance,
                radius_left=radius,
                radius_right=radius,
                amplitudes=np.array([amplitude]),
                smoothing=smoothing,
            )[0]
            for gauge in np.atleast_1d(gauges)
        ]
    )


@dataclass(frozen=True)
class ConicityReport:
    """A pair of profiles at one gauge, in numbers that a vehicle engineer asks for; SI.

    Attributes
    ----------
    functions : WheelsetFunctions
        Without roll, over lateral displacements of +-25 mm (less where a profile ends).
    gauge, radius, tape_distance : float
        Of the track and the wheelset [m].
    clearance_right, clearance_left : float
        Displacements at which a flange begins to touch, the first negative [m].
    amplitudes, conicity : FloatArray
        Amplitudes [m] and equivalent conicity [-]; NaN where the amplitude exceeds `largest_amplitude` or
        no motion of that amplitude exists.
    reference_conicity : float
        At 3 mm, as in EN 14363; NaN as above.
    nonlinearity : float
        (tan gamma_e at 4 mm - at 2 mm) / 2 mm [1/m] (Polach 2009; EN 15302:2021); NaN as above.
    """

    functions: WheelsetFunctions
    gauge: float
    radius: float
    tape_distance: float
    clearance_right: float
    clearance_left: float
    amplitudes: FloatArray
    conicity: FloatArray
    reference_conicity: float
    nonlinearity: float

    @property
    def largest_amplitude(self) -> float:
        """Half the way from flange to flange [m]: beyond it the conicity is that of a climbing flange."""
        return 0.5 * (self.clearance_left - self.clearance_right)

    def steering_index(self, curve_radius: float) -> float:
        """See `radial_steering_index`."""
        return radial_steering_index(
            self.functions,
            curve_radius=curve_radius,
            radius=self.radius,
            tape_distance=self.tape_distance,
        )


def _default_amplitudes() -> FloatArray:
    return np.arange(1.0, 9.0) * 1e-3


def conicity_report(
    wheel_left: Profile,
    rail_left: Profile,
    wheel_right: Profile | None = None,
    rail_right: Profile | None = None,
    *,
    radius: float,
    gauge: float = NOMINAL_GAUGE,
    tape_distance: float = TAPE_DISTANCE,
    amplitudes: FloatArray | None = None,
    smoothing: float = SMOOTHING,
) -> ConicityReport:
    """Conicity, flange clearance and nonlinearity of a pair (or two pairs) of profiles at one gauge.

    Nine arguments: four profiles, and by keyword the lengths that callers vary one by one.

    Parameters
    ----------
    wheel_left, rail_left : Profile
        The rail includes its inclination.
    wheel_right, rail_right : Profile, optional
        The same as on the left unless given.
    radius : float
        Nominal radius of both wheels [m], 0.1 .. 2.
    gauge, tape_distance, smoothing : float
        As `functions.wheelset_functions` [m].
    amplitudes : FloatArray, optional
        [m]; 1 to 8 mm unless given. Those beyond the flange clearance are answered with NaN.

    Raises
    ------
    ValueError
        A profile of the wrong kind, a number out of its range, or profiles that do not touch when centred.
    """
    steps = round(_REACH / CONICITY_STEP)
    functions = wheelset_functions(
        wheel_left,
        rail_left,
        wheel_right or wheel_left,
        rail_right or rail_left,
        lateral=CONICITY_STEP * np.arange(-steps, steps + 1, dtype=np.float64),
        radius_left=radius,
        radius_right=radius,
        gauge=gauge,
        tape_distance=tape_distance,
        roll=0.0,
        smoothing=smoothing,
    )
    first, last = contiguous(functions.radius_difference)
    if last - first < 2:
        pair = f"{wheel_left.name} and {rail_left.name}"
        raise ValueError(f"gauge = {gauge} m: {pair} do not touch centred (tape distance {tape_distance} m)")
    to_right, to_left = flange_clearance(functions)
    lateral = functions.lateral
    to_right, to_left = max(to_right, lateral[first]), min(to_left, lateral[last - 1])
    waves = _default_amplitudes() if amplitudes is None else np.atleast_1d(amplitudes).astype(np.float64)
    asked = np.concatenate([waves, [REFERENCE_AMPLITUDE], _NONLINEARITY_AMPLITUDES])
    inside = (lateral >= to_right) & (lateral <= to_left)
    inside[:first] = inside[last:] = False
    conicity = conicity_from_radius_difference(
        lateral[inside],
        functions.radius_difference[inside],
        radius=radius,
        tape_distance=tape_distance,
        amplitudes=asked,
    )
    at_two, at_four = conicity[-2:]
    return ConicityReport(
        functions=functions,
        gauge=gauge,
        radius=radius,
        tape_distance=tape_distance,
        clearance_right=float(to_right),
        clearance_left=float(to_left),
        amplitudes=waves,
        conicity=conicity[: len(waves)],
        reference_conicity=float(conicity[len(waves)]),
        nonlinearity=float((at_four - at_two) / np.ptp(_NONLINEARITY_AMPLITUDES)),
    )
