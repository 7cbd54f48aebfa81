"""A hydraulic damper of one's own: an Exudyn connector with a Python function, in the catalogue's coach.

    python examples/12_hydraulic_damper.py [FOLDER]

Yaw dampers between car body and bogies: steep up to their blow-off force, flat beyond. Any of Exudyn's items
can be added so; named sensors are logged with the run. Draws the loop of a damper.
"""

import sys
import tempfile
from pathlib import Path

import exudyn
import matplotlib.pyplot as plt
import numpy as np
from exudyn.itemInterface import ObjectConnectorSpringDamper, SensorObject

from hh_exudyn.case import Case, StraightCase, TrackCase
from hh_exudyn.log.sensors import sensor_values
from hh_exudyn.multibody.exudyn_system import ExudynSystem
from hh_exudyn.multibody.simulate import simulate

DAMPING, BLOW_OFF = 600e3, 8e3  # N s/m, N
HALF_SPACING, HEIGHT, LENGTH = 1.3, 0.7, 0.8  # m
TRACK = TrackCase(rail="60E1", irregularity="erri_high", sections=(StraightCase(length_m=150),))


def damper_force(mbs: object, time: float, item: int, stretch: float, rate: float, *_: float) -> float:
    """Force of a damper that opens at its blow-off force [N]."""
    return DAMPING * rate / float(np.hypot(1.0, DAMPING * rate / BLOW_OFF))


def yaw_dampers(system: ExudynSystem) -> None:
    for frame, x in {"bogie_frame_1": 9.5, "bogie_frame_2": -9.5}.items():
        for side, letter in ((1, "L"), (-1, "R")):
            ends = [(x, side * HALF_SPACING, HEIGHT), (x + LENGTH, side * HALF_SPACING, HEIGHT)]
            markers = [system.marker(frame, ends[0]), system.marker("car_body", ends[1])]
            damper = ObjectConnectorSpringDamper(markerNumbers=markers, referenceLength=LENGTH)
            damper.springForceUserFunction = damper_force
            number = system.mbs.AddObject(damper)
            for name in ("Force", "Velocity"):
                sensor = SensorObject(objectNumber=number, storeInternal=False)
                sensor.outputVariableType = getattr(exudyn.OutputVariableType, name)
                system.sensors[f"{name} {frame[-1]}{letter}"] = system.mbs.AddSensor(sensor)


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="yaw-dampers-"))
    case = Case(name="dampers", vehicle="manchester_vehicle_1", speed_km_h=120, friction=0.35, track=TRACK)
    run = simulate(case, folder / "run", extend=yaw_dampers)
    rate, force = (sensor_values(run, f"{name} 1L")[1][:, 0] for name in ("Velocity", "Force"))
    print(f"damper 1L: up to {abs(force).max() / 1e3:.2f} kN, {run.directory}")
    plt.plot(1e3 * rate, 1e-3 * force, ".", markersize=2)
    plt.gca().set(xlabel="rate of yaw damper 1L [mm/s]", ylabel="its force [kN]")
    plt.savefig(folder / "damper.png", dpi=150)


if __name__ == "__main__":
    main()
