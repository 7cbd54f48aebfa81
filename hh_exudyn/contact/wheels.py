"""Wheels of one vehicle that differ: tables of their profiles, and which wheel has which.

A `WheelRailModel` has one left and one right wheel, for all wheelsets; with `with_wheels` every wheelset has
its own, in `WheelTables`. `alike` is the model of one of these wheels again, for computations on its patches.
"""

from collections.abc import Sequence

import numpy as np

from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.spline import spline_table
from hh_exudyn.contact.strips.table import CAPACITY, wheel_strips
from hh_exudyn.contact.types import SplineTable, WheelRailModel, WheelStrips, WheelTables
from hh_exudyn.kernel import inlined_kernel

_NODES, _STRIPS = 0, 1  # columns of `WheelTables.counts`
_FIELDS = 5  # of `WheelStrips`


def no_wheels() -> WheelTables:
    """The tables of a model whose wheelsets are all alike: none."""
    return WheelTables(
        starts=np.zeros(0),
        nodes=np.zeros((0, 3, 0)),
        strips=np.zeros((0, _FIELDS, CAPACITY)),
        counts=np.zeros((0, 2), dtype=np.int64),
        which=np.zeros((0, 2), dtype=np.int64),
    )


def with_wheels(
    model: WheelRailModel, wheels: Sequence[tuple[Profile, Profile]], smoothing: float = 0.5e-3
) -> WheelRailModel:
    """A model in which every wheelset has its own left and right wheel.

    Parameters
    ----------
    model : WheelRailModel
        Everything else.
    wheels : sequence of (Profile, Profile)
        Left and right wheel of every wheelset, from the leading one.
    smoothing : float
        As for `wheel_rail.wheel_rail_model` [m].

    Raises
    ------
    ValueError
        A profile of the wrong kind.
    """
    distinct: list[Profile] = []
    which = np.zeros((len(wheels), 2), dtype=np.int64)
    for i, pair in enumerate(wheels):
        for s, profile in enumerate(pair):
            if profile.kind != "wheel":
                raise ValueError(f"wheel {i + 1}{'LR'[s]}: profile {profile.name!r} is a {profile.kind}'s")
            same = [k for k, other in enumerate(distinct) if _equal(profile, other)]
            which[i, s] = same[0] if same else len(distinct)
            if not same:
                distinct.append(profile)
    splines = [spline_table(profile, smoothing=smoothing) for profile in distinct]
    rings = [wheel_strips(table) for table in splines]
    nodes = np.zeros((len(distinct), 3, max(table.z.size for table in splines)))
    strips = np.zeros((len(distinct), _FIELDS, CAPACITY))
    for k, (table, ring) in enumerate(zip(splines, rings, strict=True)):
        nodes[k, :, : table.z.size] = table.z, table.second, table.slope
        strips[k, :, : ring.y.size] = ring
    counts = [[table.z.size, ring.y.size] for table, ring in zip(splines, rings, strict=True)]
    starts = np.array([table.start for table in splines])
    tables = WheelTables(starts, nodes, strips, np.array(counts, dtype=np.int64), which)
    left, right = which[0]
    return model._replace(
        wheel_left=splines[left],
        wheel_right=splines[right],
        strips_left=rings[left],
        strips_right=rings[right],
        wheels=tables,
    )


def alike(model: WheelRailModel, i: int, s: int) -> WheelRailModel:
    """The model of a vehicle all of whose wheels are like one of a model.

    Parameters
    ----------
    model : WheelRailModel
        With that wheel.
    i, s : int
        Wheelset from 0, and side, 0 left or 1 right.
    """
    profile, strips = wheel_of(model, i, s), strips_of(model, i, s)
    return model._replace(
        wheel_left=profile,
        wheel_right=profile,
        strips_left=strips,
        strips_right=strips,
        wheels=no_wheels(),
    )


def wheel_of(model: WheelRailModel, i: int, s: int) -> SplineTable:
    """The profile of a wheel.

    Parameters
    ----------
    model, i, s
        The model, wheelset from 0, and side, 0 left or 1 right.
    """
    wheels = model.wheels
    if wheels.which.shape[0] == 0:
        return model.wheel_left if s == 0 else model.wheel_right
    k = wheels.which[i, s]
    count = wheels.counts[k, _NODES]
    z, second, slope = wheels.nodes[k, 0][:count], wheels.nodes[k, 1][:count], wheels.nodes[k, 2][:count]
    step, per_step = model.wheel_left.step, model.wheel_left.per_step
    return SplineTable(wheels.starts[k], step, z, second, per_step, slope)


def strips_of(model: WheelRailModel, i: int, s: int) -> WheelStrips:
    """The strips of a wheel; parameters as of `wheel_of`."""
    wheels = model.wheels
    if wheels.which.shape[0] == 0:
        return model.strips_left if s == 0 else model.strips_right
    k = wheels.which[i, s]
    count = wheels.counts[k, _STRIPS]
    own = wheels.strips[k]
    return WheelStrips(own[0][:count], own[1][:count], own[2][:count], own[3][:count], own[4][:count])


wheel_in = inlined_kernel(wheel_of)
strips_in = inlined_kernel(strips_of)
"""As kernels, which can return no arrays to Python."""


def _equal(one: Profile, other: Profile) -> bool:
    return np.array_equal(one.y, other.y) and np.array_equal(one.z, other.z)
