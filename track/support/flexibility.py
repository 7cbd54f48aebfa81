"""From sleepers to the lumped track under one wheelset: `track_flexibility("concrete")`.

The parameters of the seven degrees of freedom of `track.support.substructure` are no data of components: a
wheel bends the rail over several sleepers, and their number depends on direction and frequency. So they are
fitted to the receptance of the rail on its sleepers (`track.support.sleepers`), averaged along the track, in
four cases: lateral and vertical, both rails loaded alike or opposite.

* Statics exactly: in each direction two stiffnesses give both cases' static receptance. Laterally the pad
  from the gauge spreading, the ballast from the remainder; vertically pad and bed share the deflection as
  under a sleeper, and the spacing of the bed's springs gives the roll stiffness.
* Dynamics by least squares of the relative receptance error from 0 to `VALID_TO`: masses and dampers.
* The rail masses have a least value, `LEAST_RAIL_MASS`: the beam's own effective mass (55 to 80 kg) would
  vibrate on the contact spring too fast for an explicit step.

Largest error of the complex receptance, anywhere along the track, 0 to 35 Hz (to 20 Hz), in per cent, and
the deflection under 150 kN on each rail:

==================  ===============  ===========================  ===============================
set                 deflection [mm]  lateral alike, opposite      vertical alike, opposite
==================  ===============  ===========================  ===============================
`concrete`          1.95             12.3 (3.8),  12.1 (4.6)       1.3 (1.2),   1.3 (1.2)
`concrete_frozen`   1.20             11.2 (3.6),  10.1 (4.2)       4.3 (2.0),   4.2 (2.0)
`concrete_soft`     2.75             13.5 (4.1),  14.5 (4.9)      11.8 (8.0),  12.0 (8.2)
`concrete_stiff`    1.37             10.5 (3.3),  10.2 (4.6)       2.9 (1.6),   2.7 (1.5)
`wooden`            1.88             15.8 (4.7),  11.6 (5.1)       1.4 (1.3),   1.4 (1.3)
`wooden_frozen`     1.13             12.1 (3.9),  10.2 (4.3)       4.0 (2.0),   4.0 (2.0)
==================  ===============  ===========================  ===============================

The lateral error is due to the surplus of rail mass. Above 35 Hz the lumped track is not valid: unfrozen
"concrete" resonates vertically at 67 Hz, where the rail on its sleepers and ballast does so at 52 Hz and half
as high, since it radiates waves.

Left out: the deflection that a neighbouring wheelset adds (4 to 11 % of its own at 1.78 m, by Zimmermann's
line of influence), waves that travel along the rail, overturning of the rail, lateral slip of the sleeper in
the ballast.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from track.support.sleepers import Direction, Loading, SleeperTrack, series, sleeper_track
from track.support.substructure import TrackFlexibility

VALID_TO = 35.0  # Hz, of the vehicle and track model (Hossein-Nia 2018, section 1.2.1)
LEAST_RAIL_MASS = 150.0  # kg, on contact springs of 1.7 GN/m: stable up to steps of 0.45 ms (test_stability)
LARGEST_RATE = 1000.0  # 1/s, most pad damping over rail mass; steps of 0.4 ms would allow 6000
_CASES: tuple[Loading, Loading] = ("alike", "opposite")
_FREQUENCIES = np.linspace(5.0, VALID_TO, 7)
_PULL = 0.02  # relative receptance error with the same weight as a factor e between unknown and guess

_ComplexArray = NDArray[np.complexfloating[Any, Any]]


@cache
def track_flexibility(name: str) -> TrackFlexibility:
    """The lumped track of a parameter set, "concrete". Raises what `sleeper_track` raises."""
    return lumped(sleeper_track(name))


def lumped(sleepers: SleeperTrack) -> TrackFlexibility:
    """Lumped track under one wheelset, fitted to the receptance of a track on sleepers."""
    lateral = {case: _static(sleepers, "lateral", case) for case in _CASES}
    vertical = {case: _static(sleepers, "vertical", case) for case in _CASES}

    pad_y = lateral["opposite"]
    ballast_y = 1.0 / (1.0 / lateral["alike"] - 1.0 / pad_y)
    pad_z, bed_z = sleepers.pad_stiffness_vertical, sleepers.bed_stiffness_vertical
    scale = vertical["alike"] / series(pad_z, bed_z).real
    pad_z, bed_z = scale * pad_z, scale * bed_z
    roll_ratio = 1.0 / (1.0 / vertical["opposite"] - 1.0 / pad_z) / bed_z

    omega = 2.0 * math.pi * _FREQUENCIES

    def lateral_model(rail: float, pad: float, sleeper: float, ballast: float) -> list[_ComplexArray]:
        over = pad_y + 1j * omega * pad
        below = ballast_y + 1j * omega * ballast - omega**2 * sleeper / 2.0
        return [_on_rail(over, below, rail, omega), 1.0 / (over - omega**2 * rail)]

    def vertical_model(
        rail: float, pad: float, sleeper: float, bed: float, roll: float
    ) -> list[_ComplexArray]:
        over = pad_z + 1j * omega * pad
        spring = bed_z + 1j * omega * bed
        rolling = spring * roll_ratio - omega**2 * roll / 2.0  # inertia over the square of the seat's arm
        return [
            _on_rail(over, spring - omega**2 * sleeper / 2.0, rail, omega),
            _on_rail(over, rolling, rail, omega),
        ]

    # first guess: values of one rail seat times the number of sleepers in motion
    moved_y = pad_y / sleepers.pad_stiffness_lateral
    moved_z = pad_z / sleepers.pad_stiffness_vertical
    share = bed_z / moved_z / sleepers.subgrade_stiffness_vertical  # of the subgrade in the bed's deflection
    bed = (
        1.0 - share
    ) ** 2 * sleepers.ballast_damping_vertical + share**2 * sleepers.subgrade_damping_vertical
    mass = sleepers.sleeper_mass + 2.0 * share**2 * sleepers.ballast_mass
    guess_y = [sleepers.pad_damping_lateral, sleepers.sleeper_mass, sleepers.ballast_damping_lateral]
    guess_z = [sleepers.pad_damping_vertical, mass, bed, mass * sleepers.roll_ratio]
    y = _fit(sleepers, "lateral", lateral_model, [moved_y * value for value in guess_y])
    z = _fit(sleepers, "vertical", vertical_model, [moved_z * value for value in guess_z])
    return TrackFlexibility(
        rail_mass_lateral=y[0],
        rail_mass_vertical=z[0],
        pad_stiffness_lateral=pad_y,
        pad_stiffness_vertical=pad_z,
        pad_damping_lateral=y[1],
        pad_damping_vertical=z[1],
        sleeper_mass_lateral=y[2],
        sleeper_mass_vertical=z[2],
        sleeper_roll_inertia=z[4] * sleepers.rail_spacing_half**2,
        ballast_stiffness_lateral=ballast_y,
        ballast_stiffness_vertical=bed_z,
        ballast_damping_lateral=y[3],
        ballast_damping_vertical=z[3],
        rail_spacing_half=sleepers.rail_spacing_half,
        ballast_spacing_half=math.sqrt(roll_ratio) * sleepers.rail_spacing_half,
        sleeper_spacing=sleepers.sleeper_spacing,
        passing_lateral=pad_y * _passing(sleepers, "lateral"),
        passing_vertical=pad_z * _passing(sleepers, "vertical"),
    )


def _on_rail(
    over: _ComplexArray, below: _ComplexArray, rail: float, omega: NDArray[np.float64]
) -> _ComplexArray:
    """Receptance of a rail mass on a pad on a substructure of receptance `below`."""
    return 1.0 / (over * below / (over + below) - omega**2 * rail)


def _mean(sleepers: SleeperTrack, direction: Direction, loading: Loading, frequency: float) -> complex:
    """Receptance of the rail [m/N], mean along the track."""
    found = [
        sleepers.receptance(direction, loading, frequency, share * sleepers.sleeper_spacing)
        for share in _half_span(6)
    ]
    return complex(np.mean(found))


def _static(sleepers: SleeperTrack, direction: Direction, loading: Loading) -> float:
    """Static stiffness under a wheel [N/m]."""
    return 1.0 / _mean(sleepers, direction, loading, 0.0).real


def _passing(sleepers: SleeperTrack, direction: Direction) -> float:
    """First Fourier coefficient of the rail's static compliance along the track, rails alike [m/N], > 0."""
    places = _half_span(20)  # the compliance has a corner on the sleepers: 0.1 % in this coefficient
    compliance = [
        sleepers.receptance(direction, "alike", 0.0, share * sleepers.sleeper_spacing).real
        for share in places
    ]
    return -2.0 * float(np.mean(compliance * np.cos(2.0 * math.pi * places)))


def _half_span(count: int) -> NDArray[np.float64]:
    """Places of the midpoint rule from a sleeper to the middle between two, in spacings."""
    return 0.5 * (np.arange(count) + 0.5) / count


def _fit(
    sleepers: SleeperTrack,
    direction: Direction,
    model: Callable[..., list[_ComplexArray]],
    guess: list[float],
) -> list[float]:
    """Rail mass and the parameters of `guess`, of least relative error against the rail on sleepers.

    `guess` is a pad's damper, then any order of masses and dampers. The unknowns are logarithms of the ratio
    to the guess, in bounds of 1/2 and 4, and a weak penalty keeps parameters that the receptance does
    not determine near their guess: no part becomes so light or so damped that it would limit the time step.
    """
    exact = [
        np.array([_mean(sleepers, direction, case, frequency) for frequency in _FREQUENCIES])
        for case in _CASES
    ]
    scale = np.array([LEAST_RAIL_MASS, *guess])

    def errors(unknown: NDArray[np.float64]) -> NDArray[np.float64]:
        found = model(*(scale * np.exp(unknown)))
        relative = np.concatenate([a / b - 1.0 for a, b in zip(found, exact, strict=True)])
        return np.concatenate([relative.real, relative.imag, _PULL * unknown[1:]])

    lower, upper = np.full(scale.size, -math.log(2.0)), np.full(scale.size, math.log(4.0))
    lower[0] = 0.0
    upper[1] = min(upper[1], math.log(LEAST_RAIL_MASS * LARGEST_RATE / guess[0]))
    start = np.clip(np.full(scale.size, 0.1), lower, upper - 0.01)
    solution = least_squares(errors, start, bounds=(lower, upper))
    return [float(value) for value in scale * np.exp(solution.x)]
