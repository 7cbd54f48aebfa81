"""Track irregularities: the four signals that a recording car gives, random or measured.

In the track frame (x forward, y left, z up), from the displacements y, z of the two rails:

=============  ==========================  ==================================================================
`level`        (z_left + z_right) / 2      longitudinal level, positive where the track is too high
`alignment`    (y_left + y_right) / 2      positive where the track lies too far to the left
`gauge`        y_left - y_right            deviation from the alignment's gauge, positive too wide
`cross_level`  z_right - z_left            deviation from its cant, positive where the RIGHT rail is too
                                           high, as the cant column of `track.course.types.Node`
=============  ==========================  ==================================================================

so the left rail moves by y = alignment + gauge / 2, z = level - cross_level / 2, and the right one by
y = alignment - gauge / 2, z = level + cross_level / 2. The rails are fixed to the sleeper, so that they also
roll by cross_level / 1.5 m, as they do with cant (`track.course.rail_frame`). Level and alignment are means
of both rails, as in the thesis (Hossein-Nia, section 1.1.3).

A random track is a sum of cosines with the spectrum's amplitudes and random phases (Shinozuka and Deodatis,
Appl. Mech. Rev. 44(4), 1991, 191-204):

    f(s) = sum_k sqrt(2 S(O_k) dO) cos(O_k s + phi_k),   O_k = k dO,   dO = 2 pi / length          (1)

over wavelengths within a band, by default 3 to 70 m (bands D1 and D2 of EN 13848-1, those of recording cars
and of UIC 518). At 60 km/h 3 m is a frequency of 5.6 Hz; forces up to 20 Hz need wavelengths down to 0.8 m.
The standard deviation over the whole length is that of the spectrum for every seed; the track repeats after
`length`. The phases are made from the bits of PCG64, a stream that numpy guarantees, so a seed gives the same
track on every machine (to rounding). Another sampling step samples the same track, another length gives
another track, and "erri_low" and "erri_high" of one seed and length have the same phases, since these
spectra differ by scale alone.
"""

import math
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from hh_exudyn.arrays import FloatArray
from track.irregularity.spectra import (
    SIGNALS,
    WAVELENGTHS,
    Spectrum,
    check_signal,
    check_wavelengths,
    spectrum,
)
from track.irregularity.table import IrregularityTable, irregularity_table
from track.irregularity.wavelength_bands import wavelength_band

BAND = (3.0, 70.0)  # m, wavelengths of random tracks by default
POINTS_PER_WAVELENGTH = 6  # a spline's second derivative is then 9 % small, ((2 pi / 6)^2 / 12)

_LENGTH = (20.0, 1e6)  # m, of a random track
_STRETCH = (1.0, 1e6)  # m, of any
_STEP = (0.01, 10.0)  # m
_FADE = (1.0, 1000.0)  # m
_LARGEST = 0.5  # m, of an irregularity
_DEVIATION = (0.0, 0.1)  # m, of a scaled signal


def _check(name: str, value: float, limits: tuple[float, float], unit: str = "m") -> None:
    """Raise ValueError unless `value` lies within `limits`; NaN does not."""
    if not limits[0] <= value <= limits[1]:
        raise ValueError(f"{name} is {value} {unit}, allowed are {limits[0]:g} to {limits[1]:g} {unit}")


@dataclass(frozen=True, eq=False)
class Irregularity:
    """The four signals along a stretch of track, at equal spacing.

    Attributes
    ----------
    start : float
        Arc length of the first sample [m].
    step : float
        Sample spacing [m].
    values : (n, 4) array
        Level, alignment, gauge and cross-level [m], the order of `SIGNALS`.
    shortest : float
        Shortest wavelength in the signals [m]; None, the default, for `POINTS_PER_WAVELENGTH` times `step`.

    Raises
    ------
    ValueError
        Values of another shape, not finite or above 0.5 m; start, step, length or `shortest` out of range.
    """

    start: float
    step: float
    values: FloatArray = field(repr=False)
    shortest: float | None = None

    def __post_init__(self) -> None:
        _check("start", self.start, (-1e6, 1e6))
        _check("step", self.step, _STEP)
        if self.values.ndim != 2 or self.values.shape[1] != len(SIGNALS):
            raise ValueError(f"values has shape {self.values.shape}, it must be (n, {len(SIGNALS)})")
        _check("length", self.length, _STRETCH)
        bad = ~(np.abs(self.values) <= _LARGEST)
        if bad.any():
            row, column = np.argwhere(bad)[0]
            at = self.start + row * self.step
            raise ValueError(
                f"{SIGNALS[column]} at s = {at:g} m is {self.values[row, column]} m, "
                f"allowed are {-_LARGEST:g} to {_LARGEST:g} m"
            )
        if self.shortest is not None:
            _check("shortest", self.shortest, WAVELENGTHS)

    @property
    def length(self) -> float:
        """From the first to the last sample [m]."""
        return self.step * (len(self.values) - 1)

    @property
    def s(self) -> FloatArray:
        """Arc lengths of the samples [m]."""
        return self.start + self.step * np.arange(len(self.values), dtype=float)

    def signal(self, name: str) -> FloatArray:
        """One of the four signals [m] by name."""
        check_signal(name)
        column: FloatArray = self.values[:, SIGNALS.index(name)]
        return column

    def filtered(self, wavelengths: tuple[float, float]) -> Self:
        """The part in a band of wavelengths [m], with zero phase; see `wavelength_bands.wavelength_band`."""
        values = wavelength_band(self.values, self.step, wavelengths)
        return replace(self, values=values, shortest=max(wavelengths[0], self.shortest or 0.0))

    def standard_deviation(self, name: str, wavelengths: tuple[float, float] | None = None) -> float:
        """Standard deviation [m] of a signal, as it is or in a band of wavelengths [m].

        Parameters
        ----------
        name : str
            Of the signal.
        wavelengths : (float, float) or None
            Shortest and longest [m]; None for all.
        """
        values = self.signal(name)
        return float(
            np.std(values if wavelengths is None else wavelength_band(values, self.step, wavelengths))
        )

    def scaled(self, deviations: dict[str, float], wavelengths: tuple[float, float] | None = None) -> Self:
        """Signals scaled to given standard deviations.

        Parameters
        ----------
        deviations : dict
            Standard deviation [m] by signal; signals that are not named are unchanged. 0 removes one.
        wavelengths : (float, float) or None
            Band [m] in which the standard deviation is taken; the whole signal is scaled.

        Raises
        ------
        ValueError
            Unknown signal, a deviation out of 0 to 0.1 m, or a signal that is zero in the band.
        """
        factors = np.ones(len(SIGNALS))
        for name, wanted in deviations.items():
            check_signal(name)
            _check(f"standard deviation of {name}", wanted, _DEVIATION)
            present = self.standard_deviation(name, wavelengths)
            if wanted > 0.0 and not present > 0.0:
                raise ValueError(f"{name} is zero, it cannot be scaled to a standard deviation of {wanted} m")
            factors[SIGNALS.index(name)] = wanted / present if wanted > 0.0 else 0.0
        return replace(self, values=self.values * factors)

    def mirrored(self) -> Self:
        """The mirror image: what was left is right."""
        return replace(self, values=self.values * np.array([1.0, -1.0, 1.0, -1.0]))

    def table(self, fade: float = 50.0) -> IrregularityTable:
        """Splines for the kernels, faded in and out over `fade` metres (1 to 1000) at either end.

        So a run begins and ends on smooth track, and value, slope and second derivative are continuous.

        Raises ValueError where `fade` is out of range or longer than half of the length.
        """
        _check("fade", fade, _FADE)
        if 2.0 * fade > self.length:
            raise ValueError(
                f"the irregularity is {self.length:g} m long; faded in and out over {fade:g} m at either end "
                f"it must have {2.0 * fade:g} m or more"
            )
        return irregularity_table(self.start, self.step, self.values, fade)

    def check_spacing(self, speed: float, time_step: float, frequency: float | None = None) -> None:
        """Raise ValueError where samples are too coarse for a run.

        Parameters
        ----------
        speed : float
            [m/s], 0.1 to 100.
        time_step : float
            Of the time integration [s], 1e-6 to 0.1. One step may not pass more than a sixth of the shortest
            wavelength, or the excitation is sampled too coarsely in time.
        frequency : float or None
            Up to which the run is to be excited [Hz]: the shortest wavelength must not be longer than
            speed / frequency, and six samples must lie on that wavelength.
        """
        _check("speed", speed, (0.1, 100.0), "m/s")
        _check("time_step", time_step, (1e-6, 0.1), "s")
        held = POINTS_PER_WAVELENGTH * self.step  # shortest wavelength that the samples hold
        shortest = self.shortest or held
        if shortest < held * (1.0 - 1e-9):
            raise ValueError(
                f"step is {self.step:g} m, allowed is up to {shortest / POINTS_PER_WAVELENGTH:g} m, a sixth "
                f"of the shortest wavelength of {shortest:g} m"
            )
        if speed * time_step > shortest / POINTS_PER_WAVELENGTH:
            raise ValueError(
                f"time_step is {time_step:g} s, at {speed:g} m/s allowed is up to "
                f"{shortest / POINTS_PER_WAVELENGTH / speed:g} s, a sixth of the shortest wavelength of "
                f"{shortest:g} m"
            )
        if frequency is None:
            return
        _check("frequency", frequency, (0.1, 1000.0), "Hz")
        wanted = speed / frequency
        if self.shortest is not None and shortest > wanted * (1.0 + 1e-9):
            raise ValueError(
                f"the shortest wavelength is {shortest:g} m, which at {speed:g} m/s is {speed / shortest:g} "
                f"Hz: {frequency:g} Hz need {wanted:g} m"
            )
        if held > wanted * (1.0 + 1e-9):
            raise ValueError(
                f"step is {self.step:g} m, too coarse for {frequency:g} Hz at {speed:g} m/s: allowed is up "
                f"to {wanted / POINTS_PER_WAVELENGTH:g} m"
            )


def random_irregularity(
    source: str | Spectrum,
    length: float,
    seed: int,
    *,
    wavelengths: tuple[float, float] = BAND,
    step: float = 0.25,
    start: float = 0.0,
) -> Irregularity:
    """A random track with the spectra of a class: equation (1) of the module.

    Parameters
    ----------
    source : str or Spectrum
        Name or spectrum, see `spectra.spectrum`. Signals that it does not describe are zero.
    length : float
        From `start` on [m], 20 m to 1000 km, at least the longest wavelength.
    seed : int
        The same seed gives the same track; >= 0.
    wavelengths : (float, float)
        Shortest and longest [m]. Outside `Spectrum.wavelengths` the spectrum is extrapolated.
    step : float
        Largest sample spacing [m], up to a sixth of the shortest wavelength.
    start : float
        Arc length of the first sample [m].

    Raises
    ------
    ValueError
        Unknown spectrum, a number out of range, or no wavelength of (1) within the band.
    """
    given = spectrum(source) if isinstance(source, str) else source
    check_wavelengths("wavelengths", wavelengths)
    _check("length", length, (max(_LENGTH[0], wavelengths[1]), _LENGTH[1]))
    _check("step", step, (_STEP[0], wavelengths[0] / POINTS_PER_WAVELENGTH))
    if not isinstance(seed, int) or seed < 0:
        raise ValueError(f"seed is {seed!r}, it must be an integer >= 0")
    count = math.ceil(length / step - 1e-9)
    first = math.ceil(length / wavelengths[1] - 1e-9)
    harmonics = np.arange(first, math.floor(length / wavelengths[0] + 1e-9) + 1)
    if harmonics.size == 0:
        raise ValueError(
            f"wavelengths is {wavelengths[0]:g} to {wavelengths[1]:g} m: none of length / k = {length:g} m "
            "/ k lies in it; take a longer track or a wider band"
        )
    interval = 2.0 * math.pi / length  # rad/m
    omega = interval * harmonics.astype(float)
    values = np.zeros((count + 1, len(SIGNALS)))
    for column, name in enumerate(SIGNALS):
        if name not in given.signals:
            continue
        amplitudes = np.sqrt(2.0 * given.density(name, omega) * interval)
        phases = random_phases(seed, column, harmonics.size)
        coefficients = np.zeros(count // 2 + 1, dtype=complex)
        coefficients[harmonics] = 0.5 * count * amplitudes * np.exp(1j * phases)
        values[:-1, column] = np.fft.irfft(coefficients, count)
    values[-1] = values[0]  # (1) repeats after `length`
    return Irregularity(start, length / count, values, wavelengths[0])


def random_phases(seed: int, stream: int, count: int) -> FloatArray:
    """Phases uniform in 0 to 2 pi [rad], the same on every machine: the upper 53 bits of PCG64's numbers.

    Parameters
    ----------
    seed : int
        >= 0.
    stream : int
        Number of the stream of that seed.
    count : int
        Number of phases.
    """
    bits = np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(stream,))).random_raw(count)
    phases: FloatArray = 2.0 * math.pi * 2.0**-53 * (np.asarray(bits) >> np.uint64(11)).astype(float)
    return phases
