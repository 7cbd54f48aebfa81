"""The tables ``[[season]]`` of a load collective's file."""

from hh_exudyn.campaign.collective.plan import Films, Season
from hh_exudyn.campaign.collective.sourced_table import SourcedTable
from hh_exudyn.contact.friction import FILMS
from track.friction import ZONES, Zones, climate, falling, known
from track.support.sleepers import sleeper_track

_COEFFICIENT = (0.01, 1.0)


def read_season(table: SourcedTable) -> Season:
    """One season; its share is not yet divided by the sum of all.

    Parameters
    ----------
    table : SourcedTable
        Of the file.

    Raises
    ------
    ValueError
        One line with file, key, value, unit and what is allowed.
    """
    table.begin()
    treatments = table.names("treatments", known("treatment"))
    return Season(
        name=table.text("name"),
        share=table.number("share_percent", "%", 0.0, 100.0),
        friction=_zones(table),
        films=_films(table),
        treatments=treatments,
        lubricated_wheelsets=table.wholes("lubricated_wheelsets", "", 1, 100),
        falling=falling(table.text("falling", known("falling"))) if "falling" in table else None,
        flexibility=_flexibility(table),
    )


def _zones(table: SourcedTable) -> Zones:
    """Untreated friction: a climate, or three coefficients."""
    if "climate" in table:
        given = [zone for zone in ZONES if zone in table]
        if given:
            raise table.error(
                f"{table.key('climate')} and {table.key(given[0])}: allowed is one or the other"
            )
        return climate(table.text("climate", known("climate")))
    return Zones(*(table.number(zone, "-", *_COEFFICIENT) for zone in ZONES))


def _films(table: SourcedTable) -> Films:
    """The natural films of the zones."""
    if "film" not in table:
        return Films()
    inner = table.table("film")
    found = {zone: inner.text(zone, FILMS) for zone in ZONES if zone in inner}
    inner.close()
    return Films(**found)


def _flexibility(table: SourcedTable) -> str | None:
    """The foundation in that season, where the file names one."""
    if "flexibility" not in table:
        return None
    name = table.text("flexibility")
    try:
        sleeper_track(name)
    except ValueError as error:
        raise table.error(f"{table.key('flexibility')} = {name!r}: {error}") from None
    return name
