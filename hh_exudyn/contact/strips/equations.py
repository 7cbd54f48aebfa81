"""The equations of a wheel's strips in memory, and the order of their elimination (kernel).

An inner strip is in contact, and so are its neighbours on both sides. These are eliminated first, in the
order of the profile; then come the ends of the runs of strips in contact. Equations and unknowns have the
numbers of the strips; the right-hand side is the row behind them.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.strips.elimination import PADDING
from hh_exudyn.contact.strips.influence import influence_of
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import Memory
from hh_exudyn.kernel import inlined_kernel, shaped


class Place(IntEnum):
    """Numbers of a solution, rows of an array (`PLACE_ROWS`, `PLACES`).

    By strip.
    """

    ACTIVE = 0  # 1 in contact, else 0
    SOFT = 1  # 1 to be treated as the end of a run though it is none, else 0
    OWN = 2  # influence on itself, without the common compliance [m/N]
    LOAD = 3  # of the sharp solution [N]
    GAP = 4  # likewise, of strips without load [m]
    SOFTNESS = 5  # e of equation 1 in `edges`, of inner strips [N]
    # numbers of strips in some order
    ORDER = 6  # inner strips, then ends of runs, then rows to be reduced with them
    ENDS = 7  # the strips behind every stretch (`influence.stretches_of`)
    CHOSEN = 8  # strips that `edges` softens
    # quantities of those
    Z = 9  # z of equation 1 in `edges` [N]
    WIDTH = 10  # its e [N]
    SLOPE = 11  # S'(z)
    CHANGE = 12  # S(z) less the sharp load [N]


PLACE_ROWS = len(Place)
PLACES = CAPACITY + PADDING
PLACES_SIZE = PLACE_ROWS * PLACES


class Strips(NamedTuple):
    """What the equations of one wheel are made from, beside the state of its strips."""

    number: int  # of strips with overlap
    modulus: float  # G/(1 - nu) [Pa]
    compliance: float  # common to all strips [m/N]


class Room(NamedTuple):
    """Working memory of a solution; all matrices (> count, >= count + PADDING)."""

    places: Memory  # shaped by `Place`
    rows: FloatArray  # row k: displacement of all strips under a unit load of strip k, then reduced
    factors: FloatArray  # of the reduction (`elimination.reduce_rows`)
    few: FloatArray  # a small system
    few_factors: FloatArray


@inlined_kernel
def order_strips(count: int, state: Memory, room: Room) -> tuple[int, int]:
    """Fill `Place.ORDER`; number of inner strips, and of all strips in contact."""
    s, place = shaped(state, (ROWS, CAPACITY)), shaped(room.places, (PLACE_ROWS, PLACES))
    active, order, ends = place[Place.ACTIVE], place[Place.ORDER], place[Place.CHOSEN]
    inner, others = 0, 0
    before, here = False, active[0] > 0.0  # whether the strip beside is in contact, and this one
    for j in range(count):
        beside = j + 1 < count and s[Row.NUMBER, j + 1] == s[Row.NUMBER, j] + 1.0
        behind = j + 1 < count and active[j + 1] > 0.0
        within = here & before & beside & behind & (place[Place.SOFT, j] == 0.0)
        # written in any case, kept if counted: a branch would be guessed wrong too often
        order[np.uint64(inner)], ends[np.uint64(others)] = j, j
        inner += within
        others += here & (not within)
        before, here = here & beside, behind
    for c in range(others):
        order[inner + c] = ends[c]
    return inner, inner + others


@inlined_kernel
def write_row(j: int, strips: Strips, stretches: int, state: Memory, room: Room) -> None:
    """Write row j and `Place.OWN` of strip j."""
    place, row = shaped(room.places, (PLACE_ROWS, PLACES)), room.rows[np.uint64(j)]
    influence_of(j, stretches, place[Place.ENDS], strips.modulus, state, row)
    place[Place.OWN, j] = row[np.uint64(j)]
    if strips.compliance > 0.0:
        for r in range(strips.number):
            row[r] += strips.compliance
