"""The flexible track under one wheelset: a co-running substructure of seven degrees of freedom.

Two rail masses (lateral and vertical) on pads over one sleeper (lateral, vertical, roll) on ballast. Each
wheelset carries its own along the track; the deflection that a neighbouring wheelset 1.8 m away adds is
left out, and so are rail overturning (the lateral force acts at the rail top, the pad at the foot), lateral
slip of the sleeper in the ballast, and everything that depends on the position between sleepers.

From sleepers to one lump (`SleeperTrack.lumped`): a beam on a Winkler foundation of stiffness k' per metre
(pad and ballast in series, over the sleeper spacing) has at a point the stiffness (Zimmermann 1888)

    K = 2 sqrt(2) (EI)^(1/4) k'^(3/4) = k' 2/beta,   beta = (k' / (4 EI))^(1/4)                         (1)

so K is that of the foundation over the length 2/beta. To first order in frequency the beam with masses m'
and dampers c' per metre has (put k' + i omega c' - omega^2 m' for k' in (1))

    K(omega) = K + (i omega c' - omega^2 m') 3/(2 beta)                                                  (2)

so masses and dampers count over 3/(2 beta). The rail masses are larger than that (see the data file): the
receptance of "concrete" is within 10 % of the beam's up to 35 Hz vertically, up to 20 Hz laterally (27 % at
35 Hz). The gauge spreads under opposite lateral forces 10 to 20 % too little, since the lengths are those of
equal ones. Displacements are from the unloaded track without gravity:
y left, z up, roll about the forward axis (positive lifts the left end).
"""

import math
import tomllib
from dataclasses import dataclass, fields
from importlib import resources
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.kernel import kernel

DOFS = ("y_left", "z_left", "y_right", "z_right", "y_sleeper", "z_sleeper", "roll_sleeper")


class TrackParameters(NamedTuple):
    """Springs and dampers of one wheelset's track, as the kernel takes them. SI units."""

    pad_stiffness_lateral: float
    pad_stiffness_vertical: float
    pad_damping_lateral: float
    pad_damping_vertical: float
    ballast_stiffness_lateral: float
    ballast_stiffness_vertical: float
    ballast_damping_lateral: float
    ballast_damping_vertical: float
    rail_spacing_half: float
    ballast_spacing_half: float


@kernel
def track_forces(
    parameters: TrackParameters,
    q: NDArray[np.float64],
    v: NDArray[np.float64],
    rail_force: NDArray[np.float64],
    force: NDArray[np.float64],
) -> float:
    """Generalized forces on the seven degrees of freedom of one wheelset's track.

    Parameters
    ----------
    parameters : springs and dampers
    q, v : (7,) displacements [m, rad] and velocities, in the order of `DOFS`
    rail_force : (2, 2) contact forces on left and right rail: lateral (to the left), vertical (up) [N]
    force : (7,) written: springs, dampers and contact [N, N m]

    Returns
    -------
    Power lost in the dampers [W], >= 0.
    """
    p = parameters
    power = 0.0
    for i in range(7):
        force[i] = 0.0
    for side in range(2):
        arm = 1.0 - 2.0 * side  # +1 left, -1 right
        y = 2 * side
        z = y + 1
        # pad, lateral: rail against sleeper
        rate = v[y] - v[4]
        f = p.pad_stiffness_lateral * (q[y] - q[4]) + p.pad_damping_lateral * rate
        power += p.pad_damping_lateral * rate * rate
        force[y] += rail_force[side, 0] - f
        force[4] += f
        # pad, vertical: rail against the sleeper's seat below it
        b = arm * p.rail_spacing_half
        rate = v[z] - v[5] - b * v[6]
        f = p.pad_stiffness_vertical * (q[z] - q[5] - b * q[6]) + p.pad_damping_vertical * rate
        power += p.pad_damping_vertical * rate * rate
        force[z] += rail_force[side, 1] - f
        force[5] += f
        force[6] += b * f
        # ballast, vertical: one of two springs
        b = arm * p.ballast_spacing_half
        rate = v[5] + b * v[6]
        f = p.ballast_stiffness_vertical * (q[5] + b * q[6]) + p.ballast_damping_vertical * rate
        power += p.ballast_damping_vertical * rate * rate
        force[5] -= f
        force[6] -= b * f
        # ballast, lateral: one of two springs
        f = p.ballast_stiffness_lateral * q[4] + p.ballast_damping_lateral * v[4]
        power += p.ballast_damping_lateral * v[4] * v[4]
        force[4] -= f
    return power


def _check_positive(owner: object) -> None:
    """Raise ValueError for the first field of a dataclass of floats that is not positive and finite."""
    for item in fields(owner):  # type: ignore[arg-type]
        value = getattr(owner, item.name)
        if not 0.0 < value < math.inf:
            name = f"{item.name} of {type(owner).__name__}"
            raise ValueError(f"{name} is {value} {UNITS[item.name]}, it must be positive and finite")


@dataclass(frozen=True)
class TrackFlexibility:
    """The lumped track under one wheelset. Pad and ballast values are those of ONE of the two sides.

    Vertical ballast springs stand at +-`ballast_spacing_half`, the pads at +-`rail_spacing_half`. The sleeper
    has two masses because a wheelset moves more of the track vertically than laterally.

    Raises ValueError for a value that is not positive and finite.
    """

    rail_mass_lateral: float
    rail_mass_vertical: float
    pad_stiffness_lateral: float
    pad_stiffness_vertical: float
    pad_damping_lateral: float
    pad_damping_vertical: float
    sleeper_mass_lateral: float
    sleeper_mass_vertical: float
    sleeper_roll_inertia: float
    ballast_stiffness_lateral: float
    ballast_stiffness_vertical: float
    ballast_damping_lateral: float
    ballast_damping_vertical: float
    rail_spacing_half: float
    ballast_spacing_half: float

    def __post_init__(self) -> None:
        _check_positive(self)

    def parameters(self) -> TrackParameters:
        """What the kernel `track_forces` takes."""
        return TrackParameters(*(float(getattr(self, name)) for name in TrackParameters._fields))

    def masses(self) -> NDArray[np.float64]:
        """(7,) masses [kg] and roll inertia [kg m2] in the order of `DOFS`; the mass matrix is diagonal."""
        rail = [self.rail_mass_lateral, self.rail_mass_vertical]
        sleeper = [self.sleeper_mass_lateral, self.sleeper_mass_vertical, self.sleeper_roll_inertia]
        return np.array([*rail, *rail, *sleeper])

    def matrices(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Stiffness and damping matrix (7, 7), read from the kernel column by column (it is linear)."""
        parameters, zero, none = self.parameters(), np.zeros(7), np.zeros((2, 2))
        stiffness, damping = np.zeros((7, 7)), np.zeros((7, 7))
        force = np.zeros(7)
        for i, unit in enumerate(np.eye(7)):
            track_forces(parameters, unit, zero, none, force)
            stiffness[:, i] = -force
            track_forces(parameters, zero, unit, none, force)
            damping[:, i] = -force
        return stiffness, damping

    def receptance(self, frequency: float) -> NDArray[np.complex128]:
        """(7, 7) displacements per unit force at a frequency [Hz], >= 0. Static compliance at 0."""
        if not 0.0 <= frequency < math.inf:
            raise ValueError(f"frequency is {frequency} Hz, it must be >= 0 and finite")
        stiffness, damping = self.matrices()
        omega = 2.0 * math.pi * frequency
        dynamic = stiffness + 1j * omega * damping - omega**2 * np.diag(self.masses())
        return np.asarray(np.linalg.inv(dynamic), dtype=np.complex128)

    def modes(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Undamped-equivalent frequencies |lambda| / 2 pi [Hz] and damping ratios -Re(lambda) / |lambda| [-].

        Of the track alone, sorted by frequency; an overdamped mode gives two entries of damping ratio 1.
        """
        stiffness, damping = self.matrices()
        inverse = 1.0 / self.masses()[:, None]
        state = np.block([[np.zeros((7, 7)), np.eye(7)], [-inverse * stiffness, -inverse * damping]])
        roots = np.linalg.eigvals(state)
        roots = roots[roots.imag >= 0.0]
        roots = roots[np.argsort(np.abs(roots))]
        return np.abs(roots) / (2.0 * math.pi), -roots.real / np.abs(roots)

    def static_deflection(self, load: float) -> float:
        """How far both rails go down [m] under a vertical load per wheel [N] on both."""
        stiffness, _ = self.matrices()
        return -float(np.linalg.solve(stiffness, [0.0, -load, 0.0, -load, 0.0, 0.0, 0.0])[1])


@dataclass(frozen=True)
class SleeperTrack:
    """A track on sleepers as sources give it. Pad, ballast and subgrade values are per RAIL SEAT.

    Raises ValueError for a value that is not positive and finite.
    """

    young_modulus: float
    rail_inertia_vertical: float
    rail_inertia_lateral: float
    sleeper_spacing: float
    pad_stiffness_lateral: float
    pad_stiffness_vertical: float
    pad_damping_lateral: float
    pad_damping_vertical: float
    sleeper_mass: float
    sleeper_length: float
    ballast_stiffness_lateral: float
    ballast_stiffness_vertical: float
    ballast_damping_lateral: float
    ballast_damping_vertical: float
    subgrade_stiffness_vertical: float
    subgrade_damping_vertical: float
    rail_spacing_half: float
    rail_mass: float

    def __post_init__(self) -> None:
        _check_positive(self)

    def _decay(self, inertia: float, support: float) -> float:
        """beta of equation (1) [1/m] for a support stiffness per rail seat [N/m]."""
        per_metre = support / self.sleeper_spacing
        return float((per_metre / (4.0 * self.young_modulus * inertia)) ** 0.25)

    def lumped(self) -> TrackFlexibility:
        """The seven degrees of freedom under one wheelset, equations (1) and (2).

        Ballast and subgrade are in series; the mass between them is left out, so that their dampers act in
        proportion to the square of each one's share of the deflection (static condensation, Guyan 1965).
        The lengths are those of both rails loaded alike. The ballast is even along the sleeper: springs at
        length / sqrt(12) have its roll stiffness.
        """
        share = self.ballast_stiffness_vertical / (
            self.ballast_stiffness_vertical + self.subgrade_stiffness_vertical
        )  # of the subgrade in the deflection of the sleeper
        bed = share * self.subgrade_stiffness_vertical  # ballast and subgrade in series
        bed_damping = (
            1.0 - share
        ) ** 2 * self.ballast_damping_vertical + share**2 * self.subgrade_damping_vertical
        beta_z = self._decay(self.rail_inertia_vertical, _series(self.pad_stiffness_vertical, bed))
        beta_y = self._decay(
            self.rail_inertia_lateral, _series(self.pad_stiffness_lateral, self.ballast_stiffness_lateral)
        )
        stiff_y, stiff_z = (2.0 / beta / self.sleeper_spacing for beta in (beta_y, beta_z))  # (1), sleepers
        inert_y, inert_z = (1.5 / beta / self.sleeper_spacing for beta in (beta_y, beta_z))  # (2), sleepers
        return TrackFlexibility(
            rail_mass_lateral=self.rail_mass,
            rail_mass_vertical=self.rail_mass,
            pad_stiffness_lateral=stiff_y * self.pad_stiffness_lateral,
            pad_stiffness_vertical=stiff_z * self.pad_stiffness_vertical,
            pad_damping_lateral=inert_y * self.pad_damping_lateral,
            pad_damping_vertical=inert_z * self.pad_damping_vertical,
            sleeper_mass_lateral=inert_y * self.sleeper_mass,
            sleeper_mass_vertical=inert_z * self.sleeper_mass,
            sleeper_roll_inertia=inert_z * self.sleeper_mass * self.sleeper_length**2 / 12.0,
            ballast_stiffness_lateral=stiff_y * self.ballast_stiffness_lateral,
            ballast_stiffness_vertical=stiff_z * bed,
            ballast_damping_lateral=inert_y * self.ballast_damping_lateral,
            ballast_damping_vertical=inert_z * bed_damping,
            rail_spacing_half=self.rail_spacing_half,
            ballast_spacing_half=self.sleeper_length / math.sqrt(12.0),
        )


def _series(first: float, second: float) -> float:
    """Stiffness of two springs in series [N/m]."""
    return first * second / (first + second)


def _unit(name: str) -> str:
    """SI unit of a field, from its name."""
    for part, unit in (("stiffness", "N/m"), ("damping", "N s/m"), ("roll_inertia", "kg m2"), ("mass", "kg")):
        if part in name:
            return unit
    return {"young_modulus": "Pa", "rail_inertia_vertical": "m4", "rail_inertia_lateral": "m4"}.get(name, "m")


UNITS = {item.name: _unit(item.name) for owner in (TrackFlexibility, SleeperTrack) for item in fields(owner)}


def sleeper_track(name: str) -> SleeperTrack:
    """The track on sleepers of a parameter set in `track/data/flexibility.toml`.

    Raises
    ------
    ValueError
        Unknown name (lists the known ones); a number without unit, or without a source or an assumption.
    """
    sets = tomllib.loads((resources.files("track") / "data" / "flexibility.toml").read_text(encoding="utf-8"))
    if name not in sets:
        raise ValueError(f"track flexibility {name!r} is not known, there are: {', '.join(sorted(sets))}")
    values = {}
    for item in fields(SleeperTrack):
        entry = sets[name].get(item.name, {})
        if "value" not in entry or entry.get("unit") != UNITS[item.name]:
            raise ValueError(f"{item.name} of track {name!r} needs a value and the unit {UNITS[item.name]}")
        if ("source" in entry) == ("assumed" in entry):
            raise ValueError(f"{item.name} of track {name!r} needs either a source or assumed")
        values[item.name] = float(entry["value"])
    return SleeperTrack(**values)


def track_flexibility(name: str) -> TrackFlexibility:
    """The lumped track of a parameter set, "concrete". Raises what `sleeper_track` raises."""
    return sleeper_track(name).lumped()
