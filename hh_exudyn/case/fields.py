"""Basis of the tables of a case file: strictness, numbers with unit and range, paths."""

import os
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field


class CaseTable(BaseModel):
    """Frozen; no unknown keys, no numbers in quotes, no NaN or infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


def number(unit: str, low: float, high: float, default: Any = ...) -> Any:
    """Field of a number from `low` to `high` [unit]; error messages use the same texts.

    Parameters
    ----------
    unit : str
        Of the number, "-" without one.
    low, high : float
        Allowed range, ends included.
    default
        Default value; required without it.
    """
    extra: dict[str, Any] = {"unit": unit, "allowed": f"{low:g} to {high:g}"}
    return Field(default, ge=low, le=high, json_schema_extra=extra)


def is_path(name: str) -> bool:
    """Whether a name is a path: built-in names have neither folder nor suffix."""
    return "/" in name or "\\" in name or "." in name


def from_folder(table: Any, folder: Path, *keys: str) -> None:
    """Make relative paths under the keys of a raw table start at `folder`.

    Parameters
    ----------
    table : dict
        Raw table, changed.
    folder : Path
        Start of relative paths.
    keys : str
        Keys with paths.
    """
    for key in keys:
        name = table.get(key) if isinstance(table, dict) else None
        if isinstance(name, str) and name:
            table[key] = os.path.realpath(folder / name)
