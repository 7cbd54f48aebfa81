"""The rail of one side along the track: section by section, changing smoothly from profile to profile.

Between two sections the profiles blend over a ramp of length r about the place s_c of the change,

    z = (1 - w) z1 + w z2,   w = t^3 (10 - 15 t + 6 t^2),   t = (s - s_c)/r + 1/2                    (1)

of points that lie alike in the track: the profiles are laid with their gauge points upon each other, to half
a node spacing, and the rest of their difference blends too, like the gauge point itself. So the gauge
stays, nothing jumps, and outside its ramps a section has its own profile to the last digit. Along
the ramp the search for contact takes the rail as a prism, as it is elsewhere; the slope of its surface there
(2 mm ground off over 2 m) turns the contact frame (`surface_slope`).
"""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile, gauge_point
from hh_exudyn.contact.profiles.spline import spline_evaluate, spline_table, uniform_table
from hh_exudyn.contact.profiles.steepness import MAX_SLOPE
from hh_exudyn.contact.types import Memory, RailTables, SplineTable
from hh_exudyn.conventions import GAUGE_MEASURING_DEPTH
from hh_exudyn.kernel import allocating_kernel, inlined_kernel, kernel, memory, shaped

CHANGE_LENGTH = 2.0  # m, assumed: length over which one rail passes into another (welded and ground)
_PROFILE, _START, _GAUGE_POINT, _END = range(4)  # columns of `RailTables.sections`; end: middle of the change
_Z, _SECOND, _SLOPE = range(3)  # of `RailTables.nodes`
_ROWS, _MOST_NODES = 3, 2048  # of a blend
RAIL_ROOM = _ROWS * _MOST_NODES  # numbers


@dataclass(frozen=True)
class RailCourse:
    """The profiles of one side along the track.

    Attributes
    ----------
    profiles : tuple of Profile
        Of each section, in the order of the arc length.
    changes : tuple of float
        Arc lengths of the middles of the changes, one less than there are sections [m].
    change_length : float
        Length of every change, > 0 [m].
    gauge_depth : float
        Depth below the top down to which the gauge is measured [m].

    Raises
    ------
    ValueError
        A profile that is no rail's, not one change between any two sections, changes that do not follow
        each other with at least their length between, or a length that is no positive number.
    """

    profiles: tuple[Profile, ...]
    changes: tuple[float, ...] = ()
    change_length: float = CHANGE_LENGTH
    gauge_depth: float = GAUGE_MEASURING_DEPTH

    def __post_init__(self) -> None:
        for profile in self.profiles:
            if profile.kind != "rail":
                raise ValueError(f"profile {profile.name!r} is of kind {profile.kind!r}, needed: 'rail'")
        if len(self.changes) != len(self.profiles) - 1:
            raise ValueError(
                f"{len(self.profiles)} profiles with {len(self.changes)} changes, allowed one change between "
                "any two profiles"
            )
        if not (math.isfinite(self.change_length) and self.change_length > 0.0):
            raise ValueError(f"change_length = {self.change_length} m, allowed a number > 0 m")
        for one, other in pairwise((-math.inf, *self.changes)):
            if not (math.isfinite(other) and other - one >= self.change_length):
                raise ValueError(
                    f"a change of rails at s = {other:g} m behind one at {one:g} m, allowed are "
                    f"{self.change_length:g} m and more between them: one ends before the next begins"
                )

    def weights(self, s: FloatArray) -> FloatArray:
        """How much of each section's profile lies at arc lengths s (n,) [m]: (n, sections), rows sum to 1."""
        found = np.empty((len(s), len(self.profiles)))
        _fill_weights(np.array(self.changes), self.change_length, np.asarray(s, dtype=np.float64), found)
        return found

    def gauge_points(self) -> FloatArray:
        """Lateral position of each profile's gauge point in its own coordinates [m]."""
        return np.array([gauge_point(profile, self.gauge_depth) for profile in self.profiles])


def rail_tables(course: RailCourse, smoothing: float) -> RailTables:
    """The tables of all profiles of a course, on nodes that correspond to each other.

    The tables of different profiles differ in width by some millimetres: beyond its flank (slopes above
    `MAX_SLOPE`) a rail is continued by the parabola with which its table ends. One that ends without a flank
    (a measured rail, cut off) cuts the others there, at least 55 mm from the gauge point (`Profile`).

    Parameters
    ----------
    course : RailCourse
        One side of the track.
    smoothing : float
        As of `spline.spline_table` [m].
    """
    distinct: list[Profile] = []
    rows = []
    for profile in course.profiles:
        same = [k for k, other in enumerate(distinct) if _equal(profile, other)]
        rows.append(same[0] if same else len(distinct))
        if not same:
            distinct.append(profile)
    points = np.array([gauge_point(profile, course.gauge_depth) for profile in distinct])
    tables = _alike([spline_table(profile, smoothing=smoothing) for profile in distinct], points)
    if tables[0].z.size > _MOST_NODES:
        raise ValueError(
            f"rail profiles of {tables[0].z.size} nodes at {tables[0].step * 1e3:g} mm, allowed {_MOST_NODES}"
        )
    kept = [i for i in range(len(rows)) if i == 0 or rows[i] != rows[i - 1]]  # no change is left of a section
    ends = [course.changes[i - 1] for i in kept[1:]] + [math.inf]
    return RailTables(
        step=tables[0].step,
        per_step=tables[0].per_step,
        change_length=course.change_length,
        nodes=np.stack([np.stack([table.z, table.second, table.slope]) for table in tables]),
        sections=np.array(
            [
                (rows[i], tables[rows[i]].start, points[rows[i]], end)
                for i, end in zip(kept, ends, strict=True)
            ]
        ),
    )


def with_origin(rails: RailTables, offset: float) -> RailTables:
    """The same rails with the origin of every profile `offset` [m] outwards of half the gauge."""
    sections = rails.sections.copy()
    sections[:, _GAUGE_POINT] = offset
    return rails._replace(sections=sections)


def _equal(one: Profile, other: Profile) -> bool:
    return np.array_equal(one.y, other.y) and np.array_equal(one.z, other.z)


def _alike(tables: list[SplineTable], points: FloatArray) -> list[SplineTable]:
    """The tables with as many nodes each, node by node about as far from their gauge points [m]."""
    if len(tables) == 1:
        return tables
    step = tables[0].step
    first = [round((table.start - point) / step) for table, point in zip(tables, points, strict=True)]
    last = [begin + table.z.size - 1 for begin, table in zip(first, tables, strict=True)]
    cut_first = [n for n, table in zip(first, tables, strict=True) if table.slope[0] < MAX_SLOPE]
    cut_last = [n for n, table in zip(last, tables, strict=True) if table.slope[-1] > -MAX_SLOPE]
    begin = max(cut_first, default=min(first))
    end = min(cut_last, default=max(last))
    return [_resized(table, n - begin, end - m) for table, n, m in zip(tables, first, last, strict=True)]


def _resized(table: SplineTable, before: int, behind: int) -> SplineTable:
    """A table with nodes added at its ends (along its last parabola), or taken away where negative."""
    z, second, start = table.z, table.second, table.start
    out = table.step * np.arange(1, max(before, 0) + 1)
    lead = z[0] - table.slope[0] * out + 0.5 * second[0] * out**2
    z = np.concatenate([lead[::-1], z[max(-before, 0) :]])
    second = np.concatenate([np.full(out.size, second[0]), second[max(-before, 0) :]])
    out = table.step * np.arange(1, max(behind, 0) + 1)
    tail = table.z[-1] + table.slope[-1] * out + 0.5 * second[-1] * out**2
    stop = len(z) - max(-behind, 0)
    z = np.concatenate([z[:stop], tail])
    second = np.concatenate([second[:stop], np.full(out.size, second[-1])])
    return uniform_table(start - before * table.step, table.step, z, second)


@inlined_kernel
def rail_in(rails: RailTables, s: float, room: Memory) -> tuple[SplineTable, float]:
    """The rail at arc length s [m], and y of its gauge point [m]: a section's own table, or a blend.

    Parameters
    ----------
    rails : RailTables
        Of one side.
    s : float
        Arc length [m].
    room : memory
        `RAIL_ROOM` numbers, in which the nodes of a blend lie: the table is good while they are.
    """
    section, share = _section_at(rails.sections, rails.change_length, s)
    if share > 0.0:
        start, point = _blended(rails, section, share, room)
        nodes, count = shaped(room, (_ROWS, _MOST_NODES)), rails.nodes.shape[2]
        z, second, slope = nodes[_Z][:count], nodes[_SECOND][:count], nodes[_SLOPE][:count]
    else:
        place = rails.sections[section]
        start, point = place[_START], place[_GAUGE_POINT]
        k = int(place[_PROFILE])
        z, second, slope = rails.nodes[k, _Z], rails.nodes[k, _SECOND], rails.nodes[k, _SLOPE]
    return SplineTable(start, rails.step, z, second, rails.per_step, slope), point


def rail_at(rails: RailTables, s: float) -> tuple[SplineTable, float]:
    """`rail_in` for Python, with room of its own."""
    nodes = np.empty((_ROWS, rails.nodes.shape[2]))
    start, point = _copy_rail(rails, s, nodes)
    return SplineTable(start, rails.step, nodes[_Z], nodes[_SECOND], rails.per_step, nodes[_SLOPE]), point


@kernel
def _copy_rail(rails: RailTables, s: float, nodes: FloatArray) -> tuple[float, float]:
    """Copy the nodes of `rail_in`; y of the first one and of the gauge point."""
    table, point = rail_in(rails, s, memory(RAIL_ROOM))
    for k in range(nodes.shape[1]):
        nodes[_Z, k], nodes[_SECOND, k], nodes[_SLOPE, k] = table.z[k], table.second[k], table.slope[k]
    return table.start, point


@inlined_kernel
def gauge_point_at(rails: RailTables, s: float) -> float:
    """y of the gauge point of the rail at arc length s [m], in the coordinates of its profile [m]."""
    section, share = _section_at(rails.sections, rails.change_length, s)
    point = rails.sections[section, _GAUGE_POINT]
    if share > 0.0:
        point = (1.0 - share) * point + share * rails.sections[section + 1, _GAUGE_POINT]
    return point


@inlined_kernel
def changes_at(rails: RailTables, s: float) -> bool:
    """Whether the profile of the rail changes at arc length s [m]."""
    return _section_at(rails.sections, rails.change_length, s)[1] > 0.0


@inlined_kernel
def surface_slope(rails: RailTables, s: float, y: float) -> float:
    """Slope dz/ds of the rail's surface along the track where its profile changes, zero elsewhere [-].

    At a constant distance from the gauge point, as that lies straight on through a change: the derivative of
    equation 1. NaN beyond the profile.

    Parameters
    ----------
    rails : RailTables
        Of one side.
    s : float
        Arc length [m].
    y : float
        Place on the profile there, as `rail_at` gives it [m].
    """
    section, share = _section_at(rails.sections, rails.change_length, s)
    return _slope_of_change(rails, section, share, s, y) if share > 0.0 else 0.0


@kernel
def _slope_of_change(rails: RailTables, section: int, share: float, s: float, y: float) -> float:
    """`surface_slope` inside a change: a call of its own, which would cost every contact elsewhere."""
    t = (s - rails.sections[section, _END]) / rails.change_length + 0.5
    share_rate = 30.0 * (t * (1.0 - t)) ** 2 / rails.change_length
    one, other = rails.sections[section], rails.sections[section + 1]
    rest = 1.0 - share
    along = y - (
        rest * one[_START] + share * other[_START]
    )  # from the first node, the same for both profiles
    z, slope, _ = spline_evaluate(_from_first_node(rails, int(one[_PROFILE])), along)
    z_other, slope_other, _ = spline_evaluate(_from_first_node(rails, int(other[_PROFILE])), along)
    shift = (other[_GAUGE_POINT] - other[_START]) - (one[_GAUGE_POINT] - one[_START])
    return share_rate * (z_other - z + (rest * slope + share * slope_other) * shift)


@inlined_kernel
def _from_first_node(rails: RailTables, k: int) -> SplineTable:
    """A profile with the origin of y in its first node."""
    nodes = rails.nodes[k]
    return SplineTable(0.0, rails.step, nodes[_Z], nodes[_SECOND], rails.per_step, nodes[_SLOPE])


@inlined_kernel
def _section_at(sections: FloatArray, length: float, s: float) -> tuple[int, float]:
    """The section at arc length s, and how much of the next one's profile there is (w of equation 1)."""
    section = 0
    while section < len(sections) - 1 and s >= sections[section, _END] + 0.5 * length:
        section += 1
    t = (s - sections[section, _END]) / length + 0.5
    if not t > 0.0:
        return section, 0.0
    share = t * t * t * (10.0 + t * (6.0 * t - 15.0))
    if share >= 1.0:  # by rounding, just before its end
        return section + 1, 0.0
    return section, share


@kernel
def _blended(rails: RailTables, section: int, share: float, room: Memory) -> tuple[float, float]:
    """Equation 1 of a section and the next: nodes into `room`; y of the first one and of the gauge point."""
    one, other = rails.sections[section], rails.sections[section + 1]
    first, second = rails.nodes[int(one[_PROFILE])], rails.nodes[int(other[_PROFILE])]
    nodes = shaped(room, (_ROWS, _MOST_NODES))
    rest = 1.0 - share
    for row in range(_ROWS):
        for k in range(first.shape[1]):
            nodes[row, k] = rest * first[row, k] + share * second[row, k]
    return (
        rest * one[_START] + share * other[_START],
        rest * one[_GAUGE_POINT] + share * other[_GAUGE_POINT],
    )


@allocating_kernel
def _fill_weights(change: FloatArray, length: float, s: FloatArray, weights: FloatArray) -> None:
    """`RailCourse.weights` into `weights`, (n, sections)."""
    sections = np.full((change.size + 1, _END + 1), math.inf)
    sections[:-1, _END] = change
    weights[:] = 0.0
    for i in range(s.size):
        section, share = _section_at(sections, length, s[i])
        weights[i, section] = 1.0 - share
        if share > 0.0:
            weights[i, section + 1] = share
