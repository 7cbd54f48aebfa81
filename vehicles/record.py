"""The record of a vehicle in the catalogue: name, builder, numbers, description."""

from collections.abc import Callable
from dataclasses import dataclass

from hh_exudyn.sourced import ParameterSet
from vehicles.description import Vehicle


@dataclass(frozen=True)
class VehicleRecord:
    """A vehicle of the catalogue.

    Attributes
    ----------
    name : str
        Its name in case files and commands.
    build : callable
        The `Vehicle` from its name and its numbers; raises ValueError for impossible numbers.
    parameters : callable
        Returns the numbers, mostly `hh_exudyn.sourced.load_parameters` of a file.
    description : str
        One line.
    """

    name: str
    build: Callable[[str, ParameterSet], Vehicle]
    parameters: Callable[[], ParameterSet]
    description: str

    def vehicle(self) -> Vehicle:
        """The vehicle with the numbers of its file."""
        return self.build(self.name, self.parameters())
