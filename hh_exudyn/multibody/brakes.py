"""Tread brakes: shoes pressed against turning wheels, with their reactions on the carriers."""

from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.model import Brakes, Ledger, Workspace
from hh_exudyn.multibody.vectors import add_to, cross, dot, rotate, triple

CREEPING = 0.05  # m/s of tread against shoe; below it friction falls with the speed, so that a wheel can stop


@inlined_kernel
def brake_forces(brakes: Brakes, work: Workspace, time: float) -> None:
    """Thrust of every shoe towards the axle, its friction along the tread; their opposites on the carrier.

    Both act at the contact of shoe and wheel, so that the friction is a moment about the axle and a force on
    its bearings, and the thrust a force on them.

    Parameters
    ----------
    brakes : of the model
    work : poses and velocities of the bodies are read; forces, torques and ledger are added to
    time : since the start [s]
    """
    share = _share(brakes, time)
    if share == 0.0:
        return
    for shoe in range(brakes.thrust.size):
        wheelset = brakes.bodies[shoe, 0]
        carrier = brakes.bodies[shoe, 1]
        lever = rotate(work.rotation[carrier], triple(brakes.point[shoe]))
        centre, holder = work.position[wheelset], work.position[carrier]
        arm = (
            holder[0] + lever[0] - centre[0],
            holder[1] + lever[1] - centre[1],
            holder[2] + lever[2] - centre[2],
        )
        turned = work.rotation[wheelset]
        axle = (turned[0, 1], turned[1, 1], turned[2, 1])
        tangent = cross(axle, arm)  # as long as the radius at which the shoe rubs
        radius = dot(tangent, tangent) ** 0.5
        outwards = cross(tangent, axle)
        slip = _slip(work, wheelset, carrier, arm, lever)
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
        add_to(work.torque[carrier], cross(lever, force), -1.0)
        work.ledger[Ledger.BRAKE_POWER] -= dot(force, slip)


@inlined_kernel
def _share(brakes: Brakes, time: float) -> float:
    """Share of the full thrust at a time [s]."""
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
    lever: tuple[float, float, float],
) -> tuple[float, float, float]:
    """Velocity of the wheel against its shoe at their contact [m/s].

    Parameters
    ----------
    wheelset, carrier : body numbers
    arm, lever : from the centres of wheelset and carrier to the contact, global axes [m]
    """
    swing_wheel = cross(triple(work.angular_velocity[wheelset]), arm)
    swing_shoe = cross(triple(work.angular_velocity[carrier]), lever)
    moves, holder = work.velocity[wheelset], work.velocity[carrier]
    return (
        moves[0] + swing_wheel[0] - holder[0] - swing_shoe[0],
        moves[1] + swing_wheel[1] - holder[1] - swing_shoe[1],
        moves[2] + swing_wheel[2] - holder[2] - swing_shoe[2],
    )
