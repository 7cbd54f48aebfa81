"""Lives of the wheels: turnings so far, and when they are due next by the rates of the last evaluation."""

import pyarrow

from damage.life.forecast import life_from_rates
from damage.material import wheel_material
from damage.wear.archard import DRY
from hh_exudyn.campaign.life.plan import Workshop
from hh_exudyn.campaign.results.recorded import Recorded

_NUMBERS = ("now_km", "since_turning_km", "due_km", "due_since_turning_km")
_TEXTS = ("measure", "cause", "note")
_COLUMNS = ("group", *_NUMBERS, *_TEXTS)
_SCHEMA = pyarrow.schema(
    [(name, pyarrow.float64() if name in _NUMBERS else pyarrow.string()) for name in _COLUMNS]
)


def turnings_table(recorded: Recorded) -> pyarrow.Table | None:
    """Turnings so far, as `damage.life.life_table.life_table` with the distance at which they were due.

    None where no wheel was turned.
    """
    rows = [row for end in recorded.ends for row in end.turned]
    return pyarrow.Table.from_pylist(rows) if rows else None


def forecast_table(recorded: Recorded) -> pyarrow.Table | None:
    """When the wheels of each group are due next, if they go on with the rates of the last evaluation.

    An extrapolation: worn profiles have other rates. Columns: the group; its distance now, since its turning;
    the distance at which the first limit is reached, with its measure and cause, missing where none is; a
    note where nothing is extrapolated: rates under seizure are those of running-in, and end with it. None
    where the campaign has no limits.
    """
    workshop = recorded.campaign.plan.workshop
    if workshop is None:
        return None
    material = wheel_material(recorded.campaign.plan.damage.material)
    seizure = DRY.seizure_ratio * material.require("hardness", "a forecast of lives")
    rows = []
    for group in recorded.groups:
        now = recorded.going_on(group)
        row: dict[str, object] = dict.fromkeys(_COLUMNS) | {
            "group": group,
            "now_km": 1e-3 * now.step.distance,
            "since_turning_km": 1e-3 * now.since_turning,
        }
        if recorded.pressure(group) > seizure:
            row["note"] = "running-in: not to be extrapolated"
        else:
            row |= _due(recorded, group, workshop)
        rows.append(row)
    return pyarrow.Table.from_pylist(rows, schema=_SCHEMA)


def _due(recorded: Recorded, group: str, workshop: Workshop) -> dict[str, object]:
    """When the wheels of a group are due, or why that cannot be forecast."""
    now, places = recorded.going_on(group), recorded.places(group)
    try:
        forecast = life_from_rates(
            now, recorded.life_rates(group), workshop.limits, places, workshop.inspection
        )
    except ValueError as error:  # so much wear leaves no valid profile
        return {"note": f"none: {error}"}
    if not forecast.crossings:
        return {"note": "no limit is reached"}
    first = forecast.crossings[0]
    return {
        "due_km": 1e-3 * first.distance,
        "due_since_turning_km": 1e-3 * (first.distance - now.turned_at),
        "measure": first.reason.measure,
        "cause": first.reason.cause,
    }
