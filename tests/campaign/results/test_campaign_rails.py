"""Rails by class: weights, hands and gross tonnes."""

from dataclasses import replace

import numpy as np
import pytest

from damage.rails.rail_surface import RailSurface
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.wheel_surface import Wheel
from hh_exudyn.campaign.collective import Collective, WeightedCase, plan_of_text, template_text
from hh_exudyn.campaign.engine.sums import DamageSums
from hh_exudyn.campaign.results.rails import rail_table, rails_by_class
from hh_exudyn.conventions import LEFT, RIGHT

COLLECTIVE = Collective(plan_of_text(template_text()))
STRATA = COLLECTIVE.strata
CURVE = next(item for item in STRATA if not item.stratum.straight)
STRAIGHT = next(item for item in STRATA if item.stratum.straight)


def passing(side: int, depth: float, mass: float) -> RailSurface:
    """A rail worn by a depth in one bin by one passing of a mass."""
    rail = RailSurface.zero(side, (Wheel(1, 1, 1, side),), LateralGrid(), PatchGrid())
    rail.by_wheel.depth_by_part[0, 0, 80] = depth
    return replace(rail, mass=mass)


def result(item, weight: float, left: float, right: float, mass: float, hand: str | None = None):
    stratum = item.stratum if hand is None else replace(item.stratum, run_hand=hand)
    case = WeightedCase(None, weight, stratum, False, None, ())  # type: ignore[arg-type]
    return case, {"body": DamageSums((), {}, (passing(LEFT, left, mass), passing(RIGHT, right, mass)))}


def test_the_outer_rail_of_either_hand_is_the_high_one() -> None:
    both = [result(CURVE, 0.1, 1e-9, 4e-9, 1e5, "left"), result(CURVE, 0.1, 4e-9, 1e-9, 1e5, "right")]
    table = {row["rail"]: row for row in rail_table(rails_by_class(both)).to_pylist()}
    assert set(table) == {"high", "low"}
    assert table["high"]["wear_mm_per_MGT"] == pytest.approx(4e-9 / 1e5 * 1e9 * 1e3)
    assert table["low"]["wear_mm_per_MGT"] == pytest.approx(1e-9 / 1e5 * 1e9 * 1e3)


def test_passings_count_with_their_weights_and_masses() -> None:
    """Three loaded passings and one empty: depth over the mass of all four."""
    mix = [result(STRAIGHT, 0.3, 2e-9, 2e-9, 2.4e5), result(STRAIGHT, 0.1, 1e-9, 1e-9, 0.4e5)]
    (row,) = rail_table(rails_by_class(mix)).to_pylist()
    per_kg = (3 * 2e-9 + 1e-9) / (3 * 2.4e5 + 0.4e5)
    assert row["rail"] == "straight"
    assert row["wear_mm_per_MGT"] == pytest.approx(per_kg * 1e9 * 1e3)
    assert np.isfinite(row["rcf_per_MGT"])


def test_results_without_rails_give_no_rows() -> None:
    case, _ = result(CURVE, 0.1, 1e-9, 1e-9, 1e5)
    assert rails_by_class([(case, {"body": DamageSums(())})]) == {}
