"""Suspensions of European freight wagons, between a frame (A) and a wheelset (B): Lenoir link, double link.

Frozen values on a vehicle's drawing, as those of `couplings`. Both carry by springs, unloaded on the drawing
without a `preload`, and rub with a friction that goes with their load; their elastic forces are the
derivatives of one energy, so that no path takes work out of them. The kernels are in
`hh_exudyn.multibody.couplings.freight`.
"""

import math
from dataclasses import dataclass

from vehicles.preloads import require_preload, two_stage_compression


def _require(name: str, *quantities: tuple[str, float, str, bool]) -> None:
    """Refuse a (quantity, value, unit, whether it may be zero) below zero, or zero where it may not."""
    for quantity, value, unit, or_zero in quantities:
        if not (value >= 0.0 if or_zero else value > 0.0):
            raise ValueError(f"{name}: {quantity} {value}{unit} must be {'>=' if or_zero else '>'} 0")


@dataclass(frozen=True)
class LenoirSuspension:
    """Axle box of the Y25 bogie: two spring groups, one hung on a link that presses the box on its guide.

    The link, inclined by `link_angle`, takes the force F of its spring group to the frame, and by its
    inclination pushes a plunger with F tan(angle) against the box, and the box on the guide behind it. Both
    faces rub, vertically and laterally, with a friction that goes with the load (S. Iwnicki, S. Stichel,
    A. Orlova and M. Hecht, Vehicle System Dynamics 53, 2015, section 2). Against the plunger the box yields
    once it is pushed off its guide: it carries the link with it, and compresses its springs.
    """

    name: str
    body_a: str
    body_b: str
    point: tuple[float, float, float]  # on the axle's centre line [m]
    direction: int  # +1: the plunger is ahead of the box and the guide behind it, -1 the other way round
    first_stiffness: float  # vertical, outer coils alone of both groups [N/m]
    second_stiffness: float  # vertical, with the inner coils [N/m]
    second_from: float  # compression at which the inner coils touch [m]
    horizontal_stiffness: float  # shear of the coils [N/m]
    link_share: float  # of the vertical force, on the link's spring group, 0..1
    link_angle: float  # of the link from the vertical [rad]
    guide_stiffness: float  # of the box on its guide [N/m]
    friction: float  # of plunger and guide
    stick_stiffness: float  # of the sticking faces [N/m]
    stick_damping: float  # [N s/m]
    longitudinal_damping: float  # of the box on its guide and of the coils [N s/m]
    longitudinal_clearance: float  # of the box off its guide [m]
    lateral_clearance: float  # to either side [m]
    stop_stiffness: float  # [N/m]
    preload: float = 0.0  # load on the box on the drawing [N]

    @property
    def compression(self) -> float:
        """Compression of both spring groups on the drawing [m]."""
        return two_stage_compression(
            self.preload, self.first_stiffness, self.second_stiffness, self.second_from
        )

    def __post_init__(self) -> None:
        require_preload(f"Lenoir suspension {self.name}", self.preload)
        _require(
            f"Lenoir suspension {self.name}",
            ("first_stiffness", self.first_stiffness, " N/m", False),
            ("second_stiffness", self.second_stiffness, " N/m", False),
            ("guide_stiffness", self.guide_stiffness, " N/m", False),
            ("second_from", self.second_from, " m", True),
            ("friction", self.friction, "", True),
        )
        if not (0.0 <= self.link_share <= 1.0 and 0.0 <= self.link_angle < math.pi / 4):
            raise ValueError(
                f"Lenoir suspension {self.name}: link_share {self.link_share} must be 0..1 and link_angle "
                f"{math.degrees(self.link_angle):.1f} deg 0..45 deg"
            )


@dataclass(frozen=True)
class DoubleLink:
    """UIC double link with its leaf spring: the frame hangs from the spring's ends by links and swings.

    The leaf spring has two stages and the friction of its leaves. A frame that swings off the middle rises,
    so that its weight drives it back as a pendulum of an effective length; the links' joints roll and rub.
    All friction goes with the load; an elastic part stands before each slider (J. Piotrowski, Vehicle System
    Dynamics 40, 2003; P.-A. Joensson, S. Stichel and I. Persson, Vehicle System Dynamics 46, 2008).
    """

    name: str
    body_a: str
    body_b: str
    point: tuple[float, float, float]  # on the axle's centre line [m]
    first_stiffness: float  # vertical, leaf spring in its first stage [N/m]
    second_stiffness: float  # in its second stage [N/m]
    second_from: float  # compression at the second stage [m]
    leaf_friction: float  # vertical friction over load
    leaf_stick_stiffness: float  # added to the spring's before its leaves slide [N/m]
    longitudinal_length: float  # effective, of the pendulum [m]
    lateral_length: float  # [m]
    longitudinal_friction: float  # friction force over load
    lateral_friction: float  # friction force over load
    link_stick_stiffness: float  # added to the pendulum's before the joints slide [N/m]
    stick_damping: float  # of leaves and joints that stick [N s/m]
    longitudinal_clearance: float  # of the axle guards [m]
    lateral_clearance: float  # [m]
    stop_stiffness: float  # [N/m]
    preload: float = 0.0  # load on the box on the drawing [N]

    @property
    def compression(self) -> float:
        """Compression of the leaf spring on the drawing [m]."""
        return two_stage_compression(
            self.preload, self.first_stiffness, self.second_stiffness, self.second_from
        )

    def __post_init__(self) -> None:
        require_preload(f"double link {self.name}", self.preload)
        _require(
            f"double link {self.name}",
            ("first_stiffness", self.first_stiffness, " N/m", False),
            ("second_stiffness", self.second_stiffness, " N/m", False),
            ("longitudinal_length", self.longitudinal_length, " m", False),
            ("lateral_length", self.lateral_length, " m", False),
            ("second_from", self.second_from, " m", True),
            ("leaf_friction", self.leaf_friction, "", True),
            ("longitudinal_friction", self.longitudinal_friction, "", True),
            ("lateral_friction", self.lateral_friction, "", True),
        )
