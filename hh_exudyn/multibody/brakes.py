"""Tread brakes: shoes that are pressed against turning wheels, and hold on to the bodies that carry them."""

from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.model import Brakes, Ledger, Workspace
from hh_exudyn.multibody.vectors import add_to, cross, dot, rotate, triple

_BRAKE = int(Ledger.BRAKE_POWER)
CREEPING = 0.05  # m/s of tread against shoe, below it friction falls with the speed: a wheel comes to rest


@inlined_kernel
def brake_forces(brakes: Brakes, work: Workspace, time: float) -> None:
    """Thrust of every shoe towards the axle, its friction along the tread; their opposites on the carrier.

    Both act where the shoe touches the wheel, so that the friction is a moment about the axle and a force on
    its bearings, and the thrust a force on them.
    """
    share = _share(brakes, time)
    if share == 0.0:
        return
    for shoe in range(brakes.thrust.size):
        wheelset = brakes.bodies[shoe, 0]
        carrier = brakes.bodies[shoe, 1]
        held = rotate(work.rotation[carrier], triple(brakes.point[shoe]))
        centre, holder = work.position[wheelset], work.position[carrier]
        arm = (
            holder[0] + held[0] - centre[0],
            holder[1] + held[1] - centre[1],
            holder[2] + held[2] - centre[2],
        )
        turned = work.rotation[wheelset]
        axle = (turned[0, 1], turned[1, 1], turned[2, 1])
        tangent = cross(axle, arm)  # as long as the radius at which the shoe rubs
        radius = dot(tangent, tangent) ** 0.5
        outwards = cross(tangent, axle)
        slip = _slip(work, wheelset, carrier, arm, held)
        thrust = share * brakes.thrust[shoe]
        rubs = min(max(dot(slip, tangent) / radius / CREEPING, -1.0), 1.0)
        drag = brakes.friction[shoe] * thrust * rubs
        force = (
            -(thrust * outwards[0] + drag * tangent[0]) / radius,
            -(thrust * outwards[1] + drag * tangent[1]) / radius,
            -(thrust * outwards[2] + drag * tangent[2]) / radius,
        )
        add_to(work.force[wheelset], force, 1.0)
        add_to(work.torque[wheelset], cross(arm, force), 1.0)
        add_to(work.force[carrier], force, -1.0)
        add_to(work.torque[carrier], cross(held, force), -1.0)
        work.ledger[_BRAKE] -= dot(force, slip)


@inlined_kernel
def _share(brakes: Brakes, time: float) -> float:
    """Of the full thrust, at a time [s]."""
    since = time - brakes.start
    if since < 0.0:
        return 0.0
    return 1.0 if since >= brakes.build_up else since / brakes.build_up


@inlined_kernel
def _slip(
    work: Workspace,
    wheelset: int,
    carrier: int,
    arm: tuple[float, float, float],
    held: tuple[float, float, float],
) -> tuple[float, float, float]:
    """Velocity of the wheel against its shoe where they touch [m/s]."""
    swing_wheel = cross(triple(work.angular_velocity[wheelset]), arm)
    swing_shoe = cross(triple(work.angular_velocity[carrier]), held)
    moves, holder = work.velocity[wheelset], work.velocity[carrier]
    return (
        moves[0] + swing_wheel[0] - holder[0] - swing_shoe[0],
        moves[1] + swing_wheel[1] - holder[1] - swing_shoe[1],
        moves[2] + swing_wheel[2] - holder[2] - swing_shoe[2],
    )
