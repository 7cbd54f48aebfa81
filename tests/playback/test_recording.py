"""A recording read back: entities, timelines, rows, and positions that survive single precision."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
from rerun.chunk import RrdReader
from scipy.spatial.transform import Rotation

from damage.rcf.surface_index import surface_fatigue_index
from hh_exudyn.case import Case
from hh_exudyn.log.channels import COUPLINGS
from hh_exudyn.log.store import open_run, write_case
from hh_exudyn.playback.couplings import coupling_courses, most_varying
from hh_exudyn.playback.frames import track_frames
from hh_exudyn.playback.run import record, record_tables
from hh_exudyn.playback.wheels import contact_frames, series, wheel_rows

WHEELS = [f"{number}{side}" for number in (1, 2, 3, 4) for side in "LR"]


class Recording:
    """Chunks of a recording by entity."""

    def __init__(self, path: Path) -> None:
        reader = RrdReader(path)
        self.blueprints = len(reader.blueprints())
        self.chunks = reader.stream().to_chunks()

    def entities(self) -> set[str]:
        return {chunk.entity_path.lstrip("/") for chunk in self.chunks}

    def column(self, entity: str, component: str) -> tuple[np.ndarray, list[Any]]:
        """Times [ns] and values of a temporal column, in order of time."""
        times: list[int] = []
        values: list[Any] = []
        for chunk in self.chunks:
            batch = chunk.to_record_batch()
            if (
                chunk.entity_path.lstrip("/") != entity
                or chunk.is_static
                or component not in batch.schema.names
            ):
                continue
            times += batch["sim_time"].cast("int64").to_pylist()
            values += batch[component].to_pylist()
        order = np.argsort(times, kind="stable")
        return np.array(times)[order], [values[i] for i in order]


@pytest.fixture(scope="module")
def short(synthetic_run: Callable[..., Any]) -> Any:
    return synthetic_run(seconds=2.0, rate=50.0)


@pytest.fixture(scope="module")
def recording(short: Any, tmp_path_factory: pytest.TempPathFactory) -> Recording:
    path = tmp_path_factory.mktemp("playback") / "short.rrd"
    return Recording(record_tables(short.motion, short.contact, short.scene, path))


def test_entities(recording: Recording, short: Any) -> None:
    expected = {"world/vehicle"} | {f"world/vehicle/{body}" for body in short.scene.shapes}
    for wheel in WHEELS:
        expected |= {f"world/vehicle/contact/{wheel}/{kind}" for kind in ("force", "patch")}
        expected |= {f"plots/{key}/{wheel}" for key in ("Q_kN", "Y_kN", "Y_over_Q", "nu_x", "nu_y", "FI")}
        expected.add(f"shakedown/points/{wheel}")
    expected |= {"shakedown/limit", "shakedown/grid", "shakedown/ticks"}
    expected |= {f"world/track/0000/{part}" for part in ("rails", "bed", "sleepers")}
    assert expected <= recording.entities()
    assert recording.blueprints == 1


def test_timelines_and_row_counts(recording: Recording, short: Any) -> None:
    count = len(short.times)
    for entity, component in (
        ("world/vehicle", "Transform3D:translation"),
        ("world/vehicle/wheelset_3", "Transform3D:quaternion"),
        ("world/vehicle/contact/1R/force", "Arrows3D:vectors"),
        ("world/vehicle/contact/4L/patch", "Ellipsoids3D:centers"),
        ("plots/FI/2R", "Scalars:scalars"),
        ("shakedown/points/1L", "Points2D:positions"),
    ):
        times, _ = recording.column(entity, component)
        np.testing.assert_array_equal(times, np.round(short.times * 1e9).astype(np.int64), err_msg=entity)
        assert len(times) == count
    moving = next(c for c in recording.chunks if c.entity_path == "/world/vehicle" and not c.is_static)
    assert set(moving.timeline_names) == {"sim_time", "track_mm"}
    place = moving.to_record_batch()["track_mm"].to_pylist()
    np.testing.assert_array_equal(place, np.round(short.s * 1e3))


def test_only_the_patches_that_exist_are_drawn(recording: Recording, short: Any) -> None:
    late = short.times > 0.5 * short.times[-1]
    for wheel, patches in (("1L", 1 + late), ("1R", 1 - late), ("2L", np.ones(len(late)))):
        _, vectors = recording.column(f"world/vehicle/contact/{wheel}/force", "Arrows3D:vectors")
        assert [len(row) for row in vectors] == (2 * patches).tolist()
        _, centres = recording.column(f"world/vehicle/contact/{wheel}/patch", "Ellipsoids3D:centers")
        assert [len(row) for row in centres] == patches.tolist()


def test_plots_hold_the_log(recording: Recording, short: Any) -> None:
    log = {name: short.contact[name].to_numpy() for name in short.contact.column_names}
    mine = (log["wheelset"] == 2) & (log["side"] == -1)
    _, values = recording.column("plots/Q_kN/2R", "Scalars:scalars")
    np.testing.assert_allclose(np.ravel(values), log["Q"][mine] / 1e3)
    _, values = recording.column("plots/FI/2R", "Scalars:scalars")
    index = surface_fatigue_index(
        *(log[name][mine] for name in ("force_x", "force_y", "normal_force", "a", "b")),
        short.scene.shear_yield,
    )
    np.testing.assert_allclose(np.ravel(values), index)
    _, values = recording.column("plots/Q_kN/1R", "Scalars:scalars")  # off the rail in the second half
    assert np.ravel(values)[-1] == 0.0


@pytest.mark.parametrize("start", [60.0, 10_000.0])
def test_positions_survive_single_precision(
    start: float, synthetic_run: Callable[..., Any], tmp_path: Path
) -> None:
    """Frame and relative pose as stored give the log's position to 1 um, 10 km from the start too."""
    run = synthetic_run(seconds=8.0, rate=5.0, start=start)
    stored = Recording(record_tables(run.motion, run.contact, run.scene, tmp_path / "far.rrd"))

    def pose(entity: str) -> tuple[np.ndarray, Rotation]:
        _, translation = stored.column(entity, "Transform3D:translation")
        _, quaternion = stored.column(entity, "Transform3D:quaternion")
        place = np.array(translation, dtype=np.float64).reshape(-1, 3)
        return place, Rotation.from_quat(np.array(quaternion, dtype=np.float64).reshape(-1, 4))

    origin, turn = pose("world/vehicle")
    assert np.abs(origin[:, 0]).min() > start - 1.0
    names = np.array(run.motion["body"].to_pylist())
    for body in ("car_body", "wheelset_1", "side_frame_2R"):
        place, attitude = pose(f"world/vehicle/{body}")
        assert np.abs(place).max() < 6.0
        back = origin + turn.apply(place)
        row = names == body
        logged = np.column_stack([run.motion[axis].to_numpy()[row] for axis in "xyz"])
        np.testing.assert_allclose(back, logged, rtol=0.0, atol=1e-6, err_msg=body)
        quaternion = np.column_stack([run.motion[f"q{axis}"].to_numpy()[row] for axis in "xyzw"])
        assert ((turn * attitude) * Rotation.from_quat(quaternion).inv()).magnitude().max() < 1e-6


def test_contact_points_lie_on_the_rails(short: Any) -> None:
    """On straight track: y = +-(gauge/2 + gauge point - y_rail), z on the rail; the normal leans inwards."""
    scene, times = short.scene, short.times
    for wheel in wheel_rows(short.contact, times, 1):
        frames = contact_frames(wheel, scene.alignment, scene.rail_left)
        start = wheel.columns["s"] < 50.0
        if not start.any():
            continue
        points, rows = frames.position[start], wheel.columns
        np.testing.assert_allclose(points[:, 0], rows["s"][start], atol=1e-9)
        assert np.all(np.sign(points[:, 1]) == wheel.side)
        assert np.all((np.abs(points[:, 1]) > 0.7175) & (np.abs(points[:, 1]) < 0.80))
        assert np.all((points[:, 2] <= 0.0) & (points[:, 2] > -0.014))
        normal = frames.rotation[start].apply((0.0, 0.0, 1.0))
        np.testing.assert_allclose(
            normal[:, 1], -wheel.side * np.sin(rows["contact_angle"][start]), atol=1e-12
        )


def test_a_lifted_wheel_leaves_gaps(short: Any) -> None:
    right = next(wheel for wheel in wheel_rows(short.contact, short.times, 1) if wheel.name == "1R")
    values = series(right, 300e6)
    late = short.times > 0.5 * short.times[-1]
    assert np.all(values["Q_kN"][late] == 0.0) and np.all(values["Q_kN"][~late] > 0.0)
    assert np.all(np.isnan(values["nu_x"]) == late)


def test_every_second_time(short: Any, tmp_path: Path) -> None:
    thin = Recording(record_tables(short.motion, short.contact, short.scene, tmp_path / "thin.rrd", every=2))
    for entity, component in (
        ("world/vehicle/car_body", "Transform3D:translation"), ("plots/Q_kN/1L", "Scalars:scalars")
    ):  # fmt: skip
        times, _ = thin.column(entity, component)
        np.testing.assert_array_equal(times, np.round(short.times[::2] * 1e9))


def test_run_on_disk(synthetic_run: Callable[..., Any], tmp_path: Path) -> None:
    """`record` finds track, rails and vehicle in the case; an empty wagon carries no ore."""
    case = Case(
        name="small",
        vehicle="iore_wagon_empty",
        speed_km_h=60,
        friction=0.4,
        track={
            "sections": [
                {"kind": "straight", "length_m": 50.0},
                {"kind": "transition", "length_m": 40.0},
                {"kind": "curve", "length_m": 80.0, "radius_m": 400.0, "hand": "right", "cant_mm": 50.0},
            ]
        },
    )
    made = synthetic_run(seconds=1.0, rate=20.0, start=40.0, case=case)
    directory = tmp_path / "small"
    for log, table in (("motion", made.motion), ("contact", made.contact)):
        (directory / log).mkdir(parents=True)
        pyarrow.parquet.write_table(table, directory / log / "part-00000.parquet")
    write_case(directory, case.to_toml())
    stored = Recording(record(open_run(directory), tmp_path / "small.rrd"))
    entities = stored.entities()
    assert {"world/vehicle/car_body", "world/track/0000/rails"} <= entities
    assert "world/vehicle/car_body/ore" not in entities
    _, stored_origin = stored.column("world/vehicle", "Transform3D:translation")
    exact = track_frames(case.alignment(), made.s).origin
    np.testing.assert_allclose(np.reshape(stored_origin, (-1, 3)), exact, rtol=1e-7, atol=1e-9)


def test_bad_input_is_named(short: Any, tmp_path: Path) -> None:
    path = tmp_path / "never.rrd"
    with pytest.raises(ValueError, match="every = 0"):
        record_tables(short.motion, short.contact, short.scene, path, every=0)
    with pytest.raises(ValueError, match="no vehicle 2"):
        record_tables(short.motion, short.contact, short.scene, path, vehicle=2)
    with pytest.raises(ValueError, match="car_body"):
        motion = short.motion.filter([name != "car_body" for name in short.motion["body"].to_pylist()])
        record_tables(motion, short.contact, short.scene, path)
    with pytest.raises(ValueError, match="no rows"):
        record_tables(short.motion.slice(0, 0), short.contact, short.scene, path)
    assert list(tmp_path.iterdir()) == []  # nothing half done is left


def test_couplings_are_sent_and_the_most_varying_ones_are_in_view(short: Any, tmp_path: Path) -> None:
    """Four springs whose forces swing by 1, 4, 2 and 3 kN: all curves are there, three of them in view."""
    count = len(short.times)
    wave = np.sin(np.linspace(0.0, 6.0, count))
    columns = {column.name: np.zeros(4 * count) for column in COUPLINGS if column.kind == "float64"}
    columns["time"] = np.repeat(short.times, 4)
    for i, size in enumerate((1e3, 4e3, 2e3, 3e3)):
        columns["force_z"][i::4], columns["displacement_x"][i::4] = size * wave, 2e-3 * wave
    log = pyarrow.table({**columns, "coupling": [f"spring_{i}" for i in range(4)] * count})
    path = tmp_path / "couplings.rrd"
    stored = Recording(record_tables(short.motion, short.contact, short.scene, path, couplings=log))
    _, force = stored.column("couplings/force_kN/spring_1/z", "Scalars:scalars")
    assert np.ravel(force) == pytest.approx(4.0 * wave)
    _, moved = stored.column("couplings/displacement_mm/spring_0/x", "Scalars:scalars")
    assert np.ravel(moved) == pytest.approx(2.0 * wave)
    courses = coupling_courses(log, short.times)
    assert most_varying(courses) == ["spring_1", "spring_2", "spring_3"]
    with pytest.raises(ValueError, match=r"has spring_0 at \d+ of the \d+ times"):
        coupling_courses(log.slice(4), short.times)
