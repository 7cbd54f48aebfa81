"""The case of a stratum: the file's base, the stratum's track, vehicle, speed, friction and train."""

from dataclasses import dataclass
from typing import Any

from hh_exudyn.campaign.collective.plan import Haul, Plan, Season
from hh_exudyn.campaign.collective.strata import Stratum
from hh_exudyn.campaign.collective.track import track_length, track_sections
from hh_exudyn.case import Case, CaseError
from track.friction import ZONES


@dataclass(frozen=True)
class Setting:
    """What the case of a stratum has beside the numbers of its labels.

    `scale` is that of the random irregularity [-], `inclination` that of the rails as a slope [-].
    """

    season: Season
    haul: Haul
    scale: float
    inclination: float


def case_of(plan: Plan, stratum: Stratum, setting: Setting) -> Case:
    """The case of a stratum.

    Parameters
    ----------
    plan : Plan
        Base and lengths.
    stratum : Stratum
        Labels and values.
    setting : Setting
        Season, train, irregularity.

    Raises
    ------
    CaseError
        A number of the stratum or of the base is not allowed; the message names the stratum.
    """
    track = {
        "irregularity": plan.quality.spectrum,
        "irregularity_seed": stratum.seed,
        "irregularity_scale": setting.scale,
        "inclination": setting.inclination,
        "sections": track_sections(stratum, plan.lengths),
    }
    if stratum.gradient_per_mille:
        track["grades"] = [
            {
                "length_m": track_length(stratum, plan.lengths),
                "gradient_per_mille": stratum.gradient_per_mille,
            }
        ]
    if setting.season.flexibility is not None:
        track["flexibility"] = setting.season.flexibility
    name = (
        f"{stratum.running} {stratum.group} {stratum.quality} {stratum.gauge_mm:.1f} mm {stratum.season} "
        f"{stratum.digest}"
    )
    changes: dict[str, Any] = {
        "name": name,
        "vehicle": next(one.vehicle_of_case for one in plan.running if one.name == stratum.running),
        "speed_km_h": stratum.speed_km_h,
        "friction": _friction(setting.season),
        "track": {**plan.base.get("track", {}), **track},
        **_forces(setting.haul),
    }
    try:
        return Case(**{**plan.base, **changes})
    except CaseError as error:
        raise CaseError(f"case of stratum {name}: {error}") from None


def _friction(season: Season) -> dict[str, Any]:
    """The table ``[friction]``."""
    table: dict[str, Any] = dict(zip(ZONES, season.friction.coefficients, strict=True))
    if season.treatments:
        table["treatments"] = season.treatments
    if season.lubricated_wheelsets:
        table["lubricated_wheelsets"] = season.lubricated_wheelsets
    if season.falling is not None:
        table["falling"] = {"ratio": season.falling.ratio, "decrease_s_per_m": season.falling.decrease}
    return table


def _forces(haul: Haul) -> dict[str, Any]:
    """The tables ``[traction]``, ``[train]`` and ``[brake]``."""
    traction: dict[str, Any] = {}
    if haul.trailing_wagons is not None:
        traction["trailing_wagons"] = haul.trailing_wagons
    if haul.wagon_mass is not None:
        traction["wagon_mass_t"] = 1e-3 * haul.wagon_mass
    return {
        **({"traction": traction} if traction else {}),
        **({"train": {"draft_kN": 1e-3 * haul.draft}} if haul.draft is not None else {}),
        **({"brake": {"shoe_force_kN": 1e-3 * haul.shoe_force}} if haul.shoe_force is not None else {}),
    }
