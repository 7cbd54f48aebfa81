"""The strata of a load collective as a table, for files and for reports."""

from collections.abc import Sequence
from dataclasses import fields

import pyarrow as pa

from hh_exudyn.campaign.collective.films import DIVISORS
from hh_exudyn.campaign.collective.plan import TrackLengths
from hh_exudyn.campaign.collective.strata import Stratum
from hh_exudyn.campaign.collective.track import PARTS, part_shares
from hh_exudyn.campaign.collective.weighted import WeightedStratum
from track.friction import ZONES


def strata_table(rows: Sequence[WeightedStratum], lengths: TrackLengths) -> pa.Table:
    """One row a stratum: weight, mirror image or not, seed, all labels; columns are named with units.

    Weights and parts are shares of the distance; the parts of a row sum to its weight. The radius of straight
    track is null. `wear_divisor_tread` and so on are those of the season's natural films.

    Parameters
    ----------
    rows : sequence of WeightedStratum
        Strata of a collective.
    lengths : TrackLengths
        Of its plan, for the parts.
    """
    columns: dict[str, list[object]] = {
        "weight": [row.weight for row in rows],
        "mirrored": [row.mirrored for row in rows],
        "case": [row.stratum.digest for row in rows],
        "seed": [row.stratum.seed for row in rows],
    }
    for field in fields(Stratum):
        columns[field.name] = [getattr(row.stratum, field.name) for row in rows]
    columns["radius_m"] = [None if row.stratum.straight else row.stratum.radius_m for row in rows]
    columns["irregularity_scale"] = [row.setting.scale for row in rows]
    for zone in ZONES:
        films = [getattr(row.setting.season.films, zone) for row in rows]
        columns[f"film_{zone}"] = list(films)
        columns[f"wear_divisor_{zone}"] = [DIVISORS[film] for film in films]
    for part in PARTS:
        columns[f"weight_{part}"] = [
            row.weight * part_shares(row.stratum, lengths).get(part, 0.0) for row in rows
        ]
    return pa.table(columns)
