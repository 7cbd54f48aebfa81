"""The lives of wheels as a table: one row a turning, and quantiles of the distance to the first one."""

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
from numpy.typing import ArrayLike

from damage.life.turning import Turning
from hh_exudyn.log.parts import write_whole

FILE = "life.parquet"
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)

_TYPES = {
    "group": pyarrow.string(),
    "life": pyarrow.int32(),
    "distance_km": pyarrow.float64(),
    "since_turning_km": pyarrow.float64(),
    "cause": pyarrow.string(),
    "measure": pyarrow.string(),
    "value_mm": pyarrow.float64(),
    "limit_mm": pyarrow.float64(),
    "reasons": pyarrow.string(),
    "cut_mm": pyarrow.float64(),
    "cut_for_profile_mm": pyarrow.float64(),
    "cut_cause": pyarrow.string(),
    "target": pyarrow.string(),
    "worn_diameter_mm": pyarrow.float64(),
    "diameter_mm": pyarrow.float64(),
    "end": pyarrow.bool_(),
}


def life_table(turnings: Iterable[Turning]) -> pyarrow.Table:
    """One row per turning.

    Columns: the group; the number of the life that ends; its distances; cause, measure, value and limit of
    the first reason, and all of them as text; cut and its cause, "wear" or "cracks"; target; diameter before
    and after; and whether the wheel is at its end, where the cut is the one that there was no metal for.
    """
    rows = [_row(one) for one in turnings]
    columns = {name: pyarrow.array([row[name] for row in rows], kind) for name, kind in _TYPES.items()}
    return pyarrow.table(columns)


def write_life(folder: Path | str, turnings: Iterable[Turning]) -> Path:
    """Write ``life.parquet`` into a folder, whole or not at all; returns its path.

    Parameters
    ----------
    folder
        Exists.
    turnings
        Of all groups.

    Raises
    ------
    OSError
        It cannot be written.
    """
    path, table = Path(folder) / FILE, life_table(turnings)
    write_whole(path, lambda stream: pyarrow.parquet.write_table(table, stream))
    return path


def distance_quantiles(
    distances: ArrayLike, weights: ArrayLike | None = None, quantiles: Sequence[float] = QUANTILES
) -> dict[float, float]:
    """Quantiles of the distance to a first turning over samples (seasons, seeds, wheels), in their unit.

    A sample stands for its share of the wheels; between samples the distribution is linear, from the middle
    of the share of one to that of the next. A wheel that was not due within its forecast has infinity.

    Parameters
    ----------
    distances
        (n,) one a sample, >= 0.
    weights
        (n,) their shares, > 0; None for equal ones.
    quantiles
        Wanted, 0 to 1.

    Raises
    ------
    ValueError
        No samples, a distance below zero or NaN, weights that do not fit or are not above zero, a quantile
        outside 0..1.
    """
    values = np.atleast_1d(np.asarray(distances, dtype=np.float64))
    share = np.ones_like(values) if weights is None else np.asarray(weights, dtype=np.float64)
    if values.size == 0 or not np.all(values >= 0.0):
        raise ValueError(f"{values.size} distances; needed are samples, all >= 0 m")
    if share.shape != values.shape or not np.all(share > 0.0):
        raise ValueError(f"weights of {share.size} samples must be {values.size} numbers > 0")
    if not all(0.0 <= quantile <= 1.0 for quantile in quantiles):
        raise ValueError(f"quantiles = {tuple(quantiles)}, allowed 0 .. 1")
    order = np.argsort(values, kind="stable")
    values, share = values[order], share[order] / share.sum()
    middle = np.cumsum(share) - 0.5 * share
    finite = np.isfinite(values)
    found = {}
    for quantile in quantiles:
        after = int(np.searchsorted(middle, quantile))
        beyond = after < values.size and not finite[after]
        if beyond or not finite.any() or (after == values.size and not finite[-1]):
            found[quantile] = np.inf
        else:
            found[quantile] = float(np.interp(quantile, middle[finite], values[finite]))
    return found


def _row(one: Turning) -> dict[str, object]:
    first = one.reasons[0] if one.reasons else None
    return {
        "group": one.group,
        "life": one.life,
        "distance_km": 1e-3 * one.distance,
        "since_turning_km": 1e-3 * one.since_turning,
        "cause": one.cause,
        "measure": None if first is None else first.measure,
        "value_mm": None if first is None else 1e3 * first.value,
        "limit_mm": None if first is None else 1e3 * first.limit,
        "reasons": ", ".join(reason.measure for reason in one.reasons),
        "cut_mm": 1e3 * one.cut,
        "cut_for_profile_mm": 1e3 * one.cut_for_profile,
        "cut_cause": one.cut_cause,
        "target": one.target,
        "worn_diameter_mm": 1e3 * one.worn_diameter,
        "diameter_mm": 1e3 * one.diameter,
        "end": one.condition is None,
    }
