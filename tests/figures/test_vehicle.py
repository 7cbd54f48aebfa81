"""The drawing of a vehicle shows its lengths, to one scale in both views."""

from io import BytesIO

import numpy as np
import pytest
from matplotlib.patches import Circle, Rectangle

from hh_exudyn.figures.vehicle import summary, vehicle_sheet
from vehicles.catalogue import VEHICLES, vehicle
from vehicles.couplings import Rod
from vehicles.description import Body, Coupler, Vehicle, Wheelset
from vehicles.outline import THINNEST, body_box, uniform_cuboid

WAGON = vehicle("iore_wagon_loaded")


def test_wheels_have_their_radius_and_stand_on_the_rail() -> None:
    figure = vehicle_sheet("wagon", WAGON)
    figure.savefig(BytesIO(), dpi=50)  # warnings are errors: the layout holds
    side, plan = figure.axes
    wheels = {(p.center[0], p.center[1], p.radius) for p in side.patches if isinstance(p, Circle)}
    assert {radius for _, _, radius in wheels} == {0.4575}
    assert {centre - radius for _, centre, radius in wheels} == {0.0}
    assert sorted(x for x, _, _ in wheels) == pytest.approx([-4.274, -2.496, 2.496, 4.274])
    for axes in (side, plan):
        assert axes.get_aspect() == 1.0
    # the same length on paper in both views
    lengths = [np.diff(axes.transData.transform([(0, 0), (1, 0), (0, 1)]), axis=0) for axes in (side, plan)]
    np.testing.assert_allclose(lengths[0], lengths[1])
    shown = {text.get_text() for text in side.texts}
    assert {"1778", "4992", "10290"} <= shown  # mm, thesis Table 1-1: 6770 - 1778 = 4992


def test_plan_has_a_wheel_on_each_rail() -> None:
    plan = vehicle_sheet("wagon", WAGON).axes[1]
    wheels = [p for p in plan.patches if isinstance(p, Rectangle) and p.get_width() == pytest.approx(0.915)]
    assert len(wheels) == 8
    middles = {round(p.get_y() + p.get_height() / 2, 6) for p in wheels}
    assert middles == {0.75, -0.75}


def test_cuboid_of_given_inertia() -> None:
    edges = np.array([9.0, 3.0, 2.0])
    squares = edges**2
    inertia = 7e3 / 12 * (squares.sum() - squares)
    np.testing.assert_allclose(uniform_cuboid(7e3, tuple(inertia)), edges)
    thin = uniform_cuboid(100.0, (1.0, 1.0, 2.5))  # no cuboid: Iz > Ix + Iy
    assert thin.min() == THINNEST


def test_boxes_follow_what_is_known() -> None:
    low, high = body_box(WAGON, WAGON.body("car_body"))
    np.testing.assert_allclose(high - low, [8.9, 3.49, 3.64 - 0.80])  # the basket's lengths
    low, high = body_box(WAGON, WAGON.body("side_frame_1L"))
    np.testing.assert_allclose((low[0], high[0]), (2.496, 4.274))  # from axle box to axle box


def test_any_vehicle_can_be_drawn() -> None:
    """A body on a rod, one head, kinds without an outline of their own."""
    bodies = (
        Body("frame", "bogie_frame", 2e3, (1e3, 2e3, 2.5e3), (0.0, 0.0, 0.6)),
        Body("motor", "motor", 3e3, (200.0, 300.0, 400.0), (0.4, 0.0, 0.5)),
        Body("axle", "wheelset", 1e3, (700.0, 100.0, 700.0), (0.0, 0.0, 0.6)),
    )
    rod = Rod("link", "frame", "motor", (1.0, 0.0, 0.7), (0.6, 0.0, 0.7), 1e6, 1e3)
    coupler = Coupler(("frame",), ((1.5, 0.0, 0.7),), 1e5, 1e4)
    odd = Vehicle("odd", bodies, (rod,), (Wheelset("axle", 1, 0.6),), coupler, {})
    figure = vehicle_sheet("odd", odd)
    figure.savefig(BytesIO(), dpi=50)
    lines = [line.get_xydata() for line in figure.axes[0].lines if len(line.get_xydata()) == 2]
    assert any(np.allclose(line, [(1.0, 0.7), (0.6, 0.7)]) for line in lines)
    labels = {text.get_text() for text in figure.legends[0].get_texts()}
    assert labels == {"bogie frame", "motor", "rod", "coupler head"}


@pytest.mark.parametrize("name", VEHICLES)
def test_every_vehicle_of_the_catalogue_can_be_drawn(name: str) -> None:
    one = vehicle(name)
    vehicle_sheet(summary(one), one).savefig(BytesIO(), dpi=50)


def test_summary() -> None:
    assert summary(WAGON) == "120.0 t on 4 wheelsets of 915 mm, 30.0 t each"
