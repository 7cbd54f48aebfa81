"""The alignment: straights, clothoids and curves, and the track frame at every arc length.

People write sections (`Straight`, `Transition`, `Curve`); `Alignment` checks them and builds a table that
the kernels `track_frame` and `locate` read. Curvature and cant vary linearly with arc length between the
ends of a section (a clothoid with a linear cant ramp), and the centre line starts at s = 0 in the origin of
the global frame, heading along +X.

What holds outside the sections: before s = 0 and behind the end the track goes on with the curvature, cant
and gauge it has there (`lead_in` and `run_out` metres, since the rear of a vehicle stands at s < 0), so an
alignment of one `Curve` is a full circle. A `Transition` at the start or the end joins a straight without
cant. Beyond lead-in and run-out there is no track: the kernels return NaN.

First form: the centre line lies in the plane z = 0 and cant turns the running plane about it (the inner rail
falls as much as the outer one rises); there are no gradients.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Self

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.conventions import GRAVITY, LEFT, NOMINAL_GAUGE, RAIL_TOP_DISTANCE, RIGHT
from hh_exudyn.kernel import kernel
from track.types import AlignmentTable, Node

_HANDS = {"left": LEFT, "right": RIGHT}
_LENGTH = (1e-3, 1e6)  # m, ranges of what a person may write
_RADIUS = (100.0, 20000.0)  # m
_CANT = (0.0, 0.180)  # m, EN 13803:2017 allows 180 mm as exceptional limit
_GAUGE = (1.40, 1.50)  # m
_NEWTON_STEPS = 20  # of `locate`; two or three are used from a guess some metres away


def _check(name: str, value: float, limits: tuple[float, float], unit: str = "m") -> None:
    """Raise ValueError unless `value` is a number within `limits` (NaN is not)."""
    if not limits[0] <= value <= limits[1]:
        raise ValueError(f"{name} is {value} {unit}, allowed are {limits[0]:g} to {limits[1]:g} {unit}")


@dataclass(frozen=True)
class Straight:
    """Straight track without cant: its length [m] and its gauge [m]."""

    length: float
    gauge: float = NOMINAL_GAUGE

    def __post_init__(self) -> None:
        _check("length of a Straight", self.length, _LENGTH)
        _check("gauge of a Straight", self.gauge, _GAUGE)


@dataclass(frozen=True)
class Transition:
    """A clothoid that takes curvature, cant and gauge linearly from one neighbour's value to the other's.

    Straight to curve, curve to straight, curve to another curve of the same hand (compound) or of the other
    (reverse). `length` [m]. `gauge` [m] is the gauge at its middle; None, the default, is the mean of the
    neighbours', that is one linear ramp.
    """

    length: float
    gauge: float | None = None

    def __post_init__(self) -> None:
        _check("length of a Transition", self.length, _LENGTH)
        if self.gauge is not None:
            _check("gauge of a Transition", self.gauge, _GAUGE)


@dataclass(frozen=True)
class Curve:
    """A circular arc: length, radius of the centre line, hand "left" or "right", cant >= 0, gauge [m].

    The cant always raises the outer rail.
    """

    length: float
    radius: float
    hand: str
    cant: float = 0.0
    gauge: float = NOMINAL_GAUGE

    def __post_init__(self) -> None:
        _check("length of a Curve", self.length, _LENGTH)
        _check("radius of a Curve", self.radius, _RADIUS)
        _check("cant of a Curve", self.cant, _CANT)
        _check("gauge of a Curve", self.gauge, _GAUGE)
        if self.hand not in _HANDS:
            raise ValueError(f'hand of a Curve is {self.hand!r}, allowed are "left" and "right"')


Section = Straight | Transition | Curve


@kernel
def _clothoid(curvature: float, rate: float, u: float) -> tuple[float, float, float]:
    """Heading and position after length u on a clothoid that starts at the origin along +x.

    theta = curvature u + rate u^2 / 2; the integrals of cos and sin by their series, cut where the remainder
    is below 1e-11 m for u <= 2 m and 1e-14 m for u <= 0.5 m (radii of 100 m and more).
    """
    a = curvature * u
    b = 0.5 * rate * u * u
    # with t = u'/u: theta = a t + b t^2; ahead = u int(1 - theta^2/2 + theta^4/24), aside = u int(theta -
    # theta^3/6 + theta^5/120), each power integrated from t = 0 to 1
    square = a * a / 3.0 + a * b / 2.0 + b * b / 5.0
    cube = a**3 / 4.0 + 3.0 * a * a * b / 5.0 + a * b * b / 2.0 + b**3 / 7.0
    fourth = a**4 / 5.0 + 4.0 * a**3 * b / 6.0 + 6.0 * a * a * b * b / 7.0 + 4.0 * a * b**3 / 8.0 + b**4 / 9.0
    ahead = u * (1.0 - square / 2.0 + fourth / 24.0)
    aside = u * (a / 2.0 + b / 3.0 - cube / 6.0 + (a + b) ** 5 / 720.0)
    return a + b, ahead, aside


@kernel
def _cell(table: AlignmentTable, s: float) -> int:
    """Node at or before s, -1 where s is NaN or outside the table."""
    if not (table.start <= s <= table.end):
        return -1
    i = table.cell[int((s - table.start) / table.step)]
    last = table.nodes.shape[0] - 2
    while i < last and s >= table.nodes[i + 1, Node.S]:
        i += 1
    return i


@kernel
def _centre(
    here: NDArray[np.float64], ahead: NDArray[np.float64], s: float
) -> tuple[float, float, float, float]:
    """Position x, y [m], turn since node `here` [rad] and curvature [1/m] of the centre line at s."""
    u = s - here[Node.S]
    rate = (ahead[Node.CURVATURE] - here[Node.CURVATURE]) / (ahead[Node.S] - here[Node.S])
    turn, forward, aside = _clothoid(here[Node.CURVATURE], rate, u)
    x = here[Node.X] + here[Node.FORWARD_X] * forward - here[Node.FORWARD_Y] * aside
    y = here[Node.Y] + here[Node.FORWARD_Y] * forward + here[Node.FORWARD_X] * aside
    return x, y, turn, here[Node.CURVATURE] + rate * u


@kernel
def track_frame(table: AlignmentTable, s: float) -> tuple[float, float, float, float, float, float, float]:
    """The track frame T at arc length s.

    Returns x, y, z [m] of its origin (centre line, running plane; global frame), heading about Z [rad], roll
    about the forward axis [rad] (negative in a canted left-hand curve: the right rail is higher), curvature
    [1/m], gauge [m]. All NaN outside the table. The rotation T to global is `rotation(heading, roll)`.
    """
    i = _cell(table, s)
    if i < 0:
        return math.nan, math.nan, math.nan, math.nan, math.nan, math.nan, math.nan
    here = table.nodes[i]
    ahead = table.nodes[i + 1]
    x, y, turn, curvature = _centre(here, ahead, s)
    part = (s - here[Node.S]) / (ahead[Node.S] - here[Node.S])
    cant = here[Node.CANT] + part * (ahead[Node.CANT] - here[Node.CANT])
    gauge = here[Node.GAUGE] + part * (ahead[Node.GAUGE] - here[Node.GAUGE])
    roll = -math.asin(cant / RAIL_TOP_DISTANCE)  # cant is the height difference over 1.5 m, EN 13848-1
    return x, y, 0.0, here[Node.HEADING] + turn, roll, curvature, gauge


@kernel
def rotation(heading: float, roll: float, out: NDArray[np.float64]) -> None:
    """Write the rotation matrix T to global, Rz(heading) Rx(roll), into `out` (3, 3)."""
    ch = math.cos(heading)
    sh = math.sin(heading)
    cr = math.cos(roll)
    sr = math.sin(roll)
    out[0, 0], out[0, 1], out[0, 2] = ch, -sh * cr, sh * sr
    out[1, 0], out[1, 1], out[1, 2] = sh, ch * cr, -ch * sr
    out[2, 0], out[2, 1], out[2, 2] = 0.0, sr, cr


@kernel
def locate(table: AlignmentTable, x: float, y: float, s_guess: float) -> float:
    """Arc length [m] of the foot of the perpendicular from (x, y) on the centre line in plan.

    That is where the point has no x coordinate in T: roll is about the forward axis, so the point's height
    does not enter, and this holds exactly on canted track. Newton's method from `s_guess`, exact to 1e-10 m.
    NaN where the foot lies outside the table or Newton fails (point near the centre of the curve).
    """
    s = s_guess
    for _ in range(_NEWTON_STEPS):
        i = _cell(table, s)
        if i < 0:
            return math.nan
        here = table.nodes[i]
        x0, y0, turn, curvature = _centre(here, table.nodes[i + 1], s)
        square = turn * turn  # cos and sin of the small turn by their series, below 1e-16 for 0.02 rad
        ct = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0))
        st = turn * (1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0)))
        c = here[Node.FORWARD_X] * ct - here[Node.FORWARD_Y] * st
        n = here[Node.FORWARD_Y] * ct + here[Node.FORWARD_X] * st
        forward = c * (x - x0) + n * (y - y0)
        aside = c * (y - y0) - n * (x - x0)
        step = forward / (1.0 - curvature * aside)
        s += step
        if abs(step) < 1e-5:  # converges quadratically: the error left is far below 1e-10 m
            return s if table.start <= s <= table.end else math.nan
    return math.nan


@dataclass(frozen=True)
class Alignment:
    """A checked row of sections with its kernel table.

    Parameters
    ----------
    sections : from s = 0 onwards
    step : largest distance of the table's nodes [m], 0.05 to 2
    lead_in, run_out : length of the track before s = 0 and behind the end [m]

    Raises
    ------
    ValueError
        No section, a number out of range, or curvature, cant or gauge that jump: names the section.
    """

    sections: tuple[Section, ...]
    step: float = 0.5
    lead_in: float = 50.0
    run_out: float = 50.0
    table: AlignmentTable = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not self.sections:
            raise ValueError("sections is empty, at least one is needed")
        _check("step", self.step, (0.05, 2.0))
        _check("lead_in", self.lead_in, _LENGTH)
        _check("run_out", self.run_out, _LENGTH)
        object.__setattr__(self, "table", _table(self))

    @classmethod
    def from_sections(cls, sections: Iterable[Section], step: float = 0.5) -> Self:
        """The alignment made of `sections`, from s = 0 onwards."""
        return cls(tuple(sections), step)

    @property
    def length(self) -> float:
        """Arc length of all sections, without lead-in and run-out [m]."""
        return math.fsum(section.length for section in self.sections)

    def section_at(self, s: float) -> Section:
        """The section at arc length s [m]; on a boundary the one that begins there.

        Raises ValueError outside 0 to `length` (lead-in and run-out belong to no section).
        """
        _check("s", s, (0.0, self.length))
        end = 0.0
        for section in self.sections:
            end += section.length
            if s < end:
                return section
        return self.sections[-1]

    def mirrored(self) -> Self:
        """The mirror image: left-hand curves become right-hand ones and the other way round."""
        hands = {"left": "right", "right": "left"}
        return replace(
            self,
            sections=tuple(
                replace(section, hand=hands[section.hand]) if isinstance(section, Curve) else section
                for section in self.sections
            ),
        )


_State = tuple[float, float, float]  # curvature [1/m], signed cant [m], gauge [m]


def _state(section: Section) -> _State:
    """The constant state of a straight or curve."""
    if isinstance(section, Straight):
        return 0.0, 0.0, section.gauge
    assert isinstance(section, Curve)
    sign = _HANDS[section.hand]
    return sign / section.radius, sign * section.cant, section.gauge


def _breakpoints(sections: tuple[Section, ...]) -> list[tuple[float, _State]]:
    """Arc length and state wherever a slope changes, from 0 to the length; checks that nothing jumps."""
    ends: list[tuple[_State, _State]] = []
    for i, section in enumerate(sections):
        if not isinstance(section, Transition):
            ends.append((_state(section), _state(section)))
            continue
        neighbours = [sections[k] for k in (i - 1, i + 1) if 0 <= k < len(sections)]
        if not neighbours or any(isinstance(neighbour, Transition) for neighbour in neighbours):
            raise ValueError(
                f"section {i + 1} is a Transition whose ends are not defined: a Straight or Curve must "
                "stand between two Transitions, and one alone joins nothing"
            )
        states = [_state(neighbour) for neighbour in neighbours]
        if i == 0:
            states.insert(0, (0.0, 0.0, states[0][2]))  # the straight that is assumed before the start
        elif i + 1 == len(sections):
            states.append((0.0, 0.0, states[0][2]))
        ends.append((states[0], states[1]))
    s = 0.0
    points = [(s, ends[0][0])]
    for i, (section, (first, last)) in enumerate(zip(sections, ends, strict=True)):
        for name, unit, old, new in zip(
            ("curvature", "cant", "gauge"), ("1/m", "m", "m"), points[-1][1], first, strict=True
        ):
            if old != new:
                raise ValueError(
                    f"{name} jumps from {old:g} to {new:g} {unit} between section {i} and section {i + 1} "
                    f"at s = {s:g} m, allowed is 0: put a Transition between them"
                )
        if isinstance(section, Transition) and section.gauge is not None:
            middle = (0.5 * (first[0] + last[0]), 0.5 * (first[1] + last[1]), section.gauge)
            points.append((s + 0.5 * section.length, middle))
        s += section.length
        points.append((s, last))
    return points


def _table(alignment: Alignment) -> AlignmentTable:
    """Nodes of an alignment: clothoid pieces put end to end, then moved so that s = 0 is the origin."""
    inner = _breakpoints(alignment.sections)
    points = [(-alignment.lead_in, inner[0][1]), *inner, (inner[-1][0] + alignment.run_out, inner[-1][1])]
    at = np.array([s for s, _ in points])
    pieces = [
        np.linspace(a, b, max(1, math.ceil((b - a) / alignment.step - 1e-9)) + 1)[:-1]
        for a, b in pairwise(at)
    ]
    s = np.concatenate([*pieces, at[-1:]])
    curvature, cant, gauge = (np.interp(s, at, [state[k] for _, state in points]) for k in range(3))
    h = np.diff(s)
    steps = [_clothoid(k, r, u) for k, r, u in zip(curvature[:-1], np.diff(curvature) / h, h, strict=True)]
    turn, ahead, aside = np.array(steps).T
    zero = int(np.searchsorted(s, 0.0))
    heading = np.concatenate([[0.0], np.cumsum(turn)])
    heading -= heading[zero]
    c, n = np.cos(heading), np.sin(heading)
    x = np.concatenate([[0.0], np.cumsum(c[:-1] * ahead - n[:-1] * aside)])
    y = np.concatenate([[0.0], np.cumsum(n[:-1] * ahead + c[:-1] * aside)])
    grid = s[0] + alignment.step * np.arange(math.ceil((s[-1] - s[0]) / alignment.step) + 2)
    cell = np.clip(np.searchsorted(s, grid, side="right") - 1, 0, s.size - 2)
    nodes = np.column_stack([s, x - x[zero], y - y[zero], heading, c, n, curvature, cant, gauge])
    return AlignmentTable(float(s[0]), float(s[-1]), float(alignment.step), cell.astype(np.int64), nodes)


def cant_deficiency(speed: float, radius: float, cant: float = 0.0) -> float:
    """Cant deficiency in a curve [m], negative for cant excess.

    I = e V^2 / (g R) - cant with e the lateral distance of the rail tops, EN 13803:2017 (its 11.8 V^2 / R in
    mm, km/h and m at e = 1500 mm).

    Parameters
    ----------
    speed : [m/s], 0 to 150
    radius : [m], 100 to 20000
    cant : [m], 0 to 0.180
    """
    _check("speed", speed, (0.0, 150.0), "m/s")
    _check("radius", radius, _RADIUS)
    _check("cant", cant, _CANT)
    return RAIL_TOP_DISTANCE * speed**2 / (GRAVITY * radius) - cant
