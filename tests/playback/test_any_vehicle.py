"""Shapes and recordings of vehicles that are no ore wagon."""

from pathlib import Path

import numpy as np
import pyarrow
import pytest
import trimesh

from hh_exudyn.contact.geometry.rail_tables import RailCourse
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.log.channels import CONTACT, MOTION
from hh_exudyn.playback.layout import vehicle_view
from hh_exudyn.playback.run import Scene, leading_body, record_tables
from hh_exudyn.playback.shapes.vehicle import vehicle_shapes
from track.course.alignment import Alignment, Straight
from vehicles.catalogue import VEHICLES, vehicle
from vehicles.description import Body, Coupler, Vehicle, Wheelset

OTHERS = sorted(name for name in VEHICLES if not name.startswith("iore_wagon"))
PROFILE = wheel_profile("S1002")
TREAD = np.column_stack([PROFILE.y, PROFILE.z])


def two_axles() -> Vehicle:
    """Of a script: names of its own, no lengths."""
    wheelsets = (("front", 3.0), ("rear", -3.0))
    return Vehicle(
        name="two axles",
        bodies=(
            *(Body(name, "wheelset", 1300, (700, 100, 700), (x, 0, 0.46)) for name, x in wheelsets),
            Body("tub", "car_body", 2e4, (3e4, 2e5, 2e5), (0.2, 0, 1.9)),
        ),
        couplings=(),
        wheelsets=tuple(Wheelset(name, bogie, 0.46) for bogie, (name, _) in enumerate(wheelsets, 1)),
        coupler=Coupler(("tub",), ((6.0, 0, 1.05),), 2e5, 9e4),
        dimensions={},
    )


def on_drawing(described: Vehicle, name: str, mesh: trimesh.Trimesh) -> np.ndarray:
    """Lowest and highest corner of a shape where its body is on the drawing."""
    return mesh.bounds + np.array(described.body(name).position)


@pytest.mark.parametrize("name", [*OTHERS, "of a script"])
def test_every_body_has_a_closed_shape_above_the_rails(name: str) -> None:
    described = two_axles() if name == "of a script" else vehicle(name)
    shapes = vehicle_shapes(described, TREAD)
    assert set(shapes) == {body.name for body in described.bodies}
    for body, mesh in shapes.items():
        assert mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0.0, body
        assert len(mesh.faces) < 20_000, body
        if not body.startswith(("wheelset", "front", "rear")):  # flanges reach below the rail tops
            assert on_drawing(described, body, mesh)[0, 2] > 0.05, body
    for wheelset in described.wheelsets:
        points = np.asarray(shapes[wheelset.body].vertices)
        radius = np.hypot(points[:, 0], points[:, 2])
        assert radius.max() == pytest.approx(wheelset.radius + 0.028, abs=1e-4)  # flange of S1002
        assert np.abs(points[radius > 0.9 * wheelset.radius, 1]).min() == pytest.approx(0.68, abs=1e-6)


def test_locomotive_has_its_lengths() -> None:
    """22.89 m over couplers, 2.95 m wide, 4.465 m high; its body clears the wheels of 1.25 m."""
    described = vehicle("iore_locomotive")
    low, high = on_drawing(described, "car_body", vehicle_shapes(described, TREAD)["car_body"])
    np.testing.assert_allclose((low[0], high[0]), (-11.445, 11.445), atol=1e-6)
    assert high[1] == pytest.approx(1.475, abs=0.02)
    assert high[2] == pytest.approx(4.465)


def test_shapes_of_the_locomotive_are_symmetric() -> None:
    """The locomotive is symmetric, left to right, and so are its shapes."""
    described = vehicle("iore_locomotive")
    for name, mesh in vehicle_shapes(described, TREAD).items():
        low, high = mesh.bounds
        assert low[1] == pytest.approx(-high[1], abs=1e-6), name
        # the diagonals of its faces are not mirrored
        assert mesh.center_mass[1] == pytest.approx(0.0, abs=1e-4), name


@pytest.mark.parametrize(
    ("name", "leader"),
    [("iore_locomotive", "car_body"), ("suspended_wheelset", "frame"), ("of a script", "tub")],
)
def test_the_moving_frame_follows_the_body_or_the_coupled_one(name: str, leader: str) -> None:
    assert leading_body(two_axles() if name == "of a script" else vehicle(name)) == leader


def test_the_eye_goes_back_for_a_longer_vehicle() -> None:
    def distance(described: Vehicle) -> float:
        controls = vehicle_view(described, leading_body(described)).properties["EyeControls3D"]
        position, target = (
            np.array(part.as_arrow_array().to_pylist()[0])
            for part in (controls.position, controls.look_target)
        )
        return float(np.linalg.norm(position - target))

    reach = [
        distance(vehicle(name)) for name in ("suspended_wheelset", "iore_wagon_loaded", "iore_locomotive")
    ]
    assert reach[0] < 0.5 * reach[1] < reach[1] < 0.7 * reach[2]


def test_a_vehicle_of_a_script_is_recorded(tmp_path: Path) -> None:
    """A standing run of three output times, with bodies that have names of their own."""
    described, times = two_axles(), np.array([0.0, 0.1, 0.2])
    motion: dict[str, list[np.ndarray]] = {column.name: [] for column in MOTION}
    for body in described.bodies:
        x, y, z = body.position
        given = {
            "time": times,
            "body": np.full(3, body.name),
            "s": 50 + x,
            "x": 50 + x,
            "y": y,
            "z": z,
            "qw": 1.0,
        }
        for name, column in motion.items():
            column.append(np.broadcast_to(given.get(name, 0.0), 3))
    contact: dict[str, list[np.ndarray]] = {column.name: [] for column in CONTACT}
    for number in (1, 2):
        for side in (1, -1):
            given = {
                "time": times, "vehicle": 1, "wheelset": number, "side": side, "s": 50.0, "normal_force": 5e4,
                "a": 5e-3, "b": 5e-3, "p_max": 1e9, "friction": 0.3, "Q": 5e4,
            }  # fmt: skip
            for name, column in contact.items():
                column.append(np.broadcast_to(given.get(name, 0.0), 3))
    rail = RailCourse((rail_profile("60E1"),))
    scene = Scene(described, vehicle_shapes(described, TREAD), Alignment((Straight(200.0),)), rail, rail)
    kinds = {column.name: column.kind for column in CONTACT}
    path = record_tables(
        pyarrow.table({name: np.concatenate(column) for name, column in motion.items()}),
        pyarrow.table({name: np.concatenate(column).astype(kinds[name]) for name, column in contact.items()}),
        scene,
        tmp_path / "tub.rrd",
    )
    assert path.stat().st_size > 10_000
