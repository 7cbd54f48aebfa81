"""Parameter files of damage: every number with its unit, its source, and whether that was looked up.

A file is ``damage/data/<name>.toml``; each entry of a table reads
``severe = { value = 35e-4, unit = "-", confirmed = false, source = "assumed: ..." }``.
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources

KINDS = ("published", "derived", "assumed")


@dataclass(frozen=True)
class Parameter:
    """A number with its origin.

    Attributes
    ----------
    value
        In `unit`.
    unit
        Unit of the source, not always SI.
    source
        Begins with one of `KINDS`.
    confirmed
        Whether the number was read on the source's own page (or the thesis's, where it says so); if not, it
        is from memory or second hand.

    Raises
    ------
    ValueError
        The source begins otherwise.
    """

    value: float
    unit: str
    source: str
    confirmed: bool

    def __post_init__(self) -> None:
        if self.source.split(":", 1)[0] not in KINDS:
            raise ValueError(f"source = {self.source!r} must start with one of: {', '.join(KINDS)}")


@cache
def tables_of(data: str) -> dict[str, dict[str, Parameter]]:
    """All parameters of a file that lies in a package, by table and quantity.

    Parameters
    ----------
    data
        ``package:file``, the file relative to the package's folder.

    Raises
    ------
    ValueError
        An entry without a proper source.
    """
    package, _, path = data.partition(":")
    text = resources.files(package).joinpath(path).read_text(encoding="utf-8")
    return {
        table: {quantity: Parameter(**entry) for quantity, entry in entries.items()}
        for table, entries in tomllib.loads(text).items()
    }


def _file(name: str) -> dict[str, dict[str, Parameter]]:
    return tables_of(f"damage:data/{name}.toml")


def table_names(name: str) -> tuple[str, ...]:
    """The tables of ``damage/data/<name>.toml``."""
    return tuple(_file(name))


def parameters(name: str, table: str) -> dict[str, Parameter]:
    """The parameters of a table of ``damage/data/<name>.toml``, by quantity.

    Raises
    ------
    ValueError
        No such table (the message has those there are), or an entry without a proper source.
    """
    tables = _file(name)
    if table not in tables:
        raise ValueError(f"{name}.toml has no table {table!r}; it has: {', '.join(tables)}")
    return dict(tables[table])
