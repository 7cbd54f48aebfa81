"""Changes of a case on the command line: ``--vehicle``, ``--set KEY=VALUE``, ``--vary KEY=VALUE,VALUE``.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from hh_exudyn.cli.inputs import BadInput

if TYPE_CHECKING:
    from hh_exudyn.case import Case

OtherVehicle = Annotated[
    str | None,
    typer.Option("--vehicle", metavar="NAME|FILE", help="Another vehicle: a name or a vehicle file."),
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change an input: a key of the case (speed_km_h, track.rail) or a number of its vehicle "
        "(wedge.friction). Several times.",
    ),
]
Variations = Annotated[
    list[str] | None,
    typer.Option(metavar="KEY=VALUE,VALUE,...", help="Run all combinations of the values. Several times."),
]


def changed_case(path: Path, vehicle: str | None, settings: list[str] | None) -> "Case":
    """The case in a file with the changes of the options.

    Parameters
    ----------
    path
        Of the case.
    vehicle, settings
        Of the options; None where they are not given.

    Raises
    ------
    BadInput, CaseError
        A setting without a key, a key twice or unknown, a value that is not allowed.
    """
    from hh_exudyn.case import read_case
    from hh_exudyn.case.overrides import overridden, value_of_text

    changes: dict[str, Any] = {} if vehicle is None else {"vehicle": vehicle}
    for text in settings or ():
        key, value = _split("--set", text, changes)
        changes[key] = value_of_text(key, value)
    case = read_case(path)
    return overridden(case, changes) if changes else case


def varied_cases(case: "Case", variations: list[str]) -> "dict[str, Case]":
    """The cases of a matrix by name.

    Parameters
    ----------
    case
        What they have in common.
    variations
        Of the option.

    Raises
    ------
    BadInput, CaseError
        As `changed_case`.
    """
    from hh_exudyn.case.matrix import matrix

    return matrix(case, varied_values(variations))


def varied_values(variations: list[str], of_case: str = "") -> dict[str, list[Any]]:
    """The values of every key.

    Parameters
    ----------
    variations
        Of the option.
    of_case
        What stands before the keys of a case.

    Raises
    ------
    BadInput
        As `changed_case`.
    """
    from hh_exudyn.case.overrides import value_of_text

    values: dict[str, list[Any]] = {}
    for text in variations:
        key, value = _split("--vary", text, values)
        values[key] = [value_of_text(key.removeprefix(of_case), item) for item in _items(value)]
    return values


def _split(option: str, text: str, known: dict[str, Any]) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    key = key.strip()
    if not (key and equals and value.strip()):
        raise BadInput(f"{option} {text}: allowed KEY=VALUE")
    if key in known:
        raise BadInput(f"{option} {text}: {key} is given twice")
    return key, value


def _items(text: str) -> list[str]:
    """Parts of a text between its commas, but for those in brackets."""
    found, depth = [""], 0
    for letter in text:
        depth += {"[": 1, "]": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            found.append("")
        else:
            found[-1] += letter
    if not all(item.strip() for item in found):
        raise BadInput(f"--vary {text}: a value is empty")
    return found
