"""The source of every number of a vehicle that was built from sourced parameters.

A builder computes the numbers of a `Vehicle` freely, so which parameters one rests on is found by trial:
every parameter is changed a little, and the numbers that change with it rest on it. One that is a parameter
has that one's source; one that rests on several, or is computed from one, is derived from these.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from hh_exudyn.sourced import Parameter, ParameterSet
from vehicles.description import Vehicle
from vehicles.record import VehicleRecord
from vehicles.units import converted

Address = tuple[Any, ...]  # of a number in a vehicle: fields and places in lists
_CHANGES = (1e-6, -1e-6)  # of the value, or in the parameter's unit where that is 0
_SHOWN = 6  # most parameters that a source names
_SAME = 1e-14  # of a number, after a change of unit

Origins = Mapping[Address, tuple[Parameter, ...]]  # the parameters on which numbers rest


def origins(record: VehicleRecord, parameters: ParameterSet) -> Origins:
    """The parameters on which each number rests of the vehicle that a record builds.

    Numbers that rest on none are left out: they are fixed in the builder.

    Parameters
    ----------
    record : VehicleRecord
        Builds the vehicle.
    parameters : ParameterSet
        All its parameters, in the order of the record.
    """
    here = dict(numbers_of(record.build(record.name, parameters)))
    rests_on: dict[Address, list[Parameter]] = {}
    for parameter in parameters.parameters:
        changed = _changed(record, parameters, parameter)
        if changed is None:
            continue
        for address, value in numbers_of(changed):
            if address in here and here[address] != value:
                rests_on.setdefault(address, []).append(parameter)
    return {address: tuple(found) for address, found in rests_on.items()}


def source_of(value: float, unit: str, found: Iterable[Parameter]) -> str:
    """Source of a number that rests on some parameters, on one at least."""
    once = tuple(dict.fromkeys(found))
    if len(once) == 1 and _is(value, unit, once[0]):
        return once[0].source
    names = [parameter.name for parameter in once]
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"derived: from {', '.join(names[:_SHOWN])}{more}"


def numbers_of(value: Any, address: Address = ()) -> Iterator[tuple[Address, float]]:
    """All numbers in a dataclass, by their address."""
    if is_dataclass(value):
        for one in fields(value):
            yield from numbers_of(getattr(value, one.name), (*address, one.name))
    elif isinstance(value, Mapping):
        for key, item in value.items():
            yield from numbers_of(item, (*address, key))
    elif isinstance(value, tuple):
        for i, item in enumerate(value):
            yield from numbers_of(item, (*address, i))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield address, value


def _changed(record: VehicleRecord, parameters: ParameterSet, parameter: Parameter) -> Vehicle | None:
    """The vehicle with one parameter changed; None where neither more nor less of it can be built."""
    for change in _CHANGES:
        value = parameter.value * (1.0 + change) if parameter.value else change
        try:
            return record.build(record.name, parameters.replace({parameter.name: value}, "assumed: a trial"))
        except ValueError:
            continue
    return None


def _is(value: float, unit: str, parameter: Parameter) -> bool:
    """Whether a number is a parameter, but for its sign."""
    try:
        same = converted(parameter.value, parameter.unit, unit)
    except ValueError:
        return False
    return math.isclose(abs(value), abs(same), rel_tol=_SAME)
