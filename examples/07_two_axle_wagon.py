"""A vehicle of one's own: a two-axle wagon on soft double links, through a curve of 300 m.

    python examples/07_two_axle_wagon.py [FOLDER]

A vehicle is bodies, couplings and wheelsets on a drawing: x forward from its middle, y left, z up from the
rails, springs unloaded. The numbers are round ones of a wagon of 20 t; nobody built it. Draws it, too.
"""

import sys
import tempfile
from pathlib import Path

from damage.summary import wheelset_summary
from hh_exudyn.case import Case, CurveCase, StraightCase, TrackCase, TransitionCase
from hh_exudyn.figures.vehicle import summary, vehicle_sheet
from hh_exudyn.multibody.simulate import simulate
from vehicles.couplings import AxleBoxPad
from vehicles.description import Body, Coupler, Vehicle, Wheelset

RADIUS, WHEELBASE, HALF_SPACING, LENGTH = 0.46, 6.0, 1.0, 10.0  # m
STIFFNESS, DAMPING = (1.0e6, 0.5e6, 1.2e6), (20e3, 20e3, 30e3)  # of a link, along x, y, z [N/m], [N s/m]
CURVE = CurveCase(length_m=40, radius_m=300, hand="left", cant_mm=80)
TRACK = TrackCase(sections=(StraightCase(length_m=20), TransitionCase(length_m=30), CURVE))


def two_axle_wagon() -> Vehicle:
    bodies = [Body("body", "car_body", 17.4e3, (20e3, 140e3, 145e3), (0.0, 0.0, 1.6))]
    couplings = []
    for number, x in ((1, WHEELBASE / 2), (2, -WHEELBASE / 2)):
        axle = f"wheelset_{number}"
        bodies.append(Body(axle, "wheelset", 1300.0, (750.0, 100.0, 750.0), (x, 0.0, RADIUS)))
        for side, y in (("L", HALF_SPACING), ("R", -HALF_SPACING)):
            link = f"link_{number}{side}"
            couplings.append(AxleBoxPad(link, "body", axle, (x, y, RADIUS), STIFFNESS, DAMPING, 0.0, 0.0))
    return Vehicle(
        name="two_axle_wagon",
        bodies=tuple(bodies),
        couplings=tuple(couplings),
        wheelsets=(Wheelset("wheelset_1", 1, RADIUS), Wheelset("wheelset_2", 2, RADIUS)),
        coupler=Coupler(("body", "body"), ((LENGTH / 2, 0.0, 1.05), (-LENGTH / 2, 0.0, 1.05)), 200e3, 90e3),
        dimensions={},
    )


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="two-axle-wagon-"))
    wagon = two_axle_wagon()
    case = Case(name="two axles", speed_km_h=60, friction=0.35, track=TRACK)
    run = simulate(case, folder / "run", vehicle=wagon)
    vehicle_sheet(f"{wagon.name}: {summary(wagon)}", wagon).savefig(folder / "wagon.png", dpi=150)
    print(f"{wagon.name}, {wagon.mass / 1e3:.1f} t, {run.directory}")
    for row in wheelset_summary(run, (70.0, 90.0)):  # m, the second half of the curve
        q, y = ("{:.1f} / {:.1f} kN".format(*(1e-3 * force for force in pair)) for pair in (row.Q, row.Y))
        attack = 1e3 * row.angle_of_attack
        print(f"  wheelset {row.wheelset}: Q {q}, Y {y}, angle of attack {attack:.2f} mrad")


if __name__ == "__main__":
    main()
