"""A vehicle in curves of 300 to 2000 m, all with the same cant deficiency.

    python examples/08_curving.py [FOLDER [VEHICLE [RADIUS_M ...]]]

VEHICLE: name or file. Some five minutes, less those of runs in FOLDER (curving). Writes curving.png there.
"""

import sys
from importlib.resources import files
from pathlib import Path

import numpy as np

from damage.summary import wheelset_summary
from hh_exudyn.case import read_case
from hh_exudyn.figures.curving import curving_figure
from hh_exudyn.multibody.once import simulate_once
from track.course.alignment import cant_deficiency

RADII = (300.0, 450.0, 700.0, 1200.0, 2000.0)  # m
DEFICIENCY = 20.0  # mm, assumed: moderate, so that outer wheels carry somewhat more
SHOWN = {  # label: attribute of a summary, factor
    "angle of attack [mrad], left +": ("angle_of_attack", 1e3),
    "lateral position [mm], left +": ("lateral", 1e3),
    "Y [kN], outwards +": ("Y", 1e-3),
    "Q [kN]": ("Q", 1e-3),
    "wear number [N]": ("wear_number", 1.0),
}


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "curving")
    vehicle = sys.argv[2] if len(sys.argv) > 2 else "iore_wagon_loaded"
    radii = sorted(float(word) for word in sys.argv[3:]) or RADII
    demo = read_case(str(files("hh_exudyn") / "data" / "demo.toml")).with_changes(vehicle=vehicle)
    found = []
    for radius in radii:
        cant = round(1e3 * cant_deficiency(demo.speed, radius) - DEFICIENCY, 1)
        print(f"radius {radius:g} m, cant {cant:g} mm{'':40}")
        full = {"kind": "curve", "length_m": 130.0, "radius_m": radius, "hand": "left", "cant_mm": cant}
        plan = [{"kind": "straight", "length_m": 25.0}, {"kind": "transition", "length_m": 60.0}, full]
        for part in (plan[0], full):
            part["gauge_mm"] = 1440.0
        case = demo.with_changes(name=f"R{radius:g}", track={"sections": plan})
        run = simulate_once(case, folder / case.name, lambda done, text: print(f"{done:4.0%}", end="\r"))
        found.append(wheelset_summary(run, (165.0, 215.0)))  # m, end of the curve
        for one in found[-1]:
            where = f"attack {1e3 * one.angle_of_attack:.3f} mrad, position {1e3 * one.lateral:.2f} mm"
            print(f"  wheelset {one.wheelset} of unit {one.vehicle}: {where}")
    quantities = {
        label: factor * np.array([[getattr(one, name) for one in of_run] for of_run in found])
        for label, (name, factor) in SHOWN.items()
    }
    title = f"{vehicle}, left-hand curves, {demo.speed_km_h:g} km/h, cant deficiency {DEFICIENCY:g} mm"
    curving_figure(title, np.array(radii), quantities).savefig(folder / "curving.png", dpi=150)


if __name__ == "__main__":
    main()
