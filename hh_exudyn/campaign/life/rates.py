"""Wear and crack rates of groups of wheels, from the damage sums of weighted cases: per metre rolled.

A rate is a mean over the wheels of a group in a run, over the parts of its track with their shares, and over
the cases with their weights. A failed case is left out, and the others stand for it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from damage.evolution.profile_wear import ProfileWear, increasing
from damage.surface.wheel_surface import WheelSurface
from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.weighted import WeightedCase
from hh_exudyn.campaign.engine.sums import PartSums
from hh_exudyn.campaign.life.groups import Place
from vehicles.description import Vehicle

CRACK_SUMS = {"global": "global_crack_damage", "local": "crack_damage"}
"""Sums of a surface that are followed as cracks, by the name of the fatigue index."""


@dataclass(frozen=True, eq=False)
class GroupRates:
    """Rates of the wheels of one group, over the bins of their profile.

    Attributes
    ----------
    y
        (B,) lateral place on the profile, increasing [m].
    depth
        (B,) wear depth normal to the surface per metre rolled [m/m].
    cracks
        By fatigue index, (B,) Miner's sum per metre rolled [1/m].
    contact
        (B,) whether the bin was in contact.
    pressure
        Largest contact pressure [Pa].
    worn_area
        Worn area of the cross-section per metre rolled [m^2/m].
    """

    y: FloatArray
    depth: FloatArray
    cracks: Mapping[str, FloatArray]
    contact: FloatArray
    pressure: float
    worn_area: float

    @property
    def wear(self) -> ProfileWear:
        """The wear as a step of wear takes it."""
        return ProfileWear(self.y, 1e3 * self.depth, self.pressure)


def rates_of_case(
    sums: PartSums, weighted: WeightedCase, vehicle: Vehicle, groups: Mapping[Place, str]
) -> dict[str, GroupRates]:
    """Rates of every group in one case.

    Parameters
    ----------
    sums
        Of the case, by part of its track.
    weighted
        With the shares of its parts.
    vehicle
        That ran.
    groups
        Group of every wheel (`hh_exudyn.campaign.life.groups`); wheels of a group have the same profile.
    """
    counts = _wheelsets_before(vehicle)
    found: dict[str, list[tuple[float, GroupRates]]] = {}
    for part in weighted.parts:
        for surface in sums[part.name].surfaces:
            rows: dict[str, list[int]] = {}
            for row, wheel in enumerate(surface.wheels):
                place = (counts[wheel.vehicle] + wheel.wheelset, wheel.side)
                rows.setdefault(groups[place], []).append(row)
            for group, own in rows.items():
                found.setdefault(group, []).append((part.share * len(own), _rates(surface, own)))
    return {group: weighted_mean(parts) for group, parts in found.items()}


def weighted_mean(parts: Sequence[tuple[float, GroupRates]]) -> GroupRates:
    """The mean of rates on the same bins, with their weights; pressure is the largest.

    Parameters
    ----------
    parts
        Weights (of any sum) and rates, one at least.

    Raises
    ------
    ValueError
        Rates on different bins.
    """
    whole = sum(weight for weight, _ in parts)
    first = parts[0][1]
    if any(not np.array_equal(rates.y, first.y) for _, rates in parts):
        raise ValueError("rates of one group of wheels lie on the bins of different profiles")
    shares = np.array([weight / whole for weight, _ in parts])
    return replace(
        first,
        depth=shares @ np.array([rates.depth for _, rates in parts]),
        cracks={
            index: shares @ np.array([rates.cracks[index] for _, rates in parts]) for index in first.cracks
        },
        contact=np.max([rates.contact for _, rates in parts], axis=0),
        pressure=max(rates.pressure for _, rates in parts),
        worn_area=float(shares @ np.array([rates.worn_area for _, rates in parts])),
    )


def on_bins(rates: GroupRates, y: FloatArray) -> GroupRates:
    """Rates on other bins: of a profile that differs by no more than may stand for this one.

    Parameters
    ----------
    rates
        Of a case that was run with a former profile.
    y
        (C,) lateral places of the bins wanted [m].
    """
    if np.array_equal(rates.y, y):
        return rates

    def there(values: FloatArray) -> FloatArray:
        return np.interp(y, rates.y, values, left=0.0, right=0.0)

    return replace(
        rates,
        y=y,
        depth=there(rates.depth),
        cracks={index: there(values) for index, values in rates.cracks.items()},
        contact=(there(rates.contact) > 0.0).astype(np.float64),
    )


def _rates(surface: WheelSurface, rows: list[int]) -> GroupRates:
    """Mean of some wheels of a surface, per metre rolled."""
    per = 1.0 / (surface.distance * len(rows))
    return GroupRates(
        y=increasing(surface.grid.lateral),
        depth=per * surface.depth[rows].sum(axis=0),
        cracks={
            index: per * getattr(surface, name)[rows].sum(axis=(0, 1)) for index, name in CRACK_SUMS.items()
        },
        contact=(surface.contact_time[rows].sum(axis=(0, 1)) > 0.0).astype(np.float64),
        pressure=float(surface.max_pressure[rows].max()),
        worn_area=per * float(surface.worn_area[rows].sum()),
    )


def _wheelsets_before(vehicle: Vehicle) -> dict[int, int]:
    """Wheelsets before the first one of each unit."""
    units = [wheelset.unit for wheelset in vehicle.wheelsets]
    return {unit: units.index(unit) for unit in units}
