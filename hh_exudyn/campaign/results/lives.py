"""Lives of the wheels: turnings so far, and when they are due next by the rates of the last evaluation."""

import pyarrow

from damage.life.forecast import life_from_rates
from hh_exudyn.campaign.results.recorded import Recorded


def turnings_table(recorded: Recorded) -> pyarrow.Table | None:
    """Turnings so far, as `damage.life.life_table.life_table` with the distance at which they were due.

    None where no wheel was turned.
    """
    rows = [row for end in recorded.ends for row in end.turned]
    return pyarrow.Table.from_pylist(rows) if rows else None


def forecast_table(recorded: Recorded) -> pyarrow.Table | None:
    """When the wheels of each group are due next, if they go on with the rates of the last evaluation.

    An extrapolation: worn profiles have other rates. Columns: the group; its distance now, since its turning;
    the distance at which the first limit is reached, with its measure and cause, missing where none is. None
    where the campaign has no limits.
    """
    workshop = recorded.campaign.plan.workshop
    if workshop is None:
        return None
    names = ("group", "now_km", "since_turning_km", "due_km", "due_since_turning_km", "measure", "cause")
    rows = []
    for group in recorded.groups:
        now, places = recorded.going_on(group), recorded.places(group)
        forecast = life_from_rates(
            now, recorded.life_rates(group), workshop.limits, places, workshop.inspection
        )
        km = [1e-3 * value for value in (now.step.distance, now.since_turning)]
        if forecast.crossings:
            first = forecast.crossings[0]
            due = [1e-3 * first.distance, 1e-3 * (first.distance - now.turned_at)]
            values = (group, *km, *due, first.reason.measure, first.reason.cause)
        else:
            values = (group, *km, None, None, None, None)
        rows.append(dict(zip(names, values, strict=True)))
    return pyarrow.Table.from_pylist(rows)
