"""Fatigue that starts below the surface: FI_sub, and FI_def for material defects.

A. Ekberg, E. Kabo and H. Andersson, An engineering model for prediction of rolling contact fatigue of railway
wheels, Fatigue & Fracture of Engineering Materials & Structures 25 (2002). The formulas are quoted from
memory and were NOT confirmed against the paper [M]: they approximate the largest Dang Van stress below a
Hertzian contact by its peak pressure, since P/(4 pi a b) = p0/6.

The fatigue limit of a wheel steel is not known here, so surfaces keep the revolutions by level of FI_sub
(`WheelSurface.subsurface_revolutions`): they can be judged by any limit afterwards (`revolutions_above`).
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from damage.bounds import check_above_zero

DEFECT_EXPONENT = 1.0 / 6.0
"""Exponent of the reduction of the fatigue limit by the defect's size [-]; [M], unconfirmed."""

LEVEL_STEP, LEVELS = 25e6, 40
"""Width of a level of FI_sub [Pa], and their number; the last one has all that is beyond."""


def subsurface_fatigue_index(
    normal_force: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    utilised_friction: ArrayLike,
    residual_stress: float = 0.0,
    hydrostatic_weight: float | None = None,
) -> NDArray[np.float64]:
    """Equivalent (Dang Van) stress FI_sub [Pa], to be compared with the steel's equivalent fatigue limit.

    FI_sub = P (1 + (Q/P)^2)/(4 pi a b) + c sigma_h,res [M].

    Parameters
    ----------
    normal_force
        P [N], >= 0.
    a, b
        Semi-axes of the patch [m], > 0.
    utilised_friction
        Q/P [-], >= 0.
    residual_stress
        Hydrostatic part of the residual stress, compression negative [Pa].
    hydrostatic_weight
        Dang Van's weight c of the hydrostatic stress [-], > 0: a property of the steel that no source at hand
        gives; needed only with a residual stress.

    Raises
    ------
    ValueError
        Values outside these ranges, or a residual stress without the weight.
    """
    normal, axis_a, axis_b, utilised = (
        np.asarray(value, dtype=np.float64) for value in (normal_force, a, b, utilised_friction)
    )
    if not (np.all(normal >= 0.0) and np.all(utilised >= 0.0)):
        raise ValueError("normal_force must be >= 0 N and utilised_friction >= 0 [-]")
    if not (np.all(axis_a > 0.0) and np.all(axis_b > 0.0)):
        raise ValueError("semi-axes a and b must be > 0 m")
    if not math.isfinite(residual_stress):
        raise ValueError(f"residual_stress = {residual_stress} Pa must be finite")
    residual = 0.0
    if residual_stress != 0.0:
        if hydrostatic_weight is None or not hydrostatic_weight > 0.0:
            raise ValueError(
                f"hydrostatic_weight = {hydrostatic_weight} [-] must be > 0 where residual_stress is not 0 Pa"
            )
        residual = hydrostatic_weight * residual_stress
    index: NDArray[np.float64] = normal * (1.0 + utilised**2) / (4.0 * math.pi * axis_a * axis_b) + residual
    return index


def level_of(index: ArrayLike) -> NDArray[np.int64]:
    """Number of the level that an FI_sub [Pa] lies in, from 0."""
    levels = np.asarray(index, dtype=np.float64) / LEVEL_STEP
    return np.clip(levels, 0.0, LEVELS - 1.0).astype(np.int64)


def revolutions_above(revolutions: ArrayLike, fatigue_limit: float) -> NDArray[np.float64]:
    """Revolutions with an FI_sub above a fatigue limit [-], within its level in proportion.

    Parameters
    ----------
    revolutions
        (..., LEVELS) by level, as `WheelSurface.subsurface_revolutions`.
    fatigue_limit
        Equivalent fatigue limit of the steel, or that at a defect (`defect_fatigue_limit`) [Pa], > 0, up to
        the beginning of the last level.

    Raises
    ------
    ValueError
        A limit outside these bounds, or another number of levels.
    """
    by_level = np.asarray(revolutions, dtype=np.float64)
    highest = (LEVELS - 1) * LEVEL_STEP
    if by_level.shape[-1:] != (LEVELS,):
        raise ValueError(f"revolutions of shape {by_level.shape}, needed (..., {LEVELS}): one per level")
    if not 0.0 < fatigue_limit <= highest:
        raise ValueError(f"fatigue_limit = {fatigue_limit} Pa, allowed above 0 to {highest:g} Pa")
    share = np.clip(np.arange(1, LEVELS + 1) - fatigue_limit / LEVEL_STEP, 0.0, 1.0)
    above: NDArray[np.float64] = by_level @ share
    return above


def defect_fatigue_limit(
    fatigue_limit: float, defect_size: ArrayLike, reference_size: float, exponent: float = DEFECT_EXPONENT
) -> NDArray[np.float64]:
    """Equivalent fatigue limit at a defect [Pa], for the index FI_def.

    At a defect of size d the limit is multiplied by (d/d0)^(-1/6) [M]. FI_def compares the same stress,
    `subsurface_fatigue_index`, with this limit; defects no larger than d0 do not change it.

    Parameters
    ----------
    fatigue_limit
        Equivalent fatigue limit of the steel with its usual defects [Pa], > 0.
    defect_size
        Size of the defect d [m], > 0.
    reference_size
        Size of the usual defects d0 [m], > 0.
    exponent
        [-], > 0.

    Raises
    ------
    ValueError
        Values outside these ranges.
    """
    for name, value, unit in (
        ("fatigue_limit", fatigue_limit, "Pa"),
        ("reference_size", reference_size, "m"),
        ("exponent", exponent, "-"),
    ):
        check_above_zero(name, value, unit)
    size = np.asarray(defect_size, dtype=np.float64)
    if not np.all(size > 0.0):
        raise ValueError(f"defect_size must be > 0 m; {np.count_nonzero(~(size > 0.0))} values are not")
    limit: NDArray[np.float64] = fatigue_limit * np.maximum(size / reference_size, 1.0) ** -exponent
    return limit


def defect_fatigue_index(
    subsurface_index: ArrayLike,
    fatigue_limit: float,
    defect_size: ArrayLike,
    reference_size: float,
    exponent: float = DEFECT_EXPONENT,
) -> NDArray[np.float64]:
    """Fatigue index at a defect FI_def [Pa]: FI_sub minus the fatigue limit at the defect; > 0 is fatigue.

    Parameters
    ----------
    subsurface_index
        FI_sub [Pa].
    fatigue_limit, defect_size, reference_size, exponent
        As `defect_fatigue_limit`; the size of the steel's usual defects gives the index without a defect.

    Raises
    ------
    ValueError
        As `defect_fatigue_limit`.
    """
    index: NDArray[np.float64] = np.asarray(subsurface_index, dtype=np.float64) - defect_fatigue_limit(
        fatigue_limit, defect_size, reference_size, exponent
    )
    return index
