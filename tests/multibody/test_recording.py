"""Log rows against the work space they are taken from, column by column and by name."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from hh_exudyn.contact.state import PATCH_COLUMNS, Patch
from hh_exudyn.contact.types import MAX_PATCHES
from hh_exudyn.conventions import GRAVITY
from hh_exudyn.log.channels import LOGS
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.model import (
    BODY_COORDINATES,
    TRACK_COORDINATES,
    CouplingRecord,
    Ledger,
    coordinates,
    workspace,
)
from hh_exudyn.multibody.recording import LogWriter
from track.course.alignment import track_frame
from track.support.flexibility import track_flexibility
from vehicles.catalogue import vehicle

WAGON = vehicle("iore_wagon_loaded")
BODIES = len(WAGON.bodies)


class Kept:
    """A recorder that keeps the rows of the last write."""

    def __init__(self):
        self.rows = {}

    def append_rows(self, log, rows):
        self.rows[log] = rows.copy()

    def table(self, log):
        names = [column.name for column in LOGS[log]]
        return SimpleNamespace(**dict(zip(names, self.rows[log].T, strict=True)))


@pytest.fixture(scope="module")
def model(demo):
    return assemble(WAGON, demo)


@pytest.fixture
def writer(model):
    """Work space and velocities filled with numbers that are all different, a recorder and a log writer."""
    work, kept = workspace(model), Kept()
    rng = np.random.default_rng(7)
    for array in (*work.inputs, *(field for field in work if isinstance(field, np.ndarray))):
        array[:] = rng.uniform(0.1, 1.0, array.shape)
    work.rotation[:] = Rotation.random(BODIES, rng=rng).as_matrix()
    work.rail_rotation[:] = Rotation.random(8, rng=rng).as_matrix().reshape(4, 2, 3, 3)
    work.frame_axle[:] /= np.linalg.norm(work.frame_axle, axis=1)[:, None]
    work.position[:, 0] = np.linspace(15.0, 5.0, BODIES)  # on the straight
    work.arc_length[:] = np.linspace(14.0, 6.0, work.arc_length.size)
    v = rng.uniform(0.1, 1.0, coordinates(model))
    return work, v, kept, LogWriter(WAGON, model, work, kept)


def test_contact_rows_are_the_patches_by_name(writer):
    """Every column of the schema that a patch has comes from that column of its patch."""
    work, v, kept, log = writer
    log.write(1.25, v)
    rows = kept.table("contact")
    assert rows.time.size == 4 * 2 * MAX_PATCHES
    shared = [column for column in Patch if column.name.lower() in vars(rows)]
    assert len(shared) == PATCH_COLUMNS - 2  # but power and the curvature floor
    for k in range(rows.time.size):
        wheelset, index, patch = int(rows.wheelset[k]) - 1, 0 if rows.side[k] == 1 else 1, int(rows.patch[k])
        for column in shared:
            found = getattr(rows, column.name.lower())[k]
            assert found == work.patches[wheelset, index, patch, column], column.name
        assert rows.time[k] == 1.25
        assert rows.s[k] == work.arc_length[wheelset]
        assert rows.vehicle[k] == 1
        assert rows.bogie[k] == WAGON.wheelsets[wheelset].bogie
        assert rows.speed[k] == work.frame_velocity[wheelset, 0]
        assert rows.y_wheelset[k] == work.frame_position[wheelset, 1]
        axle = work.frame_axle[wheelset]
        assert rows.yaw[k] == pytest.approx(math.atan2(-axle[0], axle[1]), rel=1e-12)
        against = work.rail_rotation[wheelset, index].T @ axle
        assert rows.roll[k] == pytest.approx(math.asin(against[2]), rel=1e-12)
        assert rows.angle_of_attack[k] == pytest.approx(math.atan2(-against[0], against[1]), rel=1e-12)
        assert rows.Q[k] == -work.rail_force[wheelset, index, 1]
        assert rows.Y[k] == rows.side[k] * work.rail_force[wheelset, index, 0]
    assert len({*zip(rows.wheelset, rows.side, rows.patch, strict=True)}) == rows.time.size


def test_wheels_have_one_row_each_with_the_numbers_of_their_patches(writer):
    """In the order 1L, 1R, 2L, ..., loaded or not."""
    work, v, kept, log = writer
    work.patches[1, 0, :, Patch.NORMAL_FORCE] = 0.0
    log.write(0.0, v)
    wheels, patches = kept.table("wheels"), kept.table("contact")
    assert [*zip(wheels.wheelset, wheels.side, strict=True)] == [
        (w, s) for w in (1, 2, 3, 4) for s in (1, -1)
    ]
    for k in range(wheels.time.size):
        mine = (patches.wheelset == wheels.wheelset[k]) & (patches.side == wheels.side[k])
        assert mine.any() == (k != 2)
        for name in set(vars(wheels)) - {"time"}:
            assert np.all(getattr(patches, name)[mine] == getattr(wheels, name)[k]), name


def test_couplings_that_are_named_have_their_records(model):
    """The rows of the work space's records, by name of the coupling."""
    work, kept = workspace(model), Kept()
    work.coupling_record[:] = np.arange(work.coupling_record.size).reshape(work.coupling_record.shape)
    log = LogWriter(WAGON, model, work, kept, logged=[7, 2])
    work.rotation[:] = np.eye(3)
    work.rail_rotation[:] = np.eye(3)
    work.frame_axle[:] = [0.0, 1.0, 0.0]
    log.write(0.5, np.zeros(coordinates(model)))
    rows = kept.table("couplings")
    assert [*rows.coupling] == [7, 2]
    assert [*rows.time] == [0.5, 0.5]
    for column in CouplingRecord:
        found = getattr(rows, column.name.lower())
        assert [*found] == [work.coupling_record[7, column], work.coupling_record[2, column]], column


def test_only_patches_that_carry_load_are_logged(writer):
    work, v, kept, log = writer
    work.patches[:, :, 1:, Patch.NORMAL_FORCE] = 0.0
    work.patches[2, 1, 0, Patch.NORMAL_FORCE] = 0.0
    work.patches[2, 1, 2, Patch.NORMAL_FORCE] = 5.0
    log.write(0.0, v)
    rows = kept.table("contact")
    wheels = {*zip(rows.wheelset, rows.side, rows.patch, strict=True)}
    assert wheels == {(w, s, 0) for w in (1, 2, 3, 4) for s in (1, -1)} - {(3, -1, 0)} | {(3, -1, 2)}


@pytest.mark.parametrize("angle", [-0.02, 0.0, 0.005])
def test_angle_of_attack_is_the_yaw_of_the_axle_to_the_rail(writer, angle):
    """Positive to the left, whatever the roll of the wheelset; yaw is that to the track."""
    work, v, kept, log = writer
    work.frame_axle[:] = Rotation.from_euler("ZX", [angle, 0.03]).apply([0.0, 1.0, 0.0])
    work.rail_rotation[:, 0] = Rotation.from_euler("Z", 0.002).as_matrix()
    work.rail_rotation[:, 1] = np.eye(3)
    log.write(0.0, v)
    rows = kept.table("contact")
    assert rows.yaw == pytest.approx(angle, abs=1e-15)
    assert rows.angle_of_attack[rows.side == 1] == pytest.approx(angle - 0.002, abs=1e-15)
    assert rows.angle_of_attack[rows.side == -1] == pytest.approx(angle, abs=1e-15)


def rotations():
    """Random ones, and turns by 180 degrees and close to it, about the axes, diagonals and at random."""
    rng = np.random.default_rng(3)
    axes = [*np.eye(3), *-np.eye(3), [1, 1, 0], [0, -1, 1], [1, 1, 1], [1, -1, 1], *rng.normal(size=(11, 3))]
    units = np.array([np.array(axis) / np.linalg.norm(axis) for axis in axes])
    turns = [np.pi + d for d in (0.0, 1e-12, -1e-9, 1e-6, -1e-3, 0.1)] + [0.0, 1e-9, 2 * np.pi / 3]
    special = [angle * unit for angle in turns for unit in units]
    return Rotation.concatenate([Rotation.random(200, rng=rng), Rotation.from_rotvec(special)])


def test_quaternions_of_the_motion_log(writer):
    """Against scipy, scalar first, up to the sign of the whole; unit length."""
    work, v, kept, log = writer
    every = rotations()
    for start in range(0, len(every) - BODIES + 1, BODIES):
        expected = every[start : start + BODIES]
        work.rotation[:] = expected.as_matrix()
        log.write(0.0, v)
        motion = kept.table("motion")
        found = np.column_stack([motion.qw, motion.qx, motion.qy, motion.qz])
        x, y, z, w = expected.as_quat().T
        cosine = np.abs((found * np.column_stack([w, x, y, z])).sum(axis=1))
        assert np.linalg.norm(found, axis=1) == pytest.approx(1.0, abs=1e-14)
        assert cosine == pytest.approx(1.0, abs=1e-14)
        assert Rotation.from_quat(found[:, [1, 2, 3, 0]]).as_matrix() == pytest.approx(
            work.rotation, abs=1e-14
        )


def test_motion_rows(writer):
    work, v, kept, log = writer
    work.position[:, 1] = 0.1
    log.write(2.5, v)
    motion = kept.table("motion")
    assert (motion.time == 2.5).all()
    assert motion.body == pytest.approx(np.arange(BODIES))
    assert np.column_stack([motion.x, motion.y, motion.z]) == pytest.approx(work.position, abs=0.0)
    rates = v[: BODY_COORDINATES * BODIES].reshape(BODIES, BODY_COORDINATES)
    assert np.column_stack([motion.vx, motion.vy, motion.vz]) == pytest.approx(rates[:, :3], abs=0.0)
    assert np.column_stack([motion.wx, motion.wy, motion.wz]) == pytest.approx(rates[:, 3:], abs=0.0)
    assert motion.s == pytest.approx(work.position[:, 0], abs=1e-9)  # on the straight


def test_arc_length_of_a_body_in_the_curve(writer, model):
    """A body 1.5 m over the track and 0.4 m beside it has the arc length of the point below it."""
    work, v, kept, log = writer
    s = np.linspace(104.0, 95.0, BODIES)  # the demo's curve begins at 100 m
    for i in range(BODIES):
        x, y, z, heading, *_ = track_frame(model.alignment, s[i])
        work.position[i] = x - 0.4 * np.sin(heading), y + 0.4 * np.cos(heading), z + 1.5
    work.arc_length[:] = 100.0
    log.write(0.0, v)
    assert kept.table("motion").s == pytest.approx(s, abs=1e-6)


def test_energy_row(writer):
    """Powers by name; kinetic energy by hand; potential energy counts from the first row."""
    work, v, kept, log = writer
    log.write(0.0, v)
    assert kept.table("energy").potential_energy == 0.0
    work.position[:, 2] += 0.01
    log.write(1.0, v)
    energy = kept.table("energy")
    assert energy.potential_energy == pytest.approx(WAGON.mass * GRAVITY * 0.01, rel=1e-9)
    for name in ("coupler_force", "coupler_power", "contact_power", "friction_power", "damper_power"):
        assert getattr(energy, name) == work.ledger[Ledger[name.upper()]]
    rates = v[: BODY_COORDINATES * BODIES].reshape(BODIES, BODY_COORDINATES)
    mass = np.array([[body.mass] * 3 + list(body.inertia) for body in WAGON.bodies])
    kinetic = (mass * rates**2).sum() / 2
    track = energy.kinetic_energy[0] - kinetic
    # then seven under each wheelset; the creep velocities behind them are no masses
    under = v[BODY_COORDINATES * BODIES :][: 4 * TRACK_COORDINATES].reshape(4, TRACK_COORDINATES)
    assert track == pytest.approx((track_flexibility("concrete").masses() * under**2).sum() / 2, rel=1e-6)
