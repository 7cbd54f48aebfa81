"""The flexible track under one wheelset: a co-running substructure of seven degrees of freedom.

Topology: two rails (lateral y and vertical z each) on pads, both on ONE body of sleeper and ballast (lateral,
vertical, roll), on ballast and subgrade to the ground. Lateral and vertical motion are not coupled, since the
rails have no overturning freedom: the lateral force acts at the rail top and the pad at its foot, and the
moment between them (0.17 m times Y) is left out. Displacements are from the unloaded track without gravity:
y left, z up, roll about the forward axis (positive lifts the left end).

Passing over the sleepers: at the arc length s the rail's static compliance is that of a beam on supports at
s = 0, d, 2d, ..., to its first harmonic,

    C(s) = C - eps / k_pad cos(2 pi s / d),   by   k_pad(s) = k_pad / (1 - eps cos(2 pi s / d))           (1)

with the amplitude eps from the beam on its supports (`track.support.flexibility`). Over point supports the
beam's compliance has a corner; its second harmonic is a fifth of the first (laterally a tenth). It is
omitted: real pads are as long as a quarter of the spacing, and at 60 km/h it lies at 56 Hz, where the lumped
track is not valid.

The wheel travels with this deflection: its change is partly motion of the rail's material, partly the slope
of the deflected rail. With G(x, s) the deflection at x under a unit load at s, G(x, s) = G(s, x) (Maxwell
and Betti), both parts of the derivative of C(s) = G(s, s) are alike: a force F gives the rail the slope

    F C'(s) / 2 = u/2 d/ds ln(C of the pad),    u the pad's deflection,                                 (2)

(`rail_shift`), and the motion of the material is less by that share. On this slope the contact force has a
longitudinal component, through which the train does the work that passing sleepers do on the track.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.kernel import inlined_kernel, kernel
from track.course.rail_frame import RailShift
from track.support.numbers import check_numbers

DOFS = ("y_left", "z_left", "y_right", "z_right", "y_sleeper", "z_sleeper", "roll_sleeper")
_MAY_VANISH = ("passing_lateral", "passing_vertical")  # from 0 to below 1: equation 1 divides by 1 - eps


class TrackParameters(NamedTuple):
    """Springs and dampers of one wheelset's track, for the kernels. SI units."""

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
    sleeper_spacing: float
    passing_lateral: float  # eps of equation (1)
    passing_vertical: float


@inlined_kernel
def rail_shift(parameters: TrackParameters, s: float, side: int, q: NDArray[np.float64]) -> RailShift:
    """Deflection of a rail (side 0 left, 1 right) and its slopes by equation (2), for q of `track_forces`.

    Parameters
    ----------
    parameters : springs and dampers
    s : arc length of the wheelset along the track [m]
    side : 0 left, 1 right
    q : (7,) displacements [m, rad] in the order of `DOFS`
    """
    p = parameters
    phase = 2.0 * math.pi * s / p.sleeper_spacing
    wave = math.cos(phase)
    rate = 0.5 * math.sin(phase) * 2.0 * math.pi / p.sleeper_spacing
    y, z = q[2 * side], q[2 * side + 1]
    below = q[5] + (1.0 - 2.0 * side) * p.rail_spacing_half * q[6]
    return RailShift(
        y,
        z,
        (y - q[4]) * rate * p.passing_lateral / (1.0 - p.passing_lateral * wave),
        (z - below) * rate * p.passing_vertical / (1.0 - p.passing_vertical * wave),
    )


@kernel
def track_forces(
    parameters: TrackParameters,
    s: float,
    q: NDArray[np.float64],
    v: NDArray[np.float64],
    rail_force: NDArray[np.float64],
    force: NDArray[np.float64],
) -> float:
    """Generalized forces on the seven degrees of freedom of one wheelset's track.

    Parameters
    ----------
    parameters : springs and dampers
    s : arc length of the wheelset along the track [m]; sleepers lie at whole multiples of their spacing
    q, v : (7,) displacements [m, rad] and velocities, in the order of `DOFS`
    rail_force : (2, 2) contact forces on left and right rail: lateral (to the left), vertical (up) [N]
    force : (7,) written: springs, dampers and contact [N, N m]

    Returns
    -------
    Power lost in the dampers [W], >= 0.
    """
    p = parameters
    wave = math.cos(2.0 * math.pi * s / p.sleeper_spacing)
    pad_lateral = p.pad_stiffness_lateral / (1.0 - p.passing_lateral * wave)  # (1)
    pad_vertical = p.pad_stiffness_vertical / (1.0 - p.passing_vertical * wave)  # (1)
    power = 0.0
    for i in range(7):
        force[i] = 0.0
    for side in range(2):
        arm = 1.0 - 2.0 * side  # +1 left, -1 right
        y = 2 * side
        z = y + 1
        # pad, lateral: rail against sleeper
        rate = v[y] - v[4]
        f = pad_lateral * (q[y] - q[4]) + p.pad_damping_lateral * rate
        power += p.pad_damping_lateral * rate * rate
        force[y] += rail_force[side, 0] - f
        force[4] += f
        # pad, vertical: rail against the sleeper's seat below it
        b = arm * p.rail_spacing_half
        rate = v[z] - v[5] - b * v[6]
        f = pad_vertical * (q[z] - q[5] - b * q[6]) + p.pad_damping_vertical * rate
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


@dataclass(frozen=True)
class TrackFlexibility:
    """The lumped track under one wheelset. Pad and ballast values are those of ONE of the two sides.

    Vertical ballast springs stand at +-`ballast_spacing_half`, the pads at +-`rail_spacing_half`. The sleeper
    has two masses because a wheelset moves more of the track vertically than laterally. `passing_lateral` and
    `passing_vertical` are eps of equation (1), 0 for constant stiffness along the track.

    Raises ValueError for a value that is not positive and finite (passing: not from 0 to below 1).
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
    sleeper_spacing: float
    passing_lateral: float
    passing_vertical: float

    def __post_init__(self) -> None:
        check_numbers(self, shares=_MAY_VANISH)

    def evenly_supported(self) -> "TrackFlexibility":
        """The same track with constant stiffness along it."""
        return replace(self, passing_lateral=0.0, passing_vertical=0.0)

    def parameters(self) -> TrackParameters:
        """The parameters of the kernel `track_forces`."""
        return TrackParameters(*(float(getattr(self, name)) for name in TrackParameters._fields))

    def masses(self) -> NDArray[np.float64]:
        """(7,) masses [kg] and roll inertia [kg m2] in the order of `DOFS`; the mass matrix is diagonal."""
        rail = [self.rail_mass_lateral, self.rail_mass_vertical]
        sleeper = [self.sleeper_mass_lateral, self.sleeper_mass_vertical, self.sleeper_roll_inertia]
        return np.array([*rail, *rail, *sleeper])

    def matrices(self, s: float | None = None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Stiffness and damping matrix (7, 7) at arc length s [m], read from the kernel (it is linear).

        Without s: at a quarter of the spacing after a sleeper, where the stiffness has its mean.
        """
        place = 0.25 * self.sleeper_spacing if s is None else s
        parameters, zero, none = self.parameters(), np.zeros(7), np.zeros((2, 2))
        stiffness, damping = np.zeros((7, 7)), np.zeros((7, 7))
        force = np.zeros(7)
        for i, unit in enumerate(np.eye(7)):
            track_forces(parameters, place, unit, zero, none, force)
            stiffness[:, i] = -force
            track_forces(parameters, place, zero, unit, none, force)
            damping[:, i] = -force
        return stiffness, damping

    def receptance(self, frequency: float, s: float | None = None) -> NDArray[np.complex128]:
        """(7, 7) displacements per unit force at a frequency [Hz], >= 0; s as in `matrices`. Static at 0.

        Parameters
        ----------
        frequency : [Hz], >= 0
        s : arc length as in `matrices` [m]
        """
        if not 0.0 <= frequency < math.inf:
            raise ValueError(f"frequency is {frequency} Hz, it must be >= 0 and finite")
        stiffness, damping = self.matrices(s)
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

    def static_deflection(self, load: float, s: float | None = None) -> float:
        """Deflection of both rails [m] under a vertical load per wheel [N] on both; s as in `matrices`.

        Parameters
        ----------
        load : vertical force of each wheel [N]
        s : arc length as in `matrices` [m]
        """
        stiffness, _ = self.matrices(s)
        return -float(np.linalg.solve(stiffness, [0.0, -load, 0.0, -load, 0.0, 0.0, 0.0])[1])
