"""Records of other packages, found through their entry points.

A package with a vehicle has in its ``pyproject.toml``::

    [project.entry-points."hh_exudyn.vehicles"]
    my_wagon = "my_package.wagon:RECORD"
"""

from importlib.metadata import EntryPoint, entry_points
from typing import TypeVar

_Record = TypeVar("_Record")


def entries_of(group: str) -> dict[str, EntryPoint]:
    """The entry points of a group by name, none imported; of two with one name the first found."""
    found: dict[str, EntryPoint] = {}
    for entry in entry_points(group=group):
        found.setdefault(entry.name, entry)
    return found


def loaded(entry: EntryPoint, kind: type[_Record]) -> _Record:
    """The record that an entry point names.

    Parameters
    ----------
    entry : EntryPoint
        From `entries_of`.
    kind : type
        The class of the group's records.

    Raises
    ------
    ValueError
        One line that names entry point and package: it cannot be imported, or is something else.
    """
    package = entry.dist.name if entry.dist is not None else "unknown package"
    place = f"entry point {entry.group}: {entry.name} = {entry.value} of {package}"
    try:
        record = entry.load()
    except Exception as error:
        reason = " ".join(str(error).split())
        raise ValueError(f"{place} cannot be imported: {type(error).__name__}: {reason}") from error
    if not isinstance(record, kind):
        raise ValueError(f"{place} is a {type(record).__name__}, allowed is a {kind.__name__}")
    return record
