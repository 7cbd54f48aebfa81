"""What has been evaluated of a collective, row by row; nothing is evaluated twice."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.collective import Collective
from hh_exudyn.campaign.collective.sampling import Estimates, by_units
from hh_exudyn.campaign.collective.weighted import WeightedCase, WeightedStratum

ValuesOf = Callable[[Collective, Sequence[WeightedStratum]], FloatArray]
"""From weighted strata of a collective to quantities per metre, (rows, quantities), mirrored as they are."""


def through_cases(values_of: Callable[[Sequence[WeightedCase]], FloatArray]) -> ValuesOf:
    """The values of strata by those of their cases: what an engine evaluates.

    Parameters
    ----------
    values_of : callable
        From weighted cases to (rows, quantities); a case that is there several times is to be run once.
    """
    return lambda collective, rows: values_of(collective.cases(rows))


@dataclass
class Bought:
    """Values of strata, and how many different cases they took.

    Attributes
    ----------
    values_of
        Evaluates what is not known yet.
    quantities
        Their number.
    """

    values_of: ValuesOf
    quantities: int
    _known: dict[tuple[str, bool], FloatArray] = field(default_factory=dict)
    _keys: set[str] = field(default_factory=set)

    @property
    def runs(self) -> int:
        """Number of different cases evaluated."""
        return len(self._keys)

    def runs_for(self, rows: Sequence[WeightedStratum]) -> int:
        """Number of cases of these strata that are not evaluated yet."""
        return len({row.stratum.key for row in rows} - self._keys)

    def values(self, collective: Collective, rows: Sequence[WeightedStratum]) -> FloatArray:
        """Values of strata, (rows, quantities).

        Parameters
        ----------
        collective : Collective
            Of the strata.
        rows : sequence of WeightedStratum
            Known or new.

        Raises
        ------
        ValueError
            The values have another shape, or are not finite.
        """
        new = [row for row in rows if (row.stratum.key, row.mirrored) not in self._known]
        if new:
            found = np.asarray(self.values_of(collective, new), dtype=np.float64)
            wanted = (len(new), self.quantities)
            if found.shape != wanted or not np.all(np.isfinite(found)):
                raise ValueError(
                    f"values have shape {found.shape}, {np.sum(~np.isfinite(found))} of them not finite: "
                    f"allowed {wanted} finite numbers"
                )
            for row, value in zip(new, found, strict=True):
                self._known[row.stratum.key, row.mirrored] = value
                self._keys.add(row.stratum.key)
        return np.array([self._known[row.stratum.key, row.mirrored] for row in rows])

    def estimates(
        self, collective: Collective, rows: Sequence[WeightedStratum]
    ) -> tuple[tuple[str, ...], Estimates]:
        """Units of sampling and what is known of the quantities in each.

        Parameters
        ----------
        collective, rows
            As `values`; at least three replicates of every unit.
        """
        return by_units(
            np.array([row.weight for row in rows]),
            [collective.unit(row.stratum) for row in rows],
            np.array([row.stratum.replicate for row in rows]),
            self.values(collective, rows),
        )
