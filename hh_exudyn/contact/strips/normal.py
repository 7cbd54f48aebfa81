"""Normal contact of one wheel in one pose, as an array: for tests, figures and validation (kernel)."""

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.strips.loads import first_half_lengths, solve_loads
from hh_exudyn.contact.strips.overlap import overlapping_strips
from hh_exudyn.contact.strips.pressure import refine_strips
from hh_exudyn.contact.strips.shape import shape_strips
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.types import WheelStrips
from hh_exudyn.kernel import kernel, memory, shaped

_STATE = ROWS * CAPACITY


@kernel
def normal_rows(
    pair: WheelRailPair, strips: WheelStrips, modulus: float, refined: bool, rows: FloatArray
) -> int:
    """Overlaps, loads, half lengths and pressures without friction (kernel: trusts its input).

    Arguments: see the map of this folder; `refined` asks for the second solution (`pressure`), and `rows`,
    (ROWS, CAPACITY) by `Row`, holds the result.

    Returns
    -------
    int
        Strips with overlap; -1 where the loads were not found.
    """
    state = memory(_STATE)
    s = shaped(state, (ROWS, CAPACITY))
    guess = shaped(memory(CAPACITY), (CAPACITY,))
    guess[:] = 0.0
    count = overlapping_strips(pair, strips, state)
    first_half_lengths(count, state)
    if not solve_loads(count, modulus, guess, state):
        return -1
    for j in range(count):
        s[Row.NU_X, j], s[Row.NU_Y, j] = 0.0, 0.0
    shape_strips(count, modulus, state)
    if refined and not refine_strips(count, modulus, state):
        return -1
    for row in range(ROWS):
        for j in range(count):
            rows[row, j] = s[row, j]
    return count
