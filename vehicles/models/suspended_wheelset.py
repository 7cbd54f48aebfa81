"""The suspended wheelset, the smallest model that hunts, and its critical speed in closed form."""

import math
from functools import partial

import numpy as np
from numpy.polynomial import Polynomial

from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import AxleBoxPad
from vehicles.description import Body, Coupler, GivenContact, Vehicle, Wheelset
from vehicles.record import VehicleRecord

HELD_MASS = 1e8  # kg, of a body in straight motion, practically unmoved by the forces of a vehicle
_REAL = 1e-9  # largest imaginary part over modulus of a root that counts as real
_VANISHES = 1e-24  # of the largest coefficient: smaller ones of V^4, V^6 have their roots above 1e4 m/s
_TRAIN_STIFFNESS, _TRAIN_DAMPING = 1e6, 1e6  # N/m, N s/m: negligible for `HELD_MASS`


def suspended_wheelset(name: str, p: ParameterSet) -> Vehicle:
    """A wheelset sprung sideways and in yaw in a frame that moves straight on."""
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
    """A body in straight motion at constant speed, with its weight on its couplings [N].

    Parameters
    ----------
    name, kind : of the body
    position : of its centre of mass on the drawing [m]
    weight : carried by its couplings [N]
    """
    return Body(name, kind, HELD_MASS, (HELD_MASS, HELD_MASS, HELD_MASS), position, held_weight=weight)


def towed(body: str, centre: tuple[float, float, float]) -> Coupler:
    """A train of nearly no force: the mass of a held body maintains its speed.

    Parameters
    ----------
    body : name of the held body
    centre : its centre of mass on the drawing [m]
    """
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
    roll: float = 0.0,
    spin_inertia: float = 0.0,
) -> tuple[float, float]:
    """Critical speed and frequency of a suspended wheelset of two degrees of freedom.

    On cones the wheelset rolls by e = `roll` per metre to the left, so the contacts move k = 1 + r0 e times
    as far as the axle, and the spin (inertia J) couples yaw and lateral motion by g = e J V/r0. With the
    creep coefficients f11, f22 of one wheel, half distance a of the contacts and conicity c (change of
    rolling radius over displacement of the axle),

        (m + I e^2) y'' + (2 f22 k^2/V) y'   + k_y y     - 2 f22 k psi - g psi'      = 0,
        I psi''         + (2 f11 a^2/V) psi' + k_psi psi + (2 f11 a c/r0) y + g y'   = 0.

    At the critical speed s = j w solves the characteristic equation. With c1 = 2 f22 k, c2 = 2 f11 a^2,
    p = 2 f11 a c/r0 and h = e J/r0, its odd powers of s give

        w^2 = (c2 k_y + c1 k k_psi + h (c1 + p) V^2)/(c2 (m + I e^2) + c1 k I),

    and its even ones, with that w^2, a cubic equation for V^2,

        V^2 [(k_y - (m + I e^2) w^2)(k_psi - I w^2) + c1 p] - c1 k c2 w^2 - h^2 V^4 w^2 = 0.

    Own derivation; for e = 0 the classical one (Wickens 2003, chapter 5, from memory), linear in V^2.

    Eleven arguments: each is a symbol of the equations.

    Parameters
    ----------
    mass, yaw_inertia : [kg], [kg m^2]
    lateral_stiffness, yaw_stiffness : k_y [N/m], k_psi [N m/rad], not both zero
    longitudinal_creep, lateral_creep : f11, f22 [N]
    half_distance, conicity, radius : [m], [-], [m]
    roll : of the wheelset over its lateral displacement [rad/m]; cones have c/a/(1 - r0 c/a)
    spin_inertia : about the axle [kg m^2]

    Returns
    -------
    speed, frequency : float
        [m/s], infinite where the springs hold the wheelset at any speed; w/(2 pi) of the motion there [Hz].

    Raises
    ------
    ValueError
        A number that is not > 0 (a stiffness: >= 0, not both zero).
    """
    _require_positive(
        ("mass", mass, "kg"),
        ("yaw_inertia", yaw_inertia, "kg m^2"),
        ("longitudinal_creep", longitudinal_creep, "N"),
        ("lateral_creep", lateral_creep, "N"),
        ("half_distance", half_distance, "m"),
        ("conicity", conicity, "-"),
        ("radius", radius, "m"),
        ("lateral_stiffness + yaw_stiffness", min(lateral_stiffness + yaw_stiffness, 1.0), "N/m, N m/rad"),
    )
    _require_not_negative(("roll", roll, "rad/m"), ("spin_inertia", spin_inertia, "kg m^2"))
    _require_not_negative(
        ("lateral_stiffness", lateral_stiffness, "N/m"), ("yaw_stiffness", yaw_stiffness, "N m/rad")
    )
    moved, rolling_mass = 1.0 + radius * roll, mass + yaw_inertia * roll**2
    c1, c2 = 2.0 * lateral_creep * moved, 2.0 * longitudinal_creep * half_distance**2
    steering = 2.0 * longitudinal_creep * half_distance * conicity / radius
    gyroscopic = roll * spin_inertia / radius
    elastic = c2 * lateral_stiffness + c1 * moved * yaw_stiffness
    w2 = Polynomial([elastic, gyroscopic * (c1 + steering)]) / (c2 * rolling_mass + c1 * moved * yaw_inertia)
    v2 = Polynomial([0.0, 1.0])
    even = v2 * ((lateral_stiffness - rolling_mass * w2) * (yaw_stiffness - yaw_inertia * w2) + c1 * steering)
    even = even - c1 * moved * c2 * w2 - gyroscopic**2 * v2**2 * w2
    square = _smallest_positive_root(even)
    frequency = math.sqrt(w2(square if math.isfinite(square) else 0.0)) / (2.0 * math.pi)
    return math.sqrt(square), frequency


def stated_critical_speed(
    p: ParameterSet, conicity: float | None = None, **spin: float
) -> tuple[float, float]:
    """`critical_speed_closed_form` of the vehicle's own numbers: critical speed [m/s] and frequency [Hz].

    Parameters
    ----------
    p : parameters of the suspended wheelset
    conicity : instead of the one stated [-]
    **spin : `roll` and `spin_inertia` of the closed form
    """
    return critical_speed_closed_form(
        p["wheelset.mass"], p["wheelset.yaw_inertia"], p["suspension.lateral_stiffness"],
        p["suspension.yaw_stiffness"], p["contact.longitudinal_creep"], p["contact.lateral_creep"],
        p["contact.half_distance"], conicity or p["contact.conicity"], p["wheelset.radius"], **spin,
    )  # fmt: skip


def _smallest_positive_root(polynomial: Polynomial) -> float:
    """Of its real roots; infinite where none is positive. Its constant term is not zero.

    It is one over the largest root of the polynomial with the coefficients in reverse: the eigenvalues that
    make the roots are exact to the largest one, and roots of V^2 may be twenty orders of magnitude apart.
    """
    trimmed = polynomial.trim(_VANISHES * np.abs(polynomial.coef).max())
    inverse = Polynomial(trimmed.coef[::-1]).roots()
    real = inverse.real[np.abs(inverse.imag) < _REAL * np.abs(inverse)]
    largest = max(real, default=0.0)
    return float(1.0 / largest) if largest > 0.0 else math.inf


def _require_not_negative(*numbers: tuple[str, float, str]) -> None:
    """Raise ValueError for the first number, by label, value and unit, that is below zero."""
    for label, value, unit in numbers:
        if value < 0.0:
            raise ValueError(f"{label} = {value} {unit}: must be >= 0")


def _require_positive(*numbers: tuple[str, float, str]) -> None:
    """Raise ValueError for the first number, by label, value and unit, that is not above zero."""
    for label, value, unit in numbers:
        if not value > 0.0:
            raise ValueError(f"{label} = {value} {unit}: must be > 0")


RECORD = VehicleRecord(
    "suspended_wheelset",
    suspended_wheelset,
    partial(load_parameters, "vehicles", "suspended_wheelset"),
    "reference: a wheelset on springs, contact given",
)
