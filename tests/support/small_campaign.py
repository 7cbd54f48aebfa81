"""A campaign of made-up wear with as few cases as there are groups, and wear that grows with the load."""

from dataclasses import replace
from pathlib import Path

from made_up_campaign import campaign_file
from made_up_wear import made_up_sums

from hh_exudyn.campaign.engine.case_damage import CaseWork
from hh_exudyn.campaign.engine.sums import DamageSums, PartSums


def small_campaign_file(folder: Path, groups: str = "role") -> Path:
    """A campaign of single wagons with a case for straight track and one for curves, loaded and empty."""
    path = campaign_file(folder, groups)
    text = path.read_text(encoding="utf-8")
    assert text.count("runs = 8") == 1
    path.write_text(text.replace("runs = 8", "runs = 4"), encoding="utf-8")
    return path


def by_load(work: CaseWork) -> PartSums:
    """Made-up sums that grow with the mass of the vehicle."""
    factor = work.case.described_vehicle().mass / 120e3
    return {
        name: DamageSums(
            tuple(
                replace(
                    surface.scaled(factor * surface.distance), distance=surface.distance, time=surface.time
                )
                for surface in sums.surfaces
            )
        )
        for name, sums in made_up_sums(work).items()
    }
