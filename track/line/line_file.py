"""The known lines, and the reader of a line's file, which checks sums of shares, classes and rails.

The tables and keys are those of ``track/data/malmbanan.toml``; ``rails`` may name measured profiles by a path
relative to the file, with a ``wear`` of their own.
"""

import math
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable
from itertools import pairwise
from pathlib import Path

from hh_exudyn.entry_points import entries_of, loaded
from track.irregularity.quality import CLASSES
from track.line.data_table import DataTable, read_data
from track.line.line_data import Line, SpeedRule, TrackClass, TransitionRule
from track.rails import NEW, GaugeRule, RailPair, RailRule, known_rail, rail_pairs, slope

GROUP = "hh_exudyn.lines"  # of the entry points

_RADIUS = (100.0, 20000.0)  # m, as in `track.course.alignment`
_ROUNDING = 0.015  # of published distributions and lengths, in whole per cent
_STRAIGHT = "straight"

_Sources = dict[str, str]
_Quality = tuple[float, float, float, float]


@dataclass(frozen=True)
class LineRecord:
    """A line by name: its file, and one line of description."""

    name: str
    file: Path | Traversable
    description: str


LINES = {
    record.name: record
    for record in (
        LineRecord(
            "malmbanan", files("track") / "data" / "malmbanan.toml", "iron-ore line Luleå - Kiruna - Narvik"
        ),
    )
}
"""The toolkit's own lines. Other packages add theirs through entry points of the group `GROUP`."""


def line_names() -> tuple[str, ...]:
    """Names of all lines, those of other packages last."""
    return tuple(dict.fromkeys((*LINES, *entries_of(GROUP))))


def line_record(name: str) -> LineRecord:
    """The record of that name. Raises ValueError for an unknown one (lists the known)."""
    if name in LINES:
        return LINES[name]
    others = entries_of(GROUP)
    if name not in others:
        known = ", ".join((*LINES, *others))
        raise ValueError(f"line {name!r} is no file, and not one of the known lines: {known}")
    return loaded(others[name], LineRecord)


def read_line(path_or_name: str | Path) -> Line:
    """A line by name, of the toolkit or of another package, or one from a TOML file.

    Raises
    ------
    ValueError
        One line: neither file nor known name; not TOML; a key that is missing, unknown or out of range (with
        key, value, unit, allowed); shares that do not sum to 100 %, classes that overlap, places without
        rails, lengths of countries that disagree with their classes.
    """
    name, path = str(path_or_name), Path(path_or_name)
    own = isinstance(path_or_name, str) and name in LINES
    file = path if path.is_file() and not own else line_record(name).file
    return _line(read_data(file), file.parent if isinstance(file, Path) else Path())


def _line(file: DataTable, folder: Path) -> Line:
    """The line of a whole file; relative paths of rails start at `folder`."""
    sources: _Sources = {}
    name = file.text("name")
    length = _with_source(file.table("length"), sources)
    speed = _speed(file, sources)
    ramp = _with_source(file.table("transition"), sources)
    gauge = _with_source(file.table("gauge"), sources)
    inclination = _with_source(file.table("rail_inclination"), sources)
    countries = _country_lengths(file, sources)
    line = Line(
        name=name,
        length=1e3 * length.number("km", "km", 0.1, 1e5),
        classes=_classes(file, countries, sources),
        speed=speed,
        transition=TransitionRule(
            ramp.number("cant_ramp", "(1:n)", 100.0, 5000.0), ramp.number("shortest_m", "m", 1.0, 1000.0)
        ),
        gauge=_gauge(gauge),
        rail_inclination=_slope(inclination),
        rails=_rails(file, countries, folder, sources),
        country_lengths=countries,
        line_quality=_line_quality(file, sources),
        sources=sources,
    )
    for table in (length, ramp, gauge, inclination, file):
        table.close()
    _check_whole(line, file)
    return line


def _with_source(table: DataTable, sources: _Sources) -> DataTable:
    """The table; its source is added to `sources`."""
    sources[table.place] = table.source()
    return table


def _speed(file: DataTable, sources: _Sources) -> SpeedRule:
    """Largest speeds by vehicle and by cant deficiency."""
    vehicles = _with_source(file.table("speed_km_h"), sources)
    names = [key for key in vehicles.entries if key != "source"]
    if not names:
        raise file.error("speed_km_h has no vehicle: allowed one or more names with 5 to 130 km/h")
    largest = {key: vehicles.number(key, "km/h", 5.0, 130.0) / 3.6 for key in names}
    curve = _with_source(file.table("curve_speed"), sources)
    rule = SpeedRule(
        largest,
        1e-3 * curve.number("largest_cant_deficiency_mm", "mm", 0.0, 300.0),
        curve.number("step_km_h", "km/h", 0.1, 20.0) / 3.6,
    )
    curve.close()
    return rule


def _gauge(table: DataTable) -> GaugeRule:
    """The gauge over the radius."""
    radius = table.numbers("radius_m", "m", _RADIUS[0], math.inf)
    gauge = table.numbers("mean_mm", "mm", 1400.0, 1500.0, len(radius))
    try:
        return GaugeRule(radius, tuple(1e-3 * value for value in gauge))
    except ValueError as error:
        raise table.error(f"{table.key('radius_m')}: {error}") from None


def _slope(table: DataTable) -> float:
    """``slope = "1:30"`` as a number [-]."""
    text = table.text("slope")
    try:
        return slope(text)
    except ValueError as error:
        raise table.error(f"{table.key('slope')} = {text!r}: {error}") from None


def _country_lengths(file: DataTable, sources: _Sources) -> dict[str, float]:
    """Length of the line in each country [m]."""
    group = file.table("country")
    found = {}
    for name in group.entries:
        table = _with_source(group.table(name), sources)
        found[name] = 1e3 * table.number("length_km", "km", 0.0, 1e5)
        table.close()
    if not math.fsum(found.values()) > 0.0:
        raise file.error("country: allowed one or more tables with a length_km above 0 km")
    return found


def _classes(file: DataTable, countries: dict[str, float], sources: _Sources) -> tuple[TrackClass, ...]:
    """Curve classes in the order of the file, left before right, and the straight."""
    splits = _splits(file, countries, sources)
    group, qualities = file.table("curve"), file.table("quality")
    found = []
    intervals: list[tuple[float, float, str]] = []
    for name in group.entries:
        if name == _STRAIGHT:
            raise file.error(
                f"curve.{_STRAIGHT}: allowed names of curve classes; straight track is [straight]"
            )
        table = _with_source(group.table(name), sources)
        quality = _with_source(qualities.table(name), sources)
        low, high = table.numbers("interval_m", "m", 0.0, _RADIUS[1], 2)
        intervals.append((low, high, name))
        hands = [table.table(key) for key in ("share_percent", "radius_m", "cant_mm")]
        for hand in ("left", "right"):
            share = hands[0].number(hand, "%", 0.0, 100.0)
            radius = hands[1].number(hand, "m", max(low, _RADIUS[0]), high)
            cant = hands[2].number(hand, "mm", 0.0, 180.0)
            found.append(
                TrackClass(
                    name, hand, share / 100.0, radius, 1e-3 * cant,
                    _split(splits, radius, table), _distribution(quality, f"{hand}_percent"),
                )
            )  # fmt: skip
        for inner in (table, quality, *hands):
            inner.close()
    for one, other in pairwise(sorted(intervals)):
        if other[0] < one[1]:
            raise file.error(
                f"curve.{other[2]}.interval_m starts at {other[0]:g} m inside that of curve.{one[2]}: "
                f"allowed from {one[1]:g} m on"
            )
    straight = _with_source(file.table(_STRAIGHT), sources)
    quality = _with_source(qualities.table(_STRAIGHT), sources)
    share = straight.number("share_percent", "%", 0.0, 100.0) / 100.0
    countries_of_it = _split(splits, math.inf, straight)
    found.append(
        TrackClass(
            _STRAIGHT, _STRAIGHT, share, math.inf, 0.0, countries_of_it, _distribution(quality, "percent")
        )
    )
    for inner in (straight, quality, qualities):
        inner.close()
    return tuple(found)


_Split = tuple[float, float, dict[str, float]]  # radius from, to, shares


def _splits(file: DataTable, countries: dict[str, float], sources: _Sources) -> list[_Split]:
    """Shares of the countries by interval of radius."""
    found = []
    for table in file.tables("country_split"):
        _with_source(table, sources)
        low, high = table.numbers("radius_m", "m", 0.0, math.inf, 2)
        shares = table.mapping("percent", "%", 0.0, 100.0)
        unknown = sorted(set(shares) - set(countries))
        if unknown:
            raise table.error(
                f"{table.key('percent')} names {unknown[0]}: allowed {', '.join(sorted(countries))}"
            )
        found.append((low, high, _fractions(table, "percent", shares)))
        table.close()
    return found


def _split(splits: list[_Split], radius: float, owner: DataTable) -> dict[str, float]:
    """The split of a radius; the one up to infinity holds for straight track too."""
    for low, high, shares in splits:
        if low <= radius < high or (math.isinf(radius) and math.isinf(high)):
            return shares
    raise owner.error(f"no country_split holds for {owner.place}, radius {radius:g} m")


def _fractions(table: DataTable, name: str, percent: dict[str, float]) -> dict[str, float]:
    """Shares that sum to 1, from percentages that sum to 100 but for rounding."""
    total = math.fsum(percent.values())
    if abs(total - 100.0) > 100.0 * _ROUNDING:
        raise table.error(f"{table.key(name)} sums to {total:g} %: allowed 100 % (+-{100 * _ROUNDING:g})")
    return {key: value / total for key, value in percent.items()}


def _distribution(table: DataTable, name: str) -> _Quality:
    """Shares of the qualities."""
    percent = dict(zip(CLASSES, table.numbers(name, "%", 0.0, 100.0, len(CLASSES)), strict=True))
    one, two, three, worse = _fractions(table, name, percent).values()
    return one, two, three, worse


def _line_quality(file: DataTable, sources: _Sources) -> _Quality | None:
    """The whole line's distribution, if there is one."""
    if "line_quality" not in file:
        return None
    table = _with_source(file.table("line_quality"), sources)
    found = _distribution(table, "percent")
    table.close()
    return found


def _rails(
    file: DataTable, countries: dict[str, float], folder: Path, sources: _Sources
) -> tuple[RailRule, ...]:
    """Rails by country, interval of radius and wear state."""
    found = []
    for table in file.tables("rails"):
        _with_source(table, sources)
        country = table.text("country", tuple(sorted(countries)))
        low, high = table.numbers("radius_m", "m", 0.0, math.inf, 2)
        share = table.number("share_percent", "%", 0.0, 100.0) / 100.0 if "share_percent" in table else 1.0
        wear = table.text("wear") if "wear" in table else NEW
        names = []
        for key in ("high", "low"):
            try:
                names.append(known_rail(table.text(key), folder))
            except ValueError as error:
                raise table.error(f"{table.key(key)}: {error}") from None
        found.append(RailRule(country, low, high, RailPair(names[0], names[1], wear), share))
        table.close()
    return tuple(found)


def _check_whole(line: Line, file: DataTable) -> None:
    """Checks across tables: the sum of the shares, the countries' lengths, rails everywhere."""
    total = 100.0 * math.fsum(part.share for part in line.classes)
    if abs(total - 100.0) > 0.05:
        raise file.error(f"share_percent of all curves and the straight sum to {total:g} %: allowed 100 %")
    whole = math.fsum(line.country_lengths.values())
    for country, length in line.country_lengths.items():
        share = math.fsum(part.share * part.countries.get(country, 0.0) for part in line.classes)
        if abs(share - length / whole) > _ROUNDING:
            raise file.error(
                f"country.{country}.length_km is {100 * length / whole:.1f} % of the countries' lengths, but "
                f"country_split gives it {100 * share:.1f} % of the line: allowed +-{100 * _ROUNDING:g} %"
            )
        for part in line.classes:
            if part.countries.get(country, 0.0) > 0.0:
                try:
                    rail_pairs(line.rails, country, part.radius)
                except ValueError as error:
                    raise file.error(f"rails: {error}") from None
