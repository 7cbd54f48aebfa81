"""Forces of a whole vehicle on its track in one kernel call: couplings, rails, track, train, brakes."""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.check_rail.forces import check_rail_forces
from hh_exudyn.contact.check_rail.table import BackContact
from hh_exudyn.contact.geometry.rail_tables import gauge_point_at
from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import ContactForces, RailMotion, WheelsetMotion
from hh_exudyn.contact.wheel_rail import wheel_rail_forces
from hh_exudyn.kernel import Bundle, allocating_kernel, inlined_kernel, kernel
from hh_exudyn.multibody.brakes import brake_forces
from hh_exudyn.multibody.couplings.dispatch import coupling_forces
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
from track.course.alignment import inclined_frame, inclined_locate, inclined_rotation
from track.course.frame import TrackTurn, track_turn
from track.course.rail_frame import RailShift, rail_frame
from track.irregularity.table import irregularity_at
from track.support.substructure import rail_shift, track_forces


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

    Parameters
    ----------
    model, work : constant model; inputs and work space
    sliders : (couplings, SLIDERS) friction sliders of the last accepted step [m] or [rad]
    q, v : (coordinates,) coordinates and velocities
    time : since the start [s]
    settle : for the equilibrium: friction as in `coupling_forces`, and no passing of sleepers

    Returns
    -------
    0, or the status of `wheel_rail_forces`: 1 + number of the wheel with forces that are not finite, counted
    1L, 1R, 2L, ...
    """
    for k in range(work.ledger.size):
        work.ledger[k] = 0.0
    _body_states(model, work, q, v)
    coupling_forces(model.couplings, sliders, settle, work, time)
    _train_forces(model, work, time)
    _drive_torques(model, work)
    brake_forces(model.brakes, work, time)
    _wheelset_states(model, work, q, v, settle)
    wheelsets = WheelsetMotion(
        work.frame_position,
        work.frame_axle,
        work.frame_velocity,
        work.frame_angular_velocity,
        work.creep_lag,
    )
    rails = RailMotion(
        work.arc_length[: model.wheelsets.size],
        work.rail_position,
        work.rail_rotation,
        work.rail_turn,
        work.rail_velocity,
    )
    forces = ContactForces(work.wrench, work.rail_force, work.patches, work.in_contact, work.refine)
    status = wheel_rail_forces(model.wheel_rail, wheelsets, rails, model.friction, forces)
    if model.check_rail.stretches.shape[0] > 0 and status == 0:
        status = check_rail_forces(model.check_rail, model.wheel_rail, wheelsets, rails, forces, work.backs)
    _contact_forces(model, work)
    _generalized_forces(model, work, q, v)
    return status


@allocating_kernel
def evaluate_bundle(
    bundle: Bundle, sliders: FloatArray, q: FloatArray, v: FloatArray, time: float, settle: bool
) -> int:
    """`evaluate` for a bundle of model and work space.

    It is fast to call from Python: a bundle enters a kernel as one pointer (`kernel.Bundle`).

    Parameters
    ----------
    bundle : model and work space
    sliders, q, v, time, settle : as for `evaluate`
    """
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
    """Forces of the train on the coupler heads along the track; the adjacent vehicles follow the track
    exactly.

    Positions and speed of the train are in plan, as chainage is; the force is along the gradient.
    """
    train, inputs = model.train, work.inputs
    course = inputs.train_course
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
            train.stiffness * (inputs.train_start[head] + course[0] + course[1] * time - s)
            + train.damping * (course[1] - speed * level)
        ) / heads + train.through[head]
        vector = (force * ahead[0], force * ahead[1], force * ahead[2])
        add_to(work.force[body], vector, 1.0)
        add_to(work.torque[body], cross(arm, vector), 1.0)
        work.ledger[Ledger.COUPLER_FORCE] += force
        work.ledger[Ledger.COUPLER_POWER] += force * speed


@inlined_kernel
def _drive_torques(model: SystemModel, work: Workspace) -> None:
    """Torque of every motor on its wheelset about the axle, and its reaction on the motor."""
    for drive in range(model.drives.bodies.shape[0]):
        wheelset = model.drives.bodies[drive, 0]
        motor = model.drives.bodies[drive, 1]
        torque = work.inputs.drive_torque[drive]
        turned = work.rotation[wheelset]
        axle = (turned[0, 1], turned[1, 1], turned[2, 1])
        add_to(work.torque[wheelset], axle, torque)
        add_to(work.torque[motor], axle, -torque)
        for axis in range(3):
            turn = work.angular_velocity[wheelset, axis] - work.angular_velocity[motor, axis]
            work.ledger[Ledger.DRIVE_POWER] += torque * axle[axis] * turn


@inlined_kernel
def _wheelset_states(model: SystemModel, work: Workspace, q: FloatArray, v: FloatArray, settle: bool) -> None:
    """Pose and velocity of every wheelset in its own frame T, and the state of the rails under it."""
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
        turn = track_turn(model.alignment, s, pitch, roll)
        if not model.cant_ramp_slope:
            turn = TrackTurn(turn.ahead, 0.0, turn.pitch, turn.yaw, turn.gauge)
        _rail_states(model, work, q, v, w, turn, gauge, settle)
        _creep_lags(model, work, v, w)


@inlined_kernel
def _rail_states(
    model: SystemModel,
    work: Workspace,
    q: FloatArray,
    v: FloatArray,
    w: int,
    turn: TrackTurn,
    gauge: float,
    settle: bool,
) -> None:
    """Position, direction and velocity of the rails under a wheelset.

    With `settle` the track has constant stiffness: the force of the train at the start is then a mean over
    the sleepers, without the slopes of the rails at the start position.
    """
    s = work.arc_length[w]
    irregular = irregularity_at(model.irregularity, s)
    twist = 0.0
    for side in range(2):
        shift = RailShift(0.0, 0.0, 0.0, 0.0)
        if model.flexible:
            k = first_track(model) + TRACK_COORDINATES * w
            end = k + TRACK_COORDINATES
            shift = rail_shift(model.track, s, side, q[k:end])
            if settle:
                shift = RailShift(shift.lateral, shift.vertical, 0.0, 0.0)
            # the deflection by passing sleepers is travelled over: it is no velocity of the rail's material
            speed = work.frame_velocity[w, 0]
            work.rail_velocity[w, side, 0] = v[k + 2 * side] - speed * shift.heading
            work.rail_velocity[w, side, 1] = v[k + 2 * side + 1] - speed * shift.slope
        rails = model.wheel_rail.rails_left if side == 0 else model.wheel_rail.rails_right
        twist = rail_frame(
            turn,
            0.5 * gauge + gauge_point_at(rails, s),
            1.0 - 2.0 * side,
            irregular,
            shift,
            work.rail_position[w, side],
            work.rail_rotation[w, side],
        )
    work.rail_turn[w, 0] = twist
    work.rail_turn[w, 1] = turn.pitch
    work.rail_turn[w, 2] = turn.yaw


@inlined_kernel
def _creep_lags(model: SystemModel, work: Workspace, v: FloatArray, w: int) -> None:
    """Lag of the slip in the creepages behind that of the wheels at their running circles.

    The slip due to a patch's distance from the running circle is small and not delayed.
    """
    k = first_creep(model) + CREEP_COORDINATES * w
    radius = model.wheel_rail.nominal_radius
    for side in range(2):
        rail = work.rail_rotation[w, side]
        moves = work.rail_velocity[w, side]
        velocity = rotate_back(
            rail,
            (
                work.frame_velocity[w, 0],
                work.frame_velocity[w, 1] - moves[0],
                work.frame_velocity[w, 2] - moves[1],
            ),
        )
        turn = rotate_back(rail, triple(work.frame_angular_velocity[w]))
        lateral = model.wheel_rail.running_circle_distance * (1 - 2 * side)
        ahead = velocity[0] - turn[1] * radius - turn[2] * lateral
        sideways = velocity[1] + turn[0] * radius
        work.creep_lag[w, side, 0] = v[k + 2 * side] - ahead
        work.creep_lag[w, side, 1] = v[k + 2 * side + 1] - sideways


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
                work.ledger[Ledger.CONTACT_POWER] += work.patches[w, side, patch, Patch.POWER]
            work.ledger[Ledger.CONTACT_POWER] += work.backs[w, side, BackContact.POWER]


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
            work.ledger[Ledger.DAMPER_POWER] += track_forces(
                model.track, work.arc_length[w], q[k:end], v[k:end], work.rail_force[w], result[k:end]
            )
        k = first_creep(model) + CREEP_COORDINATES * w
        for side in range(2):
            transition = max(work.patches[w, side, 0, Patch.A], model.shortest_transition)
            rate = work.frame_velocity[w, 0] / transition
            for axis in range(2):
                result[k + 2 * side + axis] = -rate * work.creep_lag[w, side, axis]


@kernel
def energies(model: SystemModel, work: Workspace, v: FloatArray) -> tuple[float, float]:
    """Kinetic energy of bodies and track masses, and potential energy of gravity [J], after `evaluate`.

    Parameters
    ----------
    model, work : as for `evaluate`
    v : (coordinates,) the velocities of that evaluation
    """
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
