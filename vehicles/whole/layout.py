"""What a vehicle file may have, read from the dataclasses themselves.

A field of `Vehicle` is a section of the file: ``bodies`` a list, ``coupler`` one table. The unit of a field
stands where it is read by people too, in brackets in the comment of its line::

    stiffness: Vector  # shear of the pad [N/m]

or in that of a name for its type, ``DamperTable = ...  # (speed [m/s], force [N])``, whose brackets are those
of its columns. Without brackets it has none ("-"), but for places, ``point``, which are in metres.
"""

import inspect
import re
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, NamedTuple, Union, get_args, get_origin, get_type_hints

from vehicles.couplings import Vector
from vehicles.description import Vehicle

NONE = "-"  # the unit of a number without one
PLACE = "m"
TYPE = "type"  # key of an entry that says its class, where a section has several
_LINE = re.compile(r"^[ ]+(\w+)\s*:[^#\n]*#[ ]*(.*)$", re.MULTILINE)
_TYPED = re.compile(r"^[ ]+(\w+)\s*:\s*([A-Za-z_]\w*)", re.MULTILINE)
_ALIAS = re.compile(r"^(\w+)\s*=[^#\n]*#[ ]*(.*)$", re.MULTILINE)
_BRACKETS = re.compile(r"\[([^\[\]]+)\]")


class Section(NamedTuple):
    """A part of a vehicle file."""

    key: str  # in the file, and the field of `Vehicle`
    kinds: tuple[type, ...]  # dataclasses of its entries; none: numbers by name
    many: bool  # a list of entries

    @property
    def tagged(self) -> bool:
        """Whether its entries say their class."""
        return len(self.kinds) > 1

    @property
    def part(self) -> str:
        """Name of a part of entries that have no name: wheel, shoe."""
        return self.key.removesuffix("s").removesuffix("set")


@cache
def sections() -> tuple[Section, ...]:
    """The sections of a vehicle file: the fields of `Vehicle` but its name."""
    found = []
    for name, kind in get_type_hints(Vehicle).items():
        inner = _without_none(kind)
        if inner is str:
            continue
        many = get_origin(inner) is tuple
        item = get_args(inner)[0] if many else inner
        options = get_args(item) if isinstance(item, UnionType) or get_origin(item) is Union else (item,)
        kinds = tuple(option for option in options if is_dataclass(option) and isinstance(option, type))
        found.append(Section(name, kinds, many))
    return tuple(found)


@cache
def hints(kind: type) -> dict[str, Any]:
    """Type of every field of a dataclass, without None."""
    return {name: _without_none(hint) for name, hint in get_type_hints(kind).items()}


@cache
def fields_of(kind: type) -> dict[str, "Field[Any]"]:
    """The fields of a dataclass that an entry may give."""
    return {one.name: one for one in fields(kind) if one.init}


def required(one: "Field[Any]") -> bool:
    """Whether a field has no default."""
    return one.default is MISSING and one.default_factory is MISSING


@cache
def unit_of(kind: type, name: str) -> str:
    """Unit of a field; those of the columns of a table joined by ``", "``."""
    for owner in kind.__mro__:
        if name in getattr(owner, "__annotations__", {}):
            for comment in (_comments(owner).get(name, ""), _alias_comment(owner, name)):
                if found := _BRACKETS.findall(comment):
                    return ", ".join(found)
    return PLACE if name.split("_")[0] == "point" else NONE


def is_place(kind: type, name: str) -> bool:
    """Whether a field is a place on the drawing or a list of them, which is each entry's own."""
    return unit_of(kind, name) == PLACE and hints(kind)[name] is not float


def is_number(hint: Any) -> bool:
    """Whether a type is a float or a table of floats, which have units and sources."""
    return hint is float or (get_origin(hint) is tuple and all(map(is_number, _items(hint))))


def is_vector(hint: Any) -> bool:
    """Whether a type is that of three components along x, y and z."""
    return bool(hint == Vector)


def _items(hint: Any) -> tuple[Any, ...]:
    return tuple(item for item in get_args(hint) if item is not Ellipsis)


@cache
def _comments(owner: type) -> dict[str, str]:
    """Comment of every field of a class, from its source."""
    return dict(_LINE.findall(inspect.getsource(owner)))


def _alias_comment(owner: type, name: str) -> str:
    """Comment of the name that stands for the type of a field, from its module; empty without one."""
    typed = dict(_TYPED.findall(inspect.getsource(owner))).get(name, "")
    module = inspect.getmodule(owner)
    return "" if module is None else dict(_ALIAS.findall(inspect.getsource(module))).get(typed, "")


def _without_none(kind: Any) -> Any:
    options = get_args(kind) if isinstance(kind, UnionType) or get_origin(kind) is Union else ()
    left = [option for option in options if option is not NoneType]
    return left[0] if len(left) == 1 else kind
