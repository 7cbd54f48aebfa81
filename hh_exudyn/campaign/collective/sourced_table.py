"""A table of a load collective's file, of which every number becomes a parameter with unit, source and range.

::

    [gauge]
    deviation_mm = 4.0
    source = "assumed: ..."
    ranges = { deviation_mm = [2.0, 6.0] }
"""

from hh_exudyn.sourced import Parameter, made
from track.line.data_table import DataTable


class SourcedTable(DataTable):
    """A `track.line.data_table.DataTable` that collects its numbers.

    `begin` reads ``source`` and ``ranges``, which hold for the numbers read after it, and for those of tables
    inside that have none of their own.
    """

    def __init__(self, entries: object, file: str, place: str = "") -> None:
        super().__init__(entries, file, place)
        self.found: list[Parameter] = []
        self._source = ""
        self._ranges: dict[str, tuple[float, float]] = {}

    @property
    def said_source(self) -> str:
        """The source that holds here."""
        return self._source

    def begin(self) -> None:
        """Read ``source``, and ``ranges`` if there are any. Raises ValueError as `DataTable`."""
        self._source = self.source()
        self._ranges = {}
        if "ranges" in self:
            inner = DataTable(self.entries["ranges"], self.file, self.key("ranges"))
            self._read.add("ranges")
            for name in inner.entries:
                if name not in self.entries:
                    raise self.error(f"{inner.key(name)}: {self.place} has no {name}")
                low, high = inner.numbers(name, "", -1e12, 1e12, 2)
                self._ranges[name] = (low, high)

    def number(self, name: str, unit: str, low: float, high: float) -> float:
        """As `DataTable.number`; the number is collected with its source.

        Parameters
        ----------
        name : key in the table
        unit : of the number
        low, high : allowed range, ends included
        """
        value = super().number(name, unit, low, high)
        if self._source:
            key, bounds = self.key(name), self._ranges.get(name)
            try:
                self.found.append(made(key, value=value, unit=unit, source=self._source, range=bounds))
            except ValueError as error:
                raise self.error(str(error)) from None
        return value

    def number_or(self, name: str, unit: str, low: float, high: float) -> float | None:
        """As `number`, or None where the table has no such key.

        Parameters
        ----------
        name, unit, low, high : as `number`
        """
        return self.number(name, unit, low, high) if name in self else None

    def whole(self, name: str, unit: str, low: int, high: int) -> int:
        """A whole number. Parameters and errors as `number`."""
        value = self.number(name, unit, low, high)
        if value != int(value):
            raise self.error(f"{self.key(name)} = {value:g} {unit}: allowed whole numbers {low} to {high}")
        return int(value)

    def wholes(self, name: str, unit: str, low: int, high: int) -> tuple[int, ...]:
        """A list of whole numbers, empty where the table has no such key. Errors as `number`."""
        if name not in self:
            return ()
        values = self.numbers(name, unit, low, high)
        if any(value != int(value) for value in values):
            raise self.error(f"{self.key(name)}: allowed whole numbers {low} to {high}")
        return tuple(int(value) for value in values)

    def truth(self, name: str) -> bool:
        """``true`` or ``false``. Raises ValueError for anything else."""
        value = self._get(name, "true or false")
        if not isinstance(value, bool):
            raise self.error(f"{self.key(name)} = {value!r}: allowed true or false")
        return value

    def names(self, name: str, allowed: tuple[str, ...]) -> tuple[str, ...]:
        """A list of texts out of `allowed`, empty where the table has no such key."""
        if name not in self:
            return ()
        value = self._get(name, "a list")
        for one in value if isinstance(value, list) else [value]:
            if not isinstance(value, list) or one not in allowed:
                raise self.error(f"{self.key(name)} = {value!r}: allowed a list out of {', '.join(allowed)}")
        return tuple(value)

    def groups(self, name: str) -> tuple[tuple[str, ...], ...]:
        """A list of lists of texts, every text once; empty where the table has no such key."""
        if name not in self:
            return ()
        groups = self._get(name, "lists of names")
        is_lists = isinstance(groups, list) and all(isinstance(group, list) and group for group in groups)
        texts = [text for group in groups for text in group] if is_lists else [None]
        if not all(isinstance(text, str) for text in texts) or len(set(texts)) < len(texts):
            raise self.error(f"{self.key(name)} = {groups!r}: allowed lists of names, each name once")
        return tuple(tuple(group) for group in groups)

    def table(self, name: str) -> "SourcedTable":
        """The table of that name inside this one."""
        return self._inside(super().table(name))

    def sourced_tables(self, name: str) -> "list[SourcedTable]":
        """The array of tables ``[[name]]``, one at least."""
        return [self._inside(table) for table in self.tables(name)]

    def _inside(self, plain: DataTable) -> "SourcedTable":
        inner = SourcedTable(plain.entries, plain.file, plain.place)
        inner.found, inner._source = self.found, self._source
        return inner
