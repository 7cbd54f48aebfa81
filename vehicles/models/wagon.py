"""The LKAB iron-ore wagon: a hopper body on two three-piece bogies, alone or as a Fanoo pair of two units."""

from dataclasses import dataclass
from functools import partial

from hh_exudyn.sourced import ParameterSet, load_parameters
from vehicles.couplings import Coupling, Rod
from vehicles.description import Body, BrakeShoe, Vehicle, Wheelset
from vehicles.models.parts import train_coupler
from vehicles.models.three_piece_bogie import (
    SPRING_DEFLECTION,
    bogie_bodies,
    bogie_couplings,
    bogie_shoes,
    bogie_wheelsets,
)
from vehicles.record import VehicleRecord


@dataclass(frozen=True)
class _Unit:
    """A car body with its two bogies."""

    bodies: tuple[Body, ...]  # the car body first
    couplings: tuple[Coupling, ...]
    wheelsets: tuple[Wheelset, ...]
    shoes: tuple[BrakeShoe, ...]


def ore_wagon(name: str, p: ParameterSet, payload: float) -> Vehicle:
    """One unit with a payload of ore [kg] (0 for the empty wagon), leading bogie first.

    Raises ValueError for a payload below zero or above the wagon's 102 t (thesis Table 1-1).

    Parameters
    ----------
    name : of the vehicle
    p : parameters of the wagon
    payload : mass of the ore [kg]
    """
    unit = _unit(name, p, payload, "car_body", 1, 0.0)
    return _vehicle(name, p, payload, (unit,), ())


def ore_wagon_pair(name: str, p: ParameterSet, payload: float) -> Vehicle:
    """Master and slave with a drawbar between them, both with the same payload [kg].

    The leading unit is unit 1. Bogies and wheelsets of a unit count from its leading end, in `Wheelset` and
    in the logs; the bodies are numbered through, ``wheelset_1`` to ``wheelset_8``.

    Raises ValueError as `ore_wagon`.

    Parameters
    ----------
    name : of the vehicle
    p : parameters of wagon and drawbar
    payload : mass of the ore in each unit [kg]
    """
    half = p["wagon.length"] / 2
    units = tuple(
        _unit(name, p, payload, f"car_body_{number}", number, middle)
        for number, middle in ((1, half), (2, -half))
    )
    end, height = p["drawbar.length"] / 2, p["drawbar.height"]
    drawbar = Rod(
        name="drawbar",
        body_a=units[1].bodies[0].name,
        body_b=units[0].bodies[0].name,
        point_a=(-end, 0.0, height),
        point_b=(end, 0.0, height),
        stiffness=p["drawbar.stiffness"],
        damping=p["drawbar.damping"],
    )
    return _vehicle(name, p, payload, units, (drawbar,))


def _unit(name: str, p: ParameterSet, payload: float, car_body: str, number: int, middle: float) -> _Unit:
    """Unit `number` from 1, its middle at x = `middle` [m] of the drawing."""
    most = p["wagon.largest_payload"]
    if not 0.0 <= payload <= most:
        raise ValueError(f"payload of {name} is {payload:.0f} kg; allowed: 0..{most:.0f} kg")
    half = p["wagon.centre_plate_distance"] / 2
    bodies = [_car_body(p, payload, car_body, middle)]
    couplings: list[Coupling] = []
    wheelsets: list[Wheelset] = []
    shoes: list[BrakeShoe] = []
    for of_unit, place in ((1, middle + half), (2, middle - half)):
        bogie = 2 * (number - 1) + of_unit
        bodies += bogie_bodies(p, bogie, place)
        couplings += bogie_couplings(p, bogie, place, car_body)
        wheelsets += bogie_wheelsets(p, bogie, number, of_unit)
        shoes += bogie_shoes(p, bogie, place)
    return _Unit(tuple(bodies), tuple(couplings), tuple(wheelsets), tuple(shoes))


def _vehicle(
    name: str, p: ParameterSet, payload: float, units: tuple[_Unit, ...], between: tuple[Coupling, ...]
) -> Vehicle:
    """The units in a row; `dimensions` are those of one unit."""
    bodies = tuple(body for unit in units for body in unit.bodies)
    end, height = len(units) * p["wagon.length"] / 2, p["coupler.height"]
    heads = {(end, 0.0, height): units[0].bodies[0].name, (-end, 0.0, height): units[-1].bodies[0].name}
    return Vehicle(
        name=name,
        bodies=bodies,
        couplings=(*(coupling for unit in units for coupling in unit.couplings), *between),
        wheelsets=tuple(wheelset for unit in units for wheelset in unit.wheelsets),
        coupler=train_coupler(p, heads, sum(body.mass for body in bodies)),
        dimensions={
            "length": p["wagon.length"],
            "height": p["wagon.height"],
            "basket_width": p["wagon.basket_width"],
            "basket_length": p["wagon.basket_length"],
            "centre_plate_distance": p["wagon.centre_plate_distance"],
            "centre_plate_height": p["centre_plate.height"],
            "wheelbase": p["wheelset.wheelbase"],
            "wheel_radius": p["wheelset.radius"],
            "axle_box_half_spacing": p["wheelset.axle_box_half_spacing"],
            "coupler_height": p["coupler.height"],
            "ore_depth": p["car_body.ore_depth"] if payload else 0.0,
        },
        shoes=tuple(shoe for unit in units for shoe in unit.shoes),
    )


def _car_body(p: ParameterSet, payload: float, name: str, middle: float) -> Body:
    """Tare body and a block of ore as one rigid body (parallel-axis sum)."""
    tare = p["wagon.tare"] - 2 * p["bogie.mass"]
    mass = tare + payload
    height = (tare * p["car_body.tare_height"] + payload * p["car_body.ore_height"]) / mass
    tare_offset = tare * (p["car_body.tare_height"] - height) ** 2
    ore_offset = payload * (p["car_body.ore_height"] - height) ** 2
    length, width, depth = (p[f"car_body.ore_{axis}"] for axis in ("length", "width", "depth"))
    offset = tare_offset + ore_offset
    return Body(
        name,
        "car_body",
        mass,
        (
            tare * p["car_body.tare_roll_gyration"] ** 2 + payload * (width**2 + depth**2) / 12 + offset,
            tare * p["car_body.tare_pitch_gyration"] ** 2 + payload * (length**2 + depth**2) / 12 + offset,
            tare * p["car_body.tare_yaw_gyration"] ** 2 + payload * (length**2 + width**2) / 12,
        ),
        (middle, 0.0, height),
        SPRING_DEFLECTION,
    )


def _record(units: int, loaded: bool) -> VehicleRecord:
    """The record of one unit or a pair, loaded or empty."""
    state = "loaded" if loaded else "empty"
    load = ("30 t axle load" if loaded else "without ore") if units == 1 else state
    return VehicleRecord(
        f"iore_wagon_{'' if units == 1 else 'pair_'}{state}",
        lambda name, p: (ore_wagon if units == 1 else ore_wagon_pair)(name, p, p["wagon.payload"]),
        partial(_parameters, units, loaded),
        f"LKAB iron-ore wagon, {'one unit' if units == 1 else 'both units and drawbar'}, {load}",
    )


def _parameters(units: int, loaded: bool) -> ParameterSet:
    """The numbers of a unit, without payload for the empty one, and for a pair those of the drawbar."""
    unit = load_parameters("vehicles", "iore_wagon")
    if not loaded:
        unit = unit.replace({"wagon.payload": 0.0}, "derived: empty")
    if units == 1:
        return unit
    drawbar = load_parameters("vehicles", "iore_drawbar")
    return ParameterSet("iore_wagon_pair", unit.parameters + drawbar.parameters)


RECORDS = tuple(_record(units, loaded) for units in (1, 2) for loaded in (True, False))
