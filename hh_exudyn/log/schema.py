"""Columns of the logs of a run: name, unit, meaning. The one table that writers and readers share.

Contact log: one row per output time, wheel and patch in contact. Motion log: one row per output time and
body. Energy ledger: one row per output time. Control log: one row per sample of the controllers and driven
wheelset; a run without controllers has none. SI units throughout; contact quantities in frame C, forces on
the wheel (see `hh_exudyn.conventions`).
"""

from typing import NamedTuple


class Column(NamedTuple):
    """One column of a log."""

    name: str
    kind: str  # "float64", "int32" or "string"
    unit: str
    meaning: str


CONTACT = (
    Column("time", "float64", "s", "since the start of the run"),
    Column("s", "float64", "m", "arc length of the wheelset along the track"),
    Column("vehicle", "int32", "-", "vehicle in the run, from 1"),
    Column("bogie", "int32", "-", "bogie of the vehicle, from 1 at the leading end"),
    Column("wheelset", "int32", "-", "wheelset of the vehicle, from 1 at the leading end"),
    Column("side", "int32", "-", "+1 left, -1 right"),
    Column("patch", "int32", "-", "patch of the wheel, from 0, deepest first"),
    Column("y_wheel", "float64", "m", "lateral position on the wheel profile (side coordinates)"),
    Column("y_rail", "float64", "m", "lateral position on the rail profile (side coordinates)"),
    Column("x_shift", "float64", "m", "contact ahead of the wheelset's centre, along the track"),
    Column(
        "contact_angle", "float64", "rad", "contact plane to the rail's cross-section, positive to flange"
    ),
    Column("rolling_radius", "float64", "m", "radius of the wheel at the contact"),
    Column("normal_force", "float64", "N", "normal force"),
    Column("a", "float64", "m", "semi-axis in rolling direction (equivalent ellipse if the patch is none)"),
    Column("b", "float64", "m", "lateral semi-axis of the patch"),
    Column("p_max", "float64", "Pa", "largest pressure"),
    Column("nu_x", "float64", "-", "longitudinal creepage"),
    Column("nu_y", "float64", "-", "lateral creepage"),
    Column("phi", "float64", "1/m", "spin creepage"),
    Column("friction", "float64", "-", "friction coefficient of the patch, at its slip"),
    Column("speed", "float64", "m/s", "forward speed of the wheelset, the reference of the creepages"),
    Column("force_x", "float64", "N", "longitudinal creep force on the wheel"),
    Column("force_y", "float64", "N", "lateral creep force on the wheel"),
    Column("moment_z", "float64", "N m", "spin moment on the wheel"),
    Column("Q", "float64", "N", "vertical force of the wheel on the rail (repeated on its patches)"),
    Column("Y", "float64", "N", "lateral force of the wheel on the rail, outwards (repeated on its patches)"),
    Column(
        "angle_of_attack", "float64", "rad", "yaw of the wheelset to this wheel's rail, positive to the left"
    ),
    Column("y_wheelset", "float64", "m", "lateral position of the wheelset's centre, positive to the left"),
    Column("approach", "float64", "m", "elastic approach along the normal"),
    Column("roll", "float64", "rad", "roll of the wheelset to this wheel's rail, right-hand about x"),
    Column("yaw", "float64", "rad", "yaw of the wheelset to the track frame, positive to the left"),
)

MOTION = (
    Column("time", "float64", "s", "since the start of the run"),
    Column("body", "string", "-", "name of the body"),
    Column("s", "float64", "m", "arc length of the body's centre along the track"),
    Column("x", "float64", "m", "position of the centre of mass, global frame"),
    Column("y", "float64", "m", "position, global frame"),
    Column("z", "float64", "m", "position, global frame"),
    Column("qw", "float64", "-", "unit quaternion body to global frame, scalar part"),
    Column("qx", "float64", "-", "quaternion"),
    Column("qy", "float64", "-", "quaternion"),
    Column("qz", "float64", "-", "quaternion"),
    Column("vx", "float64", "m/s", "velocity of the centre of mass, global frame"),
    Column("vy", "float64", "m/s", "velocity, global frame"),
    Column("vz", "float64", "m/s", "velocity, global frame"),
    Column("wx", "float64", "rad/s", "angular velocity, body frame"),
    Column("wy", "float64", "rad/s", "angular velocity, body frame"),
    Column("wz", "float64", "rad/s", "angular velocity, body frame"),
)

ENERGY = (
    Column("time", "float64", "s", "since the start of the run"),
    Column("s", "float64", "m", "arc length of the car body's centre along the track"),
    Column("coupler_force", "float64", "N", "force of the train on the vehicle, forward positive"),
    Column("coupler_power", "float64", "W", "power of that force"),
    Column("contact_power", "float64", "W", "power lost in the wheel-rail contacts"),
    Column("friction_power", "float64", "W", "power taken by the dry-friction elements"),
    Column("damper_power", "float64", "W", "power lost in dampers of vehicle and track"),
    Column("drive_power", "float64", "W", "power that the drives give to wheelsets, less than 0 in braking"),
    Column("brake_power", "float64", "W", "power lost between brake shoes and wheels"),
    Column("kinetic_energy", "float64", "J", "of all bodies and track masses"),
    Column("potential_energy", "float64", "J", "of gravity; zero at the start"),
)

CONTROL = (
    Column("time", "float64", "s", "since the start of the run"),
    Column("s", "float64", "m", "arc length of the wheelset along the track"),
    Column("wheelset", "int32", "-", "wheelset of the vehicle, from 1 at the leading end"),
    Column("speed", "float64", "m/s", "forward speed of the wheelset"),
    Column("wheel_speed", "float64", "m/s", "its rotation times the nominal radius"),
    Column("torque", "float64", "N m", "of the drive on the wheelset until now, losses off"),
    Column(
        "adhesion", "float64", "-", "longitudinal force of the rails on the wheelset over its vertical load"
    ),
    Column("utilisation", "float64", "-", "creep forces of its patches over friction times normal forces"),
    Column(
        "demand", "float64", "N", "effort asked of the vehicle, forward positive (repeated on its wheelsets)"
    ),
    Column("coupler_force", "float64", "N", "force of the train on the vehicle, forward positive (repeated)"),
    Column("train_speed", "float64", "m/s", "of the train behind the vehicle (repeated)"),
    Column("yaw_rest", "float64", "rad", "rest angle of the wheelset in its bogie, by active steering"),
    Column("stiffness", "float64", "-", "longitudinal stiffness of its axle boxes over that of the drawing"),
)

LOGS = {"contact": CONTACT, "motion": MOTION, "energy": ENERGY, "control": CONTROL}
