"""Variants of a case by a matrix: every combination of some values of some inputs."""

import re
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import PurePath
from typing import Any

from hh_exudyn.case.case import Case
from hh_exudyn.case.errors import CaseError
from hh_exudyn.case.fields import is_path
from hh_exudyn.case.overrides import overridden

MOST = 10_000  # cases of a matrix
_UNFIT = re.compile(r"[^\w.,=+\- ]+")  # for the name of a folder


def matrix(case: Case, values: Mapping[str, Sequence[Any]]) -> dict[str, Case]:
    """The cases of a matrix by their names, ``wedge.friction=0.2,speed_km_h=40``.

    Parameters
    ----------
    case : Case
        What they have in common.
    values : mapping
        Values by key (`hh_exudyn.case.overrides`); the last key varies fastest.

    Raises
    ------
    CaseError
        A case is not allowed, two have one name, or there are too many.
    """
    count = 1
    for each in values.values():
        count *= len(each)
    if count > MOST:
        raise CaseError(f"{count} variants: allowed up to {MOST}")
    found: dict[str, Case] = {}
    for chosen in product(*values.values()):
        changes = dict(zip(values, chosen, strict=True))
        name = variant_name(changes)
        if name in found:
            raise CaseError(f"two variants are named {name}: allowed values that differ, files of one name")
        varied = overridden(case, changes)
        found[name] = varied.with_changes(name=f"{case.name}, {name}")
    return found


def variant_name(changes: Mapping[str, Any]) -> str:
    """Name of a variant, fit for a folder: keys with values, files by their names.

    Parameters
    ----------
    changes : mapping
        Values by key.
    """
    return ",".join(f"{_fit(key)}={_fit(_shown(value))}" for key, value in changes.items())


def _shown(value: Any) -> str:
    if isinstance(value, str) and is_path(value):
        return PurePath(value).stem
    return f"{value:g}" if isinstance(value, float) else str(value)


def _fit(text: str) -> str:
    return _UNFIT.sub("-", text).strip(" -")
