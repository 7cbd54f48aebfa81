"""What the force kernel of a whole vehicle needs: the model, its work space, and the layout of coordinates.

Coordinates: six per body (position of the centre of mass in the global frame, rotation vector); on flexible
track seven per wheelset (`track.support.flexibility`); four per wheelset, two for each wheel, whose
VELOCITIES are the longitudinal and lateral slip velocity of wheel on rail as the creepage feels them, in the
axes of that rail's frame R (`contact.types.RailMotion`). Velocities: global
velocity and LOCAL angular velocity, as Exudyn's `NodeRigidBodyRotVecLG` has them; generalized forces are the
conjugate global force and local torque.

Why the creepage feels them late: a steady-state creep force answers a sudden velocity at once, as a damper
C/V of 1 MN s/m and, at low speed, much more, on a rail of 150 kg or on a wheelset's spin. A real contact must
roll about one semi-axis a before its traction is built up (from Cattaneo's shift to Carter's rolling; Kalker,
Three-Dimensional Elastic Bodies in Rolling Contact, 1990, chapter 5, quoted from memory); until then it is a
spring of stiffness C/a, about that of Mindlin. So the velocity u that the creepage feels follows the slip
velocity v of the wheel on its rail with u' = (v - u) V/a. It is the slip that lags, rolling included: a wheel
that rolls straight on where its rail bends has a new direction against the rail, but no slip, and must not
feel any. Steady rolling is untouched; without the lag the explicit integration would need steps that shrink
with the speed, and what it does beyond its limit looks like creep.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.friction import FrictionTable
from hh_exudyn.contact.state import PATCH_COLUMNS
from hh_exudyn.contact.types import MAX_PATCHES, WheelRailModel
from hh_exudyn.kernel import inlined_kernel
from track.course.alignment import AlignmentTable
from track.irregularity.table import IrregularityTable
from track.support.substructure import TrackParameters

BODY_COORDINATES = 6
TRACK_COORDINATES = 7  # per wheelset, on flexible track
CREEP_COORDINATES = 4  # per wheelset: left longitudinal, left lateral, right longitudinal, right lateral


class Kind(IntEnum):
    """Kind of a coupling in the kernel."""

    AXLE_BOX_PAD = 0
    SPRING_NEST = 1
    WEDGE = 2
    CENTRE_PLATE = 3
    SIDE_BEARER = 4
    BUSHING = 5
    ROD = 6
    BUMP_STOP = 7
    AXLE_BOX = 8


class Ledger(IntEnum):
    """Powers of one evaluation [W], dissipation positive, and the force of the train [N]."""

    COUPLER_FORCE = 0
    COUPLER_POWER = 1
    CONTACT_POWER = 2
    FRICTION_POWER = 3
    DAMPER_POWER = 4
    DRIVE_POWER = 5  # given by the drives, positive in traction
    BRAKE_POWER = 6  # taken by brake shoes


SLIDERS = 4  # slider coordinates reserved for each coupling
PARAMETERS = 25  # numbers reserved for each coupling


class Couplings(NamedTuple):
    """All couplings of a vehicle as arrays, one row each."""

    kind: IntArray  # (n,) a `Kind`
    body_a: IntArray  # (n,)
    body_b: IntArray  # (n,)
    point_a: FloatArray  # (n, 3) in the axes of body A from its centre of mass [m]
    point_b: FloatArray  # (n, 3) of body B
    parameters: FloatArray  # (n, PARAMETERS) in the order of the force laws in `couplings`


class Train(NamedTuple):
    """The train the vehicle is coupled to: it runs at constant speed, or as a controller moves it."""

    bodies: IntArray  # (heads,) body number of each coupler head
    heads: FloatArray  # (heads, 3) coupler heads in the axes of their bodies [m]
    start: FloatArray  # (heads,) arc length of the heads at time 0 without coupler force [m]
    stiffness: float  # all heads together [N/m]
    damping: float  # [N s/m]
    speed: float  # at the start [m/s]
    through: FloatArray  # (heads,) force that it passes on through the vehicle, forwards [N]
    course: FloatArray  # (2,) way of the train less its speed times time [m], and its speed [m/s]


class Drives(NamedTuple):
    """Torques of motors on wheelsets, with their reactions; none where the train pulls the vehicle."""

    bodies: IntArray  # (drives, 2) body numbers of wheelset and motor
    torque: FloatArray  # (drives,) on the wheelset about its axle, forwards [N m]; a controller writes it


class Brakes(NamedTuple):
    """Brake shoes on wheel treads, pressed by bodies that carry them; none where no brake is ordered."""

    bodies: IntArray  # (shoes, 2) body numbers of wheelset and carrier
    point: FloatArray  # (shoes, 3) of the shoe in the axes of its carrier [m]
    thrust: FloatArray  # (shoes,) of the brake fully applied [N]
    friction: FloatArray  # (shoes,)
    start: float  # when the brake is applied [s]
    build_up: float  # time in which its thrust rises to the full one [s]


class SystemModel(NamedTuple):
    """Everything constant about a vehicle on a track."""

    mass: FloatArray  # (bodies,) [kg]
    weight: FloatArray  # (bodies,) [N]
    inertia: FloatArray  # (bodies, 3) [kg m^2]
    couplings: Couplings
    wheelsets: IntArray  # (wheelsets,) body numbers
    wheel_rail: WheelRailModel
    friction: FrictionTable
    alignment: AlignmentTable
    irregularity: IrregularityTable
    flexible: bool
    track: TrackParameters
    shortest_transition: float  # of the creepage, a lower bound of the semi-axis a [m]
    track_mass: FloatArray  # (TRACK_COORDINATES,) [kg], [kg m^2]
    train: Train
    drives: Drives
    brakes: Brakes


class Workspace(NamedTuple):
    """Arrays that the kernel fills; `generalized_force` is its result."""

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
    new_sliders: FloatArray  # (couplings, SLIDERS)
    ledger: FloatArray  # (len(Ledger),)
    generalized_force: FloatArray  # (coordinates,)


@inlined_kernel
def first_track(model: SystemModel) -> int:
    """Number of the first coordinate of the track."""
    return BODY_COORDINATES * model.mass.size


@inlined_kernel
def first_creep(model: SystemModel) -> int:
    """Number of the first creep coordinate."""
    track = TRACK_COORDINATES * model.wheelsets.size if model.flexible else 0
    return BODY_COORDINATES * model.mass.size + track


def coordinates(model: SystemModel) -> int:
    """Number of coordinates of the model."""
    return first_creep(model) + CREEP_COORDINATES * len(model.wheelsets)


def workspace(model: SystemModel) -> Workspace:
    """Work space for the model, all zero."""
    bodies = len(model.mass)
    wheelsets = len(model.wheelsets)
    return Workspace(
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
        new_sliders=np.zeros((len(model.couplings.kind), SLIDERS)),
        ledger=np.zeros(len(Ledger)),
        generalized_force=np.zeros(coordinates(model)),
    )
