"""The numbers of a line's file as sourced parameters, for lists of published and assumed numbers."""

import re
from collections.abc import Iterator
from typing import Any

from hh_exudyn.sourced import Parameter, made
from track.line.data_table import read_data
from track.line.line_file import line_record
from track.rails import slope

_UNITS = {"km_h": "km/h", "km": "km", "mm": "mm", "m": "m", "percent": "%"}  # by the end of a key


def line_numbers(name: str) -> tuple[Parameter, ...]:
    """All numbers of a known line: each has the unit of its key, and the source of its table.

    Raises ValueError for an unknown name (lists the known ones).
    """
    return tuple(_numbers("", read_data(line_record(name).file).entries, "", "-"))


def _numbers(place: str, value: Any, source: str, unit: str) -> Iterator[Parameter]:
    """The numbers in a value at a place of the file; infinity (straight track, no upper bound) is skipped."""
    if isinstance(value, dict):
        source = value.get("source", source)
        for key, inner in value.items():
            of_key = next((name for end, name in _UNITS.items() if re.search(rf"(^|_){end}$", key)), unit)
            yield from _numbers(f"{place}.{key}" if place else key, inner, source, of_key)
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from _numbers(f"{place}[{i}]", inner, source, unit)
    elif isinstance(value, str) and value.startswith("1:"):
        yield made(place, value=slope(value), unit="-", source=source)
    elif isinstance(value, int | float) and value != float("inf"):
        yield made(place, value=value, unit=unit, source=source)
