"""Sizing by error: replicates are bought where they help most, until a stated error or a budget of runs.

First every unit (`Collective.unit`) gets three replicates, which give its spread; then the steps of the axes
are halved, for the discretisation error (`hh_exudyn.campaign.collective.refinement`); what is left of the
budget goes to replicates, in rounds, where the gain in variance over the runs of a replicate is largest.
Rounds are short, as spreads of three samples are poorly known. A sequential stop at a stated width covers a
little less than stated (R. J. Anscombe, J. Roy. Stat. Soc. B 15 (1953) 1-29); the tests say how much.

    >>> sizing = size(collective, through_cases(values_of), quantities, budget=400)
    >>> print(sizing.words())
    >>> loop = collective.replicate(1, sizing.nearest)

Quantities are rates that add up over cases: wear depth per km at a place of the profile, damage per km. The
relative error of a damage rate is the error of ln(life).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.bought import Bought, ValuesOf
from hh_exudyn.campaign.collective.collective import Collective, runs_of
from hh_exudyn.campaign.collective.nearest import nearest_replicates
from hh_exudyn.campaign.collective.plan import HALVED
from hh_exudyn.campaign.collective.refinement import Refinement, refinement
from hh_exudyn.campaign.collective.sampling import LEAST_SAMPLES, Estimates, samples_to_error

_GROWTH = 0.25  # runs of a round, of all sampling runs before


@dataclass(frozen=True)
class Quantity:
    """A quantity whose error counts.

    Attributes
    ----------
    name
        With unit, for the report.
    family
        Quantities of one family have their errors relative to the largest of them: wear at all places of a
        wheel to the deepest. Empty: relative to itself.
    """

    name: str
    family: str = ""


@dataclass(frozen=True, eq=False)
class Sizing:
    """What was bought, and the errors reached.

    Attributes
    ----------
    quantities
        As asked.
    total
        Weighted sum of each, (quantities,).
    reference
        What errors are relative to, (quantities,), in the unit of each.
    sampling
        Relative half width of the interval of confidence of each [-], (quantities,).
    discretisation
        By axis, of those that the budget allowed.
    left_out
        Axes whose halving was too much for the budget.
    counts
        Replicates of every unit.
    nearest
        A replicate of every unit for a loop: those which together are nearest to the mean of all.
    nearest_error
        Largest relative difference of these from the mean [-].
    runs, budget
        Cases evaluated in all, and those allowed.
    error, confidence
        As asked [-].
    """

    quantities: tuple[Quantity, ...]
    total: FloatArray
    reference: FloatArray
    sampling: FloatArray
    discretisation: dict[str, Refinement]
    left_out: tuple[str, ...]
    counts: dict[str, int]
    nearest: dict[str, int]
    nearest_error: float
    runs: int
    budget: int
    error: float
    confidence: float

    @property
    def reached(self) -> bool:
        """Whether the stated error ended it, and not the budget."""
        return bool(np.all(self.sampling <= self.error))

    def words(self) -> str:
        """What was bought and reached, in a few lines for a report."""
        worst = int(np.argmax(self.sampling))
        ended = (
            f"the stated error of {self.error:.1%} is reached"
            if self.reached
            else f"the budget of {self.budget} runs ended it before the stated error of {self.error:.1%}"
        )
        lines = [
            f"{self.runs} runs were bought; {ended}.",
            f"Sampling error at {self.confidence:.0%}: largest {self.sampling[worst]:.1%} "
            f"({self.quantities[worst].name}), median {np.median(self.sampling):.1%}.",
        ]
        for axis, found in self.discretisation.items():
            most = int(np.argmax(found.error))
            lines.append(
                f"Steps of {axis}: {found.error[most]:.1%} ({self.quantities[most].name}), known to "
                f"{found.uncertainty[most]:.1%}."
            )
        if self.left_out:
            lines.append(f"Steps of {', '.join(self.left_out)}: not measured, too much for the budget.")
        counts = ", ".join(f"{unit} {count}" for unit, count in self.counts.items())
        lines.append(f"Replicates: {counts}.")
        lines.append(
            f"For a loop: replicates {', '.join(map(str, self.nearest.values()))}, together within "
            f"{self.nearest_error:.1%} of the mean of all."
        )
        return "\n".join(lines)


@dataclass
class _Round:
    """Rows with their estimates, between two purchases."""

    collective: Collective
    bought: Bought
    counts: dict[str, int]
    cost: dict[str, float]
    units: tuple[str, ...] = ()
    known: Estimates = field(init=False)

    def take(self) -> None:
        """Evaluate what the counts ask for."""
        rows = self.collective.resampled(self.counts)
        self.units, self.known = self.bought.estimates(self.collective, rows)

    def place(self, allowed: FloatArray, runs: int, confidence: float) -> None:
        """More replicates for at most so many runs, or until the error would be reached."""
        cost = np.array([self.cost[unit] for unit in self.units])
        more = samples_to_error(self.known, allowed, runs, confidence, cost)
        count = self.known.count + more
        self.counts = {unit: int(n) for unit, n in zip(self.units, count, strict=True)}


def size(
    collective: Collective, values_of: ValuesOf, quantities: Sequence[Quantity], budget: int,
    error: float = 0.05, confidence: float = 0.95, axes: Sequence[str] = HALVED,
) -> Sizing:  # fmt: skip
    """Buy replicates until every quantity is known to a relative error, or the budget is spent.

    Seven arguments: what is sized, by what and at what price; the last three have defaults. What is
    evaluated is evaluated once: with results in files it goes on where it was stopped.

    Parameters
    ----------
    collective : Collective
        Of any design.
    values_of : callable
        As `hh_exudyn.campaign.collective.bought.ValuesOf`.
    quantities : sequence of Quantity
        Those of the columns of the values.
    budget : int
        Most cases to evaluate, at least those of three replicates.
    error : float
        Stated relative half width [-], > 0.
    confidence : float
        Probability of the interval [-].
    axes : sequence of str
        Axes whose steps are halved, out of `HALVED`.

    Raises
    ------
    ValueError
        A number out of range, a budget too small for three replicates, values that do not fit.
    """
    if not error > 0.0:
        raise ValueError(f"error = {error:g}: allowed above 0")
    units = tuple(dict.fromkeys(collective.unit(item.stratum) for item in collective.strata))
    first = max(LEAST_SAMPLES, collective.plan.replicates)
    counts = dict.fromkeys(units, first)
    start = collective.resampled(counts)
    if (least := runs_of(start)) > budget:
        raise ValueError(f"budget = {budget} runs: allowed {least} or more, for {first} replicates")
    bought = Bought(values_of, len(quantities))
    of_unit = {unit: [row for row in start if collective.unit(row.stratum) == unit] for unit in units}
    cost = {unit: runs_of(rows) / first for unit, rows in of_unit.items()}
    state = _Round(collective, bought, counts, cost)
    state.take()
    fine, left_out = {}, []
    for axis in axes:
        refined = collective.refined(axis)
        if bought.runs + bought.runs_for(refined.resampled({})) > budget:
            left_out.append(axis)
        else:
            fine[axis] = refinement(collective, refined, bought)
    extra, dearest = bought.runs - least, int(np.ceil(max(cost.values())))
    while True:
        reference = _reference(quantities, state.known.total)
        allowed = np.where(reference > 0.0, error * reference, np.inf)
        before, left = state.counts, budget - bought.runs
        state.place(allowed, min(left, max(dearest, int(_GROWTH * (bought.runs - extra)))), confidence)
        if state.counts == before or bought.runs_for(collective.resampled(state.counts)) > left:
            state.counts = before
            break
        state.take()
    return _sizing(state, quantities, fine, tuple(left_out), budget, error, confidence)


def _sizing(
    state: _Round, quantities: Sequence[Quantity], fine: dict[str, Refinement], left_out: tuple[str, ...],
    budget: int, error: float, confidence: float,
) -> Sizing:  # fmt: skip
    """The result of the last round."""
    known = state.known
    reference = _reference(quantities, known.total)
    over = np.where(reference > 0.0, reference, np.inf)
    rows = state.collective.resampled(state.counts)
    nearest, off = nearest_replicates(
        state.collective, rows, state.bought.values(state.collective, rows), over
    )
    return Sizing(
        tuple(quantities), known.total, reference, known.half_width(confidence) / over,
        {axis: found.over(over) for axis, found in fine.items()}, left_out, state.counts, nearest, off,
        state.bought.runs, budget, error, confidence,
    )  # fmt: skip


def _reference(quantities: Sequence[Quantity], total: FloatArray) -> FloatArray:
    """The largest of the family of each quantity, by absolute value."""
    size = np.abs(total)
    families: dict[str, float] = {}
    for quantity, value in zip(quantities, size, strict=True):
        families[quantity.family] = max(families.get(quantity.family, 0.0), float(value))
    return np.array(
        [families[q.family] if q.family else value for q, value in zip(quantities, size, strict=True)]
    )
