"""Check rails and flange backs: their descriptions, and the numbers that the kernels read."""

import math
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.measures import flange_height
from hh_exudyn.contact.profiles.profile import Profile
from hh_exudyn.conventions import LEFT, RIGHT

# m, of S1002 (UIC 510-2, EN 13715, section H1): arc between flange tip and the plane of the back
BACK_RADIUS = 20.5e-3
BACK_ABOVE_TIP = 28.0e-3 - 9.519259302e-3  # end of the plane above the flange tip

CROWN_RADIUS = 1.0  # m, assumed (0.3 .. 5): faces are drawn straight and wear to the backs' inclinations
SLICES = 174  # along the chord; each is a strip
_SHORTEST_REACH = 0.15  # m
_RANGES = {  # of `CheckRail`: least and largest value, in SI
    "flangeway": (0.025, 0.120, "m"),
    "height": (-0.015, 0.080, "m"),
    "corner_radius": (0.003, 0.030, "m"),
    "flare_length": (0.2, 20.0, "m"),
    "flare_opening": (0.002, 0.100, "m"),
    "friction": (0.0, 1.0, "-"),
    "stiffness": (5e6, 5e9, "N/m"),
}


@dataclass(frozen=True)
class CheckRail:
    """Check rails of a track, alike on all their stretches.

    Attributes
    ----------
    stretches : tuple of (int, float, float)
        Side, `LEFT` or `RIGHT`, and arc lengths between which a check rail has its full flangeway [m].
    flangeway : float
        From the running rail's gauge face to the check rail's face [m], 0.025 .. 0.12.
    height : float
        Of its top above the running rail's [m], -0.015 .. 0.08.
    corner_radius : float
        Of the arc between top and face [m], 0.003 .. 0.03.
    flare_length, flare_opening : float
        Of its ends beyond the stretch: over this length the flangeway widens by so much, as a parabola [m],
        0.2 .. 20 and 0.002 .. 0.1.
    friction : float
        Friction coefficient of the flange back [-], 0 .. 1.
    stiffness : float
        Lateral stiffness of check rail and wheel disc at a wheel, without the contact [N/m], 5e6 .. 5e9.

    Raises
    ------
    ValueError
        A number out of its range, a side that is none, or a stretch that does not go forwards.
    """

    stretches: tuple[tuple[int, float, float], ...]
    flangeway: float
    height: float
    corner_radius: float
    flare_length: float
    flare_opening: float
    friction: float
    stiffness: float

    def __post_init__(self) -> None:
        for name, (low, high, unit) in _RANGES.items():
            value = getattr(self, name)
            if not low <= value <= high:
                raise ValueError(f"{name} = {value} {unit}, allowed {low:g} .. {high:g} {unit}")
        for side, start, end in self.stretches:
            if side not in (LEFT, RIGHT):
                raise ValueError(f"side = {side}, allowed {LEFT} (left) or {RIGHT} (right)")
            if not start < end:
                raise ValueError(
                    f"a check rail from s = {start:g} to {end:g} m, allowed is one that ends later"
                )


class CheckRailTable(NamedTuple):
    """Check rails and the backs of all wheels, for the kernels; `stretches` is empty where there are none."""

    stretches: FloatArray  # (n, 3) side, start, end as of `CheckRail`
    back_depths: FloatArray  # (wheelsets, 2) end of the back's plane below the running circle [m]
    half_distance: float  # of the flange backs [m]
    flangeway: float  # [m], and so on as of `CheckRail`
    height: float
    corner_radius: float
    flare_length: float
    flare_opening: float
    friction: float
    compliance: float  # [m/N]
    slice_width: float  # [m]


class BackContact(IntEnum):
    """Columns of the record of a flange back on a check rail, without contact all zero; forces in T."""

    NORMAL_FORCE = 0  # sum over the slices [N]
    X_SHIFT = 1  # of its centre ahead of the wheelset's centre [m]
    HEIGHT = 2  # of its centre over the running rail's top, axes of R [m]
    FORCE_X = 3  # on the wheel, friction included [N]
    FORCE_Y = 4
    FORCE_Z = 5
    OVERLAP = 6  # the largest: contact, check rail and disc together [m]
    P_MAX = 7  # largest pressure, of a line contact [Pa]
    CREEPAGE = 8  # slip over speed, mean over the load [-]
    POWER = 9  # lost [W]


BACK_COLUMNS = len(BackContact)


def back_depth(wheel: Profile) -> float:
    """Depth below the running circle at which the plane of the flange back ends [m].

    Parameters
    ----------
    wheel : Profile
        Its flange tip carries the standard back.
    """
    return flange_height(wheel) - BACK_ABOVE_TIP


def no_check_rail() -> CheckRailTable:
    """The table of a track without check rails."""
    return CheckRailTable(
        stretches=np.zeros((0, 3)),
        back_depths=np.zeros((0, 2)),
        half_distance=0.0,
        flangeway=0.0,
        height=0.0,
        corner_radius=1.0,
        flare_length=1.0,
        flare_opening=0.0,
        friction=0.0,
        compliance=0.0,
        slice_width=1.0,
    )


def check_rail_table(
    check: CheckRail, wheels: list[tuple[Profile, Profile]], back_to_back: float, radius: float
) -> CheckRailTable:
    """The numbers of the kernels.

    Parameters
    ----------
    check : CheckRail
        The check rails.
    wheels : list of (Profile, Profile)
        Left and right wheel of every wheelset.
    back_to_back : float
        Distance of the flange backs [m].
    radius : float
        Of the wheels at the running circle [m].
    """
    depths = np.array([[back_depth(wheel) for wheel in pair] for pair in wheels])
    # half the chord at the upper end of the face, plus a tenth
    tip, face = radius + float(depths.max()) + BACK_ABOVE_TIP, radius - check.height + check.corner_radius
    reach = max(1.1 * math.sqrt(max(tip * tip - face * face, 0.0)), _SHORTEST_REACH)
    return CheckRailTable(
        stretches=np.array(check.stretches, dtype=np.float64).reshape(-1, 3),
        back_depths=depths,
        half_distance=0.5 * back_to_back,
        flangeway=check.flangeway,
        height=check.height,
        corner_radius=check.corner_radius,
        flare_length=check.flare_length,
        flare_opening=check.flare_opening,
        friction=check.friction,
        compliance=1.0 / check.stiffness,
        slice_width=2.0 * reach / SLICES,
    )
