"""The error of a weighted sum over strata, and which case is the next: stratified sampling.

W. G. Cochran, Sampling Techniques, 3rd edition, Wiley 1977, chapter 5, with endless populations (a stratum
has any number of irregularities, so that the corrections for finite ones vanish):

    y_st = sum_h W_h y_h                                            (5.1)
    v(y_st) = sum_h W_h^2 s_h^2 / n_h                               (after 5.9)
    n_e = (sum_h g_h s_h^2)^2 / sum_h (g_h^2 s_h^4 / (n_h - 1))     (5.16), g_h = W_h^2 / n_h

y_h and s_h are mean and standard deviation of n_h samples (seeds) in stratum h of weight W_h, n_e the
effective degrees of freedom of Student's t for the limits of confidence (Satterthwaite). The smallest
variance for a given number of cases has n_h in proportion to W_h s_h (Neyman). In whole cases it is reached
one by one: the next case goes where W_h s_h / sqrt(n_h (n_h + 1)) is largest, the gain of one more sample
(T. Wright, The American Statistician 66 (2012) 217-224).

Strata must be independent: every case has a seed of its own (`hh_exudyn.campaign.collective.strata`).
Equation numbers are from memory of the book; the formulas are checked by simulation in the tests.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from hh_exudyn.arrays import FloatArray, IntArray

LEAST_SAMPLES = 3  # of a stratum, for a spread


@dataclass(frozen=True, eq=False)
class Estimates:
    """What is known of some quantities in every stratum.

    Attributes
    ----------
    weight : (strata,) array
        Shares W_h [-].
    mean, spread : (strata, quantities) arrays
        Mean and standard deviation (with n - 1) over the samples of a stratum.
    count : (strata,) array
        Samples of each stratum.

    Raises
    ------
    ValueError
        Arrays that do not fit together, a negative or non-finite number, less than `LEAST_SAMPLES` samples.
    """

    weight: FloatArray
    mean: FloatArray
    spread: FloatArray
    count: IntArray

    def __post_init__(self) -> None:
        strata = len(self.weight)
        if self.mean.shape != self.spread.shape or self.mean.ndim != 2 or len(self.mean) != strata:
            raise ValueError(
                f"mean has shape {self.mean.shape}, spread {self.spread.shape}: allowed "
                f"({strata}, quantities)"
            )
        if self.count.shape != self.weight.shape or not np.all(self.count >= LEAST_SAMPLES):
            raise ValueError(
                f"count = {self.count}: allowed {LEAST_SAMPLES} samples or more for each of {strata} strata"
            )
        if not (np.all(self.weight >= 0.0) and np.all(self.spread >= 0.0) and np.all(np.isfinite(self.mean))):
            raise ValueError("weight, spread and mean: allowed finite numbers, weights and spreads from 0")

    @property
    def total(self) -> FloatArray:
        """Weighted sum of each quantity, (quantities,)."""
        found: FloatArray = self.weight @ self.mean
        return found

    @property
    def shares_of_variance(self) -> FloatArray:
        """W_h^2 s_h^2 / n_h, (strata, quantities)."""
        found: FloatArray = self.spread**2 * (self.weight**2 / self.count)[:, None]
        return found

    @property
    def standard_error(self) -> FloatArray:
        """Standard deviation of the total, (quantities,)."""
        found: FloatArray = np.sqrt(self.shares_of_variance.sum(axis=0))
        return found

    @property
    def degrees_of_freedom(self) -> FloatArray:
        """Effective degrees of freedom of the standard error, (quantities,); infinity without spread."""
        parts = self.shares_of_variance
        below = (parts**2 / (self.count - 1)[:, None]).sum(axis=0)
        found: FloatArray = np.full(len(below), np.inf)
        np.divide(parts.sum(axis=0) ** 2, below, out=found, where=below > 0.0)
        return found

    def half_width(self, confidence: float = 0.95) -> FloatArray:
        """Half of the interval of confidence about the total, (quantities,).

        Parameters
        ----------
        confidence : float
            Probability that the interval holds the true total [-], above 0 and below 1.
        """
        if not 0.0 < confidence < 1.0:
            raise ValueError(f"confidence is {confidence:g}: allowed above 0 and below 1")
        factor = student.ppf(0.5 * (1.0 + confidence), self.degrees_of_freedom)
        found: FloatArray = factor * self.standard_error
        return found

    def gains(self, scale: FloatArray) -> FloatArray:
        """Variance that one more sample takes from each stratum, W_h^2 s_h^2 / (n_h (n_h + 1)), over scale^2.

        Of several quantities it is the largest.

        Parameters
        ----------
        scale : (quantities,) array
            Error that is allowed for each quantity, > 0.
        """
        found: FloatArray = (self.shares_of_variance / (self.count + 1)[:, None] / scale**2).max(axis=1)
        return found

    def with_samples(self, count: IntArray) -> "Estimates":
        """The same strata with other numbers of samples, as if means and spreads stayed.

        Parameters
        ----------
        count : (strata,) array
            Samples of each stratum.
        """
        return Estimates(self.weight, self.mean, self.spread, count)


def of_samples(weight: FloatArray, samples: list[FloatArray]) -> Estimates:
    """Estimates of strata from their samples.

    Parameters
    ----------
    weight : (strata,) array
        Shares [-].
    samples : list of (n_h, quantities) arrays
        The samples of each stratum.

    Raises
    ------
    ValueError
        As `Estimates`.
    """
    count = np.array([len(each) for each in samples], dtype=np.int64)
    if count.min(initial=LEAST_SAMPLES) < LEAST_SAMPLES:
        raise ValueError(f"{count.min()} samples of a stratum: allowed {LEAST_SAMPLES} or more")
    mean = np.array([each.mean(axis=0) for each in samples])
    return Estimates(weight, mean, np.array([each.std(axis=0, ddof=1) for each in samples]), count)


def by_units(
    weight: FloatArray, unit: Sequence[str], replicate: IntArray, values: FloatArray
) -> tuple[tuple[str, ...], Estimates]:
    """Units of sampling and their estimates, from one row a weighted stratum.

    A replicate of a unit is a sample: the weighted mean of its rows. That holds for cells, and for overlays
    of a group, of which the cells depend on each other but whole overlays do not
    (`hh_exudyn.campaign.collective.collective.Collective.unit`).

    Parameters
    ----------
    weight : (rows,) array
        Shares [-].
    unit : sequence of str
        Of each row.
    replicate : (rows,) array
        Of each row, from 1.
    values : (rows, quantities) array
        Results of the rows, mirrored where their stratum is.

    Raises
    ------
    ValueError
        As `Estimates`.
    """
    names = np.array(unit)
    units = tuple(dict.fromkeys(unit))
    shares, samples = [], []
    for name in units:
        mine = names == name
        shares.append(weight[mine].sum())
        parts = [mine & (replicate == number) for number in np.unique(replicate[mine])]
        samples.append(np.array([weight[part] @ values[part] / weight[part].sum() for part in parts]))
    return units, of_samples(np.array(shares), samples)


def next_samples(estimates: Estimates, scale: FloatArray, more: int) -> IntArray:
    """How many of the next samples go to each stratum, (strata,): one by one where the gain is largest.

    Parameters
    ----------
    estimates : Estimates
        What is known so far.
    scale : (quantities,) array
        Error that is allowed for each quantity, > 0.
    more : int
        Number of samples to place.
    """
    start = estimates.count
    known = estimates
    for _ in range(more):
        count = known.count.copy()
        count[int(np.argmax(known.gains(scale)))] += 1
        known = known.with_samples(count)
    return known.count - start


def samples_to_error(
    estimates: Estimates, allowed: FloatArray, budget: float, confidence: float = 0.95,
    cost: FloatArray | None = None,
) -> IntArray:  # fmt: skip
    """Samples to add to each stratum until every half width is within `allowed`, or the budget is spent.

    One by one where the gain over the cost is largest, among those that the rest of the budget pays for.

    Parameters
    ----------
    estimates : Estimates
        What is known so far.
    allowed : (quantities,) array
        Half width of the interval of confidence, in the unit of each quantity, > 0; infinite for any.
    budget : float
        Most to spend, in the unit of the cost.
    confidence : float
        As `Estimates.half_width`.
    cost : (strata,) array or None
        Of one sample of each stratum, > 0; None: 1.
    """
    each = np.ones(len(estimates.weight)) if cost is None else cost
    known, spent = estimates, 0.0
    while not np.all(known.half_width(confidence) <= allowed):
        gain = np.where(spent + each <= budget, known.gains(allowed) / each, 0.0)
        best = int(np.argmax(gain))
        if gain[best] == 0.0:
            break
        spent += float(each[best])
        count = known.count.copy()
        count[best] += 1
        known = known.with_samples(count)
    return known.count - estimates.count


def halving_error(coarse: FloatArray, fine: FloatArray, order: int = 2) -> FloatArray:
    """Discretisation error of the finer of two results, |fine - coarse| / (2^order - 1) (Richardson).

    Parameters
    ----------
    coarse, fine : arrays of one shape
        Results before and after the steps of an axis are halved
        (`hh_exudyn.campaign.collective.collective.Collective.refined`).
    order : int
        Of convergence: 2 for means of intervals and a smooth quantity; 1 where it has a threshold.
    """
    found: FloatArray = np.abs(np.asarray(fine) - np.asarray(coarse)) / (2.0**order - 1.0)
    return found
