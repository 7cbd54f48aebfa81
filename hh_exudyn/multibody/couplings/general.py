"""Forces of couplings that any vehicle may have: axle-box pad, axle box, bushing, rod, bump stop.

Each takes displacement and velocity of body B relative to A in the axes of A (see `couplings`), adds what is
lost to the ledger, and returns the force on B, and a moment where it has one.
"""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.model import Ledger, Workspace
from hh_exudyn.multibody.vectors import Triple, rotate_back
from vehicles.force_laws import clearance_stop, dry_friction, tabulated_stop

_FRICTION = int(Ledger.FRICTION_POWER)
_DAMPER = int(Ledger.DAMPER_POWER)


@inlined_kernel
def pad(
    p: FloatArray, d: Triple, v: Triple, rotation_a: FloatArray, rotation_b: FloatArray, work: Workspace
) -> tuple[Triple, Triple]:
    """Linear pad; the wheelset spins, so roll and yaw are those of its axle direction."""
    stiffness, damping = (p[0], p[1], p[2]), (p[3], p[4], p[5])
    roll_stiffness, yaw_stiffness = p[6], p[7]
    work.ledger[_DAMPER] += damping[0] * v[0] ** 2 + damping[1] * v[1] ** 2 + damping[2] * v[2] ** 2
    axle = rotate_back(rotation_a, (rotation_b[0, 1], rotation_b[1, 1], rotation_b[2, 1]))
    return (
        (
            -stiffness[0] * d[0] - damping[0] * v[0],
            -stiffness[1] * d[1] - damping[1] * v[1],
            -stiffness[2] * d[2] - damping[2] * v[2],
        ),
        (-roll_stiffness * axle[2], 0.0, yaw_stiffness * axle[0]),
    )


@inlined_kernel
def shear_friction(
    d: Triple,
    v: Triple,
    stiffness: Triple,
    damping: Triple,
    bound: float,
    slider: FloatArray,
    settle: bool,
    new_slider: FloatArray,
    work: Workspace,
) -> tuple[float, float]:
    """Dry friction (`force_laws.dry_friction`) of two horizontal faces on each other, in x and y.

    Its slider is the first two numbers of the coupling's; with `settle` the faces stick whatever their load.
    """
    force_x, force_y, new_slider[0], new_slider[1] = dry_friction(
        d[0],
        d[1],
        slider[0],
        slider[1],
        v[0],
        v[1],
        stiffness[0],
        stiffness[1],
        damping[0],
        damping[1],
        math.inf if settle else bound,
    )
    work.ledger[_FRICTION] -= force_x * v[0] + force_y * v[1]
    return force_x, force_y


@inlined_kernel
def axle_box(
    p: FloatArray,
    d: Triple,
    v: Triple,
    rotation_a: FloatArray,
    rotation_b: FloatArray,
    slider: FloatArray,
    settle: bool,
    new_slider: FloatArray,
    work: Workspace,
) -> tuple[Triple, Triple]:
    """Pad that shears until its seat slides, and the pedestal's stops; moments as those of `pad`."""
    stiffness, damping = (p[0], p[1], p[2]), (p[3], p[4], p[5])
    roll_stiffness, yaw_stiffness = p[6], p[7]
    friction, longitudinal_clearance, lateral_clearance, stop_stiffness = p[8], p[9], p[10], p[11]
    spring = stiffness[2] * max(d[2], 0.0)
    load = max(spring + damping[2] * v[2], 0.0) if d[2] > 0.0 else 0.0
    work.ledger[_DAMPER] += (load - spring) * v[2]
    force_x, force_y = shear_friction(
        d, v, stiffness, damping, friction * load, slider, settle, new_slider, work
    )
    axle = rotate_back(rotation_a, (rotation_b[0, 1], rotation_b[1, 1], rotation_b[2, 1]))
    return (
        (
            force_x + clearance_stop(d[0], longitudinal_clearance, stop_stiffness),
            force_y + clearance_stop(d[1], lateral_clearance, stop_stiffness),
            -load,
        ),
        (-roll_stiffness * axle[2], 0.0, yaw_stiffness * axle[0]),
    )


@inlined_kernel
def bushing(
    p: FloatArray, d: Triple, v: Triple, angle: Triple, turn: Triple, work: Workspace
) -> tuple[Triple, Triple]:
    """Linear in all six directions, with the preload that it has on the drawing."""
    work.ledger[_DAMPER] += p[3] * v[0] ** 2 + p[4] * v[1] ** 2 + p[5] * v[2] ** 2
    work.ledger[_DAMPER] += p[9] * turn[0] ** 2 + p[10] * turn[1] ** 2 + p[11] * turn[2] ** 2
    return (
        (
            p[12] - p[0] * d[0] - p[3] * v[0],
            p[13] - p[1] * d[1] - p[4] * v[1],
            p[14] - p[2] * d[2] - p[5] * v[2],
        ),
        (
            -p[6] * angle[0] - p[9] * turn[0],
            -p[7] * angle[1] - p[10] * turn[1],
            -p[8] * angle[2] - p[11] * turn[2],
        ),
    )


@inlined_kernel
def rod(p: FloatArray, d: Triple, v: Triple, work: Workspace) -> Triple:
    """Along the line `d` from end A to end B, in which force and reaction need no moment to balance."""
    drawing_length, stiffness, damping = p[0], p[1], p[2]
    length = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
    rate = (d[0] * v[0] + d[1] * v[1] + d[2] * v[2]) / length
    work.ledger[_DAMPER] += damping * rate * rate
    pull = (stiffness * (length - drawing_length) + damping * rate) / length
    return -pull * d[0], -pull * d[1], -pull * d[2]


@inlined_kernel
def bump_stop(p: FloatArray, d: Triple) -> Triple:
    """Along its axis only: the table of `tabulated_stop`, on one side or, when odd, on both."""
    along = d[0] * p[0] + d[1] * p[1] + d[2] * p[2]
    odd, points = p[3] > 0.5, int(p[4])
    if odd and along < 0.0:
        force = tabulated_stop(-along, p[5:], points)
    else:
        force = -tabulated_stop(along, p[5:], points)
    return force * p[0], force * p[1], force * p[2]
