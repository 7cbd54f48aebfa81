"""Sum the contact states of a log on the wheel surfaces: the loop over all rows.

Every row stands for its output interval dt. In it the wheel turns V dt / (2 pi r) times, and each turn takes
the depth of Archard's law from the strip of the profile that the patch covers. A patch at y_wheel with
contact angle gamma covers its lateral coordinate y (frame C, to the left) at y_wheel - side y cos(gamma) of
the profile; the depth is normal to the surface, so a bin of width w holds the worn area depth w / cos(gamma).

The rows of a chunk are cut into blocks of a fixed size. Each is summed by itself, several at once in threads
(the kernel holds no lock), and their sums are added in the order of the rows: the result is the same to the
last bit however many threads there are.
"""

import math
import os
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from damage.contact_states import CHUNK_ROWS, Chunk, ContactSource, OutputClock, contact_chunks, output_clock
from damage.material import WheelMaterial
from damage.rcf import surface_fatigue_index
from damage.wear.energy import wear_number
from damage.wear.jendel import JendelMap
from damage.wear.laws import archard
from damage.wear.strip_wear import strip_wear
from damage.wear.values import REGIMES, LawValues
from damage.wheel_surface import FLANGE, TREAD, LateralGrid, Wheel, WheelSurface, spread
from hh_exudyn.contact.theories import FIELD_THEORIES, THEORIES, field_kernel
from hh_exudyn.contact.types import Fields, FloatArray, RollingPatch
from hh_exudyn.kernel import kernel

BLOCK_ROWS = 500  # rows of a block: some milliseconds of work; the sums depend on it in the last digits


class States(NamedTuple):
    """Columns of a chunk, (n,) each, as the loop over the rows takes them."""

    wheel: NDArray[np.int64]  # index of the wheel
    part: NDArray[np.int64]  # TREAD or FLANGE
    interval: FloatArray  # [s]
    fatigue_index: FloatArray  # [-]
    side: FloatArray
    y_wheel: FloatArray
    contact_angle: FloatArray
    rolling_radius: FloatArray
    normal_force: FloatArray
    a: FloatArray
    b: FloatArray
    nu_x: FloatArray
    nu_y: FloatArray
    phi: FloatArray
    friction: FloatArray
    speed: FloatArray


class Sums(NamedTuple):
    """Arrays of a `WheelSurface` that the loop adds to."""

    depth: FloatArray  # (W, B)
    worn_area: FloatArray  # (W, B)
    worn_volume: FloatArray  # (W, 4)
    contact_time: FloatArray  # (W, 2, B)
    fatigue_time: FloatArray  # (W, 2, B)


@kernel
def add_states(
    states: States,
    theory: int,
    shear_modulus: float,
    poisson_ratio: float,
    law: LawValues,
    grid_start: float,
    grid_step: float,
    fields: Fields,
    strips: FloatArray,
    sums: Sums,
) -> None:
    """Add wear and times of the states to the sums.

    Parameters
    ----------
    states
        The rows; every patch lies on the grid.
    theory
        A value of `theories.THEORIES` that has a field.
    shear_modulus, poisson_ratio
        Elastic constants of wheel and rail [Pa], [-].
    law
        The wear law.
    grid_start, grid_step
        The bins over the profile [m].
    fields
        Work space (ny, nx).
    strips
        (ny, 4) work space: depth of each strip and regime of the law.
    sums
        Result.
    """
    cells_y = fields.pressure.shape[0]
    for row in range(states.wheel.size):
        if states.normal_force[row] <= 0.0:
            continue  # bodies that touch without force: no pressure, no wear, no fatigue
        wheel, part = states.wheel[row], states.part[row]
        a, b, speed = states.a[row], states.b[row], states.speed[row]
        slope = math.cos(states.contact_angle[row])
        centre = states.y_wheel[row]
        spread(centre, 2.0 * b * slope, states.interval[row], grid_start, grid_step,
               sums.contact_time[wheel, part])  # fmt: skip
        if states.fatigue_index[row] > 0.0:
            spread(centre, 2.0 * b * slope, states.interval[row], grid_start, grid_step,
                   sums.fatigue_time[wheel, part])  # fmt: skip
        rolled = speed * states.interval[row]
        if rolled <= 0.0:
            continue
        patch = RollingPatch(
            a, b, states.normal_force[row], states.nu_x[row], states.nu_y[row], states.phi[row],
            states.friction[row], shear_modulus, poisson_ratio,
        )  # fmt: skip
        field_kernel(theory, patch, fields)
        strip_wear(law, patch, fields, speed, states.rolling_radius[row], strips)
        revolutions = rolled / (2.0 * math.pi * states.rolling_radius[row])
        width = 2.0 * b / cells_y
        for strip in range(cells_y):
            lateral = -1.0 + (2 * strip + 1) / cells_y
            depth = 0.0
            for regime in range(REGIMES):
                depth += strips[strip, regime]
                sums.worn_volume[wheel, regime] += strips[strip, regime] * width * rolled
            if depth != 0.0:
                y = centre - states.side[row] * b * lateral * slope
                spread(y, width * slope, depth * revolutions, grid_start, grid_step, sums.depth[wheel])
                spread(y, width * slope, depth * revolutions * grid_step / slope, grid_start, grid_step,
                       sums.worn_area[wheel])  # fmt: skip


def accumulate(
    source: ContactSource,
    material: WheelMaterial,
    theory: str,
    cells: tuple[int, int],
    wear_map: JendelMap,
    flange_angle: float,
    grid: LateralGrid,
    clock: OutputClock | None = None,
    chunk_rows: int = CHUNK_ROWS,
    threads: int | None = None,
) -> WheelSurface:
    """Sum a contact log on the surfaces of its wheels.

    Parameters
    ----------
    source
        A run, its directory, or its contact log as a table.
    material
        The wheel steel.
    theory
        Name of a tangential theory.
    cells
        Cells of a patch along and across [-].
    wear_map
        The wear coefficients.
    flange_angle
        Contact angle above which a contact is on the flange [rad].
    grid
        Bins over the wheel profile.
    clock
        Output times of the whole log where `source` is a piece of it; None takes those of `source`.
    chunk_rows
        Rows that are read at once.
    threads
        States that are solved at once, at least 1; None takes the processors that this process may use. It
        has no influence on the result.

    Raises
    ------
    ValueError
        Unknown theory, bad values in the log, patches beyond the grid, or threads below 1.
    """
    if theory not in FIELD_THEORIES:
        raise ValueError(f"theory = {theory!r}; theories with a slip field: {', '.join(FIELD_THEORIES)}")
    if min(cells) < 1:
        raise ValueError(f"cells = {cells} must be at least 1 along and across")
    if threads is None:
        threads = usable_processors()
    if threads < 1:
        raise ValueError(f"threads = {threads} must be at least 1")
    if clock is None:
        clock = output_clock(source)
    total = WheelSurface.zero((), grid)
    with ThreadPoolExecutor(threads) as pool:
        before: tuple[WheelSurface, list[Future[Sums]]] | None = None
        for chunk in contact_chunks(source, rows=chunk_rows):
            _check_on_grid(chunk, grid)
            part, states = _chunk_sums(chunk, clock, material, flange_angle, grid)
            blocks = [
                pool.submit(
                    _block_sums, block, part.wheels, THEORIES[theory], cells, material, wear_map, grid
                )
                for block in _blocks(states)
            ]
            if before is not None:  # while its successor is read, a chunk is solved
                total = total + _collected(*before)
            before = part, blocks
        if before is not None:
            total = total + _collected(*before)
    return total


def usable_processors() -> int:
    """Processors that this process may use, where the system tells; else all there are."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _blocks(states: States) -> Iterator[States]:
    """The states in blocks of `BLOCK_ROWS`."""
    for first in range(0, states.wheel.size, BLOCK_ROWS):
        yield States._make(column[first : first + BLOCK_ROWS] for column in states)


def _block_sums(
    states: States,
    wheels: tuple[Wheel, ...],
    theory: int,
    cells: tuple[int, int],
    material: WheelMaterial,
    wear_map: JendelMap,
    grid: LateralGrid,
) -> Sums:
    """Wear and times of a block, summed from zero."""
    sums = _sums(WheelSurface.zero(wheels, grid))
    add_states(
        states,
        theory,
        material.elastic.shear_modulus,
        material.elastic.poisson_ratio,
        archard(wear_map=wear_map).values,
        grid.start,
        grid.step,
        Fields(*np.zeros((5, cells[1], cells[0]))),
        np.zeros((cells[1], REGIMES)),
        sums,
    )
    return sums


def _sums(surface: WheelSurface) -> Sums:
    """The arrays of a surface that the loop over the states adds to."""
    return Sums(*(getattr(surface, name) for name in Sums._fields))


def _collected(part: WheelSurface, blocks: list[Future[Sums]]) -> WheelSurface:
    """The sums of a chunk with those of its blocks, in order."""
    for block in blocks:
        for whole, share in zip(_sums(part), block.result(), strict=True):
            whole += share
    return part


def _chunk_sums(
    chunk: Chunk, clock: OutputClock, material: WheelMaterial, flange_angle: float, grid: LateralGrid
) -> tuple[WheelSurface, States]:
    """The sums of a chunk that need no patch to be solved, and the states for those that do."""
    wheels, wheel = _wheels(chunk)
    interval, sharing = clock.of_rows(chunk["time"])
    index = surface_fatigue_index(
        chunk["force_x"],
        chunk["force_y"],
        chunk["normal_force"],
        chunk["a"],
        chunk["b"],
        material.shear_yield,
    )
    part = np.where(chunk["contact_angle"] > flange_angle, FLANGE, TREAD)
    lost = wear_number(
        chunk["force_x"], chunk["force_y"], chunk["moment_z"], chunk["nu_x"], chunk["nu_y"], chunk["phi"]
    )
    empty = WheelSurface.zero(wheels, grid)
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
    own = (name for name in States._fields if name not in ("wheel", "part", "interval", "fatigue_index"))
    states = States(wheel, part, interval, index, *(chunk[name] for name in own))
    return sums, states


def _wheels(chunk: Chunk) -> tuple[tuple[Wheel, ...], NDArray[np.int64]]:
    """The wheels of a chunk, sorted, and for each row the index of its wheel."""
    names = np.column_stack([chunk[name] for name in Wheel._fields]).astype(np.int64)
    unique, place = np.unique(names, axis=0, return_inverse=True)
    return tuple(Wheel(*row) for row in unique.tolist()), place.astype(np.int64)


def _check_on_grid(chunk: Chunk, grid: LateralGrid) -> None:
    """Refuse patches that reach beyond the bins: their wear would be lost without a word."""
    reach = chunk["b"] * np.cos(chunk["contact_angle"])
    low, high = chunk["y_wheel"] - reach, chunk["y_wheel"] + reach
    beyond = (low < grid.edges[0]) | (high > grid.edges[-1])
    if beyond.any():
        first = int(np.argmax(beyond))
        raise ValueError(
            f"contact log: patch from y_wheel = {low[first] * 1e3:.2f} to {high[first] * 1e3:.2f} mm at "
            f"time = {chunk['time'][first]:.6g} s lies beyond the grid, {grid.edges[0] * 1e3:.0f} to "
            f"{grid.edges[-1] * 1e3:.0f} mm ({int(beyond.sum())} such rows among {beyond.size})"
        )
