"""One number, or a row of them, as a vehicle file writes it.

=================================================  ====================================================
``1341.0``                                         in SI
``"13.1345 MN/m"``                                 with its unit
``{ value = 0.3, unit = "-", source = "..." }``    with unit and source, as in the toolkit's data files
``[0.889, 1.0, "457.5 mm"]``                       a row, each item in any of these forms
``{ value = [1, 2, 3], unit = "MN/m" }``           a row of one unit and source
=================================================  ====================================================

A source begins with "published", "derived" or "assumed"; a number without one has that of its entry, else of
the file, else "assumed: no source is stated".
"""

import re
from collections.abc import Iterator, Mapping
from typing import Any, get_args

from hh_exudyn.sourced import Parameter, made
from vehicles.quantities import require_plausible
from vehicles.units import converted
from vehicles.whole.layout import is_vector

_WITH_UNIT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*")
_KEYS = {"value", "unit", "source", "confirmed", "range"}
FORMS = 'a number, a text as "1.5 kN", or a table of value, unit and source'
_AXES = "xyz"


def number(name: str, given: Any, unit: str, source: str) -> Parameter:
    """A number in SI.

    Parameters
    ----------
    name : str
        Of the number: ``wedge.friction``.
    given : Any
        As the file has it.
    unit : str
        In SI.
    source : str
        Where the number itself states none.

    Raises
    ------
    ValueError
        It is in none of the forms, in a unit that does not convert, not finite, or without a unit and not
        plausible in SI.
    """
    stated = dict(given) if isinstance(given, Mapping) else {"value": given}
    if "value" not in stated or set(stated) - _KEYS:
        raise ValueError(f"{name} = {dict(given)!r}: allowed {FORMS}")
    value = stated.pop("value")
    other = stated.pop("unit", unit)
    stating = "unit" in given if isinstance(given, Mapping) else False
    if isinstance(value, str):
        found = with_unit(value)
        if found is None or stating:
            raise ValueError(f"{name} = {value!r}: allowed {FORMS}")
        value, other, stating = found[0], found[1] or unit, bool(found[1])
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{name} = {value!r}: allowed {FORMS}")
    if not isinstance(other, str):
        raise ValueError(f"{name}: unit = {other!r}: allowed a text")
    exact = made(name, value=float(value), unit=unit, source=stated.pop("source", source))
    try:
        si = converted(exact.value, other, unit)
        span = stated.pop("range", None)
        if span is not None:
            stated["range"] = [converted(float(end), other, unit) for end in span]
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} is {error}") from None
    result = made(name, value=si, unit=unit, source=exact.source, **stated)
    if not stating and unit != "m":  # places may be anywhere
        require_plausible(result)
    return result


def with_unit(text: str) -> tuple[float, str] | None:
    """Value and unit of a text as "1.5 kN", the unit empty where there is none; None for another text."""
    found = _WITH_UNIT.fullmatch(text)
    return None if found is None else (float(found[1]), found[2] or "")


def row(name: str, given: Any, hint: Any, units: tuple[str, ...], source: str) -> Any:
    """A number, or the tuple of numbers of a table, with the shape that `hint` says; errors as `number`.

    Parameters
    ----------
    name, given, source : as for `number`
    hint : type
        float, or a tuple of such.
    units : tuple of str
        One, or one for each column of a table.
    """
    if hint is float:
        return number(name, given, units[0], source)
    given = _spread(name, given)
    kinds, own, names = names_in(name, hint, len(given), units)
    if len(given) != len(kinds):
        raise ValueError(f"{name} = {given!r}: allowed {len(kinds)} numbers in brackets")
    return tuple(
        row(place, item, kind, unit, source)
        for place, item, kind, unit in zip(names, given, kinds, own, strict=True)
    )


def names_in(
    name: str, hint: Any, count: int, units: tuple[str, ...]
) -> tuple[list[Any], list[tuple[str, ...]], list[str]]:
    """Types, units and names of the items of a row; names end in x, y, z or in a number from 1.

    Parameters
    ----------
    name : str
        Of the row.
    hint : type
        A tuple of floats or of such tuples.
    count : int
        Items of a row of any length.
    units : tuple of str
        One, or one for each column of a table.
    """
    kinds = [item for item in get_args(hint) if item is not Ellipsis]
    if Ellipsis in get_args(hint):
        kinds *= count
    columns = len(units) == len(kinds) and all(kind is float for kind in kinds)
    own: list[tuple[str, ...]] = [(unit,) for unit in units] if columns else [units] * len(kinds)
    ends = _AXES if is_vector(hint) else range(1, len(kinds) + 1)
    return kinds, own, [f"{name}_{end}" for end in ends]


def leaves(value: Any) -> Iterator[Parameter]:
    """The numbers in a value of `row`."""
    if isinstance(value, Parameter):
        yield value
    elif isinstance(value, tuple):
        for item in value:
            yield from leaves(item)


def _spread(name: str, given: Any) -> list[Any]:
    """A row of one unit and source as a list of numbers that each have it."""
    if isinstance(given, Mapping) and isinstance(given.get("value"), list):
        rest = {key: item for key, item in given.items() if key != "value"}

        def each(value: Any) -> Any:
            return list(map(each, value)) if isinstance(value, list) else {**rest, "value": value}

        return [each(value) for value in given["value"]]
    if not isinstance(given, list):
        raise ValueError(f"{name} = {given!r}: allowed a list of numbers in brackets")
    return given
