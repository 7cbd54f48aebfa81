"""A wear law: a kernel for the wear depths of a solved patch, and its numbers."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from damage.patch_strips import PatchStrips, strips_space
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel_value

REGIMES = 4  # columns of a strip's depth, one per regime; columns beyond the regimes of a law stay 0


class SolvedPatch(NamedTuple):
    """A contact state with its solved patch, for the wear laws."""

    patch: RollingPatch  # loads and material; of a patch that is no ellipse, a and b of the equivalent one
    strips: PatchStrips  # (ny,)
    area: float  # of contact [m^2]
    fields: Fields  # (ny, nx) pressure, traction and slip
    speed: float  # forward [m/s], > 0
    rolling_radius: float  # of the wheel at the contact [m], > 0


LawKernel = Callable[[FloatArray, SolvedPatch, FloatArray], None]
"""Signature of a wear law's kernel: ``(numbers, solved, depth)``.

It fills ``depth`` (ny, REGIMES), the wear depth on the wheel per revolution [m], normal to the surface, by
strip of the patch and regime of the law, and returns nothing. ``numbers`` are the law's own
(`WearLaw.numbers`), ``solved`` is the `SolvedPatch`.

A strip that loses the depth dz per revolution all around the wheel, 2 pi r, loses the volume dz times its
width per metre rolled: so depth per revolution times width, summed over the strips, is the worn volume per
metre rolled.
"""


class LawValues(NamedTuple):
    """A wear law, for the kernels: ``law.depths(law.numbers, solved, depth)``."""

    depths: Any  # `kernel_value` of a `LawKernel`
    numbers: FloatArray  # (n,)


@dataclass(frozen=True)
class WearLaw:
    """A wear law with its numbers; `damage.wear.laws.wear_law` makes it by name.

    Attributes
    ----------
    name
        Name of its record in `damage.wear.laws`.
    regimes
        Names of its regimes, one to `REGIMES`: columns of the strips' depth.
    depths
        Its kernel, a `LawKernel`.
    numbers
        Numbers of the kernel, SI units; infinity is allowed, NaN is not.
    surface
        Surface that its coefficients are for: "dry", or one that the caller named.
    with_films
        Whether the films of a run divide its wear (`damage.wear.films`): dry coefficients of a law that knows
        those of lubricated surfaces.
    for_hardness
        The law for the hardness of a steel [Pa]; None where no number depends on it, or the caller named it.

    Raises
    ------
    ValueError
        No regime or more than `REGIMES`, or a number that is NaN.
    """

    name: str
    regimes: tuple[str, ...]
    depths: LawKernel
    numbers: tuple[float, ...]
    surface: str = "dry"
    with_films: bool = False
    for_hardness: "Callable[[float], WearLaw] | None" = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        if not 1 <= len(self.regimes) <= REGIMES:
            raise ValueError(
                f"wear law {self.name!r} has {len(self.regimes)} regimes, allowed 1 .. {REGIMES}"
            )
        if any(math.isnan(number) for number in self.numbers):
            raise ValueError(f"wear law {self.name!r}: numbers = {self.numbers} must not be NaN")

    def on(self, hardness: float | None) -> "WearLaw":
        """The law on a steel of that hardness [Pa]; itself where that is None, or of no influence."""
        return self if hardness is None or self.for_hardness is None else self.for_hardness(hardness)

    @property
    def values(self) -> LawValues:
        """The law for the kernels."""
        return _values(self.depths, self.numbers)


@cache
def _values(depths: LawKernel, numbers: tuple[float, ...]) -> LawValues:
    array = np.array(numbers, dtype=np.float64)
    solved = SolvedPatch(
        RollingPatch(*[0.0] * 9), strips_space(1), 0.0, Fields(*np.zeros((5, 1, 1))), 0.0, 0.0
    )
    return LawValues(kernel_value(depths, array, solved, np.zeros((1, REGIMES))), array)


def require_known(what: str, given: str, known: tuple[str, ...]) -> None:
    """Raise ValueError if a name is not among the known ones.

    Parameters
    ----------
    what
        Kind of name, for the message.
    given
        The name.
    known
        The known names.
    """
    if given not in known:
        raise ValueError(f"{what} = {given!r}; known: {', '.join(known)}")
