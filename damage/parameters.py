"""The numbers of damage, of ``damage/data`` and of other packages, read by `hh_exudyn.sourced`."""

import tomllib
from functools import cache
from importlib import resources
from pathlib import PurePosixPath

from hh_exudyn.sourced import Parameter, load_parameters, read_parameters


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
    found = read_parameters(tomllib.loads(text), PurePosixPath(path).stem, PurePosixPath(path).name)
    return {name: {item.name: item for item in found.table(name).parameters} for name in found.tables}


def table_names(name: str) -> tuple[str, ...]:
    """The tables of ``damage/data/<name>.toml``."""
    return load_parameters("damage", name).tables


def parameters(name: str, table: str) -> dict[str, Parameter]:
    """The parameters of a table of ``damage/data/<name>.toml``, by quantity.

    Raises
    ------
    ValueError
        No such table (lists the known ones), or an entry without a proper source.
    """
    return {item.name: item for item in load_parameters("damage", name).table(table).parameters}
