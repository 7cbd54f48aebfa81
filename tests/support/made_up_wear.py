"""Sums of a case without a simulation: wear as a function of place and curvature, known to the last digit."""

from dataclasses import replace

import numpy as np

from damage.surface.lateral_grid import LateralGrid
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.campaign.engine.case_damage import CaseWork
from hh_exudyn.campaign.engine.sums import DamageSums, PartSums
from hh_exudyn.case.wheels import read_wheel, wheel_names

TREAD_RATE = 1e-11  # m/m: 10 um in 1000 km
TREAD_AREA = TREAD_RATE * 8e-3 * np.sqrt(np.pi)  # m^2/m
FLANGE_RATE = 4e-11  # m/m, in curves
CRACK_RATE = 2e-8  # 1/m


def made_up_sums(work: CaseWork) -> PartSums:
    """A tread worn about y = 0, and in curves a root worn about y = 30 mm; no noise."""
    vehicle = work.case.described_vehicle()
    count = len(vehicle.wheelsets)
    names = wheel_names(work.case.wheel_profiles, work.case.wheel_profile, count)
    curved = len(work.parts) > 1
    found: PartSums = {}
    for part in work.parts:
        length = part.end - part.start
        surfaces = []
        for index, wheelset in enumerate(vehicle.wheelsets):
            number = [w.unit for w in vehicle.wheelsets[: index + 1]].count(wheelset.unit)
            for side, name in ((1, names[index][0]), (-1, names[index][1])):
                grid = LateralGrid.along(read_wheel(name))
                wheel = Wheel(wheelset.unit, wheelset.bogie, number, side)
                surfaces.append(_surface(grid, wheel, length, curved and side < 0))
        total = sum([DamageSums((surface,)) for surface in surfaces], DamageSums(()))
        passed = tuple(replace(surface, distance=length, time=length / 15.0) for surface in total.surfaces)
        found[part.name] = DamageSums(passed)
    return found


def _surface(grid: LateralGrid, wheel: Wheel, length: float, flanging: bool) -> WheelSurface:
    surface = WheelSurface.zero((wheel,), grid)
    y = grid.lateral
    tread = np.exp(-(((y - 0.0) / 8e-3) ** 2))
    root = np.exp(-(((y - 30e-3) / 5e-3) ** 2)) if flanging else np.zeros_like(y)
    depth = length * (TREAD_RATE * tread + FLANGE_RATE * root)
    surface.depth_by_part[0, 0] = depth
    surface.worn_area[0] = depth * grid.step
    surface.contact_time[0, 0] = (tread > 0.01) | (root > 0.01)
    surface.crack_damage[0, 0] = length * CRACK_RATE * tread
    surface.global_crack_damage[0, 0] = 0.5 * length * CRACK_RATE * tread
    surface.pressure_by_part[0, 0] = 1.0e9
    return surface


def scattered_sums(work: CaseWork) -> PartSums:
    """The same, times a number between 0.8 and 1.2 that goes with the case's irregularity alone."""
    factor = 0.8 + 0.4 * np.random.default_rng(work.case.track.irregularity_seed).random()
    return {
        name: DamageSums(tuple(replace(factor * s, distance=s.distance, time=s.time) for s in sums.surfaces))
        for name, sums in made_up_sums(work).items()
    }
