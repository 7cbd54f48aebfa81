"""What damages the wheels: the share of every curve class, load, season and quality in wear and in cracks.

Shares are those at the bin of a place where the whole collective wears most, or has most crack damage, with
the rates of the last evaluation: where a limit is reached first, and before cracks are worn off.
"""

import numpy as np
import pyarrow
from numpy.typing import NDArray

from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.results.recorded import WEAR, Recorded

LABELS = ("curve_class", "running", "season", "quality", "haul")
"""Attributes of a stratum by which shares are told apart."""


def shares_table(recorded: Recorded) -> pyarrow.Table:
    """Shares of damage, a row for each group, label and its value; those of one label sum to 100 %.

    Columns, in percent: of the distance, of the wear on tread, root and flange, and for every index of the
    crack damage of the tread. Missing where the wheels have no such damage.
    """
    rows = []
    for group in recorded.groups:
        y, places = recorded.wheels[group][-1].grid.lateral, recorded.places(group)
        wanted = {f"{WEAR}_{place}_percent": (WEAR, place) for place in ("tread", "root", "flange")}
        wanted |= {f"cracks_{kind}_percent": (kind, "tread") for kind in recorded.kinds() if kind != WEAR}
        columns = {}
        for name, (kind, place) in wanted.items():
            cases, values = recorded.case_rates(group, kind)
            worst = int(np.argmax(np.where(places.within(place, y), values.sum(axis=0), -1.0)))
            columns[name] = values[:, worst]
        columns = {"distance_percent": np.array([case.weight for case in cases])} | columns
        for label in LABELS:
            values_of = [str(getattr(case.stratum, label)) for case in cases]
            for value in dict.fromkeys(values_of):  # in the order of the line
                own = np.array([one == value for one in values_of])
                row = {"group": group, "label": label, "value": value}
                rows.append(row | {name: _share(column, own) for name, column in columns.items()})
    return pyarrow.Table.from_pylist(rows)


def _share(values: FloatArray, own: NDArray[np.bool_]) -> float | None:
    """Share of some cases [%]."""
    whole = float(values.sum())
    return 1e2 * float(values[own].sum()) / whole if whole > 0.0 else None
