"""What a campaign's file says beside its load collective: groups of wheels, damage, limits, steps.

    [wheels]
    groups = "axle_role"
    turns_round = true

    [damage]
    law = "archard"
    material = "ER7"
    cells = [50, 50]

    [limits]
    of = "iore_wagon"    # a vehicle of damage/data/limits.toml; without it no wheel is turned
    targets = ["WP4_like"]
    cracks = "global"

    [step]
    profile_um = 10.0
    ...
    source = "assumed: ..."

The tables may be left out: then the defaults hold, which are those of `Grouping`,
`hh_exudyn.campaign.engine.case_damage.DamageSettings` and `damage.evolution.tolerance.StepTolerance`.
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from damage.evolution.tolerance import StepTolerance
from damage.life.condition import INDICES
from damage.life.decision import Inspection
from damage.life.limits import WheelLimits, limited_vehicles
from damage.life.turning import TurningRule
from damage.material import wheel_materials
from damage.wear.laws import law_names
from hh_exudyn.campaign.collective.collective import Collective
from hh_exudyn.campaign.collective.plan_file import plan_of_entries
from hh_exudyn.campaign.collective.sourced_table import SourcedTable
from hh_exudyn.campaign.engine.case_damage import DamageSettings
from hh_exudyn.campaign.life.groups import GROUPINGS, Grouping
from hh_exudyn.contact.profile import WHEEL_PROFILES, wheel_profile
from hh_exudyn.sourced import Parameter
from hh_exudyn.text_files import parsed_toml, read_toml

OWN_TABLES = ("wheels", "damage", "limits", "step")
"""Tables of a campaign beside those of its load collective."""


@dataclass(frozen=True)
class Workshop:
    """When wheels are turned, and to what.

    Attributes
    ----------
    limits
        Of the wheels.
    inspection
        Which cracks decide.
    rule
        What a turning removes.
    """

    limits: WheelLimits
    inspection: Inspection
    rule: TurningRule


@dataclass(frozen=True)
class CampaignPlan:
    """A campaign: what is met, by which wheels, how damage is computed, and how large a step may be.

    Attributes
    ----------
    collective
        The load collective.
    grouping
        Of wheels with a profile of their own.
    damage
        Law, steel, cells.
    step
        Tolerances.
    replicates
        Random samples of the collective in every evaluation of a step (the same ones in all of them) [-]; the
        collective itself has more, for its error.
    unmoved
        Largest distance along the normal by which a profile may have moved within the contact of a case that
        is not run again [m].
    failing_weight
        Share of the collective that may fail [-].
    workshop
        Limits and turning; None: no wheel is turned.
    numbers
        Of these tables, with their sources.
    """

    collective: Collective
    grouping: Grouping = field(default_factory=Grouping)
    damage: DamageSettings = field(default_factory=DamageSettings)
    step: StepTolerance = field(default_factory=StepTolerance)
    replicates: int = 1
    unmoved: float = 1e-6
    failing_weight: float = 0.02
    workshop: Workshop | None = None
    numbers: tuple[Parameter, ...] = ()

    @property
    def of_steps(self) -> Collective:
        """The collective with the replicates that every evaluation of a step runs."""
        return Collective(replace(self.collective.plan, replicates=self.replicates))


def read_campaign(path: str | Path) -> CampaignPlan:
    """A campaign's file: a load collective (`hh_exudyn.campaign.collective.plan_file`) and the tables above.

    Raises
    ------
    ValueError
        One line with file, key, value, unit and what is allowed.
    """
    path = Path(path)
    return _campaign(read_toml(path), str(path), path.parent)


def campaign_of_text(text: str, source: str, folder: Path) -> CampaignPlan:
    """As `read_campaign`, from the text of a file.

    Parameters
    ----------
    text
        TOML.
    source
        Name of the file in messages.
    folder
        Start of relative paths.
    """
    return _campaign(parsed_toml(text, source), source, folder)


def _campaign(entries: dict[str, Any], source: str, folder: Path) -> CampaignPlan:
    """A campaign from the tables of its file."""
    own = SourcedTable({name: entries[name] for name in OWN_TABLES if name in entries}, source)
    rest = {name: value for name, value in entries.items() if name not in OWN_TABLES}
    collective = Collective(plan_of_entries(rest, source, folder))
    grouping, damage, step = Grouping(), DamageSettings(), {}
    if "wheels" in own:
        grouping = _grouping(own.table("wheels"))
    if "damage" in own:
        damage = _damage(own.table("damage"))
    if "step" in own:
        step = _step(own.table("step"))
    workshop = _workshop(own.table("limits")) if "limits" in own else None
    return CampaignPlan(collective, grouping, damage, **step, workshop=workshop, numbers=tuple(own.found))


def _grouping(table: SourcedTable) -> Grouping:
    kind = table.text("groups", GROUPINGS) if "groups" in table else Grouping().kind
    turns = table.truth("turns_round") if "turns_round" in table else True
    table.close()
    return Grouping(kind, turns)


def _damage(table: SourcedTable) -> DamageSettings:
    values: dict[str, Any] = {}
    if "law" in table:
        values["law"] = table.text("law", law_names())
    if "material" in table:
        values["material"] = table.text("material", wheel_materials())
    for name in ("normal", "theory"):
        if name in table:
            values[name] = table.text(name)
    if "cells" in table:
        along, across = table.wholes("cells", "-", 4, 400)
        values["cells"] = (along, across)
    table.close()
    return DamageSettings(**values)


def _workshop(table: SourcedTable) -> Workshop:
    limits = WheelLimits.of(table.text("of", limited_vehicles()))
    index = table.text("cracks", INDICES) if "cracks" in table else INDICES[0]
    names = table.names("targets", WHEEL_PROFILES)
    table.close()
    if not names:
        raise table.error(f"{table.key('targets')} is missing: allowed a list of wheel profiles")
    rule = TurningRule([wheel_profile(name) for name in names], index)
    return Workshop(limits, Inspection(index), rule)


def _step(table: SourcedTable) -> dict[str, Any]:
    table.begin()
    usual = StepTolerance()
    found = StepTolerance(
        profile=1e-6 * _or(table, "profile_um", "um", 0.1, 1000.0, 1e6 * usual.profile),
        pressure=1e-2 * _or(table, "pressure_percent", "%", 0.1, 1000.0, 1e2 * usual.pressure),
        conicity=_or(table, "conicity", "-", 1e-4, 1.0, usual.conicity),
        max_distance=1e3 * _or(table, "longest_km", "km", 1e-3, 1e6, 1e-3 * usual.max_distance),
        filter_length=1e-3 * _or(table, "filter_mm", "mm", 0.1, 10.0, 1e3 * usual.filter_length),
    )
    values = {
        "step": found,
        "replicates": table.whole("replicates", "-", 1, 1000) if "replicates" in table else 1,
        "unmoved": 1e-6 * _or(table, "unmoved_um", "um", 0.0, 100.0, 1.0),
        "failing_weight": 1e-2 * _or(table, "failing_percent", "%", 0.0, 100.0, 2.0),
    }
    table.close()
    return values


def _or(table: SourcedTable, name: str, unit: str, low: float, high: float, usual: float) -> float:
    """A number of the table, or the usual one."""
    return table.number(name, unit, low, high) if name in table else usual
