"""A track on sleepers by the data of its components, and the exact receptance of its rails.

The rail is a Timoshenko beam (shear and rotary inertia; Timoshenko 1921) on supports one sleeper spacing d
apart, infinitely long. Two load cases of the two rails suffice: both loaded `alike`, or `opposite`, where
vertically the sleeper rolls and laterally it rests while the gauge widens. With deflection w, rotation theta,
moment M and shear force V the beam is, at the angular frequency omega,

    w' = theta + V / (kappa G A),   theta' = M / (E I)                                                    (1)
    M' = -V - rho I omega^2 theta,   V' = -rho A omega^2 w                                                (2)

so a state y = (w, theta, M, V) is transferred over a length x by exp(A x), over a support of dynamic
stiffness K by V+ = V- + K w, and over one spacing by a matrix with the waves of the periodic track as its
eigenvectors. Those that decay to the right and to the left, joined where a unit force makes V jump, give the
receptance. This is exact at any frequency, 0 included; for d -> 0 it tends to Winkler's even foundation
(Zimmermann 1888).
"""

import math
from dataclasses import dataclass, fields, replace
from typing import Literal

import numpy as np
from scipy.linalg import expm

from hh_exudyn.sourced import Parameter, ParameterSet, load_parameters
from track.support.numbers import check_numbers, unit_of

Direction = Literal["lateral", "vertical"]
Loading = Literal["alike", "opposite"]


@dataclass(frozen=True)
class SleeperTrack:
    """Data of a track on sleepers. Pad, ballast and subgrade values are per RAIL SEAT.

    Raises ValueError for a value that is not positive and finite.
    """

    young_modulus: float
    shear_modulus: float
    rail_inertia_vertical: float
    rail_inertia_lateral: float
    rail_area: float
    rail_shear_coefficient: float
    rail_mass_per_length: float
    sleeper_spacing: float
    pad_stiffness_lateral: float
    pad_stiffness_vertical: float
    pad_damping_lateral: float
    pad_damping_vertical: float
    sleeper_mass: float
    sleeper_length: float
    ballast_mass: float
    ballast_stiffness_lateral: float
    ballast_stiffness_vertical: float
    ballast_damping_lateral: float
    ballast_damping_vertical: float
    subgrade_stiffness_vertical: float
    subgrade_damping_vertical: float
    rail_spacing_half: float

    def __post_init__(self) -> None:
        check_numbers(self)

    @property
    def bed_stiffness_vertical(self) -> float:
        """Ballast and subgrade in series, per rail seat [N/m]."""
        return series(self.ballast_stiffness_vertical, self.subgrade_stiffness_vertical).real

    @property
    def roll_ratio(self) -> float:
        """Roll stiffness of an even bed over that of springs below the rails, l^2 / 12 / seat^2 [-]."""
        return self.sleeper_length**2 / 12.0 / self.rail_spacing_half**2

    def support(self, direction: Direction, loading: Loading, omega: float) -> complex:
        """Dynamic stiffness of one rail seat [N/m] at an angular frequency [rad/s].

        The sleeper is rigid, a uniform bar on a uniform bed. Laterally the ballast is fixed to the ground.

        Parameters
        ----------
        direction, loading : lateral or vertical; both rails alike or opposite
        omega : angular frequency [rad/s]
        """
        half_sleeper = -(omega**2) * 0.5 * self.sleeper_mass
        if direction == "lateral":
            pad = self.pad_stiffness_lateral + 1j * omega * self.pad_damping_lateral
            if loading == "opposite":
                return pad
            ballast = self.ballast_stiffness_lateral + 1j * omega * self.ballast_damping_lateral
            return series(pad, ballast + half_sleeper)
        pad = self.pad_stiffness_vertical + 1j * omega * self.pad_damping_vertical
        ballast = self.ballast_stiffness_vertical + 1j * omega * self.ballast_damping_vertical
        ground = self.subgrade_stiffness_vertical + 1j * omega * self.subgrade_damping_vertical
        below = series(ballast, ground - omega**2 * self.ballast_mass) + half_sleeper
        return series(pad, below * (self.roll_ratio if loading == "opposite" else 1.0))

    def receptance(
        self, direction: Direction, loading: Loading, frequency: float, after_sleeper: float
    ) -> complex:
        """Displacement of a rail per unit force on each rail, below the force [m/N].

        Parameters
        ----------
        direction, loading : of the forces
        frequency : [Hz], >= 0
        after_sleeper : place of the forces after a sleeper [m], from 0 to the sleeper spacing

        Raises
        ------
        ValueError
            Frequency or place out of range.
        """
        if not 0.0 <= frequency < math.inf:
            raise ValueError(f"frequency is {frequency} Hz, it must be >= 0 and finite")
        if not 0.0 <= after_sleeper <= self.sleeper_spacing:
            raise ValueError(
                f"after_sleeper is {after_sleeper} m, it must be from 0 to {self.sleeper_spacing} m"
            )
        omega = 2.0 * math.pi * frequency
        inertia = self.rail_inertia_lateral if direction == "lateral" else self.rail_inertia_vertical
        bending = self.young_modulus * inertia
        shear = self.rail_shear_coefficient * self.shear_modulus * self.rail_area
        mass = self.rail_mass_per_length
        beam = np.zeros((4, 4))  # moments and forces over the bending stiffness
        beam[0, 1], beam[0, 3] = 1.0, bending / shear  # (1)
        beam[1, 2] = 1.0
        beam[2, 1], beam[2, 3] = -mass * inertia / self.rail_area * omega**2 / bending, -1.0  # (2)
        beam[3, 0] = -mass * omega**2 / bending
        support = np.eye(4, dtype=np.complex128)
        support[3, 0] = self.support(direction, loading, omega) / bending
        cell = expm(beam * after_sleeper) @ support @ expm(beam * (self.sleeper_spacing - after_sleeper))
        factors, waves = np.linalg.eig(cell)
        order = np.argsort(np.abs(factors))  # two decay to the right, two to the left
        joined = np.hstack([waves[:, order[:2]], -waves[:, order[2:]]])
        amplitudes = np.linalg.solve(joined, [0.0, 0.0, 0.0, -1.0 / bending])
        return complex(waves[0, order[:2]] @ amplitudes[:2])


def series(first: complex, second: complex) -> complex:
    """Stiffness of two springs in series [N/m].

    Parameters
    ----------
    first, second : stiffnesses [N/m]
    """
    return first * second / (first + second)


UNITS = {item.name: unit_of(item.name) for item in fields(SleeperTrack)}


def sleeper_track_names() -> tuple[str, ...]:
    """Names of the parameter sets in `track/data/flexibility.toml`."""
    return _sets().tables


def sleeper_track_numbers(name: str) -> tuple[Parameter, ...]:
    """All numbers behind a set, those of its base first, each by set and quantity.

    Raises ValueError for an unknown name (lists the known ones).
    """
    own = _set(name)
    base = sleeper_track_numbers(own.texts["based_on"]) if "based_on" in own.texts else ()
    left = (item for item in base if item.name.split(".", 1)[1] not in own or _FACTOR in item.name)
    return (*left, *(replace(item, name=f"{name}.{item.name}") for item in own.parameters))


def sleeper_track(name: str) -> SleeperTrack:
    """The track on sleepers of a parameter set in `track/data/flexibility.toml`.

    A set may be `based_on` another: it then gives numbers of its own, or a factor on the other's.

    Raises
    ------
    ValueError
        Unknown name (lists the known ones); an unknown number, one in another unit, or a missing one.
    """
    own = _set(name)
    values = dict(vars(sleeper_track(own.texts["based_on"]))) if "based_on" in own.texts else {}
    for item in own.parameters:
        key = item.name.removeprefix(_FACTOR)
        factor = key != item.name
        unit = "-" if factor else UNITS.get(key)
        if key not in UNITS or (factor and key not in values):
            known = ", ".join(sorted(UNITS))
            raise ValueError(f"{item.name} of track {name!r} is not known, there are: {known}")
        if item.unit != unit:
            raise ValueError(f"{item.name} of track {name!r} is in {item.unit!r}, allowed is {unit!r}")
        values[key] = values[key] * item.value if factor else item.value
    missing = sorted(UNITS.keys() - values.keys())
    if missing:
        raise ValueError(f"track {name!r} has no {missing[0]} [{UNITS[missing[0]]}]")
    return SleeperTrack(**values)


_FACTOR = "factor."  # the table of a set that changes its base's numbers


def _sets() -> ParameterSet:
    """The file of parameter sets."""
    return load_parameters("track", "flexibility")


def _set(name: str) -> ParameterSet:
    """One set of the file. Raises ValueError for an unknown name (lists the known ones)."""
    known = _sets()
    if name not in known.tables:
        names = ", ".join(sorted(known.tables))
        raise ValueError(f"track flexibility {name!r} is not known, there are: {names}")
    return known.table(name)
