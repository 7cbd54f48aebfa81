"""Rows of a log by stretch of track and rail: their places on it, and what needs no solved patch."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from damage.log_input.states import ContactStates
from damage.rails.model import WHOLE_PATCH, RailModel
from damage.rails.rail_surface import RailSurface
from damage.rcf.surface_index import surface_fatigue_index
from damage.surface.contact_sums import Placed
from damage.surface.wheel_surface import Wheel
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.conventions import LEFT, RIGHT

RailPair = tuple[RailSurface, RailSurface]
"""The left and the right rail."""

Rails = dict[tuple[int, int], RailSurface]
"""Sums by the number of the stretch and the side."""


class RailRows(NamedTuple):
    """Contact states on the rails, (n,) each."""

    stretch: IntArray  # its number, -1 for none
    placed: Placed  # on the rail
    damage: FloatArray  # of a passing by the whole-life rail model [-]


def rail_rows(
    states: ContactStates, on_wheel: Placed, lost: FloatArray, rails: RailModel, reach: FloatArray
) -> RailRows:
    """The places of contact states on the rails.

    Parameters
    ----------
    states
        (n,) contact states with `damage.log_input.states.RAIL_COLUMNS`.
    on_wheel
        Their places on the wheels.
    lost
        (n,) wear number of each patch [N].
    rails
        Stretches, steel, damage function.
    reach
        (n,) half the width of each patch across, nought for strips, which lie on the profile [m].

    Raises
    ------
    ValueError
        A patch lies beyond the bins of its rail.
    """
    number = rails.stretch_of(states.s)
    position, stretch = np.zeros(number.size), np.ones(number.size)
    for k in np.unique(number[number >= 0]):
        for side in (LEFT, RIGHT):
            here = (number == k) & (states.side == side)
            grid = rails.stretches[k].grid(side)
            position[here], stretch[here] = grid.place(states.y_rail[here], states.contact_angle[here])
            far = reach * stretch
            beyond = here & ((position - far < grid.edges[0]) | (position + far > grid.edges[-1]))
            if beyond.any():
                first = int(np.argmax(beyond))
                raise ValueError(
                    f"contact log: patch at y_rail = {states.y_rail[first] * 1e3:.2f} mm, "
                    f"time = {states.time[first]:.6g} s, lies beyond the bins of its rail, "
                    f"{grid.edges[0] * 1e3:.0f} to {grid.edges[-1] * 1e3:.0f} mm "
                    f"({int(beyond.sum())} such rows among {beyond.size})"
                )
    index = surface_fatigue_index(
        states.force_x, states.force_y, states.normal_force, states.a, states.b, rails.material.shear_yield
    )
    placed = on_wheel._replace(fatigue_index=index, position=position, stretch=stretch)
    return RailRows(number, placed, rails.whole_life.damage(lost))


def rail_sums(
    states: ContactStates,
    rows: RailRows,
    lost: FloatArray,
    wheels: tuple[Wheel, ...],
    wheel: IntArray,
    model: RailModel,
) -> Rails:
    """The sums of each rail that need no solved patch: times, distances, energy lost.

    Of the patches of a wheel at a time the first stands for the distance: so it counts once, however the log
    is cut. A wheel off its rail rolls on nothing.

    Parameters
    ----------
    states, rows, lost
        As of `rail_rows`.
    wheels, wheel
        The wheels of the states, and (n,) the index of each row.
    model
        Stretches.
    """
    found: Rails = {}
    interval, part = rows.placed.interval, rows.placed.part
    for k in np.unique(rows.stretch[rows.stretch >= 0]).tolist():
        for side in (LEFT, RIGHT):
            here = (rows.stretch == k) & (states.side == side)
            own = np.unique(wheel[here])
            if own.size == 0:
                continue
            names = tuple(wheels[i] for i in own)
            rail = RailSurface.zero(side, names, model.stretches[k].grid(side), WHOLE_PATCH)
            place, lasted, of_part = np.searchsorted(own, wheel[here]), interval[here], part[here]
            way = states.speed[here] * lasted
            np.add.at(rail.rolled, place, np.where(states.patch[here] == 0.0, way, 0.0))
            np.add.at(rail.by_wheel.patch_time, (place, of_part), lasted)
            np.add.at(rail.by_wheel.friction_area, (place, of_part), states.friction[here] * lasted)
            np.add.at(rail.by_wheel.work, place, lost[here] * way)
            first = states.patch[here] == 0.0
            sums = replace(
                rail.by_wheel,
                rows=int(here.sum()),
                time=float(lasted[first].sum()),
                distance=float(rail.rolled.sum()),
            )
            found[k, side] = replace(rail, by_wheel=sums)
    return found


def together(one: Rails, other: Rails) -> Rails:
    """Both sums, by stretch and side."""
    total = dict(one)
    for key, rail in other.items():
        total[key] = total[key] + rail if key in total else rail
    return total


def rail_pairs(found: Rails, model: RailModel) -> tuple[RailPair, ...]:
    """The rails of every stretch of the model; without wheels where none ran."""

    def rail(k: int, side: int) -> RailSurface:
        empty = RailSurface.zero(side, (), model.stretches[k].grid(side), WHOLE_PATCH)
        return found.get((k, side), empty)

    return tuple((rail(k, LEFT), rail(k, RIGHT)) for k in range(len(model.stretches)))
