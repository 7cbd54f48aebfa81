"""Sum the contact states of a log on the wheel surfaces: the loop over all rows.

Every row stands for its output interval dt. In it the wheel turns V dt / (2 pi r) times, and each turn takes
the wear law's depth from the strip of the profile that the patch covers, and counts where the patch is beyond
shakedown. The depth is normal to the surface. Over the arc of the profile (`lateral_grid`) the patch lies at
the arc length of y_wheel and is as wide as in its own plane; over the lateral coordinate it covers y (frame
C, to the left) at y_wheel - side y cos(gamma), so a bin of width w holds the worn area depth w / cos(gamma).

The rows of a chunk are sorted by wheel and cut into blocks of a fixed size. Each is summed by itself, several
at once in threads (the kernel holds no lock), and their sums are added in the order of the blocks: the result
is the same to the last bit however many threads there are.
"""

import os
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from damage.log_input.bad_rows import BadRows
from damage.log_input.contact_source import ContactSource
from damage.log_input.contact_states import CHUNK_ROWS, Chunk, OutputClock, contact_chunks, output_clock
from damage.model import DamageModel
from damage.rcf.number import COLUMNS, CORRECTED, COUNTED, ENERGY, Bins
from damage.rcf.surface_index import surface_fatigue_index
from damage.surface.contact_sums import Solving, States, Sums, add_states, work_space
from damage.surface.patch_field import DAMAGE_THEORIES
from damage.surface.wheel_surface import FLANGE, TREAD, Wheel, WheelSurface
from damage.wear.energy import wear_number

BLOCK_ROWS = 2500  # rows of a block: some 50 ms of work; the sums depend on it in the last digits

_COUNTED = {"rcf_number": COUNTED, "corrected_rcf_number": CORRECTED, "energy": ENERGY}  # columns of `counts`
_SUMMED = tuple(name for name in Sums._fields if name != "counts")


def accumulate(
    source: ContactSource,
    model: DamageModel,
    clock: OutputClock | None = None,
    chunk_rows: int = CHUNK_ROWS,
    threads: int | None = None,
    bad_rows: BadRows | None = None,
) -> WheelSurface:
    """Sum a contact log on the surfaces of its wheels.

    Parameters
    ----------
    source
        The contact log, see `damage.log_input.contact_source`.
    model
        What it is judged with.
    clock
        Output times of the whole log where `source` is a piece of it; None takes those of `source`.
    chunk_rows
        Rows that are read at once.
    threads
        States that are solved at once, at least 1; None takes the processors that this process may use. It
        has no influence on the result.
    bad_rows
        Rows that no contact can have are left out and told to it; None refuses them.

    Raises
    ------
    ValueError
        Bad rows in the log, patches beyond the grids, or threads below 1.
    """
    if threads is None:
        threads = usable_processors()
    if threads < 1:
        raise ValueError(f"threads = {threads} must be at least 1")
    if clock is None:
        clock = output_clock(source, skip_bad_rows=bad_rows is not None)
    total = WheelSurface.zero((), model.grid, model.patch_grid)
    with ThreadPoolExecutor(threads) as pool:
        for chunk in contact_chunks(source, rows=chunk_rows, bad_rows=bad_rows):
            _check_on_grid(chunk, model)
            part, wheel, states = _chunk_sums(chunk, clock, model)
            _add_blocks(pool, _blocks(states, wheel), model, part, 2 * threads)
            total = total + part
    return total


def usable_processors() -> int:
    """Processors that this process may use, where the system tells; else all there are."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _blocks(states: States, wheel: NDArray[np.int64]) -> Iterator[tuple[int, States]]:
    """The states in blocks of `BLOCK_ROWS`, wheel by wheel, each with the index of its wheel."""
    order = np.argsort(wheel, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(wheel[order])) + 1):
        for first in range(0, rows.size, BLOCK_ROWS):
            block = rows[first : first + BLOCK_ROWS]
            yield int(wheel[block[0]]), States._make(column[block] for column in states)


def _add_blocks(
    pool: ThreadPoolExecutor,
    blocks: Iterator[tuple[int, States]],
    model: DamageModel,
    surface: WheelSurface,
    waiting: int,
) -> None:
    """Sum the blocks and add them to the surface in order; at most `waiting` sums are held."""
    pending: deque[tuple[int, Future[Sums]]] = deque()

    def collect() -> None:
        wheel, future = pending.popleft()
        block = future.result()
        for name in _SUMMED:
            getattr(surface, name)[wheel] += getattr(block, name)
        for name, column in _COUNTED.items():
            getattr(surface, name)[wheel] += block.counts[..., column]

    for wheel, block in blocks:
        pending.append((wheel, pool.submit(_block_sums, block, surface.wheels[wheel], model)))
        if len(pending) >= waiting:
            collect()
    while pending:
        collect()


def _block_sums(states: States, wheel: Wheel, model: DamageModel) -> Sums:
    """What the states of a block add to their wheel, summed from zero."""
    zero = WheelSurface.zero((wheel,), model.grid, model.patch_grid)
    counts = np.zeros((*zero.rcf_number.shape[1:], COLUMNS))
    sums = Sums(**{name: getattr(zero, name)[0] for name in _SUMMED}, counts=counts)
    elastic, grid, along = model.material.elastic, model.grid, model.patch_grid
    solving = Solving(
        DAMAGE_THEORIES[model.theory],
        elastic.shear_modulus,
        elastic.poisson_ratio,
        model.material.shear_yield,
        model.law.values,
        model.limits,
        Bins(grid.start, grid.step, along.start, along.step),
    )
    add_states(states, solving, work_space(model.cells, along.count), sums)
    return sums


def _chunk_sums(
    chunk: Chunk, clock: OutputClock, model: DamageModel
) -> tuple[WheelSurface, NDArray[np.int64], States]:
    """The sums of a chunk that need no patch to be solved; for the rest, wheel and state of every row."""
    wheels, wheel = _wheels(chunk)
    interval, sharing = clock.of_rows(chunk["time"])
    index = surface_fatigue_index(
        chunk["force_x"],
        chunk["force_y"],
        chunk["normal_force"],
        chunk["a"],
        chunk["b"],
        model.material.shear_yield,
    )
    part = np.where(chunk["contact_angle"] > model.flange_angle, FLANGE, TREAD)
    lost = wear_number(
        chunk["force_x"], chunk["force_y"], chunk["moment_z"], chunk["nu_x"], chunk["nu_y"], chunk["phi"]
    )
    empty = WheelSurface.zero(wheels, model.grid, model.patch_grid)
    np.add.at(empty.patch_time, (wheel, part), interval)
    np.add.at(empty.positive_time, (wheel, part), np.where(index > 0.0, interval, 0.0))
    np.add.at(empty.index_area, (wheel, part), np.maximum(index, 0.0) * interval)
    np.add.at(empty.friction_area, (wheel, part), chunk["friction"] * interval)
    np.add.at(empty.work, wheel, lost * chunk["speed"] * interval)
    np.maximum.at(empty.max_pressure, wheel, chunk["p_max"])
    sums = replace(  # the rows of one output time share its interval, so time and distance add up in any cut
        empty,
        rows=wheel.size,
        time=float(np.sum(interval / sharing)),
        distance=float(np.sum(chunk["speed"] * interval / sharing)),
    )
    position, stretch = model.grid.place(chunk["y_wheel"], chunk["contact_angle"])
    made = {
        "part": part.astype(np.float64), "interval": interval, "fatigue_index": index,
        "position": position, "stretch": stretch,
    }  # fmt: skip
    states = States._make(made[name] if name in made else chunk[name] for name in States._fields)
    return sums, wheel, states


def _wheels(chunk: Chunk) -> tuple[tuple[Wheel, ...], NDArray[np.int64]]:
    """The wheels of a chunk, sorted, and for each row the index of its wheel."""
    names = np.column_stack([chunk[name] for name in Wheel._fields]).astype(np.int64)
    lowest = names.min(axis=0, initial=0)
    spans = names.max(axis=0, initial=0) - lowest + 1
    keys = np.ravel_multi_index(tuple((names - lowest).T), tuple(spans))  # one number sorts faster than four
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    return tuple(Wheel(*row) for row in names[first].tolist()), place.astype(np.int64)


def _check_on_grid(chunk: Chunk, model: DamageModel) -> None:
    """Refuse patches that reach beyond the bins: their damage would be lost without a word."""
    position, stretch = model.grid.place(chunk["y_wheel"], chunk["contact_angle"])
    reach = chunk["b"] * stretch
    loaded = chunk["normal_force"] > 0.0
    across, along = model.grid.edges, model.patch_grid.edges
    for what, low, high, edges in (
        ("across the profile", position - reach, position + reach, across),
        ("along the patch", -chunk["a"], chunk["a"], along),
    ):
        beyond = loaded & ((low < edges[0]) | (high > edges[-1]))
        if beyond.any():
            first = int(np.argmax(beyond))
            raise ValueError(
                f"contact log: patch from {low[first] * 1e3:.2f} to {high[first] * 1e3:.2f} mm {what} at "
                f"y_wheel = {chunk['y_wheel'][first] * 1e3:.2f} mm, time = {chunk['time'][first]:.6g} s, "
                f"lies beyond the grid, {edges[0] * 1e3:.0f} to {edges[-1] * 1e3:.0f} mm "
                f"({int(beyond.sum())} such rows among {beyond.size})"
            )
