"""Wear of a wheel by a handful of poses on the rail: the project's contact and wear, without a simulation.

The outer wheel of a leading wheelset, R 305 to 950 m: dry, gauge and shift spread, 15 t on the wheel.
"""

from collections.abc import Sequence

import numpy as np
import pyarrow

from damage.evolution.profile_wear import ProfileWear, mean_wear
from damage.report import assess
from hh_exudyn.contact.profile import Profile, rail_profile
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.contact.wheelset import wheel_on_rail
from hh_exudyn.log.channels import LOGS

R0, SPEED, FRICTION, LOAD = 0.4575, 16.7, 0.35, 150e3
RAIL = rail_profile("60E1", 1 / 30)
SHIFTS = (0.0, 3e-3, 5e-3, 6.5e-3, 7.5e-3, 8.5e-3)  # m
POSES = tuple((shift, 0.8 * shift) for shift in SHIFTS)


def bench_wear(wheel: Profile, poses: Sequence[tuple[float, float]] = POSES) -> ProfileWear:
    """Mean wear over poses (lateral shift [m], yaw [rad]), each of the same weight."""
    rows: dict[str, list[float]] = {column.name: [] for column in LOGS["contact"]}
    for number, (lateral, yaw) in enumerate(poses):
        contacts = wheel_on_rail(
            wheel, RAIL, 1, lateral=lateral, yaw=yaw, roll=0.0, load=LOAD, radius=R0, speed=SPEED,
            pitch_rate=SPEED / R0, friction=FRICTION, normal="coupled_strips",
        ).contacts  # fmt: skip
        for patch, state in enumerate(contacts):
            given = {"time": 0.1 * number, "side": 1, "patch": patch, "vehicle": 1, "bogie": 1, "wheelset": 1}
            for name, values in rows.items():
                values.append(given[name] if name in given else getattr(state, name, 0.0))
    kinds = {"float64": np.float64, "int32": np.int32}
    log = pyarrow.table({c.name: np.array(rows[c.name]).astype(kinds[c.kind]) for c in LOGS["contact"]})
    contact = wheel_rail_model(wheel, wheel, RAIL, RAIL, nominal_radius=R0, normal="coupled_strips")
    return mean_wear(assess(log, profile=wheel, contact=contact, cells=(20, 20), threads=1).surface)


STRAIGHT = tuple((shift, 0.1 * shift) for shift in (-3e-3, -1.5e-3, 0.0, 1.5e-3, 3e-3))
LIFE = ((0.97, STRAIGHT, 6.0, 6.0), (0.03, POSES, 6.0, 100.0))
"""Share of the distance, poses, and divisors of dry wear on the tread (lubricated by nature) and on the
flange (greased), with a blend from y = 10 to 35 mm."""


def life_wear(wheel: Profile) -> ProfileWear:
    """Mean over straight track and curves, with the wear coefficients of lubricated zones."""
    parts = [(share, bench_wear(wheel, poses), *films) for share, poses, *films in LIFE]
    y = np.arange(-60e-3, 60e-3, 0.5e-3)
    flange = np.clip((y - 10e-3) / 25e-3, 0.0, 1.0)
    depth = sum(
        share * wear.at(y) * np.exp(-((1.0 - flange) * np.log(tread) + flange * np.log(root)))
        for share, wear, tread, root in parts
    )
    return ProfileWear(y, depth, max(part[1].pressure for part in parts))
