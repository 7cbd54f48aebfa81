"""Numbers with unit and source, and the reader of their TOML files.

Every number of a data file is an entry of a table::

    [wedge]
    friction = { value = 0.3, unit = "-", source = "assumed: dry steel", range = [0.2, 0.5] }

`source` begins with one of `KINDS`; ``range = [least, largest]`` are the bounds for variations of the
number, ``confirmed = false`` marks a number quoted from memory or at second hand. A value may be a
list; each of its items is then a parameter of its own, ``name[0]``, ``name[1]``, ... Texts beside the entries
(a description, the name of a formula) remain texts.

`load_parameters` reads a file of a package, `read_parameters` reads tables in memory. `ParameterSet.replace`
gives a changed copy; `differences` compares two sets.
"""

import difflib
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache
from importlib.resources import files
from typing import Annotated, Any

from pydantic import AfterValidator, ConfigDict, Field, ValidationError
from pydantic.dataclasses import dataclass

KINDS = ("published", "derived", "assumed")
VARIANT = "variant"  # the kind of a number changed without a source


def kind_of(source: str) -> str:
    """The first word of a source, the kind of the number."""
    return source.split(":", 1)[0]


def check_source(source: str, kinds: tuple[str, ...] = KINDS) -> str:
    """The source itself. Raises ValueError where it does not begin with one of `kinds`.

    Parameters
    ----------
    source : str
        "kind: text".
    kinds : tuple of str
        Allowed kinds.
    """
    if kind_of(source) not in kinds:
        raise ValueError(f"source starts with {kind_of(source)!r}; allowed: {', '.join(kinds)}")
    return source


_Source = Annotated[str, AfterValidator(lambda text: check_source(text, (*KINDS, VARIANT)))]


@dataclass(frozen=True, config=ConfigDict(strict=True, extra="forbid", allow_inf_nan=False))
class Parameter:
    """One number with its origin.

    Attributes
    ----------
    name : str
        Its tables and its key, joined by dots: ``"wedge.friction"``.
    value : float
        In `unit`, finite.
    unit : str
        Unit of the file, not always SI; "-" without one.
    source : str
        Kind, one of `KINDS` or `VARIANT`, a colon, and the origin.
    confirmed : bool
        Whether it was read in the named source; False where it is quoted from memory or second hand.
    range : (float, float) or None
        Least and largest reasonable value, where the source gives them.

    Raises
    ------
    ValueError
        (pydantic's ValidationError) a value that is not a finite number, a source of another kind.
    """

    name: str
    value: float
    unit: str
    source: _Source
    confirmed: bool = True
    range: Annotated[tuple[float, float], Field(strict=False)] | None = None

    def __post_init__(self) -> None:
        if self.range is not None and not self.range[0] <= self.value <= self.range[1]:
            raise ValueError(
                f"value {self.value:g} lies outside its range {self.range[0]:g} to {self.range[1]:g}"
            )

    @property
    def kind(self) -> str:
        """Kind of the number: one of `KINDS`, or `VARIANT`."""
        return kind_of(self.source)


@dataclass(frozen=True)
class Difference:
    """One number that differs between two parameter sets; None for a set without it."""

    name: str
    before: Parameter | None
    after: Parameter | None


class ParameterSet:
    """Numbers by name, ``parameters["wedge.friction"]`` in the unit of the file.

    Parameters
    ----------
    name : str
        Of the set, for messages.
    parameters : tuple of Parameter
        With names that differ.
    texts : mapping of str to str, optional
        The file's texts beside its numbers, by name.
    """

    def __init__(
        self, name: str, parameters: tuple[Parameter, ...], texts: Mapping[str, str] | None = None
    ) -> None:
        self.name = name
        self.parameters = parameters
        self.texts = dict(texts or {})
        self._by_name = {parameter.name: parameter for parameter in parameters}

    def __getitem__(self, name: str) -> float:
        return self.parameter(name).value

    def __contains__(self, name: str) -> bool:
        return name in self._by_name

    def parameter(self, name: str) -> Parameter:
        """The number of that name with unit and source. Raises KeyError that names the closest one."""
        try:
            return self._by_name[name]
        except KeyError:
            raise KeyError(f"{self.name} has no parameter {name!r}{self._closest(name)}") from None

    def row(self, name: str) -> tuple[float, ...]:
        """The values of an entry that is a list. Raises KeyError where there is none."""
        found = tuple(item.value for item in self.parameters if item.name.rsplit("[", 1)[0] == name)
        return found or (self[name],)

    @property
    def tables(self) -> tuple[str, ...]:
        """Names of the file's tables."""
        return tuple(dict.fromkeys(name.split(".", 1)[0] for name in (*self._by_name, *self.texts)))

    def table(self, name: str) -> "ParameterSet":
        """The numbers of a table, by their names in it. Raises ValueError where there is no such table."""
        if name not in self.tables:
            raise ValueError(f"{self.name} has no table {name!r}; it has: {', '.join(self.tables)}")
        start = f"{name}."
        return ParameterSet(
            f"{self.name}.{name}",
            tuple(
                replace(item, name=item.name.removeprefix(start))
                for item in self.parameters
                if item.name.startswith(start)
            ),
            {key.removeprefix(start): text for key, text in self.texts.items() if key.startswith(start)},
        )

    def values(self) -> dict[str, float]:
        """All values by name."""
        return {item.name: item.value for item in self.parameters}

    def nested(self) -> dict[str, Any]:
        """Texts and values in tables as in the file; a list is a tuple."""
        found: dict[str, Any] = {}
        entries = dict.fromkeys(item.name.rsplit("[", 1)[0] for item in self.parameters)
        plain = {name: self[name] if name in self else self.row(name) for name in entries}
        for name, value in (self.texts | plain).items():
            *tables, key = name.split(".")
            inner = found
            for table in tables:
                inner = inner.setdefault(table, {})
            inner[key] = value
        return found

    def of_kind(self, kind: str) -> tuple[Parameter, ...]:
        """The parameters that are "published", "derived", "assumed" or changed, "variant"."""
        return tuple(parameter for parameter in self.parameters if parameter.kind == kind)

    def replace(self, changes: Mapping[str, float], source: str, name: str | None = None) -> "ParameterSet":
        """A copy with some numbers changed.

        Parameters
        ----------
        changes : mapping of str to float
            New values by name, in the units of this set.
        source : str
            Their source: ``"published: ..."``, ``"derived: ..."``, ``"assumed: ..."``, or
            ``"variant: ..."`` for a trial.
        name : str or None
            Of the copy; None keeps the name.

        Raises
        ------
        ValueError
            A name is not known (the message has the closest), a value is not a finite number, or the source
            does not begin with one of the four words.
        """
        return self.with_parameters(
            [
                made(key, value=value, unit=self._by_name[key].unit, source=source)
                if key in self._by_name
                else self._unknown(key)
                for key, value in changes.items()
            ],
            name,
        )

    def with_parameters(self, parameters: Iterable[Parameter], name: str | None = None) -> "ParameterSet":
        """A copy with some numbers changed, each with a source of its own; see `replace`.

        Parameters
        ----------
        parameters : iterable of Parameter
            The changed numbers.
        name : str or None
            Of the copy; None keeps the name.

        Raises
        ------
        ValueError
            A name is not known, or a unit is not that of this set.
        """
        new = dict(self._by_name)
        for parameter in parameters:
            if parameter.name not in new:
                self._unknown(parameter.name)
            unit = new[parameter.name].unit
            if parameter.unit != unit:
                raise ValueError(f'{parameter.name} is in "{parameter.unit}": allowed "{unit}"')
            new[parameter.name] = parameter
        return ParameterSet(name or self.name, tuple(new.values()), self.texts)

    def _unknown(self, name: str) -> Parameter:
        raise ValueError(f"unknown parameter {name}{self._closest(name)}")

    def _closest(self, name: str) -> str:
        """The nearest name; failing that the other numbers of the part, or the parts."""
        part, _, quantity = name.partition(".")
        ends_so = [
            known for known in self._by_name if known.startswith(f"{part}.") and known.endswith(quantity)
        ]
        if quantity and len(ends_so) > 1:
            return f"; did you mean one of {', '.join(ends_so)}?"
        if near := difflib.get_close_matches(name, self._by_name, n=1, cutoff=0.6):
            return f"; did you mean {near[0]}?"
        of_part = [known for known in self._by_name if known.startswith(f"{part}.")]
        return f"; it has {', '.join(of_part)}" if of_part else f"; its parts are {', '.join(self.tables)}"


def differences(before: ParameterSet, after: ParameterSet) -> tuple[Difference, ...]:
    """The numbers of which value or unit differ between two sets, in the order of the files.

    Parameters
    ----------
    before, after : ParameterSet
        The two sets.
    """
    old = {parameter.name: parameter for parameter in before.parameters}
    new = {parameter.name: parameter for parameter in after.parameters}
    found = []
    for name in dict.fromkeys((*old, *new)):
        one, other = old.get(name), new.get(name)
        if one is None or other is None or (one.value, one.unit) != (other.value, other.unit):
            found.append(Difference(name, one, other))
    return tuple(found)


@cache
def load_parameters(package: str, name: str) -> ParameterSet:
    """Read ``data/<name>.toml`` of an importable package.

    Raises
    ------
    ValueError
        As `read_parameters`.
    """
    text = files(package).joinpath(f"data/{name}.toml").read_text(encoding="utf-8")
    return read_parameters(tomllib.loads(text), name, f"{name}.toml")


def read_parameters(tables: Mapping[str, Any], name: str, file: str) -> ParameterSet:
    """A parameter set from the tables of a TOML file.

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
        One line: an entry lacks value, unit or source or has another key, a value is not a finite number or
        outside its range, or a source does not begin with one of `KINDS`.
    """
    parameters: list[Parameter] = []
    texts: dict[str, str] = {}
    try:
        for part, entries in tables.items():
            if isinstance(entries, str):
                texts[part] = entries
                continue
            if not isinstance(entries, Mapping):
                raise ValueError(f"{part} is not a table of parameters")
            for full, entry in _entries(part, entries):
                if isinstance(entry, str):
                    texts[full] = entry
                    continue
                parameters += _read(full, entry)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None
    return ParameterSet(name, tuple(parameters), texts)


_REQUIRED = {"value", "unit", "source"}


def _entries(place: str, table: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Entries and texts of a table and the tables in it, by full name."""
    for key, value in table.items():
        full = f"{place}.{key}"
        if isinstance(value, Mapping) and not _REQUIRED & set(value) and value:
            yield from _entries(full, value)
        else:
            yield full, value


def _read(name: str, entry: Any) -> list[Parameter]:
    """The parameter of an entry, or one for each item of its list."""
    missing = _REQUIRED - set(entry if isinstance(entry, Mapping) else ())
    if missing:
        raise ValueError(f"{name} lacks {', '.join(sorted(missing))}")
    values = entry["value"]
    if not isinstance(values, list):
        return [_from_file(name, entry)]
    return [_from_file(f"{name}[{i}]", {**entry, "value": value}) for i, value in enumerate(values)]


def _from_file(name: str, entry: Mapping[str, Any]) -> Parameter:
    """A parameter of a data file: "variant" is no kind there."""
    found = made(name, **entry)
    try:
        check_source(found.source)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    return found


def made(name: str, **entry: Any) -> Parameter:
    """A parameter from the keys of its entry: value, unit, source, and confirmed and range where given.

    Raises
    ------
    ValueError
        One line with the name and what is wrong with which key.
    """
    try:
        return Parameter(name=name, **entry)
    except ValidationError as error:
        first = error.errors()[0]
        key = ".".join(str(part) for part in first["loc"][:1])
        if key == "value":
            raise ValueError(f"{name} = {first['input']!r}: allowed is a finite number") from None
        if first["type"] == "value_error":
            raise ValueError(f"{name}: {first['ctx']['error']}") from None
        allowed = ", ".join(sorted(_REQUIRED | {"confirmed", "range"}))
        raise ValueError(
            f"{name}.{key} = {first['input']!r}: {first['msg']}; an entry has {allowed}"
        ) from None
