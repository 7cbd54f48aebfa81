"""Logs of a run as arrays, for tests that look at numbers."""

from types import SimpleNamespace

import numpy as np

from hh_exudyn.log.store import Run


def table(run: Run, log: str) -> SimpleNamespace:
    """A log as arrays by column name."""
    rows = run.read(log)
    columns = zip(rows.column_names, rows.columns, strict=True)
    return SimpleNamespace(**{name: np.asarray(column) for name, column in columns})


def steady(log: SimpleNamespace, seconds: float = 2.0) -> SimpleNamespace:
    """The rows of the last seconds, when the whole wagon has been in the curve for long."""
    rows = log.time > log.time.max() - seconds
    return SimpleNamespace(**{name: values[rows] for name, values in vars(log).items()})


def wheel_means(log: SimpleNamespace, column: str) -> np.ndarray:
    """(4, 2) time means of a per-wheel column, left and right."""
    first = log.patch == 0
    values = getattr(log, column)
    return np.array(
        [
            [values[first & (log.wheelset == w) & (log.side == side)].mean() for side in (1, -1)]
            for w in (1, 2, 3, 4)
        ]
    )
