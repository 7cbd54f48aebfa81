"""The vehicles by name."""

from collections.abc import Callable

from vehicles.description import Vehicle
from vehicles.locomotive import iore_locomotive
from vehicles.parameters import ParameterSet, load_parameters
from vehicles.wagon import ore_wagon


def _loaded(name: str) -> Vehicle:
    parameters = load_parameters("iore_wagon")
    return ore_wagon(name, parameters, parameters["wagon.payload"])


def _empty(name: str) -> Vehicle:
    return ore_wagon(name, load_parameters("iore_wagon"), 0.0)


def _locomotive(name: str) -> Vehicle:
    return iore_locomotive(name, load_parameters("iore_locomotive"))


VEHICLES: dict[str, tuple[Callable[[str], Vehicle], str]] = {
    "iore_wagon_loaded": (_loaded, "iore_wagon"),
    "iore_wagon_empty": (_empty, "iore_wagon"),
    "iore_locomotive": (_locomotive, "iore_locomotive"),
}


def vehicle(name: str) -> Vehicle:
    """The vehicle of that name. Raises ValueError that lists the known names."""
    return _entry(name)[0](name)


def parameters(name: str) -> ParameterSet:
    """The parameters a vehicle is made of, with their sources. Raises ValueError for an unknown name."""
    return load_parameters(_entry(name)[1])


def _entry(name: str) -> tuple[Callable[[str], Vehicle], str]:
    if name not in VEHICLES:
        raise ValueError(f"vehicle {name!r} is not known; known: {', '.join(sorted(VEHICLES))}")
    return VEHICLES[name]
