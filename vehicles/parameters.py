"""Parameter files: every number with its unit and its source, `assumed` where it is a guess.

A file is TOML; each entry reads ``name = { value = 1341.0, unit = "kg", source = "published: ..." }`` in a
table named after the part. The source starts with one of `KINDS`, so that a user can list the guesses.
`ParameterSet.replace` gives a changed copy; `differences` says what sets two of them apart.
"""

import difflib
import math
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from importlib.resources import files
from typing import Any

KINDS = ("published", "derived", "assumed")
VARIANT = "variant"  # the kind of a number that somebody changed without saying how it is known


@dataclass(frozen=True)
class Parameter:
    """One number of a parameter file."""

    name: str  # "part.quantity"
    value: float
    unit: str
    source: str

    @property
    def kind(self) -> str:
        """How the number is known: one of `KINDS`, or `VARIANT`."""
        return self.source.split(":", 1)[0]


@dataclass(frozen=True)
class Difference:
    """One number that is not the same in two parameter sets; None where a set does not have it."""

    name: str
    before: Parameter | None
    after: Parameter | None


class ParameterSet:
    """Numbers by name, ``parameters["wedge.friction"]`` in the unit of the file."""

    def __init__(self, name: str, parameters: tuple[Parameter, ...]) -> None:
        self.name = name
        self.parameters = parameters
        self._by_name = {parameter.name: parameter for parameter in parameters}

    def __getitem__(self, name: str) -> float:
        return self.parameter(name).value

    def parameter(self, name: str) -> Parameter:
        """The number of that name with unit and source. Raises KeyError that names the closest one."""
        try:
            return self._by_name[name]
        except KeyError:
            raise KeyError(f"{self.name} has no parameter {name!r}{self._closest(name)}") from None

    def of_kind(self, kind: str) -> tuple[Parameter, ...]:
        """The parameters that are "published", "derived", "assumed" or changed, "variant"."""
        return tuple(parameter for parameter in self.parameters if parameter.kind == kind)

    def replace(self, changes: Mapping[str, float], source: str, name: str | None = None) -> "ParameterSet":
        """A copy in which some numbers are others.

        Parameters
        ----------
        changes : mapping of str to float
            New values by name, in the units that this set has.
        source : str
            How they are known: ``"published: ..."``, ``"derived: ..."``, ``"assumed: ..."``, or
            ``"variant: ..."`` for what is merely tried.
        name : str or None
            Of the copy; None keeps the name.

        Raises
        ------
        ValueError
            A name is not known (the closest is told), a value is not a finite number, or the source does not
            begin with one of the four words.
        """
        return self.with_parameters(
            [
                Parameter(key, value, self._by_name[key].unit if key in self._by_name else "", source)
                for key, value in changes.items()
            ],
            name,
        )

    def with_parameters(self, parameters: Iterable[Parameter], name: str | None = None) -> "ParameterSet":
        """A copy in which some numbers are others, each with a source of its own; see `replace`.

        Raises
        ------
        ValueError
            As `replace`, and for a unit that is not the one that this set has.
        """
        new = dict(self._by_name)
        for parameter in parameters:
            if parameter.name not in new:
                raise ValueError(f"unknown parameter {parameter.name}{self._closest(parameter.name)}")
            unit = new[parameter.name].unit
            if parameter.unit != unit:
                raise ValueError(f'{parameter.name} is in "{parameter.unit}": allowed "{unit}"')
            if parameter.kind not in (*KINDS, VARIANT):
                raise ValueError(
                    f"source of {parameter.name} starts with {parameter.kind!r}; "
                    f"allowed: {', '.join((*KINDS, VARIANT))}"
                )
            new[parameter.name] = replace(parameter, value=_finite(parameter.name, parameter.value))
        return ParameterSet(name or self.name, tuple(new.values()))

    def _closest(self, name: str) -> str:
        """What was meant, or where to look: the other numbers of the part, or the parts."""
        if near := difflib.get_close_matches(name, self._by_name, n=1, cutoff=0.6):
            return f"; did you mean {near[0]}?"
        part = name.split(".", 1)[0] + "."
        of_part = [known for known in self._by_name if known.startswith(part)]
        parts = dict.fromkeys(known.split(".", 1)[0] for known in self._by_name)
        return f"; it has {', '.join(of_part)}" if of_part else f"; its parts are {', '.join(parts)}"


def differences(before: ParameterSet, after: ParameterSet) -> tuple[Difference, ...]:
    """The numbers whose value or unit is not the same in both sets, in the order of the files."""
    old = {parameter.name: parameter for parameter in before.parameters}
    new = {parameter.name: parameter for parameter in after.parameters}
    found = []
    for name in dict.fromkeys((*old, *new)):
        one, other = old.get(name), new.get(name)
        if one is None or other is None or (one.value, one.unit) != (other.value, other.unit):
            found.append(Difference(name, one, other))
    return tuple(found)


def load_parameters(name: str) -> ParameterSet:
    """Read ``vehicles/data/<name>.toml``.

    Raises
    ------
    ValueError
        If an entry lacks value, unit or source, or its source does not start with one of `KINDS`.
    """
    text = files("vehicles").joinpath(f"data/{name}.toml").read_text(encoding="utf-8")
    return read_parameters(tomllib.loads(text), name, f"{name}.toml")


def read_parameters(tables: Mapping[str, Any], name: str, file: str) -> ParameterSet:
    """A parameter set from the tables of a TOML file, for a vehicle of one's own.

    Parameters
    ----------
    tables : mapping
        ``{part: {quantity: {"value": ..., "unit": ..., "source": ...}}}``, as `tomllib.load` gives it.
    name : str
        Of the set.
    file : str
        Named in error messages.

    Raises
    ------
    ValueError
        As `load_parameters`.
    """
    parameters = []
    for part, entries in tables.items():
        if not isinstance(entries, Mapping):
            raise ValueError(f"{file}: {part} is not a table of parameters")
        for quantity, entry in entries.items():
            full = f"{part}.{quantity}"
            missing = {"value", "unit", "source"} - set(entry if isinstance(entry, Mapping) else ())
            if missing:
                raise ValueError(f"{file}: {full} lacks {', '.join(sorted(missing))}")
            try:
                value = _finite(full, entry["value"])
            except ValueError as error:
                raise ValueError(f"{file}: {error}") from None
            parameter = Parameter(full, value, entry["unit"], entry["source"])
            if parameter.kind not in KINDS:
                raise ValueError(
                    f"{file}: source of {full} starts with {parameter.kind!r}; allowed: {', '.join(KINDS)}"
                )
            parameters.append(parameter)
    return ParameterSet(name, tuple(parameters))


def _finite(name: str, value: Any) -> float:
    """A number as a float. Raises ValueError for a text, a truth value, NaN or infinity."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError(f"{name} = {value!r}: allowed is a finite number")
    return float(value)
