"""Data of the force kernel by lifetime - constant model, inputs, work space - and the layout of coordinates.

Coordinates: six per body (position of the centre of mass in the global frame, rotation vector); on flexible
track seven per wheelset (`track.support.flexibility`); four per wheelset, two for each wheel: their
VELOCITIES are the longitudinal and lateral slip velocity of wheel on rail as they enter the creepage, in the
axes of that rail's frame R (`contact.types.RailMotion`). Velocities: global velocity and LOCAL angular
velocity, as of Exudyn's `NodeRigidBodyRotVecLG`; generalized forces are the conjugate global force and
local torque.

Reason for the delay of the creepage: a steady-state creep force responds to a sudden velocity without delay,
as a damper C/V of 1 MN s/m and, at low speed, much more, on a rail of 150 kg or on a wheelset's spin. A real
contact must roll about one semi-axis a before its traction is built up (from Cattaneo's shift to Carter's
rolling; Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, 1990, chapter 5, quoted from memory);
until then it is a spring of stiffness C/a, about that of Mindlin. So the velocity u in the creepage follows
the slip velocity v of the wheel on its rail with u' = (v - u) V/a. The delay applies to the slip velocity,
rolling included: a wheel that rolls straight on where its rail bends has a new direction relative to the
rail, but no slip, and so no creepage. Steady rolling is not affected; without the delay the explicit
integration would need steps proportional to the speed, and its instability beyond them resembles creep.
"""

from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.check_rail.table import BACK_COLUMNS, CheckRailTable
from hh_exudyn.contact.friction import FrictionTable
from hh_exudyn.contact.state import PATCH_COLUMNS
from hh_exudyn.contact.strips.table import CAPACITY
from hh_exudyn.contact.types import MAX_PATCHES, WheelRailModel
from hh_exudyn.kernel import inlined_kernel
from track.course.alignment import AlignmentTable
from track.irregularity.table import IrregularityTable
from track.support.substructure import TrackParameters

BODY_COORDINATES = 6
TRACK_COORDINATES = 7  # per wheelset, on flexible track
CREEP_COORDINATES = 4  # per wheelset: left longitudinal, left lateral, right longitudinal, right lateral


class Ledger(IntEnum):
    """Powers of one evaluation [W], dissipation positive, and the force of the train [N]."""

    COUPLER_FORCE = 0
    COUPLER_POWER = 1
    CONTACT_POWER = 2
    FRICTION_POWER = 3
    DAMPER_POWER = 4
    DRIVE_POWER = 5  # given by the drives, positive in traction
    BRAKE_POWER = 6  # taken by brake shoes


class CouplingRecord(IntEnum):
    """Force [N] and moment [N m] of a coupling on its body B, and its displacement [m]."""

    FORCE_X = 0
    FORCE_Y = 1
    FORCE_Z = 2
    MOMENT_X = 3
    MOMENT_Y = 4
    MOMENT_Z = 5
    DISPLACEMENT_X = 6
    DISPLACEMENT_Y = 7
    DISPLACEMENT_Z = 8


SLIDERS = 6  # slider coordinates reserved for each coupling


class Couplings(NamedTuple):
    """All couplings of a vehicle as arrays, one row each.

    Body A here has the axes. It is the description's, unless that is a wheelset: then the two are exchanged
    and `sense` is -1.
    """

    kind: IntArray  # (n,) number of the family in `couplings.dispatch.FAMILIES`
    sense: FloatArray  # (n,) 1, or -1 where body A here is body B of the description
    body_a: IntArray  # (n,)
    body_b: IntArray  # (n,)
    point_a: FloatArray  # (n, 3) in the axes of body A from its centre of mass [m]
    point_b: FloatArray  # (n, 3) of body B
    on_axle: IntArray  # (n,) 1 where body B is a wheelset, else 0
    numbers: Any  # (n,) numbers of its family by name, in the field of the family's name


class Train(NamedTuple):
    """The train coupled to the vehicle: at constant speed, or moved by a controller (`Inputs`)."""

    bodies: IntArray  # (heads,) body number of each coupler head
    heads: FloatArray  # (heads, 3) coupler heads in the axes of their bodies [m]
    start: FloatArray  # (heads,) arc length of the heads on the drawing, at time 0 [m]
    stiffness: float  # all heads together [N/m]
    damping: float  # [N s/m]
    speed: float  # at the start [m/s]
    through: FloatArray  # (heads,) force of the rest of the train through the vehicle, forwards [N]


class Drives(NamedTuple):
    """Motors on wheelsets, with their reactions; empty for a hauled vehicle."""

    bodies: IntArray  # (drives, 2) body numbers of wheelset and motor


class Brakes(NamedTuple):
    """Brake shoes on wheel treads, pressed by their carriers; empty without a brake application."""

    bodies: IntArray  # (shoes, 2) body numbers of wheelset and carrier
    point: FloatArray  # (shoes, 3) of the shoe in the axes of its carrier [m]
    thrust: FloatArray  # (shoes,) of the brake fully applied [N]
    friction: FloatArray  # (shoes,)
    start: float  # time of the brake application [s]
    build_up: float  # duration of the rise to full thrust [s]


class SystemModel(NamedTuple):
    """Constants of a vehicle on a track: nothing writes to them after `assembly.assemble`."""

    mass: FloatArray  # (bodies,) [kg]
    weight: FloatArray  # (bodies,) [N]
    inertia: FloatArray  # (bodies, 3) [kg m^2]
    couplings: Couplings
    start: float  # arc length of the vehicle's middle at the start [m]
    wheelsets: IntArray  # (wheelsets,) body numbers
    wheel_rail: WheelRailModel
    check_rail: CheckRailTable
    friction: FrictionTable
    alignment: AlignmentTable
    irregularity: IrregularityTable
    cant_ramp_slope: bool  # whether rails rise and fall with a cant ramp, or lie along the centre line
    flexible: bool
    track: TrackParameters
    shortest_transition: float  # of the creepage, a lower bound of the semi-axis a [m]
    track_mass: FloatArray  # (TRACK_COORDINATES,) [kg], [kg m^2]
    train: Train
    drives: Drives
    brakes: Brakes


class Inputs(NamedTuple):
    """Quantities set by the equilibrium and by controllers; the kernels only read them."""

    train_start: FloatArray  # (heads,) arc length of the coupler heads at time 0 without coupler force [m]
    train_course: (
        FloatArray  # (2,) place of the train at time 0 as its speed now extrapolates it [m], speed [m/s]
    )
    drive_torque: FloatArray  # (drives,) of each motor on its wheelset about the axle, forwards [N m]
    coupling_shift: FloatArray  # (couplings,) of the force-free place along x of body A [m]
    coupling_stiffness: FloatArray  # (couplings,) factor on the longitudinal stiffness of axle-box pads


class Workspace(NamedTuple):
    """Inputs, and arrays that the kernel fills; `generalized_force` is its result."""

    inputs: Inputs
    position: FloatArray  # (bodies, 3)
    rotation: FloatArray  # (bodies, 3, 3) body to global
    velocity: FloatArray  # (bodies, 3)
    angular_velocity: FloatArray  # (bodies, 3), global axes
    force: FloatArray  # (bodies, 3), global axes
    torque: FloatArray  # (bodies, 3), global axes
    arc_length: FloatArray  # (wheelsets + heads,), also the next guess
    track_rotation: FloatArray  # (wheelsets, 3, 3) frame T to global
    frame_position: FloatArray  # (wheelsets, 3) of the wheelsets in their frames T
    frame_axle: FloatArray  # (wheelsets, 3)
    frame_velocity: FloatArray  # (wheelsets, 3)
    frame_angular_velocity: FloatArray  # (wheelsets, 3)
    rail_position: FloatArray  # (wheelsets, 2, 2), this and the next three as in `RailMotion`
    rail_rotation: FloatArray  # (wheelsets, 2, 3, 3)
    rail_turn: FloatArray  # (wheelsets, 3)
    rail_velocity: FloatArray  # (wheelsets, 2, 2)
    creep_lag: FloatArray  # (wheelsets, 2, 2)
    wrench: FloatArray  # (wheelsets, 6)
    rail_force: FloatArray  # (wheelsets, 2, 2)
    patches: FloatArray  # (wheelsets, 2, MAX_PATCHES, PATCH_COLUMNS)
    backs: FloatArray  # (wheelsets, 2, BACK_COLUMNS) of the flange backs on check rails
    in_contact: FloatArray  # (wheelsets, 2, CAPACITY) strips, also the next guess
    refine: FloatArray  # (1,) whether a record of the contacts is wanted, as in `ContactForces`
    new_sliders: FloatArray  # (couplings, SLIDERS)
    coupling_record: FloatArray  # (couplings, len(CouplingRecord)), in the axes of body A
    ledger: FloatArray  # (len(Ledger),)
    generalized_force: FloatArray  # (coordinates,)


@inlined_kernel
def first_track(model: SystemModel) -> int:
    """Number of the first coordinate of the track.

    Parameters
    ----------
    model : its bodies are counted
    """
    return BODY_COORDINATES * model.mass.size


@inlined_kernel
def first_creep(model: SystemModel) -> int:
    """Number of the first creep coordinate.

    Parameters
    ----------
    model : its bodies and wheelsets are counted
    """
    track = TRACK_COORDINATES * model.wheelsets.size if model.flexible else 0
    return BODY_COORDINATES * model.mass.size + track


def coordinates(model: SystemModel) -> int:
    """Number of all coordinates of a model.

    Parameters
    ----------
    model : numbers of bodies and wheelsets, and the kind of track, are read
    """
    return first_creep(model) + CREEP_COORDINATES * len(model.wheelsets)


def drawn_inputs(model: SystemModel) -> Inputs:
    """Inputs without controller: the train at its position on the drawing and at its speed, no torques.

    Parameters
    ----------
    model : numbers of couplings and drives, and the train, are read
    """
    couplings = model.couplings.kind.size
    return Inputs(
        train_start=model.train.start.copy(),
        train_course=np.array([0.0, model.train.speed]),
        drive_torque=np.zeros(len(model.drives.bodies)),
        coupling_shift=np.zeros(couplings),
        coupling_stiffness=np.ones(couplings),
    )


def workspace(model: SystemModel) -> Workspace:
    """Work space for the model, all zero, with the inputs `drawn_inputs`.

    Parameters
    ----------
    model : its sizes and its train are read
    """
    bodies = len(model.mass)
    wheelsets = len(model.wheelsets)
    return Workspace(
        inputs=drawn_inputs(model),
        position=np.zeros((bodies, 3)),
        rotation=np.zeros((bodies, 3, 3)),
        velocity=np.zeros((bodies, 3)),
        angular_velocity=np.zeros((bodies, 3)),
        force=np.zeros((bodies, 3)),
        torque=np.zeros((bodies, 3)),
        arc_length=np.zeros(wheelsets + len(model.train.bodies)),
        track_rotation=np.zeros((wheelsets, 3, 3)),
        frame_position=np.zeros((wheelsets, 3)),
        frame_axle=np.zeros((wheelsets, 3)),
        frame_velocity=np.zeros((wheelsets, 3)),
        frame_angular_velocity=np.zeros((wheelsets, 3)),
        rail_position=np.zeros((wheelsets, 2, 2)),
        rail_rotation=np.zeros((wheelsets, 2, 3, 3)),
        rail_turn=np.zeros((wheelsets, 3)),
        rail_velocity=np.zeros((wheelsets, 2, 2)),
        creep_lag=np.zeros((wheelsets, 2, 2)),
        wrench=np.zeros((wheelsets, 6)),
        rail_force=np.zeros((wheelsets, 2, 2)),
        patches=np.zeros((wheelsets, 2, MAX_PATCHES, PATCH_COLUMNS)),
        backs=np.zeros((wheelsets, 2, BACK_COLUMNS)),
        in_contact=np.zeros((wheelsets, 2, CAPACITY)),
        refine=np.zeros(1),
        new_sliders=np.zeros((len(model.couplings.kind), SLIDERS)),
        coupling_record=np.zeros((len(model.couplings.kind), len(CouplingRecord))),
        ledger=np.zeros(len(Ledger)),
        generalized_force=np.zeros(coordinates(model)),
    )
