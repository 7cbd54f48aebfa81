"""Stresses below a line contact: Hertz pressure with the traction of full slip or of partial slip (Carter).

K.L. Johnson, Contact Mechanics, 1985, equations 4.49, 7.8 and 8.8-8.12; equations 2.16-2.20 and 3.3-3.9 of
Hossein-Nia (KTH, 2018). Plane strain in the plane of rolling, half-spaces of equal material.

Frame and signs: x in rolling direction from the middle of the patch, so that the leading edge is x = +a;
depth is positive into the body. Tension is positive. The traction q acts on the body at hand, positive in
rolling direction. At the surface sigma_z = -p and tau_xz = -q, since the outward normal points against the
depth. For the wheel, (x, depth) are x and z of the contact frame and q is the library's traction on the
wheel: positive when driving, and then the leading edge is compressed and the trailing edge pulled. For the
rail, depth points downwards, and q is the opposite of the wheel's.

Chapter 3 of the thesis has the leading edge at x = -a: turn the signs of x, q and tau_xz to compare.

Method: with zeta = x - i depth, S = sqrt(a^2 - zeta^2) = m + i n of equation 3.6 and T = S - i zeta, which is
analytic in the body, vanishes far away and has the real part sqrt(a^2 - x^2) at the surface. With its
derivatives dT/dx = -i T/S and dT/dz = -T/S the stresses of equations 3.5 (pressure p0) and 3.7 (traction
q0) are

    (p0/a) times  sigma_x = -Re(T - z T/S)     sigma_z = -Re(T + z T/S)    tau_xz = Im(z T/S)
    (q0/a) times  sigma_x = Im(2 T - z T/S)    sigma_z = Im(z T/S)         tau_xz = -Re(T - z T/S)

Nothing cancels far away, and T/S, singular at the edges of the patch, meets its factor z = 0 there.
"""

import cmath
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import STEEL
from hh_exudyn.kernel import kernel


@dataclass(frozen=True)
class SubsurfaceStress:
    """Stresses in plane strain; tau_xy and tau_yz are zero. Arrays of equal shape, tension positive.

    Attributes
    ----------
    sigma_x, sigma_y, sigma_z : ndarray
        Normal stresses in rolling direction, along the axle and along the normal [Pa].
    tau_xz : ndarray
        Orthogonal shear stress [Pa].
    """

    sigma_x: FloatArray
    sigma_y: FloatArray
    sigma_z: FloatArray
    tau_xz: FloatArray

    @property
    def principal_shear(self) -> FloatArray:
        """Largest shear stress in the plane of rolling, equation 3.9 [Pa].

        Johnson's and the thesis's elastic limits are made with it.
        """
        return np.hypot(0.5 * (self.sigma_x - self.sigma_z), self.tau_xz)

    @property
    def max_shear(self) -> FloatArray:
        """Largest of the three principal shear stresses (Tresca), equation 3.1 [Pa].

        Beneath the middle of a patch with friction it exceeds `principal_shear`: there sigma_y is the largest
        principal stress (least compression).
        """
        middle = 0.5 * (self.sigma_x + self.sigma_z)
        shear = self.principal_shear
        # half of the differences sigma_1 - sigma_2, sigma_1 - sigma_y and sigma_y - sigma_2
        return np.maximum(shear, 0.5 * (shear + np.abs(middle - self.sigma_y)))

    @property
    def von_mises(self) -> FloatArray:
        """Equivalent stress of von Mises; yield is at sqrt(3) k, equation 3.2 [Pa]."""
        return np.sqrt(
            0.5 * (self.sigma_x - self.sigma_y) ** 2
            + 0.5 * (self.sigma_y - self.sigma_z) ** 2
            + 0.5 * (self.sigma_z - self.sigma_x) ** 2
            + 3.0 * self.tau_xz**2
        )


@kernel
def full_slip_stress(
    x: float, depth: float, half_length: float, max_pressure: float, max_traction: float
) -> tuple[float, float, float]:
    """Stresses under p = p0 sqrt(1 - (x/a)^2) and q = q0 sqrt(1 - (x/a)^2).

    Kernel: trusts its input.

    Parameters
    ----------
    x, depth : float
        Place, from the middle of the patch and from the surface; depth >= 0 [m].
    half_length : float
        a [m], > 0.
    max_pressure, max_traction : float
        p0 and q0 [Pa]; the signs are those of the module's docstring.

    Returns
    -------
    tuple of float
        sigma_x, sigma_z, tau_xz [Pa].
    """
    zeta = complex(x, -depth)
    root = cmath.sqrt((half_length - zeta) * (half_length + zeta))
    # n has the sign of x (equation 3.6); on the surface outside the patch the root cannot know it
    root = complex(root.real, math.copysign(root.imag, x))
    along = half_length / (root + complex(depth, x))  # T/a = (S - i zeta)/a, without the cancellation
    fade = complex(0.0, 0.0)  # (z/a) T/S; 0 at the surface, also at the edges, where S is 0
    if depth > 0.0:
        fade = depth * along / root
    sigma_x = -max_pressure * (along.real - fade.real) + max_traction * (2.0 * along.imag - fade.imag)
    sigma_z = -max_pressure * (along.real + fade.real) + max_traction * fade.imag
    tau_xz = max_pressure * fade.imag - max_traction * (along.real - fade.real)
    return sigma_x, sigma_z, tau_xz


@kernel
def partial_slip_stress(
    x: float,
    depth: float,
    half_length: float,
    max_pressure: float,
    max_traction: float,
    stick_half_length: float,
) -> tuple[float, float, float]:
    """Stresses under Hertz pressure and Carter's traction (kernel: trusts its input).

    Carter's traction is that of full slip less the same ellipse over the stick zone, which ends at the
    leading edge x = +a (equations 2.16-2.18):
    q = q0 sqrt(1 - (x/a)^2) - q0 (d/a) sqrt(1 - ((x - a + d)/d)^2).

    Parameters
    ----------
    x, depth, half_length, max_pressure : float
        As `full_slip_stress`.
    max_traction : float
        q0 = +- friction * p0, with the sign of the tangential force on the body [Pa].
    stick_half_length : float
        d [m]: 0 in full slip, a without tangential force.

    Returns
    -------
    tuple of float
        sigma_x, sigma_z, tau_xz [Pa].
    """
    sigma_x, sigma_z, tau_xz = full_slip_stress(x, depth, half_length, max_pressure, max_traction)
    if stick_half_length > 0.0:
        minus_x, minus_z, minus_xz = full_slip_stress(
            x - half_length + stick_half_length,
            depth,
            stick_half_length,
            0.0,
            -max_traction * stick_half_length / half_length,
        )
        sigma_x += minus_x
        sigma_z += minus_z
        tau_xz += minus_xz
    return sigma_x, sigma_z, tau_xz


@kernel
def _fill(
    x: FloatArray,
    depth: FloatArray,
    half_length: float,
    max_pressure: float,
    max_traction: float,
    stick_half_length: float,
    sigma_x: FloatArray,
    sigma_z: FloatArray,
    tau_xz: FloatArray,
) -> None:
    """`partial_slip_stress` over one-dimensional arrays."""
    for i in range(x.size):
        sigma_x[i], sigma_z[i], tau_xz[i] = partial_slip_stress(
            x[i], depth[i], half_length, max_pressure, max_traction, stick_half_length
        )


def stick_half_length(half_length: float, friction: float, traction_ratio: float) -> float:
    """Half length d of Carter's stick zone [m], from |Q|/P = mu (1 - (d/a)^2) (equation 2.20, corrected).

    Parameters
    ----------
    half_length : float
        a [m], > 0.
    friction : float
        Friction coefficient mu [-], >= 0.
    traction_ratio : float
        Tangential over normal force Q/P [-], |Q/P| <= mu.

    Raises
    ------
    ValueError
        If an argument lies outside its range.
    """
    _check_load(half_length, 0.0, friction, traction_ratio)
    if friction == 0.0:
        return half_length
    return half_length * math.sqrt(1.0 - abs(traction_ratio) / friction)


def line_contact_stress(
    x: ArrayLike,
    depth: ArrayLike,
    half_length: float,
    max_pressure: float,
    friction: float = 0.0,
    *,
    traction_ratio: float | None = None,
    poisson_ratio: float = STEEL.poisson_ratio,
) -> SubsurfaceStress:
    """Stresses below (and on) the surface of a rolling line contact in full or partial slip.

    Parameters
    ----------
    x, depth : array_like
        Places, broadcast against each other: in rolling direction from the middle of the patch, and into the
        body, depth >= 0 [m].
    half_length : float
        Half length a of the patch [m], > 0.
    max_pressure : float
        Hertz pressure p0 [Pa], >= 0.
    friction : float
        Friction coefficient mu [-], >= 0.
    traction_ratio : float, optional
        Tangential over normal force Q/P [-], -mu .. mu, positive where Q acts on the body in rolling
        direction (a driving wheel, a rail under braking). |Q/P| < mu is partial slip after Carter. Without
        it: full slip, Q/P = mu.
    poisson_ratio : float
        [-], 0..0.5; it enters sigma_y only.

    Returns
    -------
    SubsurfaceStress
        Frame and signs as in the module's docstring.

    Raises
    ------
    ValueError
        If an argument lies outside its range.
    """
    half_length, max_pressure, friction = float(half_length), float(max_pressure), float(friction)
    ratio = friction if traction_ratio is None else float(traction_ratio)
    _check_load(half_length, max_pressure, friction, ratio)
    if not 0.0 <= poisson_ratio <= 0.5:
        raise ValueError(f"poisson_ratio = {poisson_ratio} [-]; it must lie in 0..0.5")
    places = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(depth, dtype=np.float64))
    if not (np.all(np.isfinite(places[0])) and np.all(np.isfinite(places[1]))):
        raise ValueError("x and depth must be finite [m]")
    if np.any(places[1] < 0.0):
        raise ValueError(f"depth = {places[1].min()} m; it must be >= 0 m, into the body")
    shape = places[0].shape
    sigma_x, sigma_z, tau_xz = (np.empty(places[0].size) for _ in range(3))
    _fill(
        places[0].ravel(), places[1].ravel(), half_length, max_pressure,
        math.copysign(friction * max_pressure, ratio), stick_half_length(half_length, friction, ratio),
        sigma_x, sigma_z, tau_xz,
    )  # fmt: skip
    return SubsurfaceStress(
        sigma_x.reshape(shape),
        (poisson_ratio * (sigma_x + sigma_z)).reshape(shape),
        sigma_z.reshape(shape),
        tau_xz.reshape(shape),
    )


def _check_load(half_length: float, max_pressure: float, friction: float, traction_ratio: float) -> None:
    """ValueError for a load out of range."""
    if not (math.isfinite(half_length) and half_length > 0.0):
        raise ValueError(f"half_length = {half_length} m; it must be finite and > 0 m")
    if not (math.isfinite(max_pressure) and max_pressure >= 0.0):
        raise ValueError(f"max_pressure = {max_pressure} Pa; it must be finite and >= 0 Pa")
    if not (math.isfinite(friction) and friction >= 0.0):
        raise ValueError(f"friction = {friction} [-]; it must be finite and >= 0")
    if not abs(traction_ratio) <= friction:
        raise ValueError(
            f"traction_ratio = {traction_ratio} [-]; it must lie in {-friction}..{friction}, the friction"
        )
