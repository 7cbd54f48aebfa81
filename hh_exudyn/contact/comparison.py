"""A number of ours beside one from outside, and the files of outside numbers."""

import csv
from dataclasses import dataclass
from importlib.resources import files

_DATA = files("hh_exudyn") / "data" / "validation"


@dataclass(frozen=True)
class Comparison:
    """One number compared.

    Attributes
    ----------
    quantity, source : str
        What, and where the outside number is from.
    found, wanted : float
        Ours and the outside number; of a deviation over many, itself and 0.
    allowed : float
        Largest deviation: of the quotient from 1, or of deviations their limit [-].
    """

    quantity: str
    source: str
    found: float
    wanted: float
    allowed: float

    @property
    def deviation(self) -> float:
        """found / wanted - 1, or what was found where 0 is wanted [-]."""
        return self.found if self.wanted == 0.0 else self.found / self.wanted - 1.0

    @property
    def holds(self) -> bool:
        """Whether the deviation is allowed."""
        return abs(self.deviation) <= self.allowed


def outside_rows(name: str) -> list[dict[str, str]]:
    """Rows of a file of ``hh_exudyn/data/validation``.

    Parameters
    ----------
    name : str
        Of the file.
    """
    with (_DATA / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))
