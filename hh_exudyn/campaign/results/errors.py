"""Errors of the rates of the wheels, where they were evaluated (`hh_exudyn.campaign.life.errors`)."""

import json
from typing import Any

import pyarrow

from hh_exudyn.campaign.life.errors import FILE
from hh_exudyn.campaign.results.recorded import Recorded

_SHOWN = {"m/m]": (1e12, "µm per 1000 km"), "1/m]": (1e6, "per 1000 km")}


def errors_table(recorded: Recorded) -> pyarrow.Table | None:
    """Rates with their errors, a row for each group and quantity; None where none were evaluated.

    Columns: the rate in its unit; `sampling_percent`, half the width of its 95 % interval from sampling;
    `steps_of_<axis>_percent`, what halving the steps of an axis changed. Errors of wear are relative to the
    deepest place of the group, those of cracks to themselves: these are errors of ln(life).

    Raises ValueError for a file that is not one of errors.
    """
    content = errors_of(recorded)
    if content is None:
        return None
    rows = []
    for number, name in enumerate(content["quantities"]):
        group, _, quantity = name.partition(": ")
        quantity, _, unit = quantity.partition(" [")
        factor, shown = _SHOWN[unit]
        row = {
            "group": group,
            "quantity": quantity,
            "rate": factor * content["total"][number],
            "unit": shown,
            "sampling_percent": 1e2 * content["sampling"][number],
        }
        steps = {
            f"steps_of_{axis}_percent": 1e2 * errors[number]
            for axis, errors in content["discretisation"].items()
        }
        rows.append(row | steps)
    return pyarrow.Table.from_pylist(rows)


def errors_of(recorded: Recorded) -> dict[str, Any] | None:
    """What the file of errors holds; None where there is none. Raises ValueError for a broken one."""
    path = recorded.campaign.directory / FILE
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        lists = [found["total"], found["sampling"], *found["discretisation"].values()]
        if any(len(one) != len(found["quantities"]) for one in lists):
            raise ValueError("lists of different lengths")
    except FileNotFoundError:
        return None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"{path}: holds no errors of a campaign ({error}); evaluate them again") from None
    return found
