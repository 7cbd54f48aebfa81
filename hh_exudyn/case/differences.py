"""Inputs in which cases differ: keys of the case files, numbers of the vehicles, content of files."""

import hashlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from hh_exudyn.case.case import Case
from hh_exudyn.case.fields import is_path
from hh_exudyn.case.vehicle import variant_behind

ABSENT = "-"  # for an input that a case does not have
_NAMES = ("name", "vehicle")  # keys that say nothing by themselves


def differing_inputs(cases: Sequence[Case]) -> dict[str, list[Any]]:
    """Values of the inputs that are not the same in all cases, by their names.

    Numbers of vehicles are compared where all of them have numbers of the same names; other vehicles differ
    by name alone. A file is named with the beginning of its hash (SHA-256).

    Parameters
    ----------
    cases : sequence of Case
        Two or more, to differ.
    """
    tables = [dict(_flat(case.model_dump(exclude=set(_NAMES)))) for case in cases]
    vehicles = [_vehicle_numbers(case) for case in cases]
    alike = len({frozenset(numbers) for numbers in vehicles}) == 1 and all(vehicles)
    for case, table, numbers in zip(cases, tables, vehicles, strict=True):
        table |= numbers if alike else {"vehicle": case.described_vehicle().name}
    keys = dict.fromkeys(key for table in tables for key in table)
    rows = {key: [table.get(key, ABSENT) for table in tables] for key in keys}
    return {key: values for key, values in rows.items() if any(value != values[0] for value in values)}


def _vehicle_numbers(case: Case) -> dict[str, Any]:
    variant = variant_behind(case.vehicle)
    return {} if variant is None else variant.parameters().values()


def _flat(value: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """All values in tables and lists, by their paths."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _flat(item, f"{place}.{key}" if place else key)
    elif isinstance(value, list | tuple) and any(isinstance(item, dict) for item in value):
        for i, item in enumerate(value):
            yield from _flat(item, f"{place}[{i}]")
    elif value is not None:
        yield place, _by_content(value)


def _by_content(value: Any) -> Any:
    """A path as name and hash of its file; any other value as it is."""
    if not (isinstance(value, str) and is_path(value) and Path(value).is_file()):
        return value
    return f"{Path(value).name} ({hashlib.sha256(Path(value).read_bytes()).hexdigest()[:8]})"
