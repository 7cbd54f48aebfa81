"""Sums over the contact states of a log on the wheel surfaces: the loop over all rows.

Every row has an output interval dt. In it the wheel turns V dt / (2 pi r) times; each turn adds the depth of
the wear law to the strip of the profile that the patch covers, and counts where the patch is beyond
shakedown. The depth is normal to the surface. Over the arc of the profile (`lateral_grid`) the patch lies at
the arc length of y_wheel and is as wide as in its own plane; over the lateral coordinate it covers y (frame
C, to the left) at y_wheel - side y cos(gamma), so a bin of width w holds the worn area depth w / cos(gamma).

The rows of a chunk are sorted by wheel and cut into blocks of a fixed size. Each is summed by itself, several
at once in threads (the kernel holds no lock), and their sums are added in the order of the blocks: the result
is the same to the last bit however many threads there are.
"""

import math
import os
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from damage.log_input.bad_rows import BadRows, Fault
from damage.log_input.contact_source import ContactSource, has_column
from damage.log_input.contact_states import CHUNK_ROWS, DAMAGE_COLUMNS
from damage.log_input.output_clock import (
    GapInTime,
    OutOfOrder,
    OutputClock,
    TimedStates,
    output_clock,
    timed_states,
)
from damage.log_input.states import POSE_COLUMNS, ContactStates, patch_of
from damage.model import DamageModel
from damage.patch_strips import FLANGE, TREAD
from damage.rcf.number import COLUMNS, CORRECTED, COUNTED, ENERGY, Bins
from damage.rcf.subsurface import level_of, subsurface_fatigue_index
from damage.rcf.surface_index import surface_fatigue_index
from damage.surface.contact_sums import (
    Placed,
    Solving,
    Sums,
    Work,
    add_patch,
    add_states,
    fill_wear_factors,
    turning_of,
    work_space,
)
from damage.surface.halfspace_patch import LEAST_LOAD, EllipseSolver, WheelSolver, places_between
from damage.surface.normal_contact import ELLIPSE, HALFSPACE, STRIPS
from damage.surface.patch_field import DAMAGE_THEORIES
from damage.surface.rebuilt_sums import add_rebuilt, rebuild_work, rebuilding
from damage.surface.wheel_surface import Wheel, WheelSurface
from damage.wear.energy import wear_number
from damage.wear.films import NO_FILM
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.strips.table import CAPACITY
from hh_exudyn.contact.types import Elastic

BLOCK_ROWS = 2500  # rows of a block: some 50 ms of work; the sums depend on it in the last digits
HALFSPACE_ROWS = 50  # of the half-space: a second; the first of a block begins from nothing

_STRIPS_STEP = 32  # of the sizes of work spaces
_COUNTED = {"rcf_number": COUNTED, "corrected_rcf_number": CORRECTED, "energy": ENERGY}  # columns of `counts`
_SUMMED = tuple(name for name in Sums._fields if name not in ("counts", "pressure_by_part"))


Progress = Callable[[int], None]


class Block(NamedTuple):
    """Contact states of one wheel that are summed together."""

    wheel: int  # its place among the wheels of the piece of log
    states: ContactStates
    placed: Placed


def accumulate(
    source: ContactSource,
    model: DamageModel,
    clock: OutputClock | None = None,
    chunk_rows: int = CHUNK_ROWS,
    threads: int | None = None,
    bad_rows: BadRows | None = None,
    progress: Progress | None = None,
) -> WheelSurface:
    """Sum a contact log on the surfaces of its wheels.

    Parameters
    ----------
    source
        The contact log, see `damage.log_input.contact_source`.
    model
        Settings of the computation.
    clock
        Output times of the whole log where `source` is a piece of it; None finds those of `source` while it
        is read, once if it is in order of time.
    chunk_rows
        Rows that are read at once.
    threads
        Number of threads, at least 1; None takes the processors that this process may use. It has no
        influence on the result.
    bad_rows
        Impossible rows are skipped and counted in it; None raises.
    progress
        Called with the number of rows that have been summed.

    Raises
    ------
    ValueError
        Bad rows in the log, patches beyond the grids, poses in which nothing touches, or threads below 1.
    """
    if threads is None:
        threads = usable_processors()
    if threads < 1:
        raise ValueError(f"threads = {threads} must be at least 1")
    columns = DAMAGE_COLUMNS if model.normal == ELLIPSE else (*DAMAGE_COLUMNS, *POSE_COLUMNS)
    if model.films is not None and "s" not in columns:
        columns = (*columns, "s")  # sections of the track have films of their own
    if has_column(source, "patch"):
        columns = (*columns, "patch")  # a log has each patch of a time once
    gap: Fault | None = None
    try:
        return _sum(timed_states(source, chunk_rows, bad_rows, clock, columns), model, threads, progress)
    except OutOfOrder:
        clock = output_clock(source, bad_rows is not None, columns)
    except GapInTime as found:
        clock, gap = output_clock(source, True, columns), found.fault
    if bad_rows is not None:
        bad_rows.clear(ordered=False)
        if gap is not None:
            bad_rows.faults["gap in time"] = gap
    return _sum(timed_states(source, chunk_rows, bad_rows, clock, columns), model, threads, progress)


def _sum(
    pieces: Iterator[TimedStates], model: DamageModel, threads: int, progress: Progress | None
) -> WheelSurface:
    """The sums over all pieces of a log."""
    total = WheelSurface.zero((), model.grid, model.patch_grid)
    with ThreadPoolExecutor(threads) as pool:
        for piece in pieces:
            part, wheel, placed = _piece_sums(piece, model)
            size = HALFSPACE_ROWS if model.theory == "halfspace" else BLOCK_ROWS
            blocks = _blocks(piece.states, placed, wheel, size)
            if model.wheels is not None:
                summed = [model.sums(one.vehicle, one.wheelset, one.side) for one in part.wheels]
                blocks = _chosen(blocks, summed)
            _add_blocks(pool, blocks, model, part, 2 * threads, total.rows, progress)
            total = total + part
    if model.wheels is None:
        return total
    return total.only([model.sums(one.vehicle, one.wheelset, one.side) for one in total.wheels])


def usable_processors() -> int:
    """Number of processors that this process may use; of all processors where the system does not say."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _blocks(states: ContactStates, placed: Placed, wheel: IntArray, size: int) -> Iterator[Block]:
    """The states in blocks of `size` rows, wheel by wheel, each with the index of its wheel."""
    order = np.argsort(wheel, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(wheel[order])) + 1):
        if rows.size == 0:
            continue  # a piece of bad rows alone
        new = np.flatnonzero(np.diff(states.time[rows], prepend=np.nan) != 0.0)  # one time in one block
        starts = new[np.diff(new // size, prepend=-1) > 0]
        for block in np.split(rows, starts[1:]):
            yield Block(
                int(wheel[block[0]]),
                ContactStates._make(column[block] for column in states),
                Placed._make(column[block] for column in placed),
            )


def _chosen(blocks: Iterator[Block], wanted: list[bool]) -> Iterator[Block]:
    """The blocks of some of the wheels."""
    return (block for block in blocks if wanted[block.wheel])


def _add_blocks(
    pool: ThreadPoolExecutor,
    blocks: Iterator[Block],
    model: DamageModel,
    surface: WheelSurface,
    waiting: int,
    done: int,
    progress: Progress | None,
) -> None:
    """Sum the blocks and add them to the surface in order; at most `waiting` sums are held."""
    pending: deque[tuple[Block, Future[Sums]]] = deque()

    def collect() -> None:
        nonlocal done
        own, future = pending.popleft()
        block, wheel = future.result(), own.wheel
        index, interval, part = own.placed.fatigue_index, own.placed.interval, own.placed.part
        np.add.at(surface.positive_time[wheel], part, np.where(index > 0.0, interval, 0.0))
        np.add.at(surface.index_area[wheel], part, np.maximum(index, 0.0) * interval)
        done += index.size
        if progress is not None:
            progress(done)
        for name in _SUMMED:
            getattr(surface, name)[wheel] += getattr(block, name)
        highest = surface.pressure_by_part[wheel]
        np.maximum(highest, block.pressure_by_part, out=highest)
        for name, column in _COUNTED.items():
            getattr(surface, name)[wheel] += block.counts[..., column]

    for block in blocks:
        pending.append((block, pool.submit(_block_sums, block, surface.wheels[block.wheel], model)))
        if len(pending) >= waiting:
            collect()
    while pending:
        collect()


def _block_sums(block: Block, wheel: Wheel, model: DamageModel) -> Sums:
    """Sums over the states of a block, from zero."""
    zero = WheelSurface.zero((wheel,), model.grid, model.patch_grid)
    counts = np.zeros((*zero.rcf_number.shape[1:], COLUMNS))
    sums = Sums(**{name: getattr(zero, name)[0] for name in Sums._fields[:-1]}, counts=counts)
    elastic, grid, along = model.material.elastic, model.grid, model.patch_grid
    solving = Solving(
        DAMAGE_THEORIES[model.theory],
        Elastic(elastic.shear_modulus, elastic.poisson_ratio),
        model.material.shear_yield,
        model.law.values,
        model.limits,
        Bins(grid.start, grid.step, along.start, along.step),
        NO_FILM if model.films is None else model.films.factors,
    )
    if model.normal == STRIPS and model.contact is not None:
        work = work_space((model.cells[0], CAPACITY), along.count)
        rebuild = rebuilding(model.contact, grid, model.flange_angle)
        bad = add_rebuilt(block.states, block.placed, rebuild, solving, rebuild_work(), work, sums)
        if bad >= 0:
            raise ValueError(
                "contact log: wheel and rail do not touch at "
                f"y_wheel = {block.states.y_wheel[bad] * 1e3:.2f} mm, "
                f"time = {block.states.time[bad]:.6g} s: other profiles were in the run"
            )
    elif model.theory == "halfspace":
        solver: WheelSolver | EllipseSolver = EllipseSolver(model.cells)
        if model.normal == HALFSPACE and model.contact is not None:
            solver = WheelSolver(model.contact, grid, model.flange_angle, model.pressure_limit, elastic)
        _add_solved(block, solver, solving, along.count, sums)
    else:
        add_states(block.states, block.placed, solving, work_space(model.cells, along.count), sums)
    return sums


def _add_solved(
    block: Block, solver: WheelSolver | EllipseSolver, solving: Solving, bins_along: int, sums: Sums
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
            bearing = 2.0 / 3.0 * solved.area * solving.shear_yield
            placed.fatigue_index[row] = (solved.force - bearing) / states.normal_force[row]  # (3.16)
            np.maximum.at(sums.pressure_by_part, solved.strips.part, solved.max_pressure)
            fill_wear_factors(states, placed, row, solved.angle, solving, solved.strips)
            turning = turning_of(states, row, placed.interval[row], placed.fatigue_index[row])
            patch = patch_of(states, row, solving.elastic)
            add_patch(patch, solved.area, solved.strips, solved.fields, turning, solving, spaces[size], sums)


def _piece_sums(piece: TimedStates, model: DamageModel) -> tuple[WheelSurface, IntArray, Placed]:
    """The sums of a piece that need no solved patch; and for the others wheel and place of every row."""
    states, interval, sharing = piece
    position, stretch = model.grid.place(states.y_wheel, states.contact_angle)
    _check_on_grid(states, position, stretch, model)
    wheels, wheel = _wheels(states)
    index = surface_fatigue_index(
        states.force_x, states.force_y, states.normal_force, states.a, states.b, model.material.shear_yield
    )
    part = np.where(states.contact_angle > model.flange_angle, FLANGE, TREAD)
    lost = wear_number(states.force_x, states.force_y, states.moment_z, states.nu_x, states.nu_y, states.phi)
    empty = WheelSurface.zero(wheels, model.grid, model.patch_grid)
    np.add.at(empty.patch_time, (wheel, part), interval)
    np.add.at(empty.friction_area, (wheel, part), states.friction * interval)
    np.add.at(empty.work, wheel, lost * states.speed * interval)
    _add_subsurface(states, interval, wheel, part, empty)
    sums = replace(  # the rows of one output time share its interval, so time and distance add up in any cut
        empty,
        rows=wheel.size,
        time=float(np.sum(interval / sharing)),
        distance=float(np.sum(states.speed * interval / sharing)),
    )
    lowest, highest = places_between(states, wheel)
    if model.films is None:
        surfaces = np.zeros(wheel.size, dtype=np.int64)
    else:
        surfaces = model.films.rows(states.vehicle, states.wheelset)
    placed = Placed(part.astype(np.int64), interval, index, position, stretch, lowest, highest, surfaces)
    return sums, wheel, placed


def _add_subsurface(
    states: ContactStates, interval: FloatArray, wheel: IntArray, part: IntArray, surface: WheelSurface
) -> None:
    """Add the revolutions of the loaded patches to their levels of FI_sub, each by its equivalent ellipse."""
    loaded = states.normal_force > 0.0
    force = states.normal_force[loaded]
    used = np.hypot(states.force_x[loaded], states.force_y[loaded]) / force
    level = level_of(subsurface_fatigue_index(force, states.a[loaded], states.b[loaded], used))
    turns = states.speed * interval / (2.0 * math.pi * states.rolling_radius)
    np.add.at(surface.subsurface_revolutions, (wheel[loaded], part[loaded], level), turns[loaded])


def _wheels(states: ContactStates) -> tuple[tuple[Wheel, ...], IntArray]:
    """The wheels of the states, sorted, and for each row the index of its wheel."""
    names = np.column_stack([getattr(states, name) for name in Wheel._fields]).astype(np.int64)
    lowest = names.min(axis=0, initial=0)
    spans = names.max(axis=0, initial=0) - lowest + 1
    keys = np.ravel_multi_index(tuple((names - lowest).T), tuple(spans))  # one number sorts faster than four
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    return tuple(Wheel(*row) for row in names[first].tolist()), place.astype(np.int64)


def _check_on_grid(
    states: ContactStates, position: FloatArray, stretch: FloatArray, model: DamageModel
) -> None:
    """Raise ValueError for patches that reach beyond the bins, as part of their damage would be lost.

    Strips on the profile lie on any grid of it: only an ellipse reaches beyond its ends.
    """
    reach = states.b * stretch if model.normal == ELLIPSE else np.zeros(states.b.size)
    loaded = states.normal_force > 0.0
    across, along = model.grid.edges, model.patch_grid.edges
    for what, low, high, edges in (
        ("across the profile", position - reach, position + reach, across),
        ("along the patch", -states.a, states.a, along),
    ):
        beyond = loaded & ((low < edges[0]) | (high > edges[-1]))
        if beyond.any():
            first = int(np.argmax(beyond))
            raise ValueError(
                f"contact log: patch from {low[first] * 1e3:.2f} to {high[first] * 1e3:.2f} mm {what} at "
                f"y_wheel = {states.y_wheel[first] * 1e3:.2f} mm, time = {states.time[first]:.6g} s, "
                f"lies beyond the grid, {edges[0] * 1e3:.0f} to {edges[-1] * 1e3:.0f} mm "
                f"({int(beyond.sum())} such rows among {beyond.size})"
            )
