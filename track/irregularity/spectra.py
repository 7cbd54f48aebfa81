"""Spectra of track irregularities: ERRI B176 low and high, FRA classes 1 to 6.

S is the one-sided power spectral density over the angular wave number Omega [rad/m], in m^2/(rad/m): the
variance is the integral of S over Omega > 0. Over the wave number n = Omega / 2 pi [1/m] it is 2 pi S.
All four signals are lengths as in `track.irregularity.irregularity`.

ERRI B176 (the "German" spectra), with F = Oc^2 / ((O^2 + Or^2) (O^2 + Oc^2)):

    level      Av F                      alignment   Aa F                                     (1), (2)
    gauge      Ag F O^2 / (O^2 + Os^2)   cross-level (2b)^2 (Av / b^2) F O^2 / (O^2 + Os^2)   (3), (4)

The published fourth formula, Av / b^2 ..., has the unit 1/(rad/m): it is the spectrum of the ANGLE of the
cross-level, and (2b)^2 converts it to the height difference of the rails, 2b = 1.5 m apart. Some programs
take it for a height in m^2/(rad/m) and get two thirds of the standard deviation. (4) tends to four times (1)
at short wavelengths, as for two uncorrelated rails.

(1) and (2) reproduce GENSYS's "ORE B176 high level" within 0.1 %. (3) does NOT: GENSYS's gauge spectrum is 4
to 10 times larger. It is another spectrum, or its row means another quantity; the source could not be read.

FRA, rational form ("fra_4"):

    level   k Av Oc^2 / (O^2 (O^2 + Oc^2)),  alignment the same with Aa                       (5), (6)
    gauge and cross-level   4 k Av Oc^2 / ((O^2 + Oc^2) (O^2 + Os^2))                         (7)

Unconfirmed: (6), (7), Aa and Os are from memory of Chinese textbooks (`Spectrum.unconfirmed` names them).

FRA after Fryba ("fra_4_fryba"), longitudinal level only, over n [1/m]:

    S(n) = A n2^2 (n^2 + n1^2) / (n^4 (n^2 + n2^2)),   S(Omega) = S(n) / 2 pi                 (8)

The two FRA forms do not agree: (5) is 14 (class 6) to 80 times (class 4) larger than (8) at wavelengths of
some metres, and which of them describes a class is an open question. ERRI is the safe choice.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.integrate import simpson

from hh_exudyn.arrays import FloatArray
from hh_exudyn.sourced import ParameterSet, load_parameters

SIGNALS = ("level", "alignment", "gauge", "cross_level")  # the four that a recording car gives, in this order
WAVELENGTHS = (0.5, 300.0)  # m, between which a band may lie

_INTERVALS = 4000  # of the integral of a spectrum; Simpson's rule, to 1e-10


def check_wavelengths(name: str, wavelengths: tuple[float, float]) -> None:
    """Raise ValueError unless shortest and longest are in order and within `WAVELENGTHS`."""
    shortest, longest = wavelengths
    if not WAVELENGTHS[0] <= shortest < longest <= WAVELENGTHS[1]:
        raise ValueError(
            f"{name} is {shortest} to {longest} m, allowed are a shortest and a longer longest one between "
            f"{WAVELENGTHS[0]:g} and {WAVELENGTHS[1]:g} m"
        )


def check_signal(signal: str, known: tuple[str, ...] = SIGNALS) -> None:
    """Raise ValueError unless `signal` is one of the known ones."""
    if signal not in known:
        raise ValueError(f"signal {signal!r} is not known, there are: {', '.join(known)}")


_Numbers = Mapping[str, float]  # of a spectrum, by the names of the data file


@dataclass(frozen=True)
class Form:
    """The formula of a family of spectra.

    The record includes its signals, confirmed and unconfirmed.

    Attributes
    ----------
    name : str
        Its name in the data file.
    density : callable
        (signal, Omega^2 [rad^2/m^2], numbers) -> S [m^2/(rad/m)].
    signals : tuple of str
        The signals that it describes.
    unconfirmed : tuple of str
        Signals for which no source of the formula could be read.
    """

    name: str
    density: Callable[[str, FloatArray, _Numbers], FloatArray]
    signals: tuple[str, ...] = SIGNALS
    unconfirmed: tuple[str, ...] = ()


def _erri(signal: str, square: FloatArray, p: _Numbers) -> FloatArray:
    oc = p["omega_c"] ** 2
    shape: FloatArray = oc / ((square + p["omega_r"] ** 2) * (square + oc))
    if signal in ("level", "alignment"):
        return p["a_" + signal] * shape  # (1), (2)
    shape = shape * square / (square + p["omega_s"] ** 2)
    if signal == "gauge":
        return p["a_gauge"] * shape  # (3)
    angle = p["a_level"] / p["half_base"] ** 2 * shape
    return (2.0 * p["half_base"]) ** 2 * angle  # (4)


def _fra(signal: str, square: FloatArray, p: _Numbers) -> FloatArray:
    oc = p["omega_c"] ** 2
    if signal in ("gauge", "cross_level"):
        both: FloatArray = (
            4.0 * p["k"] * p["a_level"] * oc / ((square + oc) * (square + p["omega_s"] ** 2))
        )  # (7)
        return both
    one: FloatArray = p["k"] * p["a_" + signal] * oc / (square * (square + oc))  # (5), (6)
    return one


def _fryba(signal: str, square: FloatArray, p: _Numbers) -> FloatArray:
    n = square / (4.0 * math.pi**2)  # n^2
    top = p["a_level"] * p["n2"] ** 2 * (n + p["n1"] ** 2)
    found: FloatArray = top / (n * n * (n + p["n2"] ** 2)) / (2.0 * math.pi)  # (8)
    return found


FORMS = {
    form.name: form
    for form in (
        Form("erri", _erri),
        Form("fra", _fra, unconfirmed=("alignment", "gauge", "cross_level")),
        Form("fra_fryba", _fryba, signals=("level",)),
    )
}


@dataclass(frozen=True)
class Spectrum:
    """One spectrum: a formula with its numbers.

    Attributes
    ----------
    name, description : str
    form : Form
    numbers : ParameterSet
        In SI units, with their sources.
    """

    name: str
    description: str
    form: Form
    numbers: ParameterSet

    @property
    def wavelengths(self) -> tuple[float, float]:
        """Shortest and longest wavelength of the source [m]."""
        shortest, longest = self.numbers.row("wavelengths")
        return shortest, longest

    @property
    def parameters(self) -> dict[str, float]:
        """Numbers of the formula in SI units, by the names of the data file."""
        return {name: value for name, value in self.numbers.values().items() if "[" not in name}

    @property
    def unconfirmed(self) -> tuple[str, ...]:
        """Numbers that are not confirmed, and signals with an unconfirmed formula."""
        doubtful = (item.name for item in self.numbers.parameters if not item.confirmed)
        return (*doubtful, *self.form.unconfirmed)

    @property
    def signals(self) -> tuple[str, ...]:
        """The signals that it describes."""
        return self.form.signals

    def density(self, signal: str, omega: FloatArray) -> FloatArray:
        """One-sided S of a signal at angular wave numbers omega > 0 [rad/m], in m^2/(rad/m).

        Raises ValueError for a signal that the spectrum does not describe.

        Parameters
        ----------
        signal : str
            One of `signals`.
        omega : array
            Angular wave numbers [rad/m], > 0.
        """
        check_signal(signal, self.signals)
        return self.form.density(signal, np.asarray(omega, dtype=float) ** 2, self.parameters)

    def standard_deviation(self, signal: str, wavelengths: tuple[float, float]) -> float:
        """Standard deviation [m] of a signal in a band of wavelengths [m], by integration.

        Raises ValueError for a band out of `WAVELENGTHS` or a signal that the spectrum does not describe.

        Parameters
        ----------
        signal : str
            One of `signals`.
        wavelengths : (float, float)
            Shortest and longest [m].
        """
        check_wavelengths("wavelengths", wavelengths)
        shortest, longest = wavelengths
        # over ln Omega, in which rational spectra are smooth
        x = np.linspace(math.log(2.0 * math.pi / longest), math.log(2.0 * math.pi / shortest), _INTERVALS + 1)
        omega = np.exp(x)
        return math.sqrt(float(simpson(self.density(signal, omega) * omega, x=x)))


def spectrum_names() -> list[str]:
    """Names of all spectra."""
    return list(load_parameters("track", "spectra").tables)


def spectrum(name: str) -> Spectrum:
    """A spectrum by name: "erri_low", "erri_high", "fra_1" to "fra_6", "fra_1_fryba" to "fra_6_fryba".

    Raises ValueError for an unknown name; the message lists the known ones.
    """
    data = load_parameters("track", "spectra")
    if name not in data.tables:
        raise ValueError(f"spectrum {name!r} is not known, there are: {', '.join(data.tables)}")
    numbers = data.table(name)
    return Spectrum(name, numbers.texts["description"], FORMS[numbers.texts["form"]], numbers)
