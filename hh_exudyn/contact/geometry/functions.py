"""Contact geometry functions and equivalent conicity of EN 15302: geometry alone, no force.

`contact_functions` and `wheelset_functions` (`contact_geometry`) tabulate how wheels touch rails;
`rolling_radius_difference` and `equivalent_conicity` are EN 15302's; `conicity_from_radius_difference`
(`conicity`) starts from a table. Figures of merit on a track are in `merit`.

The displacement is that of the wheelset to the left, y of the track frame. The rolling radius difference is
r_left - r_right, so that it is positive where a displacement to the left steers back to the right; EN 15302's
tables have the same sign. EN 15302 leaves the roll out, and so do the functions after it by default.
"""

import math

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.conicity import conicity_from_radius_difference
from hh_exudyn.contact.geometry.contact_geometry import (
    MAX_LATERAL,
    SMOOTHING,
    wheelset_functions,
)
from hh_exudyn.contact.profile import Profile

CONICITY_STEP = 0.02e-3  # m, of the displacements that conicity is computed from


def rolling_radius_difference(
    wheel_left: Profile,
    rail_left: Profile,
    wheel_right: Profile,
    rail_right: Profile,
    *,
    gauge: float,
    tape_distance: float,
    radius_left: float,
    radius_right: float,
    lateral: FloatArray,
    roll: FloatArray | float | None = 0.0,
    smoothing: float = SMOOTHING,
) -> FloatArray:
    """Rolling radius difference r_left - r_right over the lateral displacement [m], the EN 15302 function.

    Positive at a positive displacement (to the left) steers back.

    Eleven arguments: those of `wheelset_functions`, and so are the errors; but the default of the roll is 0,
    as in EN 15302's reference results.
    """
    return wheelset_functions(
        wheel_left,
        rail_left,
        wheel_right,
        rail_right,
        lateral=lateral,
        radius_left=radius_left,
        radius_right=radius_right,
        gauge=gauge,
        tape_distance=tape_distance,
        roll=roll,
        smoothing=smoothing,
    ).radius_difference


def equivalent_conicity(
    wheel_left: Profile,
    rail_left: Profile,
    wheel_right: Profile,
    rail_right: Profile,
    *,
    gauge: float,
    tape_distance: float,
    radius_left: float,
    radius_right: float,
    amplitudes: FloatArray,
    roll: FloatArray | float | None = 0.0,
    smoothing: float = SMOOTHING,
) -> FloatArray:
    """Equivalent conicity after EN 15302 at the given amplitudes [-].

    Eleven arguments: those of `rolling_radius_difference`, with amplitudes for displacements.

    Parameters
    ----------
    amplitudes : FloatArray
        (m,) half the peak-to-peak displacement [m], above 0 .. 20 mm.
    others
        As `rolling_radius_difference`.

    Returns
    -------
    FloatArray
        (m,) tan gamma_e; see `conicity.conicity_from_radius_difference` for the meaning of zero,
        negative values and NaN. Beyond the flange clearance (`merit.flange_clearance`) the wheel climbs its
        flange and the conicity rises steeply.

    Raises
    ------
    ValueError
        A profile of the wrong kind or a number out of its range.
    """
    waves = np.atleast_1d(np.asarray(amplitudes, dtype=np.float64))
    if waves.ndim != 1 or not ((waves > 0.0) & (waves <= 0.02)).all():
        raise ValueError(f"amplitudes = {waves.tolist()} m, allowed (m,) numbers above 0 .. 0.02 m")
    if not waves.size:
        return waves
    # Motions of unlike wheels or rails lie off the middle: half as far again as the amplitude, and 2 mm
    reach = min(MAX_LATERAL, 1.5 * float(waves.max()) + 2e-3)
    steps = math.ceil(reach / CONICITY_STEP)
    lateral = CONICITY_STEP * np.arange(-steps, steps + 1)
    lateral = lateral[np.abs(lateral) <= MAX_LATERAL]
    difference = rolling_radius_difference(
        wheel_left,
        rail_left,
        wheel_right,
        rail_right,
        gauge=gauge,
        tape_distance=tape_distance,
        radius_left=radius_left,
        radius_right=radius_right,
        lateral=lateral,
        roll=roll,
        smoothing=smoothing,
    )
    first, last = contiguous(difference)
    if last - first < 1:
        return np.full(len(waves), math.nan)
    return conicity_from_radius_difference(
        lateral[first:last],
        difference[first:last],
        radius=0.5 * (radius_left + radius_right),
        tape_distance=tape_distance,
        amplitudes=waves,
    )


def contiguous(values: FloatArray) -> tuple[int, int]:
    """First index and end of the stretch without NaN that holds the middle of an array; (0, 0) if none."""
    good = np.isfinite(values)
    middle = len(values) // 2
    if not good[middle]:
        return 0, 0
    bad_before, bad_after = np.flatnonzero(~good[:middle]), np.flatnonzero(~good[middle:])
    first = int(bad_before[-1]) + 1 if bad_before.size else 0
    last = middle + int(bad_after[0]) if bad_after.size else len(values)
    return first, last
