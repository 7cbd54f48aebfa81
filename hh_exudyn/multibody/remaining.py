"""Report on a failed equilibrium: the largest residual force, and the forces on its body."""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.state import Patch
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.model import (
    BODY_COORDINATES,
    CREEP_COORDINATES,
    TRACK_COORDINATES,
    Couplings,
    first_creep,
    first_track,
    workspace,
)
from hh_exudyn.multibody.rolling import RollingVehicle
from hh_exudyn.multibody.system import evaluate_bundle
from track.support.substructure import DOFS

_DIRECTIONS = ("along the track", "to the left", "upwards", "in roll", "in pitch", "in yaw")
_SHARES = 3  # number of the named forces on the body, the largest
_LEAST_SHARE = 1e-3  # of the largest force; smaller ones are not named
_BOUND = 0.99  # of friction times normal force, from which a wheel slides
_WEIGHT = "its weight"


def remaining_force(rolling: RollingVehicle) -> str:
    """The largest residual force in words: its value, its place, and the couplings and wheels in it.

    Parameters
    ----------
    rolling : the vehicle in the state to be reported
    """
    force = rolling.forces().copy()
    size = np.where(np.isfinite(force), np.abs(force), np.inf)
    worst = int(np.argmax(size))
    model = rolling.model
    if worst >= first_creep(model):
        wheelset, creep = divmod(worst - first_creep(model), CREEP_COORDINATES)
        return f"the creepage of {_wheel(wheelset, creep // 2)} still changes by {force[worst]:.3g} m/s^2"
    if worst >= first_track(model):
        wheelset, place = divmod(worst - first_track(model), TRACK_COORDINATES)
        unit = "N m" if DOFS[place].startswith("roll") else "N"
        return (
            f"{force[worst]:.3g} {unit} remains on the track ({DOFS[place]}) under wheelset {wheelset + 1}; "
            f"{_loads(rolling, wheelset)}"
        )
    body, direction = divmod(worst, BODY_COORDINATES)
    unit = "N" if direction < 3 else "N m"
    shares = sorted(_shares(rolling, body, direction).items(), key=lambda share: -abs(share[1]))
    least = _LEAST_SHARE * abs(shares[0][1])
    named = [(name, value) for name, value in shares[:_SHARES] if value != 0.0 and abs(value) >= least]
    parts = ", ".join(f"{name} {value:.3g} {unit}" for name, value in named)
    if {name for name, _ in named} <= {_WEIGHT}:
        parts = f"{parts}, and nothing holds it".removeprefix(", and ")
    text = (
        f"{force[worst]:.3g} {unit} remains on {rolling.vehicle.bodies[body].name} {_DIRECTIONS[direction]} "
        f"(largest there: {parts})"
    )
    for w in np.flatnonzero(model.wheelsets == body):
        text += "; " + _loads(rolling, int(w))
    sliding = _sliding(rolling)
    return f"{text}; creep forces at their bound on {sliding} wheels" if sliding else text


def _wheel(wheelset: int, side: int) -> str:
    return f"wheel {wheelset + 1}{'LR'[side]}"


def _loads(rolling: RollingVehicle, wheelset: int) -> str:
    loads = -rolling.work.rail_force[wheelset, :, 1]
    return ", ".join(f"{_wheel(wheelset, side)} carries {loads[side]:.3g} N" for side in range(2))


def _sliding(rolling: RollingVehicle) -> int:
    """Number of wheels with creep forces at the bound of friction."""
    patches = rolling.work.patches
    creep = np.hypot(patches[..., Patch.FORCE_X], patches[..., Patch.FORCE_Y]).sum(axis=2)
    bound = (patches[..., Patch.FRICTION] * patches[..., Patch.NORMAL_FORCE]).sum(axis=2)
    return int((creep >= _BOUND * bound)[bound > 0.0].sum())


def _shares(rolling: RollingVehicle, body: int, direction: int) -> dict[str, float]:
    """Force of couplings, weight, wheels, and of train, drives and brakes on a body [N or N m], by name."""
    model = rolling.model
    k = BODY_COORDINATES * body + direction
    whole = float(rolling.forces()[k])
    wrench = rolling.work.wrench.copy()
    frames = rolling.work.track_rotation.copy()
    turned = rolling.work.rotation[body].copy()
    bare = _with_couplings(rolling, slice(0, 0))[k]
    shares = {_WEIGHT: -model.weight[body] if direction == 2 else 0.0}
    ends = zip(model.couplings.body_a, model.couplings.body_b, strict=True)
    for i, (a, b) in enumerate(ends):
        if body in (a, b):
            name = rolling.vehicle.couplings[i].name
            shares[name] = float(_with_couplings(rolling, slice(i, i + 1))[k] - bare)
    for w in np.flatnonzero(model.wheelsets == body):
        part = frames[w] @ wrench[w, :3] if direction < 3 else turned.T @ frames[w] @ wrench[w, 3:]
        shares["its wheels on the rails"] = float(part[direction % 3])
    shares["train, drives and brakes"] = whole - sum(shares.values())
    return shares


def _with_couplings(rolling: RollingVehicle, which: slice) -> FloatArray:
    """Generalized forces with the couplings `which` alone."""
    model = rolling.model
    couplings, inputs = model.couplings, rolling.work.inputs
    some = model._replace(couplings=Couplings._make(part[which] for part in couplings))
    work = workspace(some)._replace(
        inputs=inputs._replace(
            coupling_shift=inputs.coupling_shift[which], coupling_stiffness=inputs.coupling_stiffness[which]
        )
    )
    work.arc_length[:] = rolling.work.arc_length
    evaluate_bundle(Bundle(some, work), rolling.sliders[which], rolling.q, rolling.v, 0.0, True)
    return work.generalized_force
