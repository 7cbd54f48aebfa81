"""Which bodies a coupling may join, and in which order.

Any coupling joins any two bodies, a wheelset among them as A or as B: there it holds on to an axle box, which
does not spin, at a point of the axle's centre line. Some know their wheelset (`_OF_AXLE_BOXES`): they take it
for their body B however the two are named. Others say in their descriptions which body carries the other, and
turn over with the order of the names.

Not possible, and refused with the reason: two wheelsets by anything but a rod; an axle-box arm without a
wheelset; a body with itself; the ground, which passes by under a vehicle.
"""

import math
from collections.abc import Iterable
from dataclasses import replace

from vehicles.couplings import AxleBox, AxleBoxPad, Coupling, Rod, Vector
from vehicles.freight_couplings import DoubleLink, LenoirSuspension
from vehicles.passenger_bogie import AxleBoxArm

_OF_AXLE_BOXES = (AxleBoxPad, AxleBox, AxleBoxArm, LenoirSuspension, DoubleLink)
_GROUND = ("ground", "track", "earth")


def with_wheelset_last(couplings: Iterable[Coupling], wheelsets: set[str]) -> tuple[Coupling, ...]:
    """The couplings, those of axle boxes with their wheelset as body B.

    Parameters
    ----------
    couplings : of a vehicle
    wheelsets : names of its spinning bodies
    """
    return tuple(
        replace(c, body_a=c.body_b, body_b=c.body_a)
        if isinstance(c, _OF_AXLE_BOXES) and c.body_a in wheelsets and c.body_b not in wheelsets
        else c
        for c in couplings
    )


def require_possible(couplings: Iterable[Coupling], places: dict[str, Vector], wheelsets: set[str]) -> None:
    """Check which bodies couplings join, and where on a wheelset they do.

    Parameters
    ----------
    couplings : of a vehicle
    places : of its bodies on the drawing, by name [m]
    wheelsets : names of its spinning bodies

    Raises
    ------
    ValueError
        A coupling names a body that is not there, or joins two that it cannot join, or holds on to a wheelset
        off its axle.
    """
    for c in couplings:
        what, joined = f"{type(c).__name__} {c.name}", (c.body_a, c.body_b)
        for body in joined:
            if body not in places:
                hint = (
                    "; the ground passes by under a vehicle: hold on to a body with `held_weight`, which "
                    "moves ahead at its speed"
                    if body in _GROUND
                    else f"; allowed: {', '.join(places)}"
                )
                raise ValueError(f"{what}: no body named {body}{hint}")
        if c.body_a == c.body_b:
            raise ValueError(f"{what} joins {c.body_a} to itself; it must join two bodies")
        if isinstance(c, AxleBoxArm) and c.body_b not in wheelsets:
            raise ValueError(
                f"{what} turns on {c.body_b}, which is no wheelset; one of its bodies must be one"
            )
        if c.body_a in wheelsets and c.body_b in wheelsets and not isinstance(c, Rod):
            raise ValueError(
                f"{what} joins the wheelsets {c.body_a} and {c.body_b}, whose bearings pass no moment to "
                "hold it; allowed between two wheelsets: Rod"
            )
        ends = (c.point_a, c.point_b) if isinstance(c, Rod) else (c.point, c.point)
        for body, end in zip(joined, ends, strict=True):
            axle = places[body]
            if body in wheelsets and math.hypot(end[0] - axle[0], end[2] - axle[2]) > 1e-6:
                raise ValueError(
                    f"{what} is fixed to its spinning wheelset at {end} m; it must be on the axle's centre "
                    f"line, x = {axle[0]:g} m, z = {axle[2]:g} m"
                )
