"""Rails in the sums of a case: one passing of the vehicle, scaled, weighted, mirrored and kept in bytes."""

from dataclasses import replace

import numpy as np
import pyarrow
import pytest

from hh_exudyn.campaign.engine.case_damage import CaseWork, DamageSettings, Part, part_sums
from hh_exudyn.campaign.engine.sums import DamageSums, from_bytes, to_bytes
from hh_exudyn.case import Case, StraightCase, TrackCase
from hh_exudyn.log.channels import LOGS

SETTINGS = DamageSettings(normal="ellipse", theory="fastsim", cells=(10, 10))
PARTS = (Part("first", 20.0, 26.0), Part("second", 26.0, 38.0))
STEADY = {
    "rolling_radius": 0.4575, "normal_force": 1e5, "a": 7e-3, "b": 5e-3, "p_max": 1.36e9, "friction": 0.4,
    "speed": 10.0, "Q": 1e5, "force_x": 5e3, "nu_x": -1e-3, "force_y": 8e3, "nu_y": -2e-3,
}  # fmt: skip


def case() -> Case:
    track = TrackCase(sections=(StraightCase(length_m=60, gauge_mm=1437),))
    return Case(name="straight", speed_km_h=36, friction=0.4, track=track)


def log_of(vehicle_of: Case, mirrored: bool = False) -> pyarrow.Table:
    """All wheels of a vehicle roll steadily on; those on the left have twice the creep force."""
    times = 0.02 * np.arange(250)
    number: dict[int, int] = {}
    pieces = []
    for k, wheelset in enumerate(vehicle_of.described_vehicle().wheelsets):
        number[wheelset.unit] = number.get(wheelset.unit, 0) + 1
        for side in (1.0, -1.0):
            own = STEADY | {"vehicle": wheelset.unit, "bogie": 1, "wheelset": number[wheelset.unit]}
            stronger = 2.0 if (side > 0.0) != mirrored else 1.0
            turn = -1.0 if mirrored else 1.0
            own |= {"side": side, "time": times, "s": 10.0 * times + 12.0 - 2.0 * k, "y_rail": 2e-3}
            own |= {"nu_x": -1e-3 * stronger, "nu_y": -2e-3 * turn, "force_y": 8e3 * turn}
            names = [column.name for column in LOGS["contact"]]
            pieces.append(
                np.column_stack([np.broadcast_to(own.get(name, 0.0), times.shape) for name in names])
            )
    rows = np.concatenate(pieces)[np.argsort(np.tile(times, len(pieces)), kind="stable")]
    kinds = {"float64": np.float64, "int32": np.int32}
    return pyarrow.table(
        {column.name: rows[:, k].astype(kinds[column.kind]) for k, column in enumerate(LOGS["contact"])}
    )


@pytest.fixture(scope="module")
def sums() -> dict[str, DamageSums]:
    return part_sums(log_of(case()), CaseWork(case(), PARTS, SETTINGS))


def test_rails_of_parts_are_passed_once(sums: dict[str, DamageSums]) -> None:
    """Of a steady state the long part and the short one are worn alike by a passing."""
    vehicle = case().described_vehicle()
    for part in sums.values():
        left, right = part.rails
        assert (left.side, right.side) == (1, -1)
        assert len(left.by_wheel.wheels) == len(vehicle.wheelsets)
        assert left.mass == vehicle.mass
        np.testing.assert_allclose(left.rolled, 1.0, rtol=1e-12)
        assert left.worn_area_per_mgt > right.worn_area_per_mgt > 0.0
    first, second = (one.rails[0] for one in sums.values())
    np.testing.assert_allclose(first.depth_per_mgt, second.depth_per_mgt, rtol=1e-9)
    one_metre = sums["second"].per_metre()  # of the wheels; the rails stay those of one passing
    assert one_metre.surfaces[0].distance == pytest.approx(1.0)
    np.testing.assert_array_equal(one_metre.rails[0].depth_per_mgt, second.depth_per_mgt)


def test_rails_change_nothing_of_the_wheels(sums: dict[str, DamageSums]) -> None:
    alone = part_sums(log_of(case()), CaseWork(case(), PARTS, replace(SETTINGS, rails=False)))
    for name, part in alone.items():
        assert part.rails == ()
        np.testing.assert_array_equal(part.surfaces[0].depth_by_part, sums[name].surfaces[0].depth_by_part)
    keys = {CaseWork(case(), PARTS, replace(SETTINGS, rails=rails)).key for rails in (True, False)}
    assert len(keys) == 2


def test_weights_mirror_and_bytes(sums: dict[str, DamageSums]) -> None:
    part = sums["first"]
    both = 0.25 * part + 0.75 * part
    for one, other in zip(both.rails, part.rails, strict=True):
        np.testing.assert_allclose(one.depth_per_mgt, other.depth_per_mgt, rtol=1e-13)
        assert one.mass == pytest.approx(other.mass)
    again = from_bytes(to_bytes(sums, "key"), "key", "memory")
    for one, other in zip(again["first"].rails, part.rails, strict=True):
        np.testing.assert_array_equal(one.whole_life, other.whole_life)
        np.testing.assert_array_equal(one.depth_per_mgt, other.depth_per_mgt)
    turned = part_sums(log_of(case(), mirrored=True), CaseWork(case(), PARTS, SETTINGS))["first"]
    by_side = {rail.side: rail for rail in part.mirrored().rails}
    for rail in turned.rails:
        np.testing.assert_allclose(rail.depth_per_mgt, by_side[rail.side].depth_per_mgt, rtol=1e-9)
    assert len((part + turned.mirrored()).rails) == 2
