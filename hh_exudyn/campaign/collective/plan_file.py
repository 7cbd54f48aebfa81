"""Reads the file of a load collective to a `Plan`; `template` has its tables and keys with comments."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol, TypeVar

from hh_exudyn.campaign.collective.plan import (
    DESIGNS,
    HALVED,
    HANDS,
    SAMPLED,
    GaugeSpread,
    Haul,
    Plan,
    QualityRule,
    Running,
    TrackLengths,
)
from hh_exudyn.campaign.collective.seasons import read_season
from hh_exudyn.campaign.collective.sourced_table import SourcedTable
from hh_exudyn.case.files import start_at
from hh_exudyn.case.vehicle import start_in
from hh_exudyn.text_files import parsed_toml, read_toml
from track.irregularity.spectra import spectrum_names
from track.rails import NEW
from vehicles.variants import Variant, find_variant, variant_of_table

_SUM = 1e-6  # of shares in per cent, from 100
VARIED = "campaign"  # source of the numbers of a vehicle in the file that say none
_OWN_KEYS = {"name", "vehicle", "speed_km_h", "friction", "traction", "train", "brake", "start_m"}
_OWN_TRACK = {
    "sections", "alignment", "centre_line", "grades", "inclination", "irregularity", "irregularity_seed",
    "irregularity_scale", "irregularity_mirrored", "rail", "rail_left", "rail_right",
}  # fmt: skip


class _Shared(Protocol):
    @property
    def name(self) -> str: ...
    @property
    def share(self) -> float: ...


_Item = TypeVar("_Item", bound=_Shared)


def read_plan(path: str | Path) -> Plan:
    """A load collective's file.

    Raises
    ------
    ValueError
        One line: not a file or not TOML; a key that is missing, unknown or out of range (with file, key,
        value, unit, allowed); shares that do not sum to 100 %; names used twice; a table without source.
    """
    path = Path(path)
    return plan_of_entries(read_toml(path), str(path), path.parent)


def plan_of_text(text: str, source: str = "campaign", folder: Path | None = None) -> Plan:
    """As `read_plan`, from the text of a file.

    Parameters
    ----------
    text : str
        TOML.
    source : str
        Name of the file in messages.
    folder : Path or None
        Start of relative paths; None: the working directory.
    """
    return plan_of_entries(parsed_toml(text, source), source, folder or Path())


def plan_of_entries(entries: dict[str, Any], source: str, folder: Path) -> Plan:
    """As `read_plan`, from the tables of a file.

    Parameters
    ----------
    entries : dict
        As tomllib gives them.
    source, folder
        As `plan_of_text`.
    """
    return _plan(SourcedTable(entries, source), folder)


def _plan(file: SourcedTable, folder: Path) -> Plan:
    """The plan of a whole file."""
    distance = _begun(file, "distance")
    design = _begun(file, "design")
    found = Plan(
        name=file.text("name"),
        line=_line(file, folder),
        distance=1e3 * distance.number("km", "km", 1.0, 1e7),
        design=design.text("kind", DESIGNS),
        hands=design.text("hands", HANDS),
        replicates=design.whole("replicates", "-", 1, 1000),
        base=_base(file, folder),
        merged_classes=design.groups("merged_classes"),
        running=_whole(
            [_running(table, folder) for table in file.sourced_tables("running")], file, "running"
        ),
        lengths=_lengths(_begun(file, "lengths")),
        gauge=_gauge(_begun(file, "gauge")),
        quality=_quality(_begun(file, "quality")),
        seasons=_whole([_closed(t, read_season) for t in file.sourced_tables("season")], file, "season"),
        rail_wear=_rail_wear(_begun(file, "rail_wear")),
        numbers=(),
        halvings=_halvings(design),
        runs=_runs(design),
    )  # fmt: skip
    for table in (distance, design, file):
        table.close()
    return replace(found, numbers=tuple(file.found))


def _begun(file: SourcedTable, name: str) -> SourcedTable:
    """A table of the file, with its source read."""
    table = file.table(name)
    table.begin()
    return table


def _closed(table: SourcedTable, read: Callable[[SourcedTable], _Item]) -> _Item:
    """What is read of a table, which then has no other key."""
    found = read(table)
    table.close()
    return found


def _whole(items: list[_Item], file: SourcedTable, place: str) -> tuple[_Item, ...]:
    """Items of names that differ and shares that sum to 1, given in per cent."""
    total = math.fsum(item.share for item in items)
    if abs(total - 100.0) > _SUM:
        raise file.error(f"{place}: share_percent sums to {total:g} %: allowed 100 %")
    names = [item.name for item in items]
    if twice := [name for name in names if names.count(name) > 1]:
        raise file.error(f"{place}.name = {twice[0]!r} is there twice: allowed names that differ")
    return tuple(replace(item, share=item.share / total) for item in items)  # type: ignore[type-var]


def _line(file: SourcedTable, folder: Path) -> str:
    """Name of a known line, or the path of a line's file."""
    name = file.text("line")
    return str((folder / name).resolve()) if (folder / name).is_file() else name


def _base(file: SourcedTable, folder: Path) -> dict[str, Any]:
    """What all cases have in common: keys of a case file that the collective does not set."""
    table = file.table("case")
    own = [*(_OWN_KEYS & set(table.entries))]
    track = table.entries.get("track", {})
    own += [f"track.{key}" for key in sorted(_OWN_TRACK & set(track))] if isinstance(track, dict) else []
    if own:
        raise file.error(f"case.{own[0]}: set by the load collective; allowed are other keys of a case file")
    base = {key: dict(value) if isinstance(value, dict) else value for key, value in table.entries.items()}
    start_at(folder.resolve(), base)
    return base


def _runs(design: SourcedTable) -> int | None:
    """Number of cases of a replicate, which the sampled design has and no other."""
    if design.text("kind", DESIGNS) == SAMPLED:
        return design.whole("runs", "-", 1, 100_000)
    if "runs" in design:
        kind = design.text("kind", DESIGNS)
        raise design.error(f"{design.key('runs')}: {kind} has as many as it needs; allowed with {SAMPLED}")
    return None


def _halvings(design: SourcedTable) -> dict[str, int]:
    """How often the steps of each axis are halved."""
    if "halvings" not in design:
        return {}
    inner = design.table("halvings")
    found = {name: inner.whole(name, "-", 0, 4) for name in HALVED if name in inner}
    inner.close()
    return found


def _running(table: SourcedTable, folder: Path) -> Running:
    """A vehicle with its load."""
    table.begin()
    variant = _vehicle(table, folder)
    drives = bool(variant.vehicle().drives)
    hauls: tuple[Haul, ...] = (Haul("free", 1.0),)
    if "haul" in table:
        read = [_closed(inner, lambda t: _haul(t, drives)) for inner in table.sourced_tables("haul")]
        hauls = _of_classes(_whole(read, table, table.key("haul")), table)
    found = Running(
        name=table.text("name"),
        share=table.number("share_percent", "%", 0.0, 100.0),
        vehicle=variant.name,
        line_vehicle=table.text("line_vehicle"),
        returning=table.truth("returning"),
        speeds=_speeds(table),
        hauls=hauls,
        variant=None if variant.base == variant.name and not variant.changes else variant,
    )
    table.close()
    return found


def _vehicle(table: SourcedTable, folder: Path) -> Variant:
    """The vehicle as in a case's file: a name, a vehicle file, or the table of a variant."""
    given = table.entries.get("vehicle")
    inside: dict[str, Any]
    if isinstance(given, dict):
        inside = {"vehicle": dict(table.table("vehicle").entries)}
    else:
        inside = {"vehicle": table.text("vehicle")}
    start_in(folder.resolve(), inside)
    found = inside["vehicle"]
    try:
        if isinstance(found, dict):
            return variant_of_table(found, VARIED)
        return find_variant(found)
    except ValueError as error:
        raise table.error(f"{table.key('vehicle')}: {error}") from None


def _of_classes(hauls: tuple[Haul, ...], table: SourcedTable) -> tuple[Haul, ...]:
    """Hauls of which the shares in every class that is named sum to 1."""
    for name in {name for haul in hauls for name, _ in haul.of_class}:
        total = math.fsum(haul.share_in(name) for haul in hauls)
        if abs(total - 1.0) > 1e-2 * _SUM:
            key = f"{table.key('haul')}: of_class.{name!r}"
            raise table.error(f"{key} sums to {100.0 * total:g} % over all hauls: allowed 100 %")
    return hauls


def _speeds(table: SourcedTable) -> tuple[tuple[float, float], ...]:
    """Fractions of the largest speed, with shares."""
    if "speed" not in table:
        return ((1.0, 1.0),)
    inner = table.table("speed")
    if "source" in inner:
        inner.begin()
    fractions = inner.numbers("of_largest_percent", "%", 10.0, 100.0)
    shares = inner.numbers("share_percent", "%", 0.0, 100.0, len(fractions))
    inner.close()
    total = math.fsum(shares)
    if abs(total - 100.0) > _SUM:
        raise inner.error(f"{inner.key('share_percent')} sums to {total:g} %: allowed 100 %")
    return tuple((1e-2 * value, share / total) for value, share in zip(fractions, shares, strict=True))


def _haul(table: SourcedTable, drives: bool) -> Haul:
    """Forces along the track."""
    if "source" in table:
        table.begin()
    name, share = table.text("name"), table.number("share_percent", "%", 0.0, 100.0)
    given = table.mapping("of_class", "%", 0.0, 100.0) if "of_class" in table else {}
    of_class = tuple((key, 1e-2 * value) for key, value in given.items())
    if drives:
        wagons, mass = "trailing_wagons", table.number_or("wagon_mass_t", "t", 15.0, 130.0)
        return Haul(
            name,
            share,
            gradient=1e-3 * table.number("gradient_per_mille", "per mille", -50.0, 50.0),
            trailing_wagons=table.whole(wagons, "-", 0, 200) if wagons in table else None,
            wagon_mass=None if mass is None else 1e3 * mass,
            of_class=of_class,
        )
    draft = table.number_or("draft_kN", "kN", -2000.0, 2000.0)
    shoes = table.number_or("shoe_force_kN", "kN", 0.0, 100.0)
    return Haul(
        name,
        share,
        draft=None if draft is None else 1e3 * draft,
        shoe_force=None if shoes is None else 1e3 * shoes,
        of_class=of_class,
    )


def _lengths(table: SourcedTable) -> TrackLengths:
    """Lengths of a case's track."""
    found = TrackLengths(
        whole_curve=table.number("whole_curve_m", "m", 50.0, 5000.0),
        approach=table.number("approach_m", "m", 20.0, 1000.0),
        body=table.number("body_m", "m", 20.0, 5000.0),
        run_out=table.number("run_out_m", "m", 10.0, 1000.0),
    )
    table.close()
    return found


def _gauge(table: SourcedTable) -> GaugeSpread:
    """Gauge about its mean."""
    found = GaugeSpread(
        deviation=1e-3 * table.number("deviation_mm", "mm", 0.0, 15.0),
        truncation=table.number("truncation", "deviations", 0.5, 5.0),
        quantiles=table.whole("quantiles", "-", 1, 64),
        shift=1e-3 * (table.number_or("shift_mm", "mm", -30.0, 30.0) or 0.0),
    )
    table.close()
    return found


def _quality(table: SourcedTable) -> QualityRule:
    """Irregularity of the quality classes."""
    found = QualityRule(
        spectrum=table.text("spectrum", tuple(spectrum_names())),
        speed=table.number("limits_at_km_h", "km/h", 5.0, 300.0) / 3.6,
        lowest=table.number("lowest", "of QN1", 0.0, 1.0),
        highest=table.number("highest", "of QN3", 1.0, 3.0),
    )
    table.close()
    return found


def _rail_wear(table: SourcedTable) -> dict[str, dict[str, float]]:
    """Shares of the wear states of rails, by curve class; "" is any other class."""
    found = {"": _states(table, "percent") if "percent" in table else {NEW: 1.0}}
    if "of_class" in table:
        inner = table.table("of_class")
        for name in inner.entries:
            found[name] = _states(inner, name)
        inner.close()
    table.close()
    return found


def _states(table: SourcedTable, name: str) -> dict[str, float]:
    """Shares by wear state."""
    percent = table.mapping(name, "%", 0.0, 100.0)
    total = math.fsum(percent.values())
    if abs(total - 100.0) > _SUM:
        raise table.error(f"{table.key(name)} sums to {total:g} %: allowed 100 %")
    return {state: value / total for state, value in percent.items()}
