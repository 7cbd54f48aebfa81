"""What went into a campaign: every number with unit, range and source, limits of the wheels, settings."""

from collections.abc import Sequence

import pyarrow

from damage.life.limits import WheelLimits, limited_vehicles
from damage.material import material_parameters
from damage.parameters import parameters
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.sourced import Parameter

_CRACK_LIMITS = ("largest_depth", "largest_length", "length_over_depth", "failure_depth")
_SCHEMA = pyarrow.schema(
    [
        ("number", pyarrow.string()),
        ("value", pyarrow.float64()),
        ("unit", pyarrow.string()),
        ("least", pyarrow.float64()),
        ("largest", pyarrow.float64()),
        ("kind", pyarrow.string()),
        ("source", pyarrow.string()),
    ]
)


def assumed_table(campaign: Campaign) -> pyarrow.Table:
    """Assumed numbers of the file, of its line and of the steel, with ranges where there are some."""
    own = [number for number in _own(campaign) if number.kind == "assumed"]
    return numbers_table([*campaign.plan.collective.assumed(), *own])


def known_table(campaign: Campaign) -> pyarrow.Table:
    """Published and derived numbers of the file and of the steel."""
    numbers = [*campaign.plan.collective.plan.numbers, *_own(campaign)]
    return numbers_table([number for number in numbers if number.kind != "assumed"])


def numbers_table(numbers: Sequence[Parameter]) -> pyarrow.Table:
    """A row for each number: name, value, unit, range, kind and source.

    Parameters
    ----------
    numbers
        With their sources.
    """
    rows = []
    for number in numbers:
        low, high = number.range or (None, None)
        text = number.source.partition(":")[2].strip()
        if not number.confirmed and "from memory" not in text:
            text += " (from memory or at second hand)"
        values = (number.name, number.value, number.unit, low, high, number.kind, text)
        rows.append(dict(zip(_SCHEMA.names, values, strict=True)))
    return pyarrow.Table.from_pylist(rows, schema=_SCHEMA)


def limits_table(campaign: Campaign) -> pyarrow.Table | None:
    """Limits at which wheels are turned, with their sources; None where no wheel is turned."""
    workshop = campaign.plan.workshop
    if workshop is None:
        return None
    vehicle = next(name for name in limited_vehicles() if WheelLimits.of(name) == workshop.limits)
    cracks = [number for name, number in parameters("limits", "cracks").items() if name in _CRACK_LIMITS]
    own = [*parameters("limits", vehicle).values(), *parameters("limits", "profile").values()]
    return numbers_table([*own, *cracks])


def settings(campaign: Campaign) -> tuple[tuple[str, str], ...]:
    """What the file names: line, vehicles, groups of wheels, damage, steps; heading and text."""
    plan = campaign.plan
    collective, damage, step = plan.collective.plan, plan.damage, plan.step
    vehicles = ", ".join(f"{one.name}: {one.vehicle} ({1e2 * one.share:.3g} %)" for one in collective.running)
    cracks = "no limits: no wheel is turned"
    if plan.workshop is not None:
        cracks = f"cracks by the {plan.workshop.inspection.index} index decide"
    return (
        ("line", collective.line),
        ("vehicles", vehicles),
        ("distance", f"{1e-3 * collective.distance:.0f} km"),
        ("wheels", f"groups by {plan.grouping.kind}: {', '.join(campaign.groups)}"),
        ("evaluation", plan.of_steps.evaluation),
        ("wear", f"{damage.law}, {damage.material}, {damage.cells[0]} x {damage.cells[1]} cells a patch"),
        ("turning", cracks),
        (
            "steps",
            f"by their error: profile {1e6 * step.profile:.3g} µm, pressure {1e2 * step.pressure:.3g} %, "
            f"conicity {step.conicity:.3g}, at most {1e-3 * step.max_distance:.4g} km",
        ),
    )


def _own(campaign: Campaign) -> list[Parameter]:
    """Numbers beside the load collective."""
    return [*campaign.plan.numbers, *material_parameters(campaign.plan.damage.material).values()]
