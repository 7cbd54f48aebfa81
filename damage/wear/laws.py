"""The wear laws as people write them: `wear_law("archard", surface="lubricated")`.

================  ========================================================  ================================
law               worn volume                                               options
================  ========================================================  ================================
`archard`         k/H times load times sliding distance, cell by cell       surface, slip, wear_map, divisor
================  ========================================================  ================================
"""

from collections.abc import Callable
from dataclasses import dataclass
from inspect import signature
from typing import Any

from damage.wear.jendel import JENDEL_REGIMES, JendelMap
from damage.wear.parameters import parameters
from damage.wear.values import LAWS, NO_RATE, LawValues

DRY = JendelMap()
SURFACES = ("dry", "lubricated", "greased")
SLIPS = ("elastic", "rigid")


@dataclass(frozen=True)
class WearLaw:
    """A wear law with its numbers.

    Attributes
    ----------
    name
        One of `values.LAWS`.
    regimes
        What the law calls its regimes, one a column of the strips' depth; further columns stay 0.
    values
        The law for the kernels.
    """

    name: str
    regimes: tuple[str, ...]
    values: LawValues


def archard(
    surface: str = "dry",
    slip: str = "elastic",
    wear_map: JendelMap = DRY,
    divisor: float | None = None,
) -> WearLaw:
    """Archard's law with Jendel's map.

    Parameters
    ----------
    surface
        "dry"; "lubricated" divides the coefficients by 6 (natural lubrication, Jendel), "greased" by 100
        (Zhu).
    slip
        "elastic", the field's own (Enblom), or "rigid", that of the creepages in the slip zone (Jendel).
    wear_map
        The dry coefficients and the hardness.
    divisor
        Instead of the surface's [-], > 0; 5.5 is also in use for "lubricated".

    Raises
    ------
    ValueError
        Unknown surface or slip, or a divisor that is not above zero.
    """
    _one_of("surface", surface, SURFACES)
    _one_of("slip", slip, SLIPS)
    if divisor is None:
        divisor = 1.0 if surface == "dry" else parameters("surface")[surface].value
    elif surface == "dry":
        raise ValueError(f"divisor = {divisor}: a dry surface has none; name the surface it is for")
    values = LawValues(LAWS["archard"], slip == "rigid", wear_map.divided(divisor).values, NO_RATE)
    return WearLaw("archard", JENDEL_REGIMES, values)


_MAKERS: dict[str, Callable[..., WearLaw]] = {"archard": archard}


def wear_law(name: str, **options: Any) -> WearLaw:
    """A wear law by name; its options are those of the function of that name in this module.

    Raises
    ------
    ValueError
        Unknown law, an option that the law does not have, or one that it needs and is not given.
    """
    _one_of("wear law", name, tuple(_MAKERS))
    known = signature(_MAKERS[name]).parameters
    if unknown := sorted(set(options) - set(known)):
        raise ValueError(f"wear law {name!r} has no option {unknown[0]!r}; it has {', '.join(known)}")
    missing = [key for key, option in known.items() if option.default is option.empty and key not in options]
    if missing:
        raise ValueError(f"wear law {name!r} needs {', '.join(missing)}: there are no published defaults")
    return _MAKERS[name](**options)


def _one_of(what: str, given: str, known: tuple[str, ...]) -> None:
    if given not in known:
        raise ValueError(f"{what} = {given!r}; known: {', '.join(known)}")
