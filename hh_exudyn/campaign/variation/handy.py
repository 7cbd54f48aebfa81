"""Names for what is varied most, each a change of some keys of a campaign's file.

================  ===================================================================================
``axle_load``     [t] mean axle load of every loaded vehicle that has a payload (`vehicles.axle_load`)
``gauge``         [mm] mean gauge of the line over its length: ``gauge.shift_mm`` moves it, so that the
                  widening in tight curves and the spread stay as they are
``lubrication``   [%] share of the distance in the seasons with a treatment or lubricated wheelsets,
                  whose proportions are kept
``material``      ``damage.material``, the steel of the wheels
================  ===================================================================================
"""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from hh_exudyn.campaign.collective.groups import groups_of
from hh_exudyn.campaign.collective.plan import Plan
from hh_exudyn.campaign.collective.plan_file import VARIED, plan_of_entries
from hh_exudyn.campaign.life.plan import OWN_TABLES
from hh_exudyn.campaign.variation.shares import SHARE
from track.line.line import read_line
from vehicles.axle_load import carries_payload, with_axle_load
from vehicles.variants import Variant, find_variant, variant_of_table

Tables = Mapping[str, Any]


def vehicle_of(running: Tables) -> Variant:
    """The vehicle of a running, a name, a file or a table; ValueError for one that is not known.

    Parameters
    ----------
    running
        Its table in the file.
    """
    given = running["vehicle"]
    return variant_of_table(given, VARIED) if isinstance(given, dict) else find_variant(str(given))


def mean_gauge(plan: Plan) -> float:
    """Mean gauge of a plan's line over its length, without the plan's shift [m]."""
    groups = groups_of(plan, read_line(plan.line), plan.running[0])
    return math.fsum(
        group.share * share * geometry.gauge for group in groups for geometry, share in group.geometries
    )


def _axle_load(entries: Tables, value: Any) -> dict[str, Any]:
    """Another table of every loaded vehicle."""
    tonnes = _number("axle_load", value, 1.0, 60.0, "t")
    found = {}
    for index, running in enumerate(entries["running"]):
        variant = vehicle_of(running)
        if carries_payload(variant):
            found[f"running[{index}].vehicle"] = with_axle_load(variant, 1e3 * tonnes).to_table()
    if not found:
        names = ", ".join(str(running.get("name")) for running in entries["running"])
        raise ValueError(f"axle_load: no vehicle of the runnings {names} has a payload")
    return found


def _gauge(entries: Tables, value: Any) -> dict[str, Any]:
    """A shift of the gauge, to the wanted mean."""
    wanted = _number("gauge", value, 1400.0, 1500.0, "mm")
    collective = {name: table for name, table in entries.items() if name not in OWN_TABLES}
    plan = plan_of_entries(collective, str(entries.get("name")), Path())
    return {"gauge.shift_mm": round(wanted - 1e3 * mean_gauge(plan), 6)}


def _lubrication(entries: Tables, value: Any) -> dict[str, Any]:
    """Shares of the lubricated seasons."""
    wanted = _number("lubrication", value, 0.0, 100.0, "%")
    seasons = entries["season"]
    treated = [i for i, one in enumerate(seasons) if one.get("treatments") or one.get("lubricated_wheelsets")]
    if not treated:
        raise ValueError("lubrication: no season has treatments or lubricated_wheelsets: allowed with one")
    before = math.fsum(float(seasons[i][SHARE]) for i in treated)
    parts = {i: seasons[i][SHARE] / before if before else 1.0 / len(treated) for i in treated}
    return {f"season[{i}].{SHARE}": wanted * part for i, part in parts.items()}


def _material(_: Tables, value: Any) -> dict[str, Any]:
    return {"damage.material": value}


HANDY: dict[str, Callable[[Tables, Any], dict[str, Any]]] = {
    "axle_load": _axle_load,
    "gauge": _gauge,
    "lubrication": _lubrication,
    "material": _material,
}
"""By name, the changes that a value means for the tables of a file; ValueError for one not allowed."""


def _number(name: str, value: Any, low: float, high: float, unit: str) -> float:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not (is_number and low <= value <= high):
        raise ValueError(f"{name} = {value!r} {unit}: allowed {low:g} to {high:g} {unit}")
    return float(value)
