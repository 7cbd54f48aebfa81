"""The IORE locomotive and its 68 wagons: what two units can hold, and rails that turn slippery uphill.

    python examples/09_locomotive.py FOLDER

The first unit is simulated; the second one and the wagons are a mass with resistance on its rear coupler.
"""

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from hh_exudyn.case import Case, FrictionCase, FrictionSectionCase, GradeCase, StraightCase, TrackCase
from hh_exudyn.case.traction import TractionCase
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.figures.traction import control_figure, effort_figure
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle
from vehicles.traction.train import locomotive_resistance

UNIT = vehicle("iore_locomotive")
SPEED = 60 / 3.6  # m/s
DRY = dict.fromkeys(("tread", "gauge_corner", "flange"), 0.4)
WET = FrictionSectionCase(start_m=40, **dict.fromkeys(DRY, 0.1))
RAILS = FrictionCase(**DRY, sections=(WET,))


def demand(speed: float, gradient: float) -> float:
    """Effort of all units together that keeps the speed of the whole train [N]."""
    train = TractionCase().train(UNIT, lambda s: gradient + 0 * s, lambda s: 0 * s)
    own = UNIT.mass * (1e-3 * locomotive_resistance(speed) + GRAVITY * gradient)
    return own + train.resisting_force(0.0, speed)


def main() -> None:
    (folder := Path(sys.argv[1])).mkdir(exist_ok=True)
    largest, brake = UNIT.traction.largest_effort, UNIT.traction.largest_brake
    held = brentq(lambda gradient: 2 * largest(SPEED) - demand(SPEED, gradient), 0.0, 0.02)
    balance = brentq(lambda speed: 2 * largest(speed) - demand(speed, 0.010), 5.0, SPEED)
    print(f"two units hold 60 km/h up to {1e3 * held:.1f} per mille; on 10: {3.6 * balance:.1f} km/h")
    effort_figure(
        "two units and 68 wagons of 120 t", lambda v: 2 * largest(v), lambda v: min(5e5, 2 * brake(v)),
        demand, (-0.010, -0.005, 0.0, 0.005, 0.010), 80 / 3.6,
    ).savefig(folder / "efforts.png")  # fmt: skip
    track = TrackCase(sections=(StraightCase(length_m=100, gauge_mm=1440),),
                      grades=(GradeCase(length_m=100, gradient_per_mille=6),))  # fmt: skip
    for which in ("on", "off"):
        case = Case(name=which, vehicle=UNIT.name, speed_km_h=60, track=track, friction=RAILS,
                    traction=TractionCase(slip_control=which == "on"))  # fmt: skip
        log = simulate(case, folder / which).read("control")
        control = {name: log[name].to_numpy() for name in log.column_names}
        slip, pull = np.max(control["wheel_speed"] / control["speed"] - 1.0), -control["coupler_force"][-1]
        print(f"slip control {which}: largest slip {100 * slip:6.1f} %, last pull {pull / 1e3:.0f} kN")
        control_figure(f"slip control {which}", control).savefig(folder / f"{which}.png")


if __name__ == "__main__":
    main()
