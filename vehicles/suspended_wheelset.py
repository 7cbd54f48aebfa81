"""The suspended wheelset, the smallest model that hunts, and its critical speed in closed form."""

import math

from vehicles.couplings import AxleBoxPad
from vehicles.description import Body, Coupler, GivenContact, Vehicle, Wheelset
from vehicles.parameters import ParameterSet

HELD_MASS = 1e8  # kg, of a body that the forces of a vehicle shall not move
_TRAIN_STIFFNESS, _TRAIN_DAMPING = 1e6, 1e6  # N/m, N s/m: nothing on `HELD_MASS`, which keeps its speed


def suspended_wheelset(name: str, p: ParameterSet) -> Vehicle:
    """A wheelset sprung sideways and in yaw in a frame that keeps its way (sources: the parameter file)."""
    centre = (0.0, 0.0, p["wheelset.radius"])
    roll, spin = p["wheelset.yaw_inertia"], p["wheelset.spin_inertia"]
    return Vehicle(
        name=name,
        bodies=(
            Body("wheelset_1", "wheelset", p["wheelset.mass"], (roll, spin, roll), centre),
            held_body("frame", "bogie_frame", centre, 0.0),
        ),
        couplings=(
            AxleBoxPad(
                name="suspension",
                body_a="frame",
                body_b="wheelset_1",
                point=centre,
                stiffness=(p["suspension.longitudinal_stiffness"], p["suspension.lateral_stiffness"], 0.0),
                damping=(p["suspension.longitudinal_damping"], 0.0, 0.0),
                roll_stiffness=0.0,
                yaw_stiffness=p["suspension.yaw_stiffness"],
            ),
        ),
        wheelsets=(Wheelset("wheelset_1", 1, p["wheelset.radius"]),),
        coupler=towed("frame", centre),
        dimensions={"wheel_radius": p["wheelset.radius"]},
        contact=given_contact(p),
    )


def held_body(name: str, kind: str, position: tuple[float, float, float], weight: float) -> Body:
    """A body that keeps its straight way at constant speed, and what it weighs on what carries it [N]."""
    return Body(name, kind, HELD_MASS, (HELD_MASS, HELD_MASS, HELD_MASS), position, held_weight=weight)


def towed(body: str, centre: tuple[float, float, float]) -> Coupler:
    """A train that hardly pulls: a held body keeps its speed by its mass."""
    return Coupler((body,), (centre,), _TRAIN_STIFFNESS, _TRAIN_DAMPING)


def given_contact(p: ParameterSet) -> GivenContact:
    """The table [contact] of a reference vehicle's parameters."""
    return GivenContact(
        longitudinal=p["contact.longitudinal_creep"],
        lateral=p["contact.lateral_creep"],
        conicity=p["contact.conicity"],
        half_distance=p["contact.half_distance"],
    )


def critical_speed_closed_form(
    mass: float,
    yaw_inertia: float,
    lateral_stiffness: float,
    yaw_stiffness: float,
    longitudinal_creep: float,
    lateral_creep: float,
    half_distance: float,
    conicity: float,
    radius: float,
) -> tuple[float, float]:
    """Critical speed and frequency of a suspended wheelset of two degrees of freedom.

    With the creep coefficients f11, f22 of one wheel, half distance a of the contacts and conicity c,

        m y''   + (2 f22/V) y'       + k_y y     - 2 f22 psi        = 0,
        I psi'' + (2 f11 a^2/V) psi' + k_psi psi + (2 f11 a c/r0) y = 0.

    At the critical speed s = j w solves the characteristic equation; its odd powers of s give w, without V,
    its even ones V. With c1 = 2 f22, c2 = 2 f11 a^2, P = 4 f11 f22 a c/r0,

        w^2 = (c1 k_psi + c2 k_y)/(m c2 + I c1),
        V^2 = c1 c2/(m I w^2 - m k_psi - I k_y + (k_y k_psi + P)/w^2).

    Own derivation; it is the classical one (for example Wickens 2003, chapter 5, quoted from memory).

    Parameters
    ----------
    mass, yaw_inertia : [kg], [kg m^2]
    lateral_stiffness, yaw_stiffness : k_y [N/m], k_psi [N m/rad], not both zero
    longitudinal_creep, lateral_creep : f11, f22 [N]
    half_distance, conicity, radius : [m], [-], [m]

    Returns
    -------
    speed : float
        [m/s]; infinite where the springs hold the wheelset at any speed.
    frequency : float
        w/(2 pi) of the motion there [Hz].

    Raises
    ------
    ValueError
        A number that is not > 0 (a stiffness: >= 0, not both zero).
    """
    for label, value, unit in (
        ("mass", mass, "kg"),
        ("yaw_inertia", yaw_inertia, "kg m^2"),
        ("longitudinal_creep", longitudinal_creep, "N"),
        ("lateral_creep", lateral_creep, "N"),
        ("half_distance", half_distance, "m"),
        ("conicity", conicity, "-"),
        ("radius", radius, "m"),
        ("lateral_stiffness + yaw_stiffness", min(lateral_stiffness + yaw_stiffness, 1.0), "N/m, N m/rad"),
    ):
        if not value > 0.0:
            raise ValueError(f"{label} = {value} {unit}: must be > 0")
    if min(lateral_stiffness, yaw_stiffness) < 0.0:
        raise ValueError(f"stiffness {lateral_stiffness} N/m, {yaw_stiffness} N m/rad: must be >= 0")
    c1 = 2.0 * lateral_creep
    c2 = 2.0 * longitudinal_creep * half_distance**2
    coupling = 4.0 * longitudinal_creep * lateral_creep * half_distance * conicity / radius
    square = (c1 * yaw_stiffness + c2 * lateral_stiffness) / (mass * c2 + yaw_inertia * c1)
    rest = (
        mass * yaw_inertia * square
        - mass * yaw_stiffness
        - yaw_inertia * lateral_stiffness
        + (lateral_stiffness * yaw_stiffness + coupling) / square
    )
    speed = math.sqrt(c1 * c2 / rest) if rest > 0.0 else math.inf
    return speed, math.sqrt(square) / (2.0 * math.pi)
