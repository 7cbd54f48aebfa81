"""The vehicles by name: those of `vehicles.models`, and those of other packages.

A package adds vehicles through entry points (`hh_exudyn.entry_points`) of the group ``hh_exudyn.vehicles``,
each a `VehicleRecord`; case files, vehicle files and commands may then name them::

    RECORD = VehicleRecord("my_wagon", build, partial(load_parameters, "my_package", "my_wagon"), "one line")

For a run alone ``simulate(case, folder, vehicle=...)`` does. Vehicles with a few numbers changed need no
code: see `vehicles.variants`.
"""

import difflib

from hh_exudyn.entry_points import entries_of, loaded
from hh_exudyn.sourced import ParameterSet
from vehicles.description import Vehicle
from vehicles.models import RECORDS
from vehicles.record import VehicleRecord

GROUP = "hh_exudyn.vehicles"  # of the entry points

VEHICLES: dict[str, VehicleRecord] = {record.name: record for record in RECORDS}
"""The toolkit's own vehicles."""


def vehicle_names() -> tuple[str, ...]:
    """Names of all vehicles, those of other packages last."""
    return tuple(dict.fromkeys((*VEHICLES, *entries_of(GROUP))))


def vehicle(name: str) -> Vehicle:
    """The vehicle of that name. Raises ValueError as `catalogued`."""
    return catalogued(name).vehicle()


def parameters(name: str) -> ParameterSet:
    """The parameters a vehicle is made of, with their sources. Raises ValueError as `catalogued`."""
    return catalogued(name).parameters()


def catalogued(name: str) -> VehicleRecord:
    """The record of that name; the toolkit's own come before those of other packages.

    Raises
    ------
    ValueError
        One line: an unknown name (lists the known ones), or a package whose record cannot be imported.
    """
    if name in VEHICLES:
        return VEHICLES[name]
    others = entries_of(GROUP)
    if name in others:
        return loaded(others[name], VehicleRecord)
    known = (*VEHICLES, *others)
    near = difflib.get_close_matches(name, known, n=1, cutoff=0.6)
    hint = f'; did you mean "{near[0]}"?' if near else ""
    raise ValueError(f"vehicle {name!r} is not known; known: {', '.join(sorted(known))}{hint}")
