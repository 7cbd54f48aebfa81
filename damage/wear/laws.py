"""The wear laws, one record each: `wear_law("archard", surface="lubricated")` makes one by name.

A record names the function that makes the law, the file with its numbers, and its needs; the command
line, the tests and `wear_law` derive from the records. To add a law: its file with kernel and maker, its
numbers in ``damage/data/wear.toml``, a record in `LAW_RECORDS`, a test.

Laws of other packages come through the entry points of the group ``hh_exudyn.wear_laws``. In the
``pyproject.toml`` of such a package

    [project.entry-points."hh_exudyn.wear_laws"]
    my_law = "my_package.my_module:RECORD"

names a `LawRecord` called ``my_law``. A law's module is imported when the law is made, so that lists of names
and help texts are fast.
"""

from dataclasses import dataclass
from importlib import metadata
from inspect import signature
from pkgutil import resolve_name
from typing import TYPE_CHECKING, Any

from damage.parameters import tables_of
from hh_exudyn.sourced import Parameter

if TYPE_CHECKING:
    from damage.wear.law import WearLaw

GROUP = "hh_exudyn.wear_laws"


@dataclass(frozen=True)
class LawRecord:
    """The record of a wear law.

    Help texts and checks need the record only; the module of the law is imported when the law is made.

    Attributes
    ----------
    name
        Its name in commands and calls.
    maker
        ``package.module:function`` of the function that makes the `damage.wear.law.WearLaw`; the arguments of
        the function are the options of the law.
    summary
        The worn volume per metre rolled, in a line.
    data
        ``package:file`` of the numbers with their sources, as `damage.parameters` reads them; empty where the
        user gives all numbers.
    tables
        Tables of that file with the law's numbers.
    needs_field
        Whether the law needs pressure, traction and slip cell by cell; otherwise the dissipated energies of
        the strips suffice.
    needs_options
        Whether it has options without a default, so that the name alone is not enough.
    """

    name: str
    maker: str
    summary: str
    data: str = ""
    tables: tuple[str, ...] = ()
    needs_field: bool = False
    needs_options: bool = False


_DATA = "damage:data/wear.toml"
LAW_RECORDS = (
    LawRecord(
        "archard",
        "damage.wear.archard:archard",
        "k/H times pressure times slip, summed over the cells; the only law with lubricated surfaces",
        _DATA,
        ("jendel", "surface"),
        needs_field=True,
    ),
    LawRecord(
        "british_rail",
        "damage.wear.british_rail:british_rail",
        "piecewise linear in the wear number; strips by their energy",
        _DATA,
        ("british_rail",),
    ),
    LawRecord(
        "usfd",
        "damage.wear.usfd:usfd",
        "piecewise linear in wear number over area; evenly over the patch",
        _DATA,
        ("usfd",),
    ),
    LawRecord(
        "ward",
        "damage.wear.usfd:ward",
        "the law of usfd in every cell, of the cell's own energy",
        _DATA,
        ("usfd",),
        needs_field=True,
    ),
    LawRecord(
        "krause_poll",
        "damage.wear.krause_poll:krause_poll",
        "coefficient times energy, by power density; strips by their energy",
        needs_options=True,
    ),
)
"""The laws of this package. Lubrication changes the friction coefficient for all of them; Archard's alone has
wear coefficients for lubricated and greased surfaces besides."""

_OWN = {record.name: record for record in LAW_RECORDS}


def law_names() -> tuple[str, ...]:
    """Names of all wear laws, those of installed packages last, without importing them."""
    return (*_OWN, *(point.name for point in metadata.entry_points(group=GROUP) if point.name not in _OWN))


def names_for_help() -> str:
    """The laws without required options, for the help of a command: ``archard, british_rail, ...``."""
    return ", ".join(name for name in law_names() if name not in _OWN or not _OWN[name].needs_options)


def law_record(name: str) -> LawRecord:
    """The record of a law.

    Raises
    ------
    ValueError
        Unknown law, an entry point that has the name of one of this package's laws or of another package's,
        that cannot be imported, or that is no record of its name.
    """
    points = tuple(metadata.entry_points(group=GROUP, name=name))
    if name in _OWN and not points:
        return _OWN[name]
    if not points:
        raise ValueError(f"wear law = {name!r}; known: {', '.join(law_names())}")
    if len(points) > 1 or name in _OWN:
        owners = [*(["damage"] if name in _OWN else []), *(point.value for point in points)]
        raise ValueError(f"wear law {name!r} is defined more than once: {', '.join(owners)}")
    point = points[0]
    where = f"entry point {name} = {point.value} of the group {GROUP}"
    try:
        record = point.load()
    except (ImportError, AttributeError) as error:
        raise ValueError(f"{where} cannot be imported: {error}") from error
    if not isinstance(record, LawRecord) or record.name != name:
        raise ValueError(f"{where} must be a LawRecord with the name {name!r}, not {record!r}")
    return record


def law_parameters(name: str) -> dict[str, dict[str, Parameter]]:
    """The numbers of a law with their sources, by table and quantity; empty where the user gives all of them.

    Raises
    ------
    ValueError
        As `law_record`, or a table that the law's file does not have.
    """
    record = law_record(name)
    if not record.data:
        return {}
    tables = tables_of(record.data)
    if missing := [table for table in record.tables if table not in tables]:
        raise ValueError(f"{record.data} has no table {missing[0]!r}; it has: {', '.join(tables)}")
    return {table: tables[table] for table in record.tables}


def wear_law(name: str, **options: Any) -> "WearLaw":
    """A wear law by name; its options are the arguments of the function that makes it.

    Parameters
    ----------
    name
        One of `law_names`.
    options
        Of the law, see the function that its record names.

    Raises
    ------
    ValueError
        Unknown law, an option that the law does not have, one that it needs and is not given, or a value out
        of its range.
    """
    maker = resolve_name(law_record(name).maker)
    known = signature(maker).parameters
    if unknown := sorted(set(options) - set(known)):
        raise ValueError(f"wear law {name!r} has no option {unknown[0]!r}; it has {', '.join(known)}")
    missing = [key for key, option in known.items() if option.default is option.empty and key not in options]
    if missing:
        raise ValueError(f"wear law {name!r} needs {' and '.join(missing)}: there are no published defaults")
    law: WearLaw = maker(**options)
    return law
