"""Contact states solved again by the half-space, one after the other, each from a similar one before it.

With the profiles of the run the wheel is pressed on its rail in the pose of the row, along the normal of the
row's contact, until it carries the row's normal force; then its tractions follow from the row's creepages,
the wheel being a rigid body. Patches of one wheel displace each other's surface: they are solved in turn,
each with the forces of the others. Without profiles the equivalent ellipse is solved.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from damage.log_input.states import ContactStates, patch_of
from damage.patch_strips import FLANGE, TREAD, PatchStrips, ellipse_strips, place_strips, strips_space
from damage.surface.contact_sums import Placed, Solving
from damage.surface.lateral_grid import LateralGrid
from damage.surface.rebuilt_sums import pose_of
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.halfspace.conformal import wheel_arc
from hh_exudyn.contact.halfspace.conformal_slip import slip_of_creepages
from hh_exudyn.contact.halfspace.ellipse import ellipse_field
from hh_exudyn.contact.halfspace.rolling import rolling_contact
from hh_exudyn.contact.halfspace.wheel_rail import (
    ConformalContact,
    Pressing,
    carry_over,
    conformal_contact,
)
from hh_exudyn.contact.material import Material
from hh_exudyn.contact.strips.rebuilt import logged_pair
from hh_exudyn.contact.types import Fields, WheelRailModel

SPACING = (0.4e-3, 0.4e-3)  # m, of the elements along the patch and across
LEAST_LOAD = 20.0  # N, of a patch that is solved: a smaller one is narrower than an element of the grid
_NORMAL_TOLERANCE = 1e-4  # of the largest displacement
_NEAR = 5e-3  # m, between places on the wheel: a farther contact is no start
_FIRST_TURNS, _TURNS = 3, 2  # in which patches of one wheel are solved, from nothing and from those before


class Solved(NamedTuple):
    """A solved patch."""

    strips: PatchStrips
    area: float  # of contact [m^2]
    fields: Fields
    force: float  # creep force [N]
    max_pressure: FloatArray  # (strips,) [Pa]
    angle: FloatArray  # (strips,) contact angle, positive towards the flange [rad]
    y_rail: FloatArray | None  # (strips,) places on the rail profile [m]; None: those of the ellipse


@dataclass
class WheelSolver:
    """Solves the states of one wheel from the profiles of the run, in their order in time.

    Attributes
    ----------
    contact
        Profiles of the run.
    grid
        The bins on the wheel.
    flange_angle
        From which a strip's contact counts as flange contact [rad].
    pressure_limit
        Upper bound of the pressure [Pa].
    material
        Of wheel and rail.
    """

    contact: WheelRailModel
    grid: LateralGrid
    flange_angle: float
    pressure_limit: float
    material: Material
    _before: list[tuple[ConformalContact, FloatArray]] = field(default_factory=list)
    _arcs: dict[float, tuple[FloatArray, FloatArray]] = field(default_factory=dict)

    def solve(
        self, states: ContactStates, placed: Placed, rows: IntArray, solving: Solving
    ) -> Iterator[Solved]:
        """The patches of the wheel at one time.

        Parameters
        ----------
        states, placed
            Contact states of the wheel with poses.
        rows
            Numbers of those of one time.
        solving
            Not read: the material is the solver's own.

        Raises
        ------
        ValueError
            Nothing touches: other profiles were in the run; or the pressure limit is so low that the load
            cannot be carried.
        """
        starts = [self._start(float(states.y_wheel[row])) for row in rows]
        known = [None if start is None else start[0] for start in starts]
        turns = _TURNS if all(known) else _FIRST_TURNS
        for _ in range(turns if rows.size > 1 else 1):
            for k, row in enumerate(rows):
                beside = tuple(other for i, other in enumerate(known) if i != k and other is not None)
                known[k] = self._pressed(states, placed, int(row), beside, known[k])
        self._before = []
        for start, contact, row in zip(starts, known, rows, strict=True):
            if contact is not None:
                yield self._rolled(states, int(row), contact, start)

    def _start(self, place: float) -> tuple[ConformalContact, FloatArray] | None:
        """The last contact near a place on the wheel."""
        near = [before for before in self._before if abs(_middle(before[0]) - place) < _NEAR]
        return min(near, key=lambda before: abs(_middle(before[0]) - place)) if near else None

    def _pressed(
        self,
        states: ContactStates,
        placed: Placed,
        row: int,
        beside: tuple[ConformalContact, ...],
        start: ConformalContact | None,
    ) -> ConformalContact:
        """The wheel pressed on its rail with the normal force of a row."""
        side, place = float(states.side[row]), float(states.y_wheel[row])
        pair = logged_pair(self.contact, pose_of(states, row))
        if side not in self._arcs:
            self._arcs[side] = wheel_arc(pair.wheel)
        within = (float(placed.lowest[row]), float(placed.highest[row]))
        load, angle = float(states.normal_force[row]), float(states.contact_angle[row])
        pressing = Pressing(load, angle, within, beside)

        def solve(begin: ConformalContact | None) -> ConformalContact | None:
            return conformal_contact(
                pair, load=pressing, spacing=SPACING, material=self.material, limit=self.pressure_limit,
                tolerance=_NORMAL_TOLERANCE, start=begin, arc=self._arcs[side],
            )  # fmt: skip

        try:
            found = solve(start)
            if start is not None and found is not None and not abs(_middle(found) - place) < _NEAR:
                found = solve(None)  # the start led to another place
        except ArithmeticError as error:
            raise ValueError(f"{_where(states, row)}: {error}") from None
        if found is None:
            raise ValueError(f"{_where(states, row)}: no contact; other profiles were in the run")
        return found

    def _rolled(
        self,
        states: ContactStates,
        row: int,
        contact: ConformalContact,
        start: tuple[ConformalContact, FloatArray] | None,
    ) -> Solved:
        """The tractions of a contact, and all that damage needs of it."""
        creepages = (float(states.nu_x[row]), float(states.nu_y[row]), float(states.phi[row]))
        yaw, roll = float(states.angle_of_attack[row]), float(states.roll[row])
        axle = (math.cos(yaw) * math.cos(roll), math.sin(roll))
        rigid = slip_of_creepages(contact, axle, creepages)
        rolling = rolling_contact(
            contact.influence,
            float(states.friction[row]) * contact.pressure,
            rigid,
            start=None if start is None else carry_over(start[1], start[0], contact),
        )
        self._before.append((contact, rolling.traction))
        fields = _balanced(contact.pressure, rolling.traction, rolling.slip, rigid)
        return self._solved(contact, fields, rigid, float(np.hypot(*rolling.force)))

    def _solved(self, contact: ConformalContact, fields: Fields, rigid: FloatArray, force: float) -> Solved:
        """The strips and fields of the part of the grid that is in contact."""
        touching = contact.pressure > 0.0
        rows, columns = np.flatnonzero(touching.any(axis=1)), np.flatnonzero(touching.any(axis=0))
        inside = np.ix_(rows, np.arange(columns[0], columns[-1] + 1))
        part = Fields(*(np.ascontiguousarray(values[inside]) for values in fields))
        spacing = contact.influence.grid
        slip_x, slip_y = rigid[0][inside], rigid[1][inside]
        gamma = -contact.angle[rows]
        position, stretch = self.grid.place(contact.y_wheel[rows], gamma)
        count = rows.size
        strips = PatchStrips(
            position=np.ascontiguousarray(position),
            covered=spacing.dy * stretch,
            width=np.full(count, spacing.dy),
            half_length=np.full(count, 0.5 * slip_x.shape[1] * spacing.dx),
            contact_length=spacing.dx * touching[rows].sum(axis=1),
            nu_x=np.ascontiguousarray(slip_x[:, 0]),
            nu_y=slip_y.mean(axis=1),
            phi=np.ascontiguousarray(
                (rigid[1, rows, -1] - rigid[1, rows, 0]) / (contact.x[-1] - contact.x[0])
            ),
            wear_factor=np.ones(count),
            part=np.where(gamma > self.flange_angle, FLANGE, TREAD).astype(np.int64),
        )
        return Solved(
            strips,
            contact.area,
            part,
            force,
            part.pressure.max(axis=1),
            np.ascontiguousarray(gamma),
            contact.y_rail[rows],
        )


@dataclass
class EllipseSolver:
    """Solves the equivalent ellipses of states without profiles by the half-space.

    Attributes
    ----------
    cells
        Along the patch and across.
    """

    cells: tuple[int, int]
    _shares: FloatArray | None = None

    def solve(
        self, states: ContactStates, placed: Placed, rows: IntArray, solving: Solving
    ) -> Iterator[Solved]:
        """The patches of the wheel at one time; arguments as of `WheelSolver.solve`."""
        nx, ny = self.cells
        for row in rows:
            patch = patch_of(states, row, solving.elastic)
            strips, fields = strips_space(ny), Fields(*np.zeros((5, ny, nx)))
            area = ellipse_strips(patch, strips)
            across = -states.side[row] * placed.stretch[row]
            place_strips(patch.b, placed.position[row], across, placed.part[row], strips)
            start = self._shares if rows.size == 1 else None
            self._shares = ellipse_field(patch, fields, start)
            cell = (2.0 * strips.half_length * strips.width / nx)[:, None]
            force = float(np.hypot(np.sum(fields.q_x * cell), np.sum(fields.q_y * cell)))
            angle = np.full(ny, states.contact_angle[row])
            yield Solved(strips, float(area), fields, force, np.full(ny, states.p_max[row]), angle, None)


def _balanced(pressure: FloatArray, traction: FloatArray, slip: FloatArray, rigid: FloatArray) -> Fields:
    """The fields, with the slip scaled so that friction dissipates the power of the creepages."""
    work, power = float(np.sum(traction * slip)), float(np.sum(traction * rigid))
    factor = power / work if work < 0.0 and power < 0.0 else 1.0
    return Fields(pressure, traction[0], traction[1], factor * slip[0], factor * slip[1])


def _middle(contact: ConformalContact) -> float:
    """Place on the wheel of the centre of pressure [m]."""
    load = contact.pressure.sum(axis=1)
    return float(load @ contact.y_wheel / load.sum())


def _where(states: ContactStates, row: int) -> str:
    return f"contact log: time = {states.time[row]:.6g} s, y_wheel = {states.y_wheel[row] * 1e3:.2f} mm"


def places_between(states: ContactStates, wheel: IntArray) -> tuple[FloatArray, FloatArray]:
    """Places on the wheel between which each row's patch touches, (n,) each [m].

    Infinite where the wheel has no other patch on that side; else where the gap between the patches is
    divided as their half widths.

    Parameters
    ----------
    states
        Contact states.
    wheel
        (n,) number of the wheel of each row.
    """
    order = np.lexsort((states.y_wheel, states.time, wheel))
    y, b = states.y_wheel[order], states.b[order]
    same = (np.diff(states.time[order]) == 0.0) & (np.diff(wheel[order]) == 0)
    width = b[1:] + b[:-1]
    share = np.divide(b[:-1], width, out=np.full(width.size, 0.5), where=width > 0.0)
    border = y[:-1] + share * np.diff(y)
    low, high = np.full(y.size, -np.inf), np.full(y.size, np.inf)
    low[1:][same], high[:-1][same] = border[same], border[same]
    lowest, highest = np.empty(y.size), np.empty(y.size)
    lowest[order], highest[order] = low, high
    return lowest, highest
