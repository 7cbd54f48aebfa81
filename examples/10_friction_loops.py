"""Friction loops of a bogie: force over deflection of each element under its static load.

Usage: python 10_friction_loops.py [PICTURE.png [VEHICLE]]. Prints what a cycle takes, and draws the loops
into the picture: of the three-piece bogie of the demo's wagon, or of the axle boxes of y25_wagon_loaded.
"""

import sys
from importlib.resources import files

from hh_exudyn.case import Case
from hh_exudyn.figures.hysteresis import Panel, friction_loops
from hh_exudyn.multibody.hysteresis import ROLL, bogie_loops, suspension_loops, warp_loop
from vehicles.catalogue import vehicle

case = Case.from_toml(files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8"))
wagon = vehicle(sys.argv[2] if len(sys.argv) > 2 else case.vehicle)
three_piece = any(body.kind == "bolster" for body in wagon.bodies)
loops = (*bogie_loops(wagon, case), warp_loop(wagon, case)) if three_piece else suspension_loops(wagon, case)
for loop in loops:
    print(f"{loop.title:30s} {loop.area:8.1f} J around the loop, {loop.dissipated:8.1f} J dissipated")
if len(sys.argv) > 1:
    panels = [
        Panel(loop.title, loop.axis >= ROLL, loop.displacement, loop.force, loop.dissipated) for loop in loops
    ]
    friction_loops(f"Friction of {wagon.name}", panels).savefig(sys.argv[1], dpi=150)
