"""The whole contact kernel against the Manchester contact benchmark A-2.2."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from manchester_rail import manchester_rail
from wheelset_state import MODEL, R0, State, model

from hh_exudyn.contact.state import Patch
from hh_exudyn.contact.types import WheelRailModel

REFERENCE = Path(__file__).parents[1] / "reference" / "wheel_rail_mbench_a22.csv"


ROWS = list(csv.DictReader(line for line in REFERENCE.read_text().splitlines() if not line.startswith("#")))


def benchmark(row: dict[str, str], contact_model: WheelRailModel) -> tuple[np.ndarray, float]:
    """Patches under the prescribed vertical force, and how far the wheelset stands from the reference [m].

    The benchmark's frame is x forward, y right, z down: y, yaw and pitch rate change sign, roll does not.
    """
    side = 0 if row["side"] == "left" else 1
    state = State()
    state.position[0, 1] = -float(row["y_ws"]) * 1e-3
    state.point(-float(row["yaw_ws"]), float(row["roll_ws"]))
    state.velocity[0, 0] = 2.0
    state.angular_velocity[0] = -float(row["vpitch_ws"]) * state.axle[0]
    reference = R0 - float(row["z_ws"]) * 1e-3
    low, high = reference - 0.5e-3, reference + 0.5e-3
    for _ in range(50):
        state.position[0, 2] = 0.5 * (low + high)
        if -state.solve(contact_model).rail_force[0, side, 1] > float(row["fz_tr"]):
            low = state.position[0, 2]
        else:
            high = state.position[0, 2]
    return state.rows(0, side), state.position[0, 2] - reference


def compare(row: dict[str, str], rows: np.ndarray, y_top: float, *, creep: bool) -> None:
    """One-patch rows of the reference; patches of ours that it has merged are averaged by their force."""
    sign = 1.0 if row["side"] == "left" else -1.0
    normal = rows[:, Patch.NORMAL_FORCE]
    y_rail = (normal @ rows[:, Patch.Y_RAIL] / normal.sum() - y_top) * 1e3
    angle = normal @ rows[:, Patch.CONTACT_ANGLE] / normal.sum()
    assert y_rail == pytest.approx(sign * float(row["y_r"]), abs=1.0)
    assert angle == pytest.approx(sign * float(row["delta_r"]), abs=0.03 if angle > 0.3 else 0.01)
    assert normal.sum() == pytest.approx(float(row["fn"]), rel=0.02)
    if creep:
        limit = 0.03 * 0.3 * float(row["fn"])
        (one,) = rows
        assert one[Patch.FORCE_X] == pytest.approx(-float(row["fx"]), abs=limit)
        # frame of the reference: s to the right in the contact plane, force on the rail
        assert one[Patch.FORCE_Y] == pytest.approx(float(row["fs"]), abs=limit)
        assert one[Patch.P_MAX] == pytest.approx(float(row["pmax"]) * 1e6, rel=0.06)
        assert one[Patch.NU_Y] == pytest.approx(float(row["ceta"]), abs=5e-4)
        assert one[Patch.NU_X] == pytest.approx(-float(row["cksi"]), abs=5e-4)
        # spin about the normal into the wheel, of the wheel: minus rail-to-wheel, about the opposite axis
        assert one[Patch.PHI] == pytest.approx(float(row["cphi"]) * 1e3, abs=0.02)
        assert one[Patch.X_SHIFT] == pytest.approx(float(row["x_tr"]) * 1e-3, abs=0.1e-3)


# The reference measures y from the rail's highest point, here on the crown's 300 mm arc inclined 1:40
TOP_60E1 = -0.3 * math.sin(math.atan(1 / 40))

# Left out: the row at the jump from tread to flange (it hangs on 0.03 mm of the rail's shape, see the tests
# with the benchmark's own rail), and 60 kN on the conformal part of the tread, where the reference's patch is
# 20 mm wide and far from elliptic (contact 1.8 mm off).
WITH_60E1 = [
    row
    for row in ROWS
    if (row["load"] == "60kN" and float(row["y_ws"]) >= 2.0)
    or (row["load"] == "10kN" and (row["side"], float(row["y_ws"])) != ("right", 5.0))
]


@pytest.mark.parametrize("row", WITH_60E1, ids=lambda row: f"{row['load']}-{row['side']}-{row['y_ws']}mm")
def test_manchester_benchmark_with_60e1(row: dict[str, str]) -> None:
    rows, _ = benchmark(row, MODEL)
    # At y = 0 and 1 mm the patch spans 16 and 8 mm of changing curvature: geometry only.
    compare(row, rows, TOP_60E1, creep=float(row["y_ws"]) > 1.5)


@pytest.fixture(scope="module")
def manchester() -> WheelRailModel:
    """With the benchmark's own rail."""
    return model(manchester_rail())


@pytest.mark.parametrize(
    "row", [row for row in ROWS if row["load"] == "10kN"], ids=lambda row: f"{row['side']}-{row['y_ws']}mm"
)
def test_manchester_benchmark_with_its_own_rail(row: dict[str, str], manchester: WheelRailModel) -> None:
    rows, height = benchmark(row, manchester)
    assert abs(height) < 5e-6  # the wheelset stands where CONTACT's does
    y = float(row["y_ws"])
    if row["side"] == "right" and y == 5.0:
        return  # merged by the reference: the next test
    compare(row, rows, 0.0, creep=y > 1.5)


def test_manchester_two_point_row(manchester: WheelRailModel) -> None:
    """y = 5 mm, right wheel on tread side and gauge corner at once; the reference with patches kept apart."""
    references = [row for row in ROWS if row["load"] == "10kN_separate"]
    rows, _ = benchmark(references[0], manchester)
    rows = rows[np.argsort(rows[:, Patch.Y_RAIL])]
    assert len(rows) == len(references) == 2
    for ours, row in zip(rows, references, strict=True):
        assert ours[Patch.Y_RAIL] * 1e3 == pytest.approx(-float(row["y_r"]), abs=0.1)
        assert ours[Patch.CONTACT_ANGLE] == pytest.approx(-float(row["delta_r"]), abs=0.005)
        assert ours[Patch.NORMAL_FORCE] == pytest.approx(float(row["fn"]), abs=200.0)  # of 10 kN
        assert ours[Patch.P_MAX] == pytest.approx(float(row["pmax"]) * 1e6, rel=0.06)
