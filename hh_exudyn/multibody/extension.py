"""Anybody's own Exudyn items in a vehicle's system: how they are added, and their state at borders.

An extension is a function that gets the system of the vehicle before `Assemble()` and adds nodes, bodies,
connectors, loads or sensors to it. It is called for every system of a run, also at the borders of segments
(`checkpoint`) and where the start is settled, and must add the same items each time; what they start from,
and where they are at a border, is set here.
"""

import hashlib
import inspect
from collections.abc import Callable
from typing import Any

import exudyn as exu
import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.multibody.exudyn_system import ExudynSystem

Extension = Callable[[ExudynSystem], None]

_PLACED = ("Point", "RigidBody")  # node types that begin so have global places as their first coordinates


def label(extension: Extension) -> str:
    """Name of an extension with a hash of its source, or all of an object, for the case of its run.

    Parameters
    ----------
    extension : the function
    """
    if not hasattr(extension, "__qualname__"):  # an object that is called
        return repr(extension)
    name = f"{extension.__module__}.{extension.__qualname__}"
    try:
        source = inspect.getsource(extension)
    except (OSError, TypeError):  # typed in
        return name
    return f"{name} {hashlib.sha256(source.encode()).hexdigest()[:16]}"


def coordinates_of(system: ExudynSystem) -> dict[str, FloatArray]:
    """All coordinates of an assembled system, by name: of second order with their rates, first order, data.

    Those of the vehicle are global ones.

    Parameters
    ----------
    system : after its last step
    """
    data = system.mbs.systemData
    q = data.GetODE2Coordinates()
    q[: system.reference.size] += system.reference
    return {
        "q": q,
        "v": data.GetODE2Coordinates_t(),
        "first_order": data.GetODE1Coordinates(),
        "data": data.GetDataCoordinates(),
    }


def begin_from(system: ExudynSystem, state: dict[str, FloatArray], velocity: FloatArray) -> None:
    """Set where an assembled system begins.

    A state without the coordinates of the extension leaves these as its nodes were made; they then travel
    with the vehicle.

    Parameters
    ----------
    system : assembled
    state : ``q`` and ``v``, and where the extension's items are known too ``first_order`` and ``data``
    velocity : (3,) of the vehicle, for nodes that have a place in the global frame [m/s]

    Raises
    ------
    ValueError
        The extension has not added the same items as before.
    """
    mbs = system.mbs
    data, initial = mbs.systemData, exu.ConfigurationType.Initial
    q, v = data.GetODE2Coordinates(initial), data.GetODE2Coordinates_t(initial)
    own = system.reference.size
    if "data" in state:
        there = {"q": q.size, "first_order": data.GetODE1Coordinates(initial).size}
        there["data"] = data.GetDataCoordinates(initial).size
        for name, size in there.items():
            if state[name].size != size:
                raise ValueError(
                    f"the extension adds other items than before: {size} coordinates {name!r}, first "
                    f"{state[name].size}; it must add the same ones each time"
                )
    elif q.size > own:
        add_to_places(mbs, own, v, velocity)
    given = state["q"].size
    q[:given], v[:given] = state["q"], state["v"]
    q[:own] -= system.reference
    data.SetODE2Coordinates(q, initial)
    data.SetODE2Coordinates_t(v, initial)
    if "data" in state:
        data.SetODE1Coordinates(state["first_order"], initial)
        data.SetDataCoordinates(state["data"], initial)


def add_to_places(mbs: Any, own: int, coordinates: FloatArray, change: FloatArray) -> None:
    """Add a vector to the coordinates, or velocities, of all nodes of the extension that have a place.

    Parameters
    ----------
    mbs : Exudyn's system, assembled
    own : number of the vehicle's own coordinates
    coordinates : of second order, or their rates
    change : (3,) in the global frame [m] or [m/s]
    """
    for number in range(mbs.systemData.NumberOfNodes()):
        kind = str(mbs.GetNode(number)["nodeType"])
        if not kind.startswith(_PLACED) or kind == "PointGround":
            continue
        first = mbs.GetNodeODE2Index(number)
        if first >= own:
            axes = 2 if kind.endswith("2D") else 3
            coordinates[first : first + axes] += np.asarray(change)[:axes]
