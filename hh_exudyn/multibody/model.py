"""What the force kernel of a whole vehicle needs: the model, its work space, and the layout of coordinates.

Coordinates: six per body (position of the centre of mass in the global frame, rotation vector), then, on
flexible track, nine per wheelset: the seven of `track.flexibility` and one for each rail whose VELOCITY is
the rail's lateral velocity as the creepage feels it. Velocities: global velocity and LOCAL angular velocity,
as Exudyn's `NodeRigidBodyRotVecLG` has them; generalized forces are the conjugate global force and local
torque.

Why the creepage feels the rail late: a steady-state creep force answers a sudden velocity at once, as a
damper C/V of near 1 MN s/m between a wheelset and a rail of some 100 kg. A real contact must roll about one
semi-axis a before its traction has built up (Kalker 1990, section 5.2: transition to steady rolling); until
then it is a spring of stiffness C/a, about that of Mindlin. The rail's lateral velocity u in the creepage
follows the rail with u' = (v - u) V/a. At rest and in steady rolling nothing changes; without it, explicit
integration would need a quarter of the step.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.contact.types import MAX_PATCHES, PATCH_COLUMNS, FloatArray, WheelRailModel
from track.alignment import AlignmentTable
from track.flexibility import TrackParameters

IntArray = NDArray[np.int64]

BODY_COORDINATES = 6
TRACK_MASSES = 7  # coordinates of `track.flexibility` per wheelset
TRACK_COORDINATES = TRACK_MASSES + 2  # with the two velocities that the creepages feel


class Kind(IntEnum):
    """Kind of a coupling in the kernel."""

    AXLE_BOX_PAD = 0
    SPRING_NEST = 1
    WEDGE = 2
    CENTRE_PLATE = 3
    SIDE_BEARER = 4


class Ledger(IntEnum):
    """Powers of one evaluation [W], dissipation positive, and the force of the train [N]."""

    COUPLER_FORCE = 0
    COUPLER_POWER = 1
    CONTACT_POWER = 2
    FRICTION_POWER = 3
    DAMPER_POWER = 4


SLIDERS = 3  # slider coordinates reserved for each coupling
PARAMETERS = 18  # numbers reserved for each coupling


class Couplings(NamedTuple):
    """All couplings of a vehicle as arrays, one row each."""

    kind: IntArray  # (n,) a `Kind`
    body_a: IntArray  # (n,)
    body_b: IntArray  # (n,)
    point_a: FloatArray  # (n, 3) in the axes of body A from its centre of mass [m]
    point_b: FloatArray  # (n, 3) of body B
    parameters: FloatArray  # (n, PARAMETERS) in the order of the force laws in `couplings`


class Train(NamedTuple):
    """The train the vehicle is coupled to, running at constant speed."""

    body: int
    heads: FloatArray  # (2, 3) coupler heads in the axes of the body [m]
    start: FloatArray  # (2,) arc length of the heads at time 0 without coupler force [m]
    stiffness: float  # both couplers together [N/m]
    damping: float  # [N s/m]
    speed: float  # [m/s]


class SystemModel(NamedTuple):
    """Everything constant about a vehicle on a track."""

    mass: FloatArray  # (bodies,) [kg]
    inertia: FloatArray  # (bodies, 3) [kg m^2]
    couplings: Couplings
    wheelsets: IntArray  # (wheelsets,) body numbers
    wheel_rail: WheelRailModel
    friction: FloatArray  # (wheelsets, 2) left, right
    alignment: AlignmentTable
    flexible: bool
    track: TrackParameters
    track_mass: FloatArray  # (TRACK_COORDINATES,) [kg], [kg m^2], 1 for the creepage velocities
    train: Train


class Workspace(NamedTuple):
    """Arrays that the kernel fills; `generalized_force` is its result."""

    position: FloatArray  # (bodies, 3)
    rotation: FloatArray  # (bodies, 3, 3) body to global
    velocity: FloatArray  # (bodies, 3)
    angular_velocity: FloatArray  # (bodies, 3), global axes
    force: FloatArray  # (bodies, 3), global axes
    torque: FloatArray  # (bodies, 3), global axes
    arc_length: FloatArray  # (wheelsets + 2,) of the wheelsets and the coupler heads, also the next guess
    track_rotation: FloatArray  # (wheelsets, 3, 3) frame T to global
    frame_position: FloatArray  # (wheelsets, 3) of the wheelsets in their frames T
    frame_axle: FloatArray  # (wheelsets, 3)
    frame_velocity: FloatArray  # (wheelsets, 3)
    frame_angular_velocity: FloatArray  # (wheelsets, 3)
    gauge: FloatArray  # (wheelsets,)
    rail_displacement: FloatArray  # (wheelsets, 2, 2)
    rail_velocity: FloatArray  # (wheelsets, 2, 2)
    wrench: FloatArray  # (wheelsets, 6)
    rail_force: FloatArray  # (wheelsets, 2, 2)
    patches: FloatArray  # (wheelsets, 2, MAX_PATCHES, PATCH_COLUMNS)
    new_sliders: FloatArray  # (couplings, SLIDERS)
    ledger: FloatArray  # (len(Ledger),)
    generalized_force: FloatArray  # (coordinates,)


def coordinates(model: SystemModel) -> int:
    """Number of coordinates of the model."""
    track = TRACK_COORDINATES * len(model.wheelsets) if model.flexible else 0
    return BODY_COORDINATES * len(model.mass) + track


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
        arc_length=np.zeros(wheelsets + 2),
        track_rotation=np.zeros((wheelsets, 3, 3)),
        frame_position=np.zeros((wheelsets, 3)),
        frame_axle=np.zeros((wheelsets, 3)),
        frame_velocity=np.zeros((wheelsets, 3)),
        frame_angular_velocity=np.zeros((wheelsets, 3)),
        gauge=np.zeros(wheelsets),
        rail_displacement=np.zeros((wheelsets, 2, 2)),
        rail_velocity=np.zeros((wheelsets, 2, 2)),
        wrench=np.zeros((wheelsets, 6)),
        rail_force=np.zeros((wheelsets, 2, 2)),
        patches=np.zeros((wheelsets, 2, MAX_PATCHES, PATCH_COLUMNS)),
        new_sliders=np.zeros((len(model.couplings.kind), SLIDERS)),
        ledger=np.zeros(len(Ledger)),
        generalized_force=np.zeros(coordinates(model)),
    )
