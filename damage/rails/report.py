"""Damage of the rails of a run per gross tonne: a row for each rail of each stretch of track."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pyarrow

from damage.model import DamageModel
from damage.patch_strips import FLANGE, TREAD
from damage.rails.model import RailModel, RailStretch
from damage.rails.pieces import RailPair
from damage.rails.rail_surface import RailSurface
from damage.report import NOT_EXTRAPOLATED, DamageReport
from damage.surface.wheel_surface import Wheel
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT

_LEAST_COVERED = 0.5  # of a stretch, by every wheel


@dataclass(frozen=True)
class RailPlace:
    """A stretch of track with its rails.

    Attributes
    ----------
    title
        Its name: "curve R 450 m left".
    start, end
        Arc lengths of the track [m].
    hand
        Hand of the curve, "left" or "right"; empty for a straight or a transition.
    left, right
        Profiles of the rails: a rail that changes on the way counts as one.
    """

    title: str
    start: float
    end: float
    hand: str
    left: Profile
    right: Profile

    @property
    def stretch(self) -> RailStretch:
        """The stretch with bins along its rails."""
        return RailStretch.of(self.start, self.end, self.left, self.right)

    def rail_name(self, side: int) -> str:
        """ "high" or "low" in a curve, else "left" or "right"."""
        own = "left" if side == LEFT else "right"
        if not self.hand:
            return own
        return "low" if own == self.hand else "high"

    def profile(self, side: int) -> Profile:
        """Profile of a rail."""
        return self.left if side == LEFT else self.right


class PlacedRails(NamedTuple):
    """The rails of a place, passed once by the vehicle."""

    place: RailPlace
    pair: RailPair


@dataclass(frozen=True)
class RailReport:
    """Damage of the rails of a run.

    Attributes
    ----------
    found
        The places that all wheels ran on, with the sums of one passing of the vehicle.
    left_out
        Places of which a wheel ran less than half.
    model
        Settings of the computation.
    mass
        Of the vehicle [kg].
    """

    found: tuple[PlacedRails, ...]
    left_out: tuple[RailPlace, ...]
    model: DamageModel
    mass: float

    @property
    def rails(self) -> RailModel:
        """Steel, wear law and damage function of the rails."""
        if self.model.rails is None:
            raise ValueError("the report is of a computation without rails")
        return self.model.rails

    def seized(self, rail: RailSurface) -> bool:
        """Whether a contact was beyond the pressure of seizure, so that unworn profiles wear in first."""
        return bool(rail.by_wheel.max_pressure.max(initial=0.0) > self.model.rail_seizure_pressure)

    def to_table(self) -> pyarrow.Table:
        """A row for each rail of each place, with units in the names of the columns.

        Depth is normal to the surface and the largest of all places on the profile; "head" is by contact up
        to the flange angle, "gauge" by contact above, at gauge corner and face. ``wear_y_mm`` is the place of
        the deepest wear on the rail profile (positive towards the track centre). ``wear_number_N`` is the
        mean over the wheels that pass. ``fatigue_share`` is the share of the contacts with FI_surf above zero
        (of the rail's shear yield), ``fatigue_area_index`` as of the wheels. ``beyond_shakedown_share`` is
        the share of the wheel passings in which the worst place was beyond shakedown in shear;
        ``miner_per_MGT`` the largest Miner's sum of a place after Kabo, whose lives were fitted on wheels;
        ``rcf_per_MGT`` that of the whole-life rail model, below zero where wear prevails. ``worst_wheelset``
        wears this rail most, by ``worst_share`` of the worn area.
        """
        rows = [
            {
                "element": place.title, "start_m": place.start, "end_m": place.end, "hand": place.hand,
                "rail": place.rail_name(rail.side), "side": rail.side, "law": self.rails.wear.name,
                "steel": self.rails.material.name, "normal_contact": self.model.normal,
                "vehicle_mass_t": self.mass * 1e-3, **self._row(rail),
            }
            for place, pair in self.found
            for rail in pair
        ]  # fmt: skip
        return pyarrow.Table.from_pylist(rows)

    def _row(self, rail: RailSurface) -> dict[str, Any]:
        """The numbers of a rail."""
        sums, per_mgt = rail.by_wheel, rail.per_mgt
        depth, by_part = sums.depth.sum(axis=0), sums.depth_by_part.sum(axis=0)
        area = sums.worn_area.sum(axis=1)
        worst = int(area.argmax())
        volume = sums.worn_volume.sum(axis=0)
        seizure = volume[3] / volume.sum() if "seizure" in self.rails.wear.regimes and volume.sum() else 0.0
        return {
            "p_max_MPa": float(sums.max_pressure.max()) * 1e-6,
            "wear_number_N": float(rail.mean_wear_number.mean()),
            "wear_mm_per_MGT": float(depth.max()) * per_mgt * 1e3,
            "wear_y_mm": float(sums.grid.lateral[depth.argmax()]) * 1e3,
            "head_wear_mm_per_MGT": float(by_part[TREAD].max()) * per_mgt * 1e3,
            "gauge_wear_mm_per_MGT": float(by_part[FLANGE].max()) * per_mgt * 1e3,
            "worn_area_mm2_per_MGT": rail.worn_area_per_mgt * 1e6,
            "wear_seizure_share": float(seizure),
            "wear_note": NOT_EXTRAPOLATED if self.seized(rail) else "",
            "fatigue_share": float(sums.positive_time.sum() / sums.patch_time.sum()),
            "fatigue_area_index": float(sums.index_area.sum() / sums.friction_area.sum()),
            "beyond_shakedown_share": float(_worst(sums.ratchet_revolutions)) / float(rail.rolled.sum()),
            "miner_per_MGT": float(_worst(sums.crack_damage)) * per_mgt,
            "rcf_per_MGT": _farthest(rail.whole_life.sum(axis=0)) * per_mgt,
            "worst_wheelset": sums.wheels[worst].wheelset,
            "worst_vehicle": sums.wheels[worst].vehicle,
            "worst_share": float(area[worst] / area.sum()) if area.sum() > 0.0 else 0.0,
        }

    def profile_table(self) -> pyarrow.Table:
        """A row for each rail and bin across it: depth, worn area, Miner's sum and RCF per MGT."""
        tables = []
        for place, pair in self.found:
            for rail in pair:
                grid, per_mgt, sums = rail.by_wheel.grid, rail.per_mgt, rail.by_wheel
                head, gauge = sums.depth_by_part.sum(axis=0)
                tables.append(
                    pyarrow.table(
                        {
                            "element": np.full(grid.count, place.title),
                            "start_m": np.full(grid.count, place.start),
                            "rail": np.full(grid.count, place.rail_name(rail.side)),
                            "s_mm": grid.centres * 1e3,
                            "y_mm": grid.lateral * 1e3,
                            "head_wear_mm_per_MGT": head * per_mgt * 1e3,
                            "gauge_wear_mm_per_MGT": gauge * per_mgt * 1e3,
                            "miner_per_MGT": sums.crack_damage.sum(axis=(0, 1)) * per_mgt,
                            "rcf_per_MGT": rail.whole_life.sum(axis=0) * per_mgt,
                        }
                    )
                )
        return pyarrow.concat_tables(tables)


def rail_report(reports: Sequence[DamageReport], places: Iterable[RailPlace], mass: float) -> RailReport:
    """The damage of the rails of a run.

    Parameters
    ----------
    reports
        Of the run, one for the wheels of each profile, all with rails (`damage.report.assess`) of the same
        model, whose stretches are those of the places.
    places
        In the order of the model's stretches.
    mass
        Of the vehicle [kg], > 0.

    Raises
    ------
    ValueError
        There is no report, one is without rails, no place was run on by all wheels, or the mass is not above
        zero.
    """
    if not reports or any(not one.rails for one in reports):
        raise ValueError("a report of rails needs damage reports with rails: assess(..., rails=...)")
    wheels = {wheel for one in reports for wheel in one.surface.wheels}
    found, left_out = [], []
    for k, place in enumerate(places):
        left, right = (sum((one.rails[k][i] for one in reports[1:]), reports[0].rails[k][i]) for i in (0, 1))
        if all(_covered(rail, place, wheels) for rail in (left, right)):
            found.append(PlacedRails(place, (left.passed_once(mass), right.passed_once(mass))))
        else:
            left_out.append(place)
    if not found:
        raise ValueError("no stretch of rail was passed by all wheels, for half its length at least")
    return RailReport(tuple(found), tuple(left_out), reports[0].model, mass)


def _covered(rail: RailSurface, place: RailPlace, wheels: set[Wheel]) -> bool:
    own = {wheel for wheel in wheels if wheel.side == rail.side}
    least = _LEAST_COVERED * (place.end - place.start)
    return set(rail.by_wheel.wheels) == own and bool(np.all(rail.rolled >= least))


def _worst(by_part: FloatArray) -> float:
    """The largest of all places of a sum (W, 2, B) over wheels and parts."""
    return float(by_part.sum(axis=(0, 1)).max())


def _farthest(values: FloatArray) -> float:
    """The largest value; where none is above zero, the least."""
    return float(values.max()) if values.max() > 0.0 else float(values.min())
