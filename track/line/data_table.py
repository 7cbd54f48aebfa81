"""The file of a line, read strictly: every key named, every number in its range, every table with its source.

The file is TOML with units in the names of its keys (``share_percent``, ``radius_m``). The ``source``
of a table holds for all its numbers and begins as that of any number (`hh_exudyn.sourced`).
A fault is a ValueError of one line with file, key, value, unit and what is allowed.
"""

import difflib
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from hh_exudyn.sourced import KINDS, kind_of
from hh_exudyn.text_files import parsed_toml, read_toml


class DataTable:
    """One table of a data file. Keys are read one by one; `close` refuses those never read.

    Parameters
    ----------
    entries : the table as tomllib gives it
    file : name of the file, for messages
    place : the table's place in the file, "" for the file itself
    """

    def __init__(self, entries: Any, file: str, place: str = "") -> None:
        self.file = file
        self.place = place
        if not isinstance(entries, dict):
            raise self.error(f"{place} = {entries!r}: allowed a table")
        self.entries: dict[str, Any] = entries
        self._read: set[str] = set()

    def error(self, text: str) -> ValueError:
        """A ValueError that starts with the name of the file."""
        return ValueError(f"{self.file}: {text}")

    def key(self, name: str) -> str:
        """Full name of a key, as in the file."""
        return f"{self.place}.{name}" if self.place else name

    def __contains__(self, name: str) -> bool:
        return name in self.entries

    def _get(self, name: str, allowed: str) -> Any:
        self._read.add(name)
        if name not in self.entries:
            near = difflib.get_close_matches(name, set(self.entries) - self._read, n=1)
            hint = f"; is it {self.key(near[0])}?" if near else ""
            raise self.error(f"{self.key(name)} is missing: allowed {allowed}{hint}")
        return self.entries[name]

    def _checked(self, name: str, value: Any, unit: str, low: float, high: float) -> float:
        """`value` as a float, or an error; NaN is in no range, and true is not a number."""
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if not (is_number and low <= value <= high):
            shown = f"{value:g} {unit}" if is_number else repr(value)
            raise self.error(f"{self.key(name)} = {shown}: allowed {low:g} to {high:g} {unit}")
        return float(value)

    def number(self, name: str, unit: str, low: float, high: float) -> float:
        """A number from `low` to `high` in the unit of the file.

        Parameters
        ----------
        name : key in the table
        unit : of the number, for messages
        low, high : allowed range, ends included
        """
        value = self._get(name, f"{low:g} to {high:g} {unit}")
        return self._checked(name, value, unit, low, high)

    def numbers(
        self, name: str, unit: str, low: float, high: float, count: int | None = None
    ) -> tuple[float, ...]:
        """A list of numbers, `count` of them unless None.

        Parameters
        ----------
        name : key in the table
        unit : of the numbers, for messages
        low, high : allowed range, ends included
        count : how many are needed; None for one or more
        """
        allowed = f"a list of {count or 'one or more'} numbers, {low:g} to {high:g} {unit}"
        value = self._get(name, allowed)
        if not isinstance(value, list) or not value or (count is not None and len(value) != count):
            raise self.error(f"{self.key(name)} = {value!r}: allowed {allowed}")
        return tuple(self._checked(f"{name}[{i}]", x, unit, low, high) for i, x in enumerate(value))

    def mapping(self, name: str, unit: str, low: float, high: float) -> dict[str, float]:
        """A table of numbers under names of the user's choice.

        Parameters
        ----------
        name : key in the table
        unit : of the numbers, for messages
        low, high : allowed range, ends included
        """
        inner = DataTable(self._get(name, "a table of numbers"), self.file, self.key(name))
        if not inner.entries:
            raise self.error(
                f"{inner.place} is empty: allowed one or more names with {low:g} to {high:g} {unit}"
            )
        return {key: inner.number(key, unit, low, high) for key in inner.entries}

    def text(self, name: str, allowed: tuple[str, ...] = ()) -> str:
        """A text, one of `allowed` if there are any."""
        choices = ", ".join(allowed) or "a text"
        value = self._get(name, choices)
        if not isinstance(value, str) or not value or (allowed and value not in allowed):
            raise self.error(f"{self.key(name)} = {value!r}: allowed {choices}")
        return value

    def source(self) -> str:
        """The table's ``source``: "kind: text", kind one of `KINDS`."""
        value = self.text("source")
        if kind_of(value) not in KINDS:
            raise self.error(
                f"{self.key('source')} = {value!r}: allowed a text that starts with {', '.join(KINDS)}"
            )
        return value

    def table(self, name: str) -> "DataTable":
        """The table of that name inside this one."""
        return DataTable(self._get(name, "a table"), self.file, self.key(name))

    def tables(self, name: str) -> list["DataTable"]:
        """The array of tables ``[[name]]``, one at least."""
        value = self._get(name, f"one or more tables [[{name}]]")
        if not isinstance(value, list) or not value:
            raise self.error(f"{self.key(name)} = {value!r}: allowed one or more tables [[{name}]]")
        return [DataTable(x, self.file, f"{self.key(name)}[{i}]") for i, x in enumerate(value)]

    def close(self) -> None:
        """Raise ValueError for the first key that was not read."""
        for name in self.entries:
            if name not in self._read:
                near = difflib.get_close_matches(name, self._read, n=1)
                hint = f"did you mean {near[0]}?" if near else f"known keys: {', '.join(sorted(self._read))}"
                raise self.error(f"unknown key {self.key(name)}; {hint}")


def read_data(path: Path | Traversable) -> DataTable:
    """The whole file as a table. Raises ValueError where it cannot be read or is not TOML."""
    if isinstance(path, Path):
        return DataTable(read_toml(path), str(path))
    return DataTable(parsed_toml(path.read_bytes(), path.name), path.name)
