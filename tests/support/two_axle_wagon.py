"""A small vehicle for tests: a body on two wheelsets, round numbers."""

from vehicles.couplings import AxleBoxPad
from vehicles.description import Body, Coupler, Vehicle, Wheelset

HALF_WHEELBASE, RADIUS = 3.0, 0.46  # m


def two_axle_wagon() -> Vehicle:
    bodies = [Body("body", "car_body", 17.4e3, (20e3, 140e3, 145e3), (0.0, 0.0, 1.6))]
    couplings = []
    for name, x in (("front", HALF_WHEELBASE), ("rear", -HALF_WHEELBASE)):
        bodies.append(Body(name, "wheelset", 1300.0, (750.0, 100.0, 750.0), (x, 0.0, RADIUS)))
        for side, y in (("L", 1.0), ("R", -1.0)):
            stiffness, damping = (1.0e6, 0.5e6, 1.2e6), (20e3, 20e3, 30e3)
            link = AxleBoxPad(f"{name}{side}", "body", name, (x, y, RADIUS), stiffness, damping, 0.0, 0.0)
            couplings.append(link)
    ends = ((5.0, 0.0, 1.05), (-5.0, 0.0, 1.05))
    return Vehicle(
        name="two_axle_wagon",
        bodies=tuple(bodies),
        couplings=tuple(couplings),
        wheelsets=(Wheelset("front", 1, RADIUS), Wheelset("rear", 2, RADIUS)),
        coupler=Coupler(("body", "body"), ends, 200e3, 90e3),
        dimensions={},
    )
