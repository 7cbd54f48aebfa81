"""A track with its irregularities, held to the limits that its sections have: gauge, cant, direction.

Measured irregularities are anybody's numbers: a gauge that is narrow by design and narrower by irregularity
jams the wheelset, and a run over it has forces of nothing real. So does a random track of FRA class 1 to 5 at
1435 mm, whose gauge comes down to 1395 to 1421 mm: their tracks are wider.
"""

from collections.abc import Iterator

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case.alignment import WIDENING_MM
from hh_exudyn.case.case import Case
from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from track.course.alignment import Alignment
from track.course.frame import inclined_frame
from track.irregularity.irregularity import Irregularity

LARGEST_CANT = 0.180  # m, as of curves
LARGEST_SLOPE = 0.03  # of the alignment irregularity; assumed: 15 mm over 1 m is a broken track


def require_possible_track(case: Case, alignment: Alignment, irregular: Irregularity) -> None:
    """Check gauge and cant of a track with irregularities, and the direction that they give it.

    Parameters
    ----------
    case : Case
        Its wheel profile bounds the gauge from below.
    alignment : Alignment
        Of the case.
    irregular : Irregularity
        Of the run; samples beyond the track are not looked at.

    Raises
    ------
    ValueError
        One line with the first place beyond a limit.
    """
    s = irregular.s
    on_track = s <= alignment.length
    s = s[on_track]
    frames = np.array([inclined_frame(alignment.table, place) for place in s])
    cant = -RAIL_TOP_DISTANCE * np.sin(frames[:, 5]) + irregular.signal("cross_level")[on_track]
    gauge = frames[:, 7] + irregular.signal("gauge")[on_track]
    slope = np.gradient(irregular.signal("alignment")[on_track], irregular.step)
    least, largest = 1e3 * case.least_gauge, case.track.nominal_gauge_mm + WIDENING_MM
    bounds = f"allowed above {least:.1f} up to {largest:g} mm with wheel profile {case.wheel_profile}"
    wrong = [
        *_beyond("gauge with irregularity", 1e3 * gauge, "mm", s, (least, largest), bounds),
        *_beyond("cant with irregularity", 1e3 * cant, "mm", s, (-1e3 * LARGEST_CANT, 1e3 * LARGEST_CANT)),
        *_beyond("slope of the alignment irregularity", slope, "", s, (-LARGEST_SLOPE, LARGEST_SLOPE)),
    ]
    if wrong:
        raise ValueError(
            f"track.irregularity: {wrong[0]}; another gauge_mm, or a smaller irregularity_scale, is needed"
        )


def _beyond(
    name: str, values: FloatArray, unit: str, s: FloatArray, limits: tuple[float, float], bounds: str = ""
) -> Iterator[str]:
    """The worst value beyond its limits, as a message."""
    low, high = limits
    excess = np.maximum(low - values, values - high)
    worst = int(np.argmax(excess))
    if excess[worst] > 0.0:
        behind = f" {unit}" if unit else ""
        yield (
            f"{name} is {values[worst]:.4g}{behind} at s = {s[worst]:.1f} m: "
            f"{bounds or f'allowed {low:g} to {high:g}{behind}'}"
        )
