"""A tank wagon on Y25 bogies: built in Python, written to a file, and run from the file through R 300 m.

    python examples/07_y25_wagon.py [FOLDER]

x forward from the middle, y left, z up from the rails, springs unloaded; round numbers of the type, assumed.
FOLDER/y25.toml has them to be changed: `hh-exudyn run CASE --vehicle y25.toml`. Writes wagon.png, too.
"""

import sys
import tempfile
from functools import partial
from pathlib import Path

from damage.summary import wheelset_summary
from hh_exudyn.case import Case, CurveCase, StraightCase, TrackCase, TransitionCase
from hh_exudyn.figures.vehicle import summary, vehicle_sheet
from hh_exudyn.multibody.simulate import simulate
from vehicles.couplings import CentrePlate, SideBearer
from vehicles.description import Body, Coupler, Vehicle, Wheelset
from vehicles.freight_couplings import LenoirSuspension
from vehicles.variants import find_variant
from vehicles.whole.export import document_of
from vehicles.whole.writing import to_toml

Box = partial(LenoirSuspension, first_stiffness=1e6, second_stiffness=2.6e6, second_from=0.03, link_share=0.5,
              horizontal_stiffness=0.3e6, link_angle=0.297, guide_stiffness=20e6, friction=0.3,
              stick_stiffness=20e6, stick_damping=40e3, longitudinal_damping=40e3, stop_stiffness=20e6,
              longitudinal_clearance=0.004, lateral_clearance=0.01)  # fmt: skip
Bowl = partial(CentrePlate, radius=0.19, stiffness=400e6, damping=0.8e6, friction=0.15, stick_stiffness=100e6,
               stick_damping=0.4e6, yaw_stiffness=5e6, yaw_damping=20e3, rim_clearance=0.001,
               rim_stiffness=100e6, spherical=True)  # fmt: skip
Bearer = partial(SideBearer, preload=16e3, stiffness=0.7e6, damping=20e3, stop_clearance=0.012,
                 stop_stiffness=50e6, friction=0.35, stick_stiffness=5e6, stick_damping=80e3)  # fmt: skip
CURVE = CurveCase(length_m=90, radius_m=300, hand="left", cant_mm=80)
TRACK = TrackCase(sections=(StraightCase(length_m=20), TransitionCase(length_m=30), CURVE))
bodies = [Body("tank", "car_body", 80.6e3, (35e3, 1.3e6, 1.3e6), (0.0, 0.0, 2.27), 0.03)]
couplings, wheelsets, sides = [], [], (("L", 1), ("R", -1))
for bogie, frame, middle in ((1, "frame_1", 4.8), (2, "frame_2", -4.8)):
    bodies.append(Body(frame, "bogie_frame", 2100.0, (1500.0, 1350.0, 2500.0), (middle, 0.0, 0.6), 0.03))
    couplings.append(Bowl(f"bowl_{bogie}", frame, "tank", (middle, 0.0, 0.9)))
    for letter, side in sides:
        couplings.append(Bearer(f"bearer_{bogie}{letter}", frame, "tank", (middle, 0.85 * side, 0.9)))
    for axle, end in ((f"axle_{bogie}1", 1), (f"axle_{bogie}2", -1)):  # the Lenoir links face each other
        x = middle + 0.9 * end
        bodies.append(Body(axle, "wheelset", 1300.0, (690.0, 100.0, 690.0), (x, 0.0, 0.46)))
        wheelsets.append(Wheelset(axle, bogie, 0.46))
        for letter, side in sides:
            couplings.append(Box(f"box_{axle}{letter}", frame, axle, (x, side, 0.46), -end))
ends = Coupler(("tank", "tank"), ((7.65, 0.0, 1.06), (-7.65, 0.0, 1.06)), stiffness=900e3, damping=400e3)
wagon = Vehicle("y25", tuple(bodies), tuple(couplings), tuple(wheelsets), ends, dimensions={})

folder = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="y25-"))
(file := folder / "y25.toml").write_bytes(to_toml(document_of(wagon, "assumed: round numbers")).encode())
print(f"{summary(wagon)}; the same from its file: {find_variant(file).vehicle() == wagon}")
vehicle_sheet("tank wagon on Y25 bogies", wagon).savefig(folder / "wagon.png", dpi=150)
run = simulate(Case(name="y25", vehicle=str(file), speed_km_h=60, friction=0.35, track=TRACK), folder / "run")
for row in wheelset_summary(run, (100.0, 140.0)):
    (q_left, q_right), attack = (1e-3 * force for force in row.Q), 1e3 * row.angle_of_attack
    print(f"  wheelset {row.wheelset}: Q {q_left:.1f} / {q_right:.1f} kN, angle of attack {attack:.2f} mrad")
