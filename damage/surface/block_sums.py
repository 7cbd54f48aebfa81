"""The sums over a block: contact states of one wheel, solved together, for the wheel and for its rail."""

from typing import NamedTuple

import numpy as np

from damage.log_input.states import ContactStates, patch_of
from damage.model import DamageModel
from damage.patch_strips import PatchStrips
from damage.rails.model import WHOLE_PATCH, RailModel
from damage.rails.rail_surface import RailSurface
from damage.rails.side import RailSide, add_to_rail, no_rail, strips_on_rail
from damage.rcf.number import COLUMNS, CORRECTED, COUNTED, ENERGY, Bins
from damage.surface.contact_sums import (
    Placed,
    Solving,
    Sums,
    Work,
    add_patch,
    fill_wear_factors,
    turning_of,
    work_space,
)
from damage.surface.ellipse_sums import add_states
from damage.surface.halfspace_patch import LEAST_LOAD, EllipseSolver, Solved, WheelSolver
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.normal_contact import HALFSPACE, STRIPS
from damage.surface.patch_field import DAMAGE_THEORIES
from damage.surface.rebuilt_sums import add_rebuilt, rebuild_work, rebuilding
from damage.surface.wheel_surface import Wheel, WheelSurface
from damage.wear.films import NO_FILM
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.table import CAPACITY
from hh_exudyn.contact.types import Elastic

_STRIPS_STEP = 32  # of the sizes of work spaces
_COUNTED = {"rcf_number": COUNTED, "corrected_rcf_number": CORRECTED, "energy": ENERGY}  # columns of `counts`
_SUMMED = tuple(name for name in Sums._fields if name not in ("counts", "pressure_by_part"))


class RailBlock(NamedTuple):
    """The states of a block on their rail."""

    stretch: int  # number of the stretch of track
    placed: Placed
    damage: FloatArray  # (n,) of a passing by the whole-life rail model [-]


class Block(NamedTuple):
    """Contact states of one wheel that are summed together."""

    wheel: int  # its place among the wheels of the piece of log
    states: ContactStates
    placed: Placed
    rail: RailBlock | None  # None where no rail is wanted


class BlockSums(NamedTuple):
    """What a block adds to its wheel and to its rail."""

    wheel: Sums
    rail: Sums | None
    whole_life: FloatArray  # (B,) of the rail


def add_block(surface: WheelSurface, row: int, placed: Placed, sums: Sums) -> None:
    """Add the sums of a block to those of its wheel, or of its rail.

    Parameters
    ----------
    surface
        Result, added to.
    row
        Of the wheel in it.
    placed
        The block's states there, with the fatigue indices that belong to it.
    sums
        Of the block.
    """
    index, interval, part = placed.fatigue_index, placed.interval, placed.part
    np.add.at(surface.positive_time[row], part, np.where(index > 0.0, interval, 0.0))
    np.add.at(surface.index_area[row], part, np.maximum(index, 0.0) * interval)
    for name in _SUMMED:
        getattr(surface, name)[row] += getattr(sums, name)
    highest = surface.pressure_by_part[row]
    np.maximum(highest, sums.pressure_by_part, out=highest)
    for name, column in _COUNTED.items():
        getattr(surface, name)[row] += sums.counts[..., column]


def add_rail_block(
    rail: RailSurface, wheel: Wheel, placed: Placed, sums: Sums, whole_life: FloatArray
) -> None:
    """Add the sums of a block to those of its rail; arguments as of `add_block`."""
    row = rail.by_wheel.wheels.index(wheel)
    add_block(rail.by_wheel, row, placed, sums)
    rail.whole_life[row] += whole_life


def block_sums(block: Block, wheel: Wheel, model: DamageModel) -> BlockSums:
    """Sums over the states of a block, from zero.

    Parameters
    ----------
    block
        The states.
    wheel
        Their wheel.
    model
        Settings.

    Raises
    ------
    ValueError
        Nothing touches in the pose of a state.
    """
    sums = _zero_sums(model.grid, model.patch_grid)
    elastic, along = model.material.elastic, model.patch_grid
    solving = Solving(
        DAMAGE_THEORIES[model.theory],
        Elastic(elastic.shear_modulus, elastic.poisson_ratio),
        model.material.shear_yield,
        model.law.values,
        model.limits,
        _bins(model.grid, along),
        NO_FILM if model.films is None else model.films.factors,
    )
    cells = (model.cells[0], CAPACITY) if model.normal == STRIPS else model.cells
    work = work_space(cells, along.count)
    rail = _rail_side(block, wheel.side, model.rails, solving, work, sums)
    if model.normal == STRIPS and model.contact is not None:
        rebuild = rebuilding(model.contact, model.grid, model.flange_angle)
        bad = add_rebuilt(block.states, block.placed, rebuild, solving, rebuild_work(), work, sums, rail)
        if bad >= 0:
            raise ValueError(
                "contact log: wheel and rail do not touch at "
                f"y_wheel = {block.states.y_wheel[bad] * 1e3:.2f} mm, "
                f"time = {block.states.time[bad]:.6g} s: other profiles were in the run"
            )
    elif model.theory == "halfspace":
        solver: WheelSolver | EllipseSolver = EllipseSolver(model.cells)
        if model.normal == HALFSPACE and model.contact is not None:
            solver = WheelSolver(model.contact, model.grid, model.flange_angle, model.pressure_limit, elastic)
        grid = None
        if block.rail is not None and model.rails is not None:
            grid = model.rails.stretches[block.rail.stretch].grid(wheel.side)
        _add_solved(block, solver, solving, along.count, sums, rail, grid)
    else:
        add_states(block.states, block.placed, solving, work, sums, rail)
    if not rail.wanted:
        return BlockSums(sums, None, rail.whole_life)
    rail.sums.pressure_by_part[:] = sums.pressure_by_part  # of the same strips, by the same parts
    return BlockSums(sums, rail.sums, rail.whole_life)


def _bins(grid: LateralGrid, along: PatchGrid) -> Bins:
    return Bins(grid.start, grid.step, along.start, along.step)


def _zero_sums(grid: LateralGrid, along: PatchGrid) -> Sums:
    zero = WheelSurface.zero((Wheel(1, 1, 1, 1),), grid, along)
    counts = np.zeros((*zero.rcf_number.shape[1:], COLUMNS))
    return Sums(**{name: getattr(zero, name)[0] for name in Sums._fields[:-1]}, counts=counts)


def _rail_side(
    block: Block, side: int, rails: RailModel | None, solving: Solving, work: Work, sums: Sums
) -> RailSide:
    """The rail of a block, for the kernels."""
    if block.rail is None or rails is None:
        return no_rail(block.placed, solving, work, sums)
    grid = rails.stretches[block.rail.stretch].grid(side)
    own = solving._replace(
        shear_yield=rails.material.shear_yield, law=rails.wear.values, bins=_bins(grid, WHOLE_PATCH)
    )
    return RailSide(
        True, block.rail.placed, block.rail.damage, own, grid.table, strips_on_rail(work.strips),
        _zero_sums(grid, WHOLE_PATCH), np.zeros(grid.count),
    )  # fmt: skip


def _add_solved(
    block: Block,
    solver: WheelSolver | EllipseSolver,
    solving: Solving,
    bins_along: int,
    sums: Sums,
    rail: RailSide,
    grid: LateralGrid | None,
) -> None:
    """Add the states of a block, each solved by the half-space; their fatigue indices follow from it too.

    A patch under `LEAST_LOAD` is left out: the bodies begin to touch on less than an element of the grid.
    """
    states, placed = block.states, block.placed
    spaces: dict[tuple[int, int], Work] = {}
    loaded = np.flatnonzero(states.normal_force > LEAST_LOAD)
    for rows in np.split(loaded, np.flatnonzero(np.diff(states.time[loaded])) + 1):
        for row, solved in zip(rows, solver.solve(states, placed, rows, solving), strict=True):
            strips, along = solved.fields.pressure.shape
            size = along, -(-strips // _STRIPS_STEP) * _STRIPS_STEP
            if size not in spaces:
                spaces[size] = work_space(size, bins_along)
            for one, body in ((placed, solving), (rail.placed, rail.solving)):
                bearing = 2.0 / 3.0 * solved.area * body.shear_yield
                one.fatigue_index[row] = (solved.force - bearing) / states.normal_force[row]  # (3.16)
            np.maximum.at(sums.pressure_by_part, solved.strips.part, solved.max_pressure)
            fill_wear_factors(states, placed, row, solved.angle, solving, solved.strips)
            turning = turning_of(states, row, placed.interval[row], placed.fatigue_index[row])
            patch, work = patch_of(states, row, solving.elastic), spaces[size]
            add_patch(patch, solved.area, solved.strips, solved.fields, turning, solving, work, sums)
            if grid is not None:
                on_rail = _on_rail(solved, grid, placed, rail.placed, row)
                add_to_rail(rail, row, patch, solved.area, on_rail, solved.fields, turning, work)


def _on_rail(solved: Solved, grid: LateralGrid, on_wheel: Placed, on_rail: Placed, row: int) -> PatchStrips:
    """The strips of a solved patch on its rail: by their own places, those of an ellipse in its plane."""
    strips = solved.strips
    if solved.y_rail is None:
        scale = on_rail.stretch[row] / on_wheel.stretch[row]
        position = on_rail.position[row] + scale * (strips.position - on_wheel.position[row])
        return strips._replace(position=position, covered=scale * strips.covered)
    position, stretch = grid.place(solved.y_rail, solved.angle)
    return strips._replace(position=position, covered=strips.width * stretch)
