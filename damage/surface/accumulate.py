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
from collections.abc import Callable, Iterator, Sequence
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
from damage.log_input.states import POSE_COLUMNS, RAIL_COLUMNS, ContactStates
from damage.model import DamageModel
from damage.patch_strips import FLANGE, TREAD
from damage.rails.pieces import RailPair, RailRows, Rails, rail_pairs, rail_rows, rail_sums, together
from damage.rcf.subsurface import level_of, subsurface_fatigue_index
from damage.rcf.surface_index import surface_fatigue_index
from damage.surface.block_sums import (
    Block,
    BlockSums,
    RailBlock,
    add_block,
    add_rail_block,
    block_sums,
)
from damage.surface.contact_sums import Placed
from damage.surface.halfspace_patch import places_between
from damage.surface.normal_contact import ELLIPSE
from damage.surface.wheel_surface import Wheel, WheelSurface
from damage.wear.energy import wear_number
from hh_exudyn.arrays import FloatArray, IntArray

BLOCK_ROWS = 2500  # rows of a block: some 50 ms of work; the sums depend on it in the last digits
HALFSPACE_ROWS = 50  # of the half-space: a second; the first of a block begins from nothing

Progress = Callable[[int], None]


class Accumulated(NamedTuple):
    """The sums of a log."""

    wheels: WheelSurface
    rails: tuple[RailPair, ...]  # of each stretch of track that the model has, left and right


def accumulate(
    source: ContactSource,
    model: DamageModel,
    clock: OutputClock | None = None,
    chunk_rows: int = CHUNK_ROWS,
    threads: int | None = None,
    bad_rows: BadRows | None = None,
    progress: Progress | None = None,
) -> WheelSurface:
    """Sum a contact log on the surfaces of its wheels; arguments and errors as `accumulate_both`."""
    return accumulate_both(source, model, clock, chunk_rows, threads, bad_rows, progress).wheels


def accumulate_both(
    source: ContactSource,
    model: DamageModel,
    clock: OutputClock | None = None,
    chunk_rows: int = CHUNK_ROWS,
    threads: int | None = None,
    bad_rows: BadRows | None = None,
    progress: Progress | None = None,
) -> Accumulated:
    """Sum a contact log on the surfaces of its wheels, and of the rails where the model names stretches.

    Every patch is solved once, for both.

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
    if model.rails is not None:
        columns = (*columns, *(name for name in RAIL_COLUMNS if name not in columns))
    elif has_column(source, "patch"):
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
) -> Accumulated:
    """The sums over all pieces of a log."""
    total, all_rails = WheelSurface.zero((), model.grid, model.patch_grid), Rails()
    with ThreadPoolExecutor(threads) as pool:
        for piece in pieces:
            part, wheel, placed = _piece_sums(piece, model)
            rails, rows = Rails(), None
            if model.rails is not None:
                lost = _lost(piece.states)
                reach = piece.states.b if model.normal == ELLIPSE else np.zeros(wheel.size)
                rows = rail_rows(piece.states, placed, lost, model.rails, reach)
                rails = rail_sums(piece.states, rows, lost, part.wheels, wheel, model.rails)
            size = HALFSPACE_ROWS if model.theory == "halfspace" else BLOCK_ROWS
            blocks = _blocks(piece.states, placed, wheel, size, rows)
            if model.wheels is not None:
                blocks = _chosen(blocks, _summed(part.wheels, model))
            _add_blocks(pool, blocks, model, part, rails, 2 * threads, total.rows, progress)
            total, all_rails = total + part, together(all_rails, rails)
    if model.wheels is not None:
        total = total.only(_summed(total.wheels, model))
        all_rails = {key: one.only(_summed(one.by_wheel.wheels, model)) for key, one in all_rails.items()}
    return Accumulated(total, () if model.rails is None else rail_pairs(all_rails, model.rails))


def _summed(wheels: Sequence[Wheel], model: DamageModel) -> list[bool]:
    """Whether each wheel is among those that are summed."""
    return [model.sums(one.vehicle, one.wheelset, one.side) for one in wheels]


def usable_processors() -> int:
    """Number of processors that this process may use; of all processors where the system does not say."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _blocks(
    states: ContactStates, placed: Placed, wheel: IntArray, size: int, rows: RailRows | None
) -> Iterator[Block]:
    """The states in blocks of `size` rows, wheel by wheel and there by stretch of rail where these count."""
    kind = wheel if rows is None else wheel * (int(rows.stretch.max(initial=0)) + 2) + rows.stretch + 1
    order = np.argsort(kind, kind="stable")
    for of_kind in np.split(order, np.flatnonzero(np.diff(kind[order])) + 1):
        if of_kind.size == 0:
            continue  # a piece of bad rows alone
        new = np.flatnonzero(np.diff(states.time[of_kind], prepend=np.nan) != 0.0)  # one time in one block
        starts = new[np.diff(new // size, prepend=-1) > 0]
        for block in np.split(of_kind, starts[1:]):
            rail = None
            if rows is not None and rows.stretch[block[0]] >= 0:
                on_rail = Placed._make(column[block] for column in rows.placed)
                rail = RailBlock(int(rows.stretch[block[0]]), on_rail, rows.damage[block])
            yield Block(
                int(wheel[block[0]]),
                ContactStates._make(column[block] for column in states),
                Placed._make(column[block] for column in placed),
                rail,
            )


def _chosen(blocks: Iterator[Block], wanted: list[bool]) -> Iterator[Block]:
    """The blocks of some of the wheels."""
    return (block for block in blocks if wanted[block.wheel])


def _add_blocks(
    pool: ThreadPoolExecutor,
    blocks: Iterator[Block],
    model: DamageModel,
    surface: WheelSurface,
    rails: Rails,
    waiting: int,
    done: int,
    progress: Progress | None,
) -> None:
    """Sum the blocks and add them to surface and rails in order; at most `waiting` sums are held."""
    pending: deque[tuple[Block, Future[BlockSums]]] = deque()

    def collect() -> None:
        nonlocal done
        own, future = pending.popleft()
        sums, wheel = future.result(), surface.wheels[own.wheel]
        add_block(surface, own.wheel, own.placed, sums.wheel)
        if own.rail is not None and sums.rail is not None:
            rail = rails[own.rail.stretch, wheel.side]
            add_rail_block(rail, wheel, own.rail.placed, sums.rail, sums.whole_life)
        done += own.states.time.size
        if progress is not None:
            progress(done)

    for block in blocks:
        pending.append((block, pool.submit(block_sums, block, surface.wheels[block.wheel], model)))
        if len(pending) >= waiting:
            collect()
    while pending:
        collect()


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
    lost = _lost(states)
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


def _lost(states: ContactStates) -> FloatArray:
    """(n,) wear number of each patch [N]."""
    return wear_number(states.force_x, states.force_y, states.moment_z, states.nu_x, states.nu_y, states.phi)


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
