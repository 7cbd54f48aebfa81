"""The wear laws by name: `wear_law("archard", surface="lubricated")`.

================  ===============================================================  ===========================
law               worn volume per metre rolled                                     options
================  ===============================================================  ===========================
`archard`         k/H times pressure times slip, summed over the cells             surface, slip, wear_map,
                                                                                   divisor, hardness
`british_rail`    piecewise linear in the wear number; strips by their energy      continuous
`usfd`            piecewise linear in wear number over area; all over the patch    density
`ward`            the same law in every cell, of the cell's own energy             density
`krause_poll`     coefficient times energy, by power density; strips by energy     coefficients,
                                                                                   power_densities (required)
================  ===============================================================  ===========================

Only Archard's law has coefficients for a lubricated or greased surface; the others see lubrication through
the friction coefficient alone.
"""

from collections.abc import Callable
from inspect import signature
from typing import Any

from damage.wear.archard import archard
from damage.wear.british_rail import british_rail
from damage.wear.krause_poll import krause_poll
from damage.wear.law import WearLaw, require_known
from damage.wear.usfd import usfd, ward

_MAKERS: dict[str, Callable[..., WearLaw]] = {
    "archard": archard,
    "british_rail": british_rail,
    "usfd": usfd,
    "ward": ward,
    "krause_poll": krause_poll,
}


def wear_law(name: str, **options: Any) -> WearLaw:
    """A wear law by name; its options are the arguments of the function of that name.

    Raises
    ------
    ValueError
        Unknown law, an option that the law does not have, one that it needs and is not given, or a value out
        of its range.
    """
    require_known("wear law", name, tuple(_MAKERS))
    known = signature(_MAKERS[name]).parameters
    if unknown := sorted(set(options) - set(known)):
        raise ValueError(f"wear law {name!r} has no option {unknown[0]!r}; it has {', '.join(known)}")
    missing = [key for key, option in known.items() if option.default is option.empty and key not in options]
    if missing:
        raise ValueError(f"wear law {name!r} needs {' and '.join(missing)}: there are no published defaults")
    return _MAKERS[name](**options)
