"""All couplings of a vehicle in one kernel: relative motion, force law, forces and torques on both bodies.

A coupling's displacement is that of its point on body B relative to body A, in the axes of A; force and
moment act on B there, and their opposites on A at the same place, so that no coupling generates energy. On a
wheelset stands an axle box: it does not spin, and its bearings pass no moment about the axle.

A coupling described with a wheelset as body A has the two exchanged here, as the axes of A must not spin. Its
law still gets and returns what is B's of the description: displacement, rate and rotation of the one relative
to the other are the opposites (its `sense`) of those of the exchanged bodies, and so are force and moment.
"""

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.couplings import freight, general, passenger_bogie, three_piece_bogie
from hh_exudyn.multibody.couplings.family import (
    Condition,
    Family,
    Motion,
    matrix,
    one_law,
    spin_free,
    turned_back,
    without,
)
from hh_exudyn.multibody.model import SLIDERS, CouplingRecord, Couplings, Ledger, Workspace
from hh_exudyn.multibody.vectors import add_to, cross, rotate, rotate_back, times, triple

FAMILIES: tuple[Family, ...] = (
    *general.FAMILIES,
    *three_piece_bogie.FAMILIES,
    *passenger_bogie.FAMILIES,
    *freight.FAMILIES,
)

_law = one_law(FAMILIES)


@inlined_kernel
def coupling_forces(
    couplings: Couplings, sliders: FloatArray, settle: bool, work: Workspace, time: float = 0.0
) -> None:
    """Add the forces of all couplings to `work.force` and `work.torque`; fill their sliders and records.

    Parameters
    ----------
    couplings : of the model; their forces are added in their order
    sliders : (couplings, SLIDERS) friction sliders of the last accepted step [m] or [rad]
    settle : for the static equilibrium: wedges have no vertical friction, and all other friction elements
        stick under any load, so that the slider of one unloaded during the search remains in the middle
    work : positions, rotations and velocities of the bodies are read, and the inputs
    time : of the evaluation [s]
    """
    inputs = work.inputs
    for i in range(couplings.kind.size):
        a = couplings.body_a[i]
        b = couplings.body_b[i]
        sense = couplings.sense[i]
        rotation_a = work.rotation[a]
        arm_b = rotate(work.rotation[b], triple(couplings.point_b[i]))
        arm_a = (
            work.position[b, 0] + arm_b[0] - work.position[a, 0],
            work.position[b, 1] + arm_b[1] - work.position[a, 1],
            work.position[b, 2] + arm_b[2] - work.position[a, 2],
        )
        local = rotate_back(rotation_a, arm_a)
        displacement = times(
            sense,
            (
                local[0] - (couplings.point_a[i, 0] + inputs.coupling_shift[i]),
                local[1] - couplings.point_a[i, 1],
                local[2] - couplings.point_a[i, 2],
            ),
        )
        swing_a = cross(triple(work.angular_velocity[a]), arm_a)
        swing_b = cross(triple(work.angular_velocity[b]), arm_b)
        rate = rotate_back(
            rotation_a,
            (
                work.velocity[b, 0] + swing_b[0] - work.velocity[a, 0] - swing_a[0],
                work.velocity[b, 1] + swing_b[1] - work.velocity[a, 1] - swing_a[1],
                work.velocity[b, 2] + swing_b[2] - work.velocity[a, 2] - swing_a[2],
            ),
        )
        turn = (
            work.angular_velocity[b, 0] - work.angular_velocity[a, 0],
            work.angular_velocity[b, 1] - work.angular_velocity[a, 1],
            work.angular_velocity[b, 2] - work.angular_velocity[a, 2],
        )
        rotation_b = matrix(work.rotation[b])
        axle = (work.rotation[b, 0, 1], work.rotation[b, 1, 1], work.rotation[b, 2, 1])
        if couplings.on_axle[i]:
            rotation_b, turn = spin_free(work.rotation[b], rotation_a), without(turn, axle)
        if sense < 0.0:
            rotation_b = turned_back(matrix(rotation_a), rotation_b)
        before = sliders[i]
        reaction = _law(
            couplings.kind[i],
            couplings.numbers[i],
            Motion(displacement, times(sense, rate), times(sense, turn), matrix(rotation_a), rotation_b),
            Condition(
                (before[0], before[1], before[2], before[3], before[4], before[5]),
                settle,
                inputs.coupling_stiffness[i],
                work.ledger[Ledger.FRICTION_POWER],
                work.ledger[Ledger.DAMPER_POWER],
                time,
            ),
        )
        work.ledger[Ledger.FRICTION_POWER] = reaction.friction_power
        work.ledger[Ledger.DAMPER_POWER] = reaction.damper_power
        for k in range(SLIDERS):
            work.new_sliders[i, k] = reaction.slider[k]
        record = work.coupling_record[i]
        for axis in range(3):
            record[CouplingRecord.FORCE_X + axis] = reaction.force[axis]
            record[CouplingRecord.MOMENT_X + axis] = reaction.moment[axis]
            record[CouplingRecord.DISPLACEMENT_X + axis] = displacement[axis]
        force = times(sense, rotate(rotation_a, reaction.force))
        moment = times(sense, rotate(rotation_a, reaction.moment))
        if couplings.on_axle[i]:
            moment = without(moment, axle)
        add_to(work.force[b], force, 1.0)
        add_to(work.force[a], force, -1.0)
        add_to(work.torque[b], cross(arm_b, force), 1.0)
        add_to(work.torque[a], cross(arm_a, force), -1.0)
        add_to(work.torque[b], moment, 1.0)
        add_to(work.torque[a], moment, -1.0)
