"""Shapes: closed, of the wagon's real lengths, light enough, and placed about the centres of mass."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from hh_exudyn.contact.check_rail.table import CheckRail
from hh_exudyn.contact.geometry.rail_tables import RailCourse
from hh_exudyn.contact.profile import Profile, gauge_point, rail_profile, wheel_profile
from hh_exudyn.playback.frames import moving_frame
from hh_exudyn.playback.shapes.dimensions import wagon_dimensions
from hh_exudyn.playback.shapes.meshes import box, shaded, turned
from hh_exudyn.playback.shapes.three_piece_bogie import SPRING
from hh_exudyn.playback.shapes.track import pieces, rail_section, sleeper
from hh_exudyn.playback.shapes.vehicle import vehicle_shapes
from track.course.alignment import Alignment, Curve, Grade, Straight, Transition
from vehicles.catalogue import parameters, vehicle
from vehicles.couplings import SideBearer
from vehicles.description import Vehicle
from vehicles.models.wagon import ore_wagon


@pytest.fixture(scope="module")
def tread() -> np.ndarray:
    profile = wheel_profile("S1002")
    return np.column_stack([profile.y, profile.z])


@pytest.fixture(scope="module")
def shapes(tread: np.ndarray) -> dict[str, trimesh.Trimesh]:
    return vehicle_shapes(vehicle("iore_wagon_loaded"), tread)


def test_every_shape_is_closed_light_and_points_outwards(shapes: dict[str, trimesh.Trimesh]) -> None:
    for name, mesh in shapes.items():
        assert mesh.is_watertight, name
        assert mesh.is_winding_consistent, name
        assert mesh.volume > 0.0, name
        assert len(mesh.faces) < 20_000, name


def test_wagon_has_the_published_lengths(shapes: dict[str, trimesh.Trimesh]) -> None:
    """Length over couplers, basket width and height of Table 1-1 (Hossein-Nia 2018)."""
    height = vehicle("iore_wagon_loaded").body("car_body").position[2]
    body = shapes["car_body"].bounds + np.array([0.0, 0.0, height])
    np.testing.assert_allclose(body[:, 0], [-10.29 / 2, 10.29 / 2], atol=1e-9)
    np.testing.assert_allclose(body[:, 1], [-3.49 / 2, 3.49 / 2], atol=1e-9)
    assert body[1, 2] == pytest.approx(3.64)
    assert body[0, 2] > 0.3  # clear of the rails


def test_wheels_stand_on_the_rails_with_flanges_inside(shapes: dict[str, trimesh.Trimesh]) -> None:
    """Greatest radius is the flange's: 457.5 mm and the 28 mm of S1002, 1360 mm between the flange backs."""
    points = np.asarray(shapes["wheelset_1"].vertices)
    radius = np.hypot(points[:, 0], points[:, 2])
    assert radius.max() == pytest.approx(0.4575 + 0.028, abs=1e-4)
    assert np.abs(points[radius > 0.42, 1]).min() == pytest.approx(0.68, abs=1e-6)
    assert np.abs(points[radius > 0.4575 + 0.015, 1]).max() < 0.75


def test_ore_lies_in_the_basket_and_heaps_over_its_rim(shapes: dict[str, trimesh.Trimesh]) -> None:
    ore, size = shapes["car_body/ore"], wagon_dimensions(vehicle("iore_wagon_loaded"))
    assert np.all(np.abs(ore.bounds[:, 0]) < 0.5 * size.basket_length)
    assert np.all(np.abs(ore.bounds[:, 1]) < 0.5 * size.basket_width)
    low, high = ore.bounds[:, 2] + vehicle("iore_wagon_loaded").body("car_body").position[2]
    assert low < size.height - 0.3 and size.height < high < size.height + 0.5


def test_empty_wagon_has_no_ore(tread: np.ndarray) -> None:
    assert "car_body/ore" not in vehicle_shapes(vehicle("iore_wagon_empty"), tread)


X, Y, Z = range(3)
CHANGED = {  # parameter: its change [m], a body that shows it, the axis and the change of the mesh along it
    "wheelset.radius": (-0.03, "wheelset_1", X, -0.06),
    "wheelset.wheelbase": (0.2, "side_frame_1L", X, 0.2),
    "wheelset.axle_box_half_spacing": (0.05, "wheelset_1", Y, 0.1),
    "wagon.basket_width": (-0.3, "car_body", Y, -0.3),
    "wagon.length": (0.4, "car_body", X, 0.4),
    "wagon.height": (0.2, "car_body", Z, 0.2),
}


@pytest.mark.parametrize("name", CHANGED)
def test_a_changed_dimension_is_drawn(name: str, tread: np.ndarray) -> None:
    change, body, axis, expected = CHANGED[name]
    before, after = (
        vehicle_shapes(wagon_with(name, own)[1], tread)[body].extents[axis] for own in (0.0, change)
    )
    assert after - before == pytest.approx(expected, abs=1e-9)


def test_a_bolster_stays_on_its_springs_when_its_centre_of_mass_is_higher(tread: np.ndarray) -> None:
    before, after = (
        vehicle_shapes(wagon_with("bolster.height", own)[1], tread)["bolster_1"] for own in (0.0, 0.05)
    )
    assert after.bounds[0, 2] - before.bounds[0, 2] == pytest.approx(-0.05)


INSIDE = {  # what lies within a body: parameter, its value [m], body, and points that the mesh must have
    "side_bearer.lateral_position": (0.55, "bolster_1", lambda points: np.abs(points[:, 1] - 0.55), 0.07),
    "centre_plate.radius": (0.25, "bolster_1", lambda points: np.hypot(points[:, 0], points[:, 1]), 0.26),
    "wedge.longitudinal_position": (0.183, "bolster_1", lambda points: np.abs(points[:, 0]), 0.183),
}


@pytest.mark.parametrize("name", INSIDE)
def test_a_changed_place_inside_is_drawn(name: str, tread: np.ndarray) -> None:
    value, body, distance, wanted = INSIDE[name]
    usual, own = wagon_with(name, 0.0)
    _, changed = wagon_with(name, value - usual)

    def nearest(described: Vehicle) -> float:
        points = np.asarray(vehicle_shapes(described, tread)[body].vertices)
        return float(np.abs(distance(points) - wanted).min())

    assert nearest(changed) < 1e-9 < nearest(own)


def test_spring_nests_rise_with_their_couplings(tread: np.ndarray) -> None:
    """Coils lie about the height of the nest (to half a facet of their wire)."""

    def coils(change: float) -> np.ndarray:
        mesh = vehicle_shapes(wagon_with("spring_nest.height", change)[1], tread)["side_frame_1L"]
        yellow = (mesh.visual.face_colors[:, :3] == SPRING).all(axis=1)
        heights = np.asarray(mesh.triangles_center)[yellow, 2] + 0.48
        return np.array([heights.min(), heights.max()])

    assert coils(-0.06) == pytest.approx(coils(0.0) - 0.06, abs=1e-3)
    assert coils(0.0).mean() == pytest.approx(0.50, abs=0.02)


def test_what_lacks_a_coupling_is_no_ore_wagon() -> None:
    wagon = vehicle("iore_wagon_loaded")
    bare = replace(wagon, couplings=tuple(one for one in wagon.couplings if not isinstance(one, SideBearer)))
    with pytest.raises(ValueError, match="cannot be drawn as an ore wagon: it lacks SideBearer"):
        wagon_dimensions(bare)


def wagon_with(name: str, change: float) -> tuple[float, Vehicle]:
    """The usual value of a parameter, and the loaded wagon with it changed."""
    known = parameters("iore_wagon_loaded")
    usual = known[name]
    payload = known["wagon.payload"]
    return usual, ore_wagon("changed", known.replace({name: usual + change}, "assumed: test"), payload)


@pytest.mark.parametrize("change", [{"length": 0.0}, {"wheelbase": -1.0}, {"basket_length": 11.0}])
def test_wrong_lengths_are_refused(change: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=next(iter(change))):
        replace(wagon_dimensions(vehicle("iore_wagon_loaded")), **change)


def test_side_frames_mirror_each_other(shapes: dict[str, trimesh.Trimesh]) -> None:
    left, right = shapes["side_frame_1L"], shapes["side_frame_1R"]
    np.testing.assert_allclose(left.vertices * (1.0, -1.0, 1.0), right.vertices)
    assert right.volume == pytest.approx(left.volume)


def test_shading_keeps_a_box_sharp_and_a_cylinder_round() -> None:
    sharp = shaded(box((0.0, 0.0, 0.0), (1.0, 2.0, 3.0), (10, 20, 30)))
    assert {tuple(normal) for normal in np.abs(sharp.normals).round(6).tolist()} == {
        (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    }  # fmt: skip
    assert set(map(tuple, sharp.colours.tolist())) == {(10, 20, 30, 255)}
    cylinder = shaded(turned(np.array([[0.0, 0.5], [1.0, 0.5]]), 48, (1, 2, 3)))
    shell = np.abs(cylinder.normals[:, 1]) < 0.5
    outward = cylinder.positions[shell] * (2.0, 0.0, 2.0)
    np.testing.assert_allclose(cylinder.normals[shell], outward, atol=0.03)


def test_shading_keeps_every_triangle(shapes: dict[str, trimesh.Trimesh]) -> None:
    mesh = shapes["wheelset_1"]
    shape = shaded(mesh)
    np.testing.assert_allclose(shape.positions[shape.triangles], mesh.triangles, atol=1e-6)


def test_rail_section_is_a_60e1() -> None:
    """Height 172 mm, foot 150 mm, head 72 mm wide 14 mm below its top (EN 13674-1)."""
    section = rail_section(rail_profile("60E1", inclination=0.0))
    assert np.ptp(section[:, 1]) == pytest.approx(0.172, abs=1e-4)
    assert np.ptp(section[:, 0]) == pytest.approx(0.150, abs=1e-6)
    head = section[section[:, 1] > -0.03]
    field, gauge = head[head[:, 0] < 0.0], head[head[:, 0] > 0.0][::-1]
    width = np.interp(-0.014, gauge[:, 1], gauge[:, 0]) - np.interp(-0.014, field[:, 1], field[:, 0])
    assert width == pytest.approx(0.072, abs=5e-4)


def test_rails_lie_at_the_gauge_along_a_curve() -> None:
    """Everywhere the rails' inner faces, 14 mm below the top, are one gauge apart (to the swept chord)."""
    gauge = 1.445
    alignment = Alignment((Straight(40.0), Transition(60.0), Curve(100.0, 250.0, "right", 0.08, gauge)))
    rail = RailCourse((rail_profile("60E1"),))
    piece = next(pieces(alignment, rail, rail, 120.0, 170.0))
    centre = np.array([0.0, -250.0, 0.0])
    local = Alignment((Curve(100.0, 250.0, "right", 0.0, gauge),))
    swept = next(pieces(local, rail, rail, 0.0, 40.0))
    points = np.asarray(swept.rails.vertices) + swept.origin - centre
    radius = np.hypot(points[:, 0], points[:, 1])
    in_band = np.abs(points[:, 2] + 0.014) < 0.012
    inner, outer = radius[in_band & (radius < 250.0)], radius[in_band & (radius > 250.0)]
    assert outer.min() - inner.max() == pytest.approx(gauge, abs=1.5e-3)
    assert piece.rails.is_watertight and piece.bed.is_watertight
    assert np.abs(piece.rails.vertices).max() < 30.0  # relative to the piece's own origin


def test_a_check_rail_stands_a_flangeway_inside_the_inner_rail() -> None:
    gauge, flangeway = 1.445, 0.044
    alignment = Alignment((Curve(100.0, 250.0, "left", 0.0, gauge),))
    rail = RailCourse((rail_profile("60E1"),))
    check = CheckRail(((1, 15.0, 25.0),), flangeway, 0.020, 0.013, 3.0, 0.040, friction=0.3, stiffness=100e6)
    bare = next(pieces(alignment, rail, rail, 0.0, 40.0))
    piece = next(pieces(alignment, rail, rail, 0.0, 40.0, check))
    assert piece.rails.is_watertight
    points = np.asarray(piece.rails.vertices)[len(bare.rails.vertices) :] + piece.origin
    radius = np.hypot(points[:, 0], points[:, 1] - 250.0)
    s = 250.0 * np.arctan2(points[:, 0], 250.0 - points[:, 1])
    assert points[:, 2].max() == pytest.approx(0.020, abs=1e-6)
    inside = (s > 14.9) & (s < 25.1)
    assert radius[inside].min() == pytest.approx(250.0 - 0.5 * gauge + flangeway, abs=1e-3)
    assert (s.min(), s.max()) == (pytest.approx(12.0, abs=0.02), pytest.approx(28.0, abs=0.02))


def test_track_on_a_gradient_rises_and_its_frames_pitch() -> None:
    """Rail tops, sleepers and the frames of logs rise by 20 per mille; sleepers stand square to the rails."""
    slope = 0.020
    alignment = Alignment((Straight(60.0),), grades=(Grade(60.0, slope),))
    rail = RailCourse((rail_profile("60E1"),))
    piece = next(pieces(alignment, rail, rail, 5.0, 45.0))
    points = np.asarray(piece.rails.vertices) + piece.origin
    above = points[:, 2] - slope * points[:, 0]
    assert above.max() * np.cos(np.arctan(slope)) == pytest.approx(0.0, abs=1e-4)
    seats = piece.sleepers.position + piece.origin
    np.testing.assert_allclose(seats[:, 2], slope * seats[:, 0], atol=1e-6)
    ahead = piece.sleepers.rotation.apply((1.0, 0.0, 0.0))
    np.testing.assert_allclose(ahead[:, 2] / ahead[:, 0], slope, rtol=1e-9)
    frame = moving_frame(alignment, np.array([10.0, 50.0]))  # it stays upright: gradients are seen
    np.testing.assert_allclose(frame.rotation.apply((1.0, 0.0, 0.0))[:, 2], 0.0, atol=1e-9)
    np.testing.assert_allclose(frame.position[:, 2], [0.2, 1.0], atol=1e-6)


def test_pieces_cover_the_way_and_keep_the_sleeper_spacing() -> None:
    alignment = Alignment((Straight(130.0),))
    rail = RailCourse((rail_profile("60E1"),))
    parts = list(pieces(alignment, rail, rail, 3.0, 127.0))
    along = np.concatenate([part.sleepers.position[:, 0] + part.origin[0] for part in parts])
    np.testing.assert_allclose(np.diff(along), 0.6, atol=1e-9)
    assert along[0] >= 3.0 and along[-1] <= 127.0
    assert all(np.array_equal(part.origin, part.origin.astype(np.float32)) for part in parts)
    assert sleeper().is_watertight


def test_track_outside_of_the_alignment_is_refused() -> None:
    rail = RailCourse((rail_profile("60E1"),))
    with pytest.raises(ValueError, match="no track"):
        list(pieces(Alignment((Straight(50.0),)), rail, rail, 500.0, 600.0))


def test_a_change_of_rails_is_drawn() -> None:
    """The rail's head is ground off behind the change, on that side only; the piece stays closed."""
    wide, ground = rail_profile("60E1"), rail_profile("MB1_like")
    alignment = Alignment((Straight(130.0),))
    piece = next(pieces(alignment, RailCourse((wide, ground), (30.0,)), RailCourse((wide,)), 10.0, 50.0))
    assert piece.rails.is_watertight
    points = np.asarray(piece.rails.vertices) + piece.origin

    def corner(side: int, low: float, high: float) -> float:
        """Height of the rails 5 mm off the gauge line, from its nearest points to both sides."""
        inside = (points[:, 0] >= low) & (points[:, 0] <= high) & (points[:, 2] > -0.02)
        y = side * points[inside, 1] - 0.7175
        order = np.argsort(y)
        return float(np.interp(0.005, y[order], points[inside, 2][order]))

    def height(rail: Profile) -> float:
        return float(np.interp(gauge_point(rail) - 0.005, rail.y, rail.z))

    assert height(ground) < height(wide) - 1e-3
    for side, low, high, rail in ((1, 0.0, 29.0, wide), (1, 31.0, 60.0, ground), (-1, 0.0, 60.0, wide)):
        assert corner(side, low, high) == pytest.approx(height(rail), abs=3e-4)
    assert height(ground) < corner(1, 29.9, 30.1) < height(wide)


def test_a_pair_has_a_shape_for_every_body(tread: np.ndarray) -> None:
    pair = vehicle("iore_wagon_pair_empty")
    assert set(vehicle_shapes(pair, tread)) == {body.name for body in pair.bodies}
