"""Poses of one wheel on its rail, and its coupled strips there."""

from dataclasses import dataclass

import numpy as np

from hh_exudyn.contact.geometry.silhouette import WheelRailPair, wheel_rail_pair
from hh_exudyn.contact.profile import Profile, gauge_point
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.contact.strips.normal import normal_rows
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row, wheel_strips
from hh_exudyn.contact.types import SplineTable, WheelStrips
from hh_exudyn.conventions import FLANGE_BACK_TO_RUNNING_CIRCLE, RIGHT

MODULUS = 82e9 / 0.72  # G/(1 - nu) [Pa]


@dataclass(frozen=True)
class WheelAndRail:
    """Tables of a wheel and its rail, and their place in track and wheelset [m]."""

    wheel: SplineTable
    rail: SplineTable
    strips: WheelStrips
    gauge_point: float
    gauge: float = 1.445
    radius: float = 0.4575
    side: int = RIGHT

    def pair(self, outwards: float, lowered: float, yaw: float = 0.0, roll: float = 0.0) -> WheelRailPair:
        """The wheelset displaced to this wheel's rail and lowered [m], nose turned to it by `yaw` [rad]."""
        turn = yaw * self.side  # to the left
        axle = np.array([-np.sin(turn) * np.cos(roll), np.cos(turn) * np.cos(roll), np.sin(roll)])
        rail = self.side * (0.5 * self.gauge + self.gauge_point)
        centre = np.array([0.0, self.side * outwards - rail, self.radius - lowered])
        return wheel_rail_pair(
            self.wheel,
            self.rail,
            float(self.side),
            0.68 + FLANGE_BACK_TO_RUNNING_CIRCLE,
            self.radius,
            centre,
            axle,
        )

    def rows(self, *pose: float, refined: bool = False) -> np.ndarray:
        """(ROWS, strips with overlap) of a pose."""
        rows = np.zeros((ROWS, CAPACITY))
        count = normal_rows(self.pair(*pose), self.strips, MODULUS, refined, rows)
        assert count >= 0
        return rows[:, :count]

    def forces(self, *pose: float) -> tuple[float, float]:
        """Vertical and lateral (outwards) force on the rail [N]."""
        rows = self.rows(*pose)
        return float(rows[Row.LOAD] @ rows[Row.COSINE]), float(rows[Row.LOAD] @ rows[Row.SINE])


def wheel_and_rail(
    wheel: Profile, rail: Profile, widths: tuple[float, ...] = (), **place: float
) -> WheelAndRail:
    """Tables of two profiles; strips of other widths than the toolkit's on request [m]."""
    table = spline_table(wheel)
    return WheelAndRail(table, spline_table(rail), wheel_strips(table, *widths), gauge_point(rail), **place)
