"""Theories of creep forces and Kalker's coefficients against numbers from outside, as rows of a table.

What a theory is held to is what it is made for: FaStrip and the half-space over all cases, the others over
the cases of their range. FASTSIM is held to the errors that it has in the reference program itself.
"""

from collections.abc import Callable

import numpy as np

from hh_exudyn.contact.comparison import Comparison, outside_rows
from hh_exudyn.contact.tangential.kalker import kalker_coefficients
from hh_exudyn.contact.tangential.validation import TheoryErrors

_WORDS = {
    "force_mean": "mean error / mu N",
    "force_95": "95 % error / mu N",
    "force_max": "max error / mu N",
    "stress_mean": "|q|, mean L1 error",
    "slip_mean": "|s|, mean L1 error",
    "peak_worst": "peak of |q|, error",
}
_HELD = (  # theory, cases, error, what it is (0: allowed up to the last number), allowed deviation
    ("fastrip", "all", "force_mean", 0.0, 0.013),
    ("fastrip", "all", "force_max", 0.0, 0.09),
    ("fastrip", "all", "stress_mean", 0.0, 0.05),
    ("fastrip", "all", "slip_mean", 0.0, 0.20),
    ("fastrip", "all", "peak_worst", 0.0, 0.05),
    # forces good to 0.2 % (the reference's own tolerance), fields on other cells than the reference's
    ("halfspace", "all", "force_mean", 0.0, 0.003),
    ("halfspace", "all", "force_max", 0.0, 0.01),
    ("halfspace", "all", "stress_mean", 0.0, 0.03),
    ("halfspace", "all", "slip_mean", 0.0, 0.07),
    ("linear", "force <= 0.1 mu N", "force_mean", 0.0, 0.01),
    ("strip", "a/b = 0.2, no spin", "force_mean", 0.0, 0.015),
    ("polach", "no spin", "force_mean", 0.0, 0.025),
    # the reference program's own FASTSIM, over the same cases
    ("fastsim", "all", "force_mean", 0.024, 0.08),
    ("fastsim", "all", "force_95", 0.079, 0.04),
    ("fastsim", "all", "force_max", 0.151, 0.02),
)
_NAMES = ("c11", "c22", "c23", "c33")
_TABLE_END = (0.1, 10.0)  # a/b: its source has left the table there already, and the half-space judges


def theory_rows(table: list[TheoryErrors]) -> list[Comparison]:
    """Errors of the theories that are held to something, from their table.

    Parameters
    ----------
    table : list of TheoryErrors
        What `hh_exudyn.contact.tangential.validation.contact_table` returns.
    """
    errors = {(row.theory, row.cases): row for row in table}
    rows = []
    for theory, cases, error, wanted, allowed in _HELD:
        of_theory = errors[theory, cases]
        label = theory if cases == "all" else f"{theory} ({cases})"
        source = (
            f"CONTACT's FASTSIM, {of_theory.forces}" if wanted else f"CONTACT, {of_theory.forces} ellipses"
        )
        found = float(getattr(of_theory, error))
        rows.append(Comparison(f"{label}, {_WORDS[error]}", source, found, wanted, allowed))
    return rows


def coefficient_rows() -> list[Comparison]:
    """Worst deviations of Kalker's coefficients, from his table and from the half-space without slip."""
    low, high = _TABLE_END
    table, contact = "Kalker 1990, table E.3", "CONTACT, no slip"
    return [
        *_worst("table", table, "table and asymptotes", lambda ratio: ratio not in _TABLE_END, (1e-6,) * 3),
        *_worst(
            "computed",
            contact,
            f"a/b {low:g} to {high:g}",
            lambda ratio: low <= ratio <= high,
            (0.012, 0.012, 0.016, 0.03),
        ),
        # the computed C33 at a/b = 20 is not converged
        *_worst("computed", contact, "a/b 0.05", lambda ratio: ratio < low, (0.04,) * 4),
        *_worst("computed", contact, "a/b 20", lambda ratio: ratio > high, (0.04,) * 3),
    ]


def _worst(
    kind: str, source: str, where: str, wanted: Callable[[float], bool], allowed: tuple[float, ...]
) -> list[Comparison]:
    """A row per coefficient: its largest relative deviation over the wanted rows of one kind in the file."""
    rows = [row for row in outside_rows("kalker_coefficients.csv") if row["source"] == kind]
    chosen = [row for row in rows if wanted(float(row["a_over_b"]))]
    names = _NAMES[: len(allowed)]
    outside = np.array([[float(row[name]) for name in names] for row in chosen])
    found = np.array([kalker_coefficients(float(row["a_over_b"]), float(row["nu"])) for row in chosen])
    worst = np.abs(found[:, : len(names)] / outside - 1.0).max(axis=0)
    return [
        Comparison(f"{name.upper()}, {where}, worst of {len(chosen)}", source, float(value), 0.0, most)
        for name, value, most in zip(names, worst, allowed, strict=True)
    ]
