"""Columns of the logs of a run: name, source, unit, meaning; the common table of writers and readers.

Contact log: one row per output time, wheel and patch in contact; Q and Y of a wheel stand on each of its
patches, so that means over rows are biased. Wheels log: one row per output time and wheel, loaded or not.
Motion log: one row per output time and body. Energy ledger: one row per output time. Control log: one row per
sample of the controllers and driven wheelset; a run without controllers has none. Couplings log: one row per
output time and coupling that the case names (``integration.logged_couplings``). Sensors log: one row per
output time and component of each of Exudyn's sensors that an extension has named. Check-rail log: one row per
output time and wheel whose flange back touches a check rail; this force is in Q and Y of the wheel too, as in
what a measuring wheelset shows, but in no patch of the contact log. SI units throughout;
contact quantities in frame C, forces on the wheel (see `hh_exudyn.conventions`).

A column of source `PATCH` is copied from the kernel's record of a contact patch, out of the member of
`hh_exudyn.contact.state.Patch` with the column's name in capitals; one of source `LEDGER` likewise from the
ledger of the multibody system. `hh_exudyn.multibody.recording` derives its copies from this table and fills
all other columns by name. A new column is a row here and the line that computes it.
"""

from enum import IntEnum
from typing import Any, NamedTuple

TIME = "time"  # of output
BODY = "body"  # state of a body
PATCH = "patch"  # copied from the record of a contact patch
WHEEL = "wheel"  # of the patch's wheel on its rail
WHEELSET = "wheelset"  # of the patch's, or the driven, wheelset
VEHICLE = "vehicle"  # of all bodies together
LEDGER = "ledger"  # copied from the ledger of powers
CONTROLLER = "controller"  # of drivers and actuators
COUPLING = "coupling"  # between two bodies
BACK = "back"  # copied from the record of a flange back on a check rail
SENSOR = "sensor"  # of Exudyn, added by an extension


class Column(NamedTuple):
    """One column of a log."""

    name: str
    source: str
    unit: str
    meaning: str
    kind: str = "float64"  # or "int32" or "string"


CONTACT = (
    Column("time", TIME, "s", "since the start of the run"),
    Column("s", WHEELSET, "m", "arc length of the wheelset along the track"),
    Column("vehicle", WHEELSET, "-", "vehicle in the run, from 1", kind="int32"),
    Column("bogie", WHEELSET, "-", "bogie of the vehicle, from 1 at the leading end", kind="int32"),
    Column("wheelset", WHEELSET, "-", "wheelset of the vehicle, from 1 at the leading end", kind="int32"),
    Column("side", WHEEL, "-", "+1 left, -1 right", kind="int32"),
    Column("patch", WHEEL, "-", "patch of the wheel, from 0, most loaded first", kind="int32"),
    Column("y_wheel", PATCH, "m", "lateral position on the wheel profile (side coordinates)"),
    Column("y_rail", PATCH, "m", "lateral position on the rail profile (side coordinates)"),
    Column("x_shift", PATCH, "m", "contact ahead of the wheelset's centre, along the track"),
    Column("contact_angle", PATCH, "rad", "of the contact plane about the rail's axis, flange positive"),
    Column("rolling_radius", PATCH, "m", "radius of the wheel at the contact"),
    Column("normal_force", PATCH, "N", "normal force"),
    Column("a", PATCH, "m", "semi-axis in rolling direction, of the equivalent ellipse"),
    Column("b", PATCH, "m", "lateral semi-axis of the patch"),
    Column("p_max", PATCH, "Pa", "largest pressure"),
    Column("nu_x", PATCH, "-", "longitudinal creepage"),
    Column("nu_y", PATCH, "-", "lateral creepage"),
    Column("phi", PATCH, "1/m", "spin creepage"),
    Column("friction", PATCH, "-", "friction coefficient of the patch, at its slip"),
    Column("speed", WHEELSET, "m/s", "forward speed, the reference of the creepages"),
    Column("force_x", PATCH, "N", "longitudinal creep force on the wheel"),
    Column("force_y", PATCH, "N", "lateral creep force on the wheel"),
    Column("moment_z", PATCH, "N m", "spin moment on the wheel"),
    Column(
        "Q", WHEEL, "N", "of the wheel on the rail, down; REPEATED on its patches: means over rows are biased"
    ),
    Column("Y", WHEEL, "N", "lateral force of the wheel on the rail, outwards; likewise"),
    Column("angle_of_attack", WHEEL, "rad", "yaw of the wheelset to this wheel's rail, left positive"),
    Column("y_wheelset", WHEELSET, "m", "lateral position of the wheelset's centre, left positive"),
    Column("approach", PATCH, "m", "elastic approach along the normal"),
    Column("centre_y", PATCH, "m", "centre of the wheelset from the origin of the rail profile, along its y"),
    Column("centre_z", PATCH, "m", "the same along its z: with roll and angle_of_attack the wheel's pose"),
    Column("roll", WHEEL, "rad", "roll of the wheelset to this wheel's rail, right-hand about x"),
    Column("yaw", WHEELSET, "rad", "yaw of the wheelset to the track frame, left positive"),
)

MOTION = (
    Column("time", TIME, "s", "since the start of the run"),
    Column("body", BODY, "-", "name of the body", kind="string"),
    Column("s", BODY, "m", "arc length of the body's centre along the track"),
    Column("x", BODY, "m", "position of the centre of mass, global frame"),
    Column("y", BODY, "m", "position, global frame"),
    Column("z", BODY, "m", "position, global frame"),
    Column("qw", BODY, "-", "unit quaternion body to global frame, scalar part"),
    Column("qx", BODY, "-", "quaternion"),
    Column("qy", BODY, "-", "quaternion"),
    Column("qz", BODY, "-", "quaternion"),
    Column("vx", BODY, "m/s", "velocity of the centre of mass, global frame"),
    Column("vy", BODY, "m/s", "velocity, global frame"),
    Column("vz", BODY, "m/s", "velocity, global frame"),
    Column("wx", BODY, "rad/s", "angular velocity, body frame"),
    Column("wy", BODY, "rad/s", "angular velocity, body frame"),
    Column("wz", BODY, "rad/s", "angular velocity, body frame"),
)

ENERGY = (
    Column("time", TIME, "s", "since the start of the run"),
    Column("s", VEHICLE, "m", "arc length of the car body's centre along the track"),
    Column("coupler_force", LEDGER, "N", "force of the train on the vehicle, forward positive"),
    Column("coupler_power", LEDGER, "W", "power of that force"),
    Column("contact_power", LEDGER, "W", "power lost in the wheel-rail contacts"),
    Column("friction_power", LEDGER, "W", "power taken by the dry-friction elements"),
    Column("damper_power", LEDGER, "W", "power lost in dampers of vehicle and track"),
    Column("drive_power", LEDGER, "W", "power of the drives on the wheelsets, below 0 in braking"),
    Column("brake_power", LEDGER, "W", "power lost between brake shoes and wheels"),
    Column("kinetic_energy", VEHICLE, "J", "of all bodies and track masses"),
    Column("potential_energy", VEHICLE, "J", "of gravity; zero at the start"),
)

CONTROL = (
    Column("time", TIME, "s", "since the start of the run"),
    Column("s", WHEELSET, "m", "arc length of the wheelset along the track"),
    Column("vehicle", WHEELSET, "-", "vehicle in the run, from 1", kind="int32"),
    Column("wheelset", WHEELSET, "-", "wheelset of the vehicle, from 1 at the leading end", kind="int32"),
    Column("speed", WHEELSET, "m/s", "forward speed of the wheelset"),
    Column("wheel_speed", WHEELSET, "m/s", "its rotation times the nominal radius"),
    Column("torque", CONTROLLER, "N m", "of the drive on the wheelset since the last sample, less losses"),
    Column("adhesion", WHEELSET, "-", "longitudinal force of the rails on it over its vertical load"),
    Column("utilisation", WHEELSET, "-", "its creep forces over friction times normal forces"),
    Column("demand", CONTROLLER, "N", "effort demanded of each unit, forward positive (repeated)"),
    Column("coupler_force", CONTROLLER, "N", "force of the train on all units, forward positive (repeated)"),
    Column("train_speed", CONTROLLER, "m/s", "of the train behind them (repeated)"),
    Column("yaw_rest", CONTROLLER, "rad", "rest angle of the wheelset in its bogie, by active steering"),
    Column("stiffness", CONTROLLER, "-", "longitudinal stiffness of its axle boxes over that of the drawing"),
)

# the columns of the contact log that are the wheel's, not the patch's
WHEELS = tuple(
    column for column in CONTACT if column.source in (TIME, WHEELSET, WHEEL) and column.name != "patch"
)

CHECK_RAIL = (
    *(column for column in WHEELS if column.source != WHEEL or column.name == "side"),
    Column("normal_force", BACK, "N", "normal force of the check rail on the flange back"),
    Column("x_shift", BACK, "m", "its centre ahead of the wheelset's centre, along the track"),
    Column("height", BACK, "m", "its centre above the top of the running rail"),
    Column("force_x", BACK, "N", "force on the wheel along the track, friction included"),
    Column("force_y", BACK, "N", "force on the wheel across the track, to the left"),
    Column("force_z", BACK, "N", "force on the wheel, up"),
    Column("overlap", BACK, "m", "largest overlap: contact, check rail and wheel disc together"),
    Column("p_max", BACK, "Pa", "largest pressure, of a line contact"),
    Column("creepage", BACK, "-", "slip of the back over speed, mean over the load"),
    Column("power", BACK, "W", "power lost"),
)

COUPLINGS = (
    Column("time", TIME, "s", "since the start of the run"),
    Column("coupling", COUPLING, "-", "name of the coupling", kind="string"),
    Column("force_x", COUPLING, "N", "force on its body B, in the axes of body A as all here"),
    Column("force_y", COUPLING, "N", "force on B"),
    Column("force_z", COUPLING, "N", "force on B"),
    Column("moment_x", COUPLING, "N m", "moment on B at its point there"),
    Column("moment_y", COUPLING, "N m", "moment on B"),
    Column("moment_z", COUPLING, "N m", "moment on B"),
    Column("displacement_x", COUPLING, "m", "of its point on B relative to A; zero on the drawing"),
    Column("displacement_y", COUPLING, "m", "displacement"),
    Column("displacement_z", COUPLING, "m", "displacement"),
)

SENSORS = (
    Column("time", TIME, "s", "since the start of the run"),
    Column("sensor", SENSOR, "-", "name of the sensor", kind="string"),
    Column("component", SENSOR, "-", "of its value, from 0", kind="int32"),
    Column("value", SENSOR, "its own", "value of the component, in the sensor's unit"),
)

LOGS = {
    "contact": CONTACT,
    "motion": MOTION,
    "energy": ENERGY,
    "control": CONTROL,
    "wheels": WHEELS,
    "couplings": COUPLINGS,
    "check_rail": CHECK_RAIL,
    "sensors": SENSORS,
}


def positions(name: str, columns: tuple[Column, ...]) -> Any:
    """The positions of a log's columns by their names, as an enumeration that kernels can read.

    Parameters
    ----------
    name : str
        Name of the enumeration, as in this module.
    columns : tuple of Column
        In the order of the log.
    """
    return IntEnum(name, {column.name: k for k, column in enumerate(columns)}, module=__name__)


# Any: type checkers cannot derive the members from the table
ContactColumn: Any = positions("ContactColumn", CONTACT)
MotionColumn: Any = positions("MotionColumn", MOTION)
WheelColumn: Any = positions("WheelColumn", WHEELS)
CheckRailColumn: Any = positions("CheckRailColumn", CHECK_RAIL)
CouplingColumn: Any = positions("CouplingColumn", COUPLINGS)
EnergyColumn: Any = positions("EnergyColumn", ENERGY)
ControlColumn: Any = positions("ControlColumn", CONTROL)
