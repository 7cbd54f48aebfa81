"""Ratchetting: plastic shear that grows with every passage, layer by layer below the surface.

A. Kapoor and F.J. Franklin, Tribological layers and the wear of ductile materials, Wear 245 (2000);
Hossein-Nia (2018), equations 3.25 and 3.26. A layer whose largest orthogonal shear stress exceeds its
strength gains plastic strain with every cycle,

    dgamma/dN = C (tau_zx,max(z)/k_eff - 1)  where positive
    k_eff = k0 max(1, beta sqrt(1 - exp(-alpha gamma)))

and fails at the critical strain. Layers do not act on one another. The strain per cycle is taken as a rate
and integrated by scipy's pair of Bogacki and Shampine (third order, its error estimated by the second), all
layers at once, from one failure or wear-off of a layer to the next: millions of cycles in some hundred steps.

Wear brings layers to the surface: the layer at depth z lies at z - wear N after N cycles, has the stress of
that depth, and is worn off at depth 0.

No number but C has a confirmed source; see `RatchettingSteel`.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import pyarrow
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

from damage.bounds import check_above_zero, check_not_below_zero
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.normal.subsurface import line_contact_stress

_PLACES = 401  # along x, in each of the two passes of the search for the largest shear stress
_ROUNDING = 1e-12  # of strains, relative


@dataclass(frozen=True)
class RatchettingSteel:
    """Strength, hardening and ductility of a steel.

    Attributes
    ----------
    shear_yield
        Initial strength in shear k0 [Pa].
    rate
        C of equation 3.25 [-]: 0.00237, measured on BS11 rail steel (published); of wheel steels not known.
    hardening_rate
        alpha of equation 3.26 [-]; assumed.
    hardening_limit
        beta of equation 3.26 [-], >= 1: k_eff saturates at beta k0; assumed. 1 is no hardening.
    critical_strain
        gamma_c at which a layer fails [-]; 11.5 for BS11 [M: Tyfour, Beynon and Kapoor 1996, unconfirmed].

    Raises
    ------
    ValueError
        A value out of its range.
    """

    shear_yield: float
    rate: float = 0.00237
    hardening_rate: float = 0.5
    hardening_limit: float = 2.0
    critical_strain: float = 11.5

    def __post_init__(self) -> None:
        for name in ("shear_yield", "rate", "hardening_rate", "hardening_limit", "critical_strain"):
            unit = "Pa" if name == "shear_yield" else "-"
            check_above_zero(name, getattr(self, name), unit, "the ratchetting steel")
        if self.hardening_limit < 1.0:
            raise ValueError(f"hardening_limit = {self.hardening_limit} must be >= 1")

    def strength(self, strain: ArrayLike) -> FloatArray:
        """k_eff after a plastic shear strain [Pa] (3.26)."""
        hardened = self.hardening_limit * np.sqrt(-np.expm1(-self.hardening_rate * np.asarray(strain)))
        strength: FloatArray = self.shear_yield * np.maximum(1.0, hardened)
        return strength

    def strain_per_cycle(self, stress: ArrayLike, strain: ArrayLike) -> FloatArray:
        """dgamma/dN [-] under a largest orthogonal shear stress [Pa] at a plastic strain [-] (3.25).

        Parameters
        ----------
        stress
            Largest orthogonal shear stress [Pa].
        strain
            Plastic shear strain reached [-].
        """
        step: FloatArray = self.rate * np.maximum(np.asarray(stress) / self.strength(strain) - 1.0, 0.0)
        return step

    def final_strain(self, stress: ArrayLike) -> FloatArray:
        """Strain at which hardening stops ratchetting at constant stress [-]; infinite from beta k0 on."""
        ratio = np.asarray(stress, dtype=np.float64) / (self.hardening_limit * self.shear_yield)
        with np.errstate(divide="ignore"):
            strain = -np.log1p(-(np.minimum(ratio, 1.0) ** 2)) / self.hardening_rate
        return np.where(np.asarray(stress) > self.shear_yield, strain, 0.0)


@dataclass(frozen=True)
class Ratchetting:
    """Strain of L layers after cycles.

    Attributes
    ----------
    depth
        (L,) depth of the layers below the new surface [m].
    cycles
        (S,) numbers of cycles of the strains, ascending; the last is the end.
    strain
        (S, L) plastic shear strain [-]; of a failed or worn-off layer the value at that time.
    cycles_to_failure
        (L,) cycles at which the layers reached the critical strain; infinite where they did not.
    cycles_to_wear_off
        (L,) cycles at which the layers were worn off; infinite where they were not.
    steps
        Steps of the integration.
    """

    depth: FloatArray
    cycles: FloatArray
    strain: FloatArray
    cycles_to_failure: FloatArray
    cycles_to_wear_off: FloatArray
    steps: int

    @property
    def failed(self) -> NDArray[np.bool_]:
        """(L,) whether the layers failed before they were worn off."""
        return np.isfinite(self.cycles_to_failure)

    def to_table(self) -> pyarrow.Table:
        """One row per layer: depth_m, strain (at the end), cycles_to_failure, cycles_to_wear_off."""
        return pyarrow.table(
            {
                "depth_m": self.depth,
                "strain": self.strain[-1],
                "cycles_to_failure": self.cycles_to_failure,
                "cycles_to_wear_off": self.cycles_to_wear_off,
            }
        )


def largest_orthogonal_shear(
    depth: ArrayLike,
    half_length: float,
    max_pressure: float,
    friction: float,
    traction_ratio: float | None = None,
) -> FloatArray:
    """Largest |tau_zx| along x at each depth below a line contact [Pa], (L,).

    The line contact approximates the middle of a patch; under an ellipse stresses decay faster with depth.

    Parameters
    ----------
    depth
        (L,) [m], >= 0.
    half_length, max_pressure, friction, traction_ratio
        As in `line_contact_stress`: a [m], p0 [Pa], mu and Q/P [-] (None: full slip).

    Raises
    ------
    ValueError
        As `line_contact_stress`.
    """
    z = np.atleast_1d(np.asarray(depth, dtype=np.float64))[:, None]

    def shear(x: FloatArray) -> FloatArray:
        stress = line_contact_stress(x, z, half_length, max_pressure, friction, traction_ratio=traction_ratio)
        return np.abs(stress.tau_xz)

    reach = half_length + 2.0 * z
    x = np.linspace(-1.0, 1.0, _PLACES) * reach
    first = shear(x)
    middle = np.take_along_axis(x, np.argmax(first, axis=1)[:, None], axis=1)
    around = middle + np.linspace(-1.0, 1.0, _PLACES) * 2.0 * reach / (_PLACES - 1)
    largest: FloatArray = np.maximum(first.max(axis=1), shear(around).max(axis=1))
    return largest


def ratchet(
    steel: RatchettingSteel,
    depth: ArrayLike,
    stress: ArrayLike,
    cycles: float,
    *,
    shares: ArrayLike | None = None,
    wear_per_cycle: float = 0.0,
    noted: ArrayLike = (),
    tolerance: float = 1e-6,
) -> Ratchetting:
    """Strain and failure of the layers below a surface after many passages.

    Parameters
    ----------
    steel
        Strength, hardening, ductility.
    depth
        (L,) depths of the layers [m], >= 0, ascending.
    stress
        (L,) largest orthogonal shear stress at these depths [Pa], or (cases, L) for several load cases.
        Between the depths it is taken as linear (where there is wear), and above the first as constant.
    cycles
        Number of cycles, >= 0.
    shares
        (cases,) shares of the load cases in the cycles, adding up to 1; needed with several cases.
    wear_per_cycle
        Wear depth per cycle [m], >= 0.
    noted
        Numbers of cycles within 0..cycles at which the strain is returned, besides the end.
    tolerance
        Error of the strain allowed in a step, over the critical strain [-].

    Raises
    ------
    ValueError
        Values out of these ranges.
    """
    z, cases, weights = _checked(depth, stress, cycles, shares, wear_per_cycle, tolerance)
    stops = np.unique(np.append(np.asarray(noted, np.float64), float(cycles)))
    if not (stops[0] >= 0.0 and stops[-1] == cycles):  # also catches NaN
        raise ValueError(f"noted cycles must lie within 0..{cycles:g}")
    worn_at = z / wear_per_cycle if wear_per_cycle > 0.0 else np.full(z.size, np.inf)
    # a step must not move a layer past a depth at which the stress is given
    longest = float(np.diff(z).min()) / wear_per_cycle if wear_per_cycle > 0.0 and z.size > 1 else math.inf
    layers = _Layers(steel, z, cases, weights, wear_per_cycle)
    strain, now, steps = np.zeros(z.size), 0.0, 0
    failed_at, noted_strain = np.full(z.size, np.inf), []
    for stop in stops.tolist():
        while now < stop:
            alive = np.isinf(failed_at) & (worn_at > now)
            end = min(stop, float(worn_at[alive].min(initial=math.inf)))  # a layer is worn off, or a stop
            step = layers.until_failure(strain, alive, (now, end), longest, tolerance)
            strain, now, steps = step.strain, step.cycles, steps + step.steps
            failed = alive & (strain >= steel.critical_strain * (1.0 - _ROUNDING))
            failed_at[failed] = now
            strain[failed] = steel.critical_strain
        noted_strain.append(strain.copy())
    worn_off = np.where(worn_at <= cycles, worn_at, np.inf)
    return Ratchetting(z, stops, np.array(noted_strain), failed_at, worn_off, steps)


class _Reached(NamedTuple):
    """End of an integration: at a failure or at the last cycle."""

    cycles: float
    strain: FloatArray  # (L,)
    steps: int


class _Layers(NamedTuple):
    """Layers and their load cases."""

    steel: RatchettingSteel
    depth: FloatArray  # (L,)
    cases: FloatArray  # (cases, L) [Pa]
    weights: FloatArray  # (cases,)
    wear_per_cycle: float

    def rate(self, cycles: float, strain: FloatArray) -> FloatArray:
        """(L,) strain per cycle (3.25) after a number of cycles, mean over the load cases."""
        place = np.maximum(self.depth - self.wear_per_cycle * cycles, 0.0)
        total: FloatArray = np.zeros(self.depth.size)
        for weight, case in zip(self.weights, self.cases, strict=True):
            felt = case if self.wear_per_cycle == 0.0 else np.interp(place, self.depth, case)
            total += weight * self.steel.strain_per_cycle(felt, strain)
        return total

    def until_failure(
        self,
        strain: FloatArray,
        alive: NDArray[np.bool_],
        span: tuple[float, float],
        longest: float,
        tolerance: float,
    ) -> _Reached:
        """Integrate over a span of cycles, or until the first layer reaches the critical strain.

        The error of a step is bounded for every layer: the norm of scipy is the root of the mean over them.
        """
        if not alive.any():
            return _Reached(span[1], strain, 0)
        critical = self.steel.critical_strain

        def left(_: float, now: FloatArray) -> float:
            return critical - float(now[alive].max())

        left.terminal = True  # type: ignore[attr-defined]
        found = solve_ivp(
            lambda cycles, now: np.where(alive, self.rate(cycles, now), 0.0),
            span,
            strain,
            method="RK23",
            max_step=longest,
            rtol=_ROUNDING,
            atol=tolerance * critical / math.sqrt(strain.size),
            events=left,
        )
        if not found.success:
            raise ArithmeticError(f"the strain of the layers cannot be integrated: {found.message}")
        return _Reached(float(found.t[-1]), found.y[:, -1], found.t.size - 1)


def _checked(
    depth: ArrayLike,
    stress: ArrayLike,
    cycles: float,
    shares: ArrayLike | None,
    wear_per_cycle: float,
    tolerance: float,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Depths (L,), stresses (cases, L) and shares (cases,); ValueError for anything out of range."""
    z = np.atleast_1d(np.asarray(depth, dtype=np.float64))
    cases = np.atleast_2d(np.asarray(stress, dtype=np.float64))
    if z.ndim != 1 or not (np.all(np.isfinite(z)) and np.all(z >= 0.0) and np.all(np.diff(z) > 0.0)):
        raise ValueError("depth must be finite, >= 0 m and ascending")
    if (
        cases.ndim != 2
        or cases.shape[1] != z.size
        or not (np.all(np.isfinite(cases)) and np.all(cases >= 0.0))
    ):
        raise ValueError(
            f"stress of shape {np.shape(stress)} for {z.size} layers; needed is a finite stress >= 0 Pa "
            "for every layer, or for every load case and layer"
        )
    if shares is None and cases.shape[0] > 1:
        raise ValueError(f"{cases.shape[0]} load cases need their shares of the cycles")
    weights = np.ones(1) if shares is None else np.asarray(shares, dtype=np.float64)
    if weights.shape != (cases.shape[0],) or not (np.all(weights >= 0.0) and abs(weights.sum() - 1.0) < 1e-9):
        raise ValueError(f"shares = {weights} must be >= 0, one for each load case, and add up to 1")
    for name, value, unit in (("cycles", cycles, "-"), ("wear_per_cycle", wear_per_cycle, "m")):
        check_not_below_zero(name, value, unit)
    if not 0.0 < tolerance < 1.0:
        raise ValueError(f"tolerance = {tolerance} [-] must lie in 0..1")
    return z, cases, weights
