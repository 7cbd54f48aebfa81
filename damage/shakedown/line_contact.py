"""Limits p0/k of a rolling line contact, computed from its stress field: full slip and partial slip.

Definition and computation of the three limits: `damage.shakedown.stress_circle`. They are those of
equations 3.11, 3.12 and Table 3-1 of Hossein-Nia (KTH, 2018) after Johnson; the partial slip is Carter's.
"""

import functools
import itertools

import numpy as np
from numpy.typing import ArrayLike, NDArray

from damage.shakedown.stress_circle import stress_circle

_SURFACE_FROM = (
    0.39  # friction from which the surface determines all limits in full slip, with margin: k/p0 = mu
)
_FIRST_STEP = 0.03
_STRAIGHT = 4e-5  # deviation of k/p0 from a straight line over friction that is small enough


def shakedown_limit(friction: ArrayLike, hardening: str = "elastic") -> NDArray[np.float64]:
    """Limit p0/k [-] of a line contact in full slip (figure 3-8).

    Interpolated to some 2e-4 in a table that is computed once per hardening, so that it serves whole logs;
    `stress_circle` gives a single limit more exactly, with the place of first yield.

    Parameters
    ----------
    friction
        Friction coefficient mu [-], >= 0.
    hardening
        "elastic": the load of first yield; "perfect": shakedown limit of an elastic-perfectly plastic body;
        "kinematic": of a body with kinematic hardening (Table 3-1).

    Raises
    ------
    ValueError
        Friction below zero or not finite; an unknown hardening.
    """
    mu = _checked("friction", friction)
    nodes, radii = _table(hardening)
    limit: NDArray[np.float64] = 1.0 / np.maximum(np.interp(mu, nodes, radii), mu)
    return limit


def partial_slip_limit(
    friction: ArrayLike, traction_ratio: ArrayLike, hardening: str = "elastic"
) -> NDArray[np.float64]:
    """Limit p0/k [-] of a line contact in partial slip, of the surface and below it (figure 3-11).

    Computed for every new pair (some 20 ms) and cached. Unlike full slip, the limit below the surface
    depends on the sense of Q, since stick always lies at the leading edge: with little traction a braked
    wheel (and the rail below a driving one) has a limit lower by up to a few per cent. The surface's limit is
    the same.

    Parameters
    ----------
    friction
        Friction coefficient mu [-], >= 0.
    traction_ratio
        Tangential over normal force Q/P [-], -mu..mu, positive where Q acts on the body in rolling direction
        (a driving wheel). At its ends the slip is full. Broadcast with friction.
    hardening
        As `shakedown_limit`.

    Raises
    ------
    ValueError
        |Q/P| above mu, an argument out of range or an unknown hardening.
    """
    mu, ratio = np.broadcast_arrays(_checked("friction", friction), _finite("Q/P", traction_ratio))
    pairs = zip(mu.ravel().tolist(), ratio.ravel().tolist(), strict=True)
    return np.array([stress_circle(*pair, hardening).limit for pair in pairs]).reshape(mu.shape)


def partial_slip_surface_limit(
    friction: ArrayLike, traction_ratio: ArrayLike, hardening: str = "kinematic"
) -> NDArray[np.float64]:
    """Limit p0/k [-] of the surface alone in partial slip, in closed form (Johnson, 1995).

    From the stresses at the leading edge and at the border of stick and slip (equation 3.13). Where friction
    is high it is the limit of the whole body; with little traction the limit below the surface is lower, see
    `partial_slip_limit`.

    Parameters
    ----------
    friction
        Friction coefficient mu [-], > 0.
    traction_ratio
        |Q/P| [-], 0 to mu; without traction the limit is infinite.
    hardening
        "perfect" (3.14) or "kinematic" (3.15, which is 1/sqrt(mu Q/P)).

    Raises
    ------
    ValueError
        |Q/P| above mu, an argument out of range or another hardening.
    """
    mu, ratio = _checked("friction", friction), np.abs(_finite("Q/P", traction_ratio))
    if np.any(mu == 0.0) or np.any(ratio > mu):
        raise ValueError("friction must be > 0 and |Q/P| at most the friction [-]")
    slip = 1.0 - np.sqrt(1.0 - ratio / mu)  # share (a - d)/a of the patch that slips (2.20)
    if hardening == "perfect":
        radius = mu * np.sqrt(slip) * (2.0 - slip)  # (3.14)
    elif hardening == "kinematic":
        radius = mu * np.sqrt(slip * (2.0 - slip))  # (3.15)
    else:
        raise ValueError(f"hardening = {hardening!r}; allowed here: perfect, kinematic")
    with np.errstate(divide="ignore"):
        limit: NDArray[np.float64] = 1.0 / radius
    return limit


@functools.cache
def _table(hardening: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Friction and k/p0 in full slip, close enough for linear interpolation.

    k/p0 is convex in mu (the largest of distances that are convex in mu and in the centre, and the centre
    chosen best), so that a straight line lies above it: an interpolated limit is never too high.
    """
    radii: dict[float, float] = {}

    def radius(mu: float) -> float:
        if mu not in radii:
            radii[mu] = stress_circle(mu, None, hardening).radius
        return radii[mu]

    def divide(low: float, high: float) -> None:
        middle = 0.5 * (low + high)
        if abs(0.5 * (radius(low) + radius(high)) - radius(middle)) > _STRAIGHT:
            divide(low, middle)
            divide(middle, high)

    ends = np.linspace(0.0, _SURFACE_FROM, 1 + round(_SURFACE_FROM / _FIRST_STEP)).tolist()
    for low, high in itertools.pairwise(ends):
        divide(low, high)
    nodes = sorted(radii)
    return np.array(nodes), np.array([radii[mu] for mu in nodes])


def _finite(name: str, given: ArrayLike) -> NDArray[np.float64]:
    """As an array of finite numbers."""
    values = np.asarray(given, dtype=np.float64)
    if not np.all(np.isfinite(values)):
        raise ValueError(
            f"{name} must be finite [-]; {np.count_nonzero(~np.isfinite(values))} values are not"
        )
    return values


def _checked(name: str, given: ArrayLike) -> NDArray[np.float64]:
    """As an array of finite numbers from zero on."""
    values = _finite(name, given)
    if np.any(values < 0.0):
        raise ValueError(f"{name} must be >= 0 [-]; {np.count_nonzero(values < 0.0)} values are not")
    return values
