"""Forces of a whole vehicle on its track in one kernel call: couplings, rails, track, train, brakes."""

import math

from hh_exudyn.contact.types import FloatArray, Patch
from hh_exudyn.contact.wheel_rail import wheel_rail_forces
from hh_exudyn.kernel import Bundle, inlined_kernel, kernel
from hh_exudyn.multibody.brakes import brake_forces
from hh_exudyn.multibody.couplings import coupling_forces
from hh_exudyn.multibody.model import (
    BODY_COORDINATES,
    CREEP_COORDINATES,
    TRACK_COORDINATES,
    Ledger,
    SystemModel,
    Workspace,
    first_creep,
    first_track,
)
from hh_exudyn.multibody.vectors import add_to, cross, rotate, rotate_back, rotation_matrix, triple
from track.alignment import inclined_frame, inclined_locate, inclined_rotation
from track.irregularity_table import irregularity_at, rail_displacements
from track.substructure import track_forces

_FORCE = int(Ledger.COUPLER_FORCE)
_COUPLER = int(Ledger.COUPLER_POWER)
_CONTACT = int(Ledger.CONTACT_POWER)
_DAMPER = int(Ledger.DAMPER_POWER)
_DRIVE = int(Ledger.DRIVE_POWER)
_POWER = int(Patch.POWER)
_A = int(Patch.A)


@inlined_kernel
def evaluate(
    model: SystemModel,
    work: Workspace,
    sliders: FloatArray,
    q: FloatArray,
    v: FloatArray,
    time: float,
    settle: bool,
) -> int:
    """Fill `work.generalized_force` for the coordinates q and velocities v (layout: `model`).

    Returns 0, or the status of `wheel_rail_forces` (1 + number of the wheel that became NaN, counted
    1L, 1R, 2L, ...). With `settle` friction elements are those of `coupling_forces`.
    """
    for k in range(work.ledger.size):
        work.ledger[k] = 0.0
    _body_states(model, work, q, v)
    coupling_forces(model.couplings, sliders, settle, work)
    _train_forces(model, work, time)
    _drive_torques(model, work)
    brake_forces(model.brakes, work, time)
    _wheelset_states(model, work, q, v)
    status = wheel_rail_forces(
        model.wheel_rail,
        work.frame_position,
        work.frame_axle,
        work.frame_velocity,
        work.frame_angular_velocity,
        work.rail_displacement,
        work.rail_velocity,
        work.creep_lag,
        work.gauge,
        work.arc_length[: model.wheelsets.size],
        model.friction,
        work.wrench,
        work.rail_force,
        work.patches,
    )
    _contact_forces(model, work)
    _generalized_forces(model, work, q, v)
    return status


@kernel
def evaluate_bundle(
    bundle: Bundle, sliders: FloatArray, q: FloatArray, v: FloatArray, time: float, settle: bool
) -> int:
    """`evaluate` for a bundle of model and work space: the call that is made ten thousand times a second."""
    return evaluate(bundle.model, bundle.work, sliders, q, v, time, settle)


@inlined_kernel
def _body_states(model: SystemModel, work: Workspace, q: FloatArray, v: FloatArray) -> None:
    """Pose and velocity of every body in global axes, and gravity as its first force."""
    for i in range(model.mass.size):
        k = BODY_COORDINATES * i
        rotation_matrix(q[k + 3], q[k + 4], q[k + 5], work.rotation[i])
        angular_velocity = rotate(work.rotation[i], triple(v[k + 3 :]))
        for axis in range(3):
            work.position[i, axis] = q[k + axis]
            work.velocity[i, axis] = v[k + axis]
            work.angular_velocity[i, axis] = angular_velocity[axis]
            work.force[i, axis] = 0.0
            work.torque[i, axis] = 0.0
        work.force[i, 2] = -model.weight[i]


@inlined_kernel
def _train_forces(model: SystemModel, work: Workspace, time: float) -> None:
    """The train pulls at the coupler heads along the track, as if its neighbours kept to their course.

    Places and the speed of the train count in plan, as chainage does; the force points along the gradient.
    """
    train = model.train
    heads = train.bodies.size
    for head in range(heads):
        body = train.bodies[head]
        arm = rotate(work.rotation[body], triple(train.heads[head]))
        place = model.wheelsets.size + head
        s = inclined_locate(
            model.alignment,
            work.position[body, 0] + arm[0],
            work.position[body, 1] + arm[1],
            work.position[body, 2] + arm[2],
            work.arc_length[place],
        )
        work.arc_length[place] = s
        _, _, _, heading, pitch, _, _, _ = inclined_frame(model.alignment, s)
        level = math.cos(pitch)
        ahead = (level * math.cos(heading), level * math.sin(heading), -math.sin(pitch))
        swing = cross(triple(work.angular_velocity[body]), arm)
        speed = (
            (work.velocity[body, 0] + swing[0]) * ahead[0]
            + (work.velocity[body, 1] + swing[1]) * ahead[1]
            + (work.velocity[body, 2] + swing[2]) * ahead[2]
        )
        force = (
            train.stiffness * (train.start[head] + train.course[0] + train.course[1] * time - s)
            + train.damping * (train.course[1] - speed * level)
        ) / heads + train.through[head]
        vector = (force * ahead[0], force * ahead[1], force * ahead[2])
        add_to(work.force[body], vector, 1.0)
        add_to(work.torque[body], cross(arm, vector), 1.0)
        work.ledger[_FORCE] += force
        work.ledger[_COUPLER] += force * speed


@inlined_kernel
def _drive_torques(model: SystemModel, work: Workspace) -> None:
    """Every motor turns its wheelset about the axle, and itself the other way."""
    for drive in range(model.drives.torque.size):
        wheelset = model.drives.bodies[drive, 0]
        motor = model.drives.bodies[drive, 1]
        torque = model.drives.torque[drive]
        turned = work.rotation[wheelset]
        axle = (turned[0, 1], turned[1, 1], turned[2, 1])
        add_to(work.torque[wheelset], axle, torque)
        add_to(work.torque[motor], axle, -torque)
        for axis in range(3):
            turn = work.angular_velocity[wheelset, axis] - work.angular_velocity[motor, axis]
            work.ledger[_DRIVE] += torque * axle[axis] * turn


@inlined_kernel
def _wheelset_states(model: SystemModel, work: Workspace, q: FloatArray, v: FloatArray) -> None:
    """Pose and velocity of every wheelset in its own frame T, and the state of the rails under it.

    The rails are taken as running along T's x axis: on a cant or gauge ramp they do so up to the ramp's slope
    (below 1e-3), which makes a false approach rate of some mm/s.
    """
    for w in range(model.wheelsets.size):
        body = model.wheelsets[w]
        s = inclined_locate(
            model.alignment,
            work.position[body, 0],
            work.position[body, 1],
            work.position[body, 2],
            work.arc_length[w],
        )
        work.arc_length[w] = s
        x, y, z, heading, pitch, roll, _, gauge = inclined_frame(model.alignment, s)
        frame = work.track_rotation[w]
        inclined_rotation(heading, pitch, roll, frame)
        work.gauge[w] = gauge
        offset = (work.position[body, 0] - x, work.position[body, 1] - y, work.position[body, 2] - z)
        turned = work.rotation[body]
        for row, vector in (
            (work.frame_position[w], offset),
            (work.frame_axle[w], (turned[0, 1], turned[1, 1], turned[2, 1])),
            (work.frame_velocity[w], triple(work.velocity[body])),
            (work.frame_angular_velocity[w], triple(work.angular_velocity[body])),
        ):
            local = rotate_back(frame, vector)
            row[0] = local[0]
            row[1] = local[1]
            row[2] = local[2]
        _rail_states(model, work, q, v, w)
        k = first_creep(model) + CREEP_COORDINATES * w
        velocity = work.frame_velocity[w]
        turn = work.frame_angular_velocity[w]
        for side in range(2):
            # of wheel against rail at the running circle; what a patch lies off it is small and not delayed
            lateral = model.wheel_rail.running_circle_distance * (1 - 2 * side)
            ahead = velocity[0] - turn[1] * model.wheel_rail.nominal_radius - turn[2] * lateral
            sideways = velocity[1] - work.rail_velocity[w, side, 0]
            work.creep_lag[w, side, 0] = v[k + 2 * side] - ahead
            work.creep_lag[w, side, 1] = v[k + 2 * side + 1] - sideways


@inlined_kernel
def _rail_states(model: SystemModel, work: Workspace, q: FloatArray, v: FloatArray, w: int) -> None:
    """Where the rails under a wheelset lie and how they move: track irregularity, and what gives way."""
    state = irregularity_at(model.irregularity, work.arc_length[w])
    lies = rail_displacements(state[0], state[1], state[2], state[3])
    rises = rail_displacements(state[4], state[5], state[6], state[7])
    speed = work.frame_velocity[w, 0]
    for side in range(2):
        for axis in range(2):
            work.rail_displacement[w, side, axis] = lies[2 * side + axis]
            work.rail_velocity[w, side, axis] = speed * rises[2 * side + axis]
    if model.flexible:
        k = first_track(model) + TRACK_COORDINATES * w
        for side in range(2):
            for axis in range(2):
                work.rail_displacement[w, side, axis] += q[k + 2 * side + axis]
                work.rail_velocity[w, side, axis] += v[k + 2 * side + axis]


@inlined_kernel
def _contact_forces(model: SystemModel, work: Workspace) -> None:
    """Wrenches of the rails onto the wheelsets, and the power lost in the contacts."""
    for w in range(model.wheelsets.size):
        body = model.wheelsets[w]
        frame = work.track_rotation[w]
        add_to(work.force[body], rotate(frame, triple(work.wrench[w])), 1.0)
        add_to(work.torque[body], rotate(frame, triple(work.wrench[w, 3:])), 1.0)
        for side in range(2):
            for patch in range(work.patches.shape[2]):
                work.ledger[_CONTACT] += work.patches[w, side, patch, _POWER]


@inlined_kernel
def _generalized_forces(model: SystemModel, work: Workspace, q: FloatArray, v: FloatArray) -> None:
    """Global forces and local torques of the bodies, then the forces of the track masses."""
    result = work.generalized_force
    for i in range(model.mass.size):
        k = BODY_COORDINATES * i
        local = rotate_back(work.rotation[i], triple(work.torque[i]))
        for axis in range(3):
            result[k + axis] = work.force[i, axis]
            result[k + 3 + axis] = local[axis]
    for w in range(model.wheelsets.size):
        if model.flexible:
            k = first_track(model) + TRACK_COORDINATES * w
            end = k + TRACK_COORDINATES
            work.ledger[_DAMPER] += track_forces(
                model.track, work.arc_length[w], q[k:end], v[k:end], work.rail_force[w], result[k:end]
            )
        k = first_creep(model) + CREEP_COORDINATES * w
        for side in range(2):
            transition = max(work.patches[w, side, 0, _A], model.shortest_transition)
            rate = work.frame_velocity[w, 0] / transition
            for axis in range(2):
                result[k + 2 * side + axis] = -rate * work.creep_lag[w, side, axis]


@kernel
def energies(model: SystemModel, work: Workspace, v: FloatArray) -> tuple[float, float]:
    """Kinetic energy of bodies and track masses, and potential energy of gravity [J], after `evaluate`."""
    kinetic = 0.0
    potential = 0.0
    for i in range(model.mass.size):
        k = BODY_COORDINATES * i
        potential += model.weight[i] * work.position[i, 2]
        for axis in range(3):
            kinetic += 0.5 * model.mass[i] * v[k + axis] ** 2
            kinetic += 0.5 * model.inertia[i, axis] * v[k + 3 + axis] ** 2
    if model.flexible:
        for w in range(model.wheelsets.size):
            k = first_track(model) + TRACK_COORDINATES * w
            for n in range(TRACK_COORDINATES):
                kinetic += 0.5 * model.track_mass[n] * v[k + n] ** 2
    return kinetic, potential
