"""Couplings of passenger bogies: axle-box arm, damper by a table, damper in series with its mounting.

As those of `vehicles.couplings`, which names them all: frozen values on the drawing, displacement of body B
relative to body A in the axes of A, force on B. Their kernels:
`hh_exudyn.multibody.couplings.passenger_bogie`.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

Vector = tuple[float, float, float]
DamperTable = tuple[tuple[float, float], ...]  # (speed [m/s], force [N]), from (0, 0) on, both rising

LARGEST_DAMPER_TABLE = 10  # most points, the size of the table in the force kernel


@dataclass(frozen=True)
class AxleBoxArm:
    """Arm of an axle box: it turns about the axle of a wheelset (B), guided by a bushing of a frame (A).

    The arm has no mass of its own here (add that to the wheelset), so it needs no joint and no stiff
    stand-in: it is a two-force member. Let r be the vector from the axle to the bushing in the arm's plane, d
    the bushing's deflection there and K = diag(Kx, Kz) its stiffness. The bearing passes no moment about the
    axle, so that the bushing's force F = K d has none either,

        r x F = 0,   F along r;   with the arm's pitch as unknown:   F = k (u.d) u,   1/k = ux^2/Kx + uz^2/Kz

    with u = r/|r|: bushing and arm are one spring along the arm, whose length is that from axle to bushing.
    For Kx = Kz that holds at any angle, else for small changes of it. Whatever else presses on the axle box
    through the axle (a coil above it) has no moment about it and stays a coupling of its own. Across its
    plane the arm is stiff: the bushing's lateral force acts on the axle with its lever, and turns it.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector  # on the axle's centre line, where the arm turns [m]
    bushing: Vector  # in the frame [m]; as far from the vehicle's middle plane as `point`
    stiffness: Vector  # of the bushing [N/m]
    damping: tuple[float, float] = (0.0, 0.0)  # along the arm and lateral [N s/m]
    preload: float = 0.0  # pull of the arm on the drawing [N]

    def __post_init__(self) -> None:
        if not (math.hypot(self.arm[0], self.arm[2]) > 0.0 and abs(self.arm[1]) < 1e-9):
            raise ValueError(
                f"axle-box arm {self.name}: bushing {self.bushing} m must be away from the axle at "
                f"{self.point} m and at the same y"
            )
        if not all(value > 0.0 for value in self.stiffness):
            raise ValueError(f"axle-box arm {self.name}: stiffness {self.stiffness} N/m must be > 0")
        if not all(value >= 0.0 for value in self.damping):
            raise ValueError(f"axle-box arm {self.name}: damping {self.damping} N s/m must be >= 0")

    @property
    def arm(self) -> Vector:
        """From the axle to the bushing on the drawing [m]."""
        (x, y, z), (x0, y0, z0) = self.bushing, self.point
        return x - x0, y - y0, z - z0

    @property
    def along_stiffness(self) -> float:
        """k of bushing and arm along the arm [N/m]."""
        x, _, z = self.arm
        return (x * x + z * z) / (x * x / self.stiffness[0] + z * z / self.stiffness[2])


@dataclass(frozen=True)
class Damper:
    """Damper along one axis of body A by a table of force over speed, the same in both directions.

    Linear between its points; beyond the last it goes on as between the last two, so that a blow-off valve is
    a last stretch of constant force. `preload` is a force on body B along the axis, of a gas cushion.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector
    axis: Vector  # unit vector in the axes of body A
    table: DamperTable
    preload: float = 0.0  # [N]

    def __post_init__(self) -> None:
        _check_damper("damper", self.name, self.axis, self.table)


@dataclass(frozen=True)
class SeriesDamper:
    """A `Damper` in series with the spring of its mounting or its oil column (Maxwell).

    One state, the force in both. It is marched exactly for a stretch of its table and a relative speed linear
    over the step, however stiff the spring: an infinite one leaves the damper alone.
    """

    name: str
    body_a: str
    body_b: str
    point: Vector
    axis: Vector  # unit vector in the axes of body A
    table: DamperTable
    series_stiffness: float  # [N/m]
    preload: float = 0.0  # force on body B along the axis [N]

    def __post_init__(self) -> None:
        _check_damper("series damper", self.name, self.axis, self.table)
        if not self.series_stiffness > 0.0:
            raise ValueError(
                f"series damper {self.name}: series_stiffness {self.series_stiffness} N/m must be > 0"
            )


def _check_damper(kind: str, name: str, axis: Vector, table: DamperTable) -> None:
    """ValueError for an axis that is no unit vector, or a table that does not begin at rest and rise."""
    if abs(math.hypot(*axis) - 1.0) > 1e-9:
        raise ValueError(f"{kind} {name}: axis {axis} must be a unit vector")
    if not 2 <= len(table) <= LARGEST_DAMPER_TABLE:
        raise ValueError(
            f"{kind} {name}: its table has {len(table)} points; allowed: 2..{LARGEST_DAMPER_TABLE}"
        )
    if tuple(table[0]) != (0.0, 0.0):
        raise ValueError(f"{kind} {name}: its table must start at (0 m/s, 0 N), not at {table[0]}")
    if not all(v0 < v1 and f0 <= f1 for (v0, f0), (v1, f1) in pairwise(table)) or not table[1][1] > 0.0:
        raise ValueError(f"{kind} {name}: speeds [m/s] must rise and forces [N] not fall in {table}")
