"""The vehicles by name: what builds each of them, out of which numbers.

A vehicle of one's own joins them, for the process at hand, with one line,
``VEHICLES["my_wagon"] = Entry(build, parameters, "what it is")``, where ``build(name, parameters)`` returns
the `Vehicle`; then case files and vehicle files may name it. For a run alone ``simulate(case, folder,
vehicle=...)`` does. Vehicles with a few numbers changed need no code: see `vehicles.variants`.
"""

import difflib
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from vehicles.description import Vehicle
from vehicles.models.cooperrider import cooperrider_bogie
from vehicles.models.locomotive import iore_locomotive
from vehicles.models.manchester import manchester_vehicle_1
from vehicles.models.suspended_wheelset import suspended_wheelset
from vehicles.models.wagon import ore_wagon, ore_wagon_pair
from vehicles.parameters import ParameterSet, load_parameters


@dataclass(frozen=True)
class Entry:
    """A vehicle of the catalogue."""

    build: Callable[[str, ParameterSet], Vehicle]  # from its name and its numbers
    parameters: Callable[[], ParameterSet]
    description: str  # one line


def _wagon(name: str, p: ParameterSet) -> Vehicle:
    return ore_wagon(name, p, p["wagon.payload"])


def _pair(name: str, p: ParameterSet) -> Vehicle:
    return ore_wagon_pair(name, p, p["wagon.payload"])


def _loaded() -> ParameterSet:
    return load_parameters("iore_wagon")


def _empty() -> ParameterSet:
    return _loaded().replace({"wagon.payload": 0.0}, "derived: empty")


def _with_drawbar(unit: Callable[[], ParameterSet]) -> ParameterSet:
    return ParameterSet("iore_wagon_pair", unit().parameters + load_parameters("iore_drawbar").parameters)


VEHICLES: dict[str, Entry] = {
    "iore_wagon_loaded": Entry(_wagon, _loaded, "LKAB iron-ore wagon, one unit, 30 t axle load"),
    "iore_wagon_empty": Entry(_wagon, _empty, "LKAB iron-ore wagon, one unit, without ore"),
    "iore_wagon_pair_loaded": Entry(
        _pair, partial(_with_drawbar, _loaded), "LKAB iron-ore wagon, both units and drawbar, loaded"
    ),
    "iore_wagon_pair_empty": Entry(
        _pair, partial(_with_drawbar, _empty), "LKAB iron-ore wagon, both units and drawbar, empty"
    ),
    "suspended_wheelset": Entry(
        suspended_wheelset,
        partial(load_parameters, "suspended_wheelset"),
        "reference: a wheelset on springs, contact given",
    ),
    "cooperrider_bogie": Entry(
        cooperrider_bogie,
        partial(load_parameters, "cooperrider_bogie"),
        "reference: Cooperrider's bogie, contact given",
    ),
    "manchester_vehicle_1": Entry(
        manchester_vehicle_1,
        partial(load_parameters, "manchester_vehicle_1"),
        "reference: passenger coach of the Manchester benchmarks",
    ),
    "iore_locomotive": Entry(
        iore_locomotive, partial(load_parameters, "iore_locomotive"), "IORE Co-Co locomotive, one unit, 180 t"
    ),
}


def vehicle(name: str) -> Vehicle:
    """The vehicle of that name. Raises ValueError that lists the known names."""
    entry = catalogued(name)
    return entry.build(name, entry.parameters())


def parameters(name: str) -> ParameterSet:
    """The parameters a vehicle is made of, with their sources. Raises ValueError for an unknown name."""
    return catalogued(name).parameters()


def catalogued(name: str) -> Entry:
    """The entry of that name. Raises ValueError that lists the known names."""
    if name not in VEHICLES:
        near = difflib.get_close_matches(name, VEHICLES, n=1, cutoff=0.6)
        hint = f'; did you mean "{near[0]}"?' if near else ""
        raise ValueError(f"vehicle {name!r} is not known; known: {', '.join(sorted(VEHICLES))}{hint}")
    return VEHICLES[name]
