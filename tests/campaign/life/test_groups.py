"""Which wheel of a run is in which group, by hand, direction and mirror image."""

from dataclasses import replace

import pytest

from hh_exudyn.campaign.collective import Collective, plan_of_text, template_text
from hh_exudyn.campaign.life.groups import GROUPINGS, Grouping, bogie_axles
from hh_exudyn.conventions import LEFT, RIGHT
from vehicles.catalogue import vehicle

PAIR = vehicle("iore_wagon_pair_loaded")
CURVE = next(
    item.stratum
    for item in Collective(plan_of_text(template_text())).strata
    if not item.stratum.straight and item.stratum.run_hand == "left"
)


def test_axles_of_bogies() -> None:
    assert bogie_axles(PAIR) == ("leading", "trailing") * 4
    assert bogie_axles(vehicle("iore_locomotive")) == ("leading", "middle", "trailing") * 2


@pytest.mark.parametrize("kind", GROUPINGS)
def test_every_wheel_is_in_one_of_the_named_groups(kind: str) -> None:
    grouping = Grouping(kind)
    found = grouping.of_run(PAIR, CURVE, returning=False, mirrored=False)
    assert len(found) == 16
    assert set(found.values()) == set(grouping.names(PAIR))


def test_the_right_wheel_is_the_outer_one_of_a_left_curve() -> None:
    for hand, outer in (("left", RIGHT), ("right", LEFT), ("straight", RIGHT)):
        found = Grouping("role").of_run(PAIR, replace(CURVE, run_hand=hand), False, False)
        assert {found[wheelset, outer] for wheelset in range(1, 9)} == {"outer"}
        assert {found[wheelset, -outer] for wheelset in range(1, 9)} == {"inner"}


def test_a_mirrored_run_stands_for_the_other_side_but_for_the_same_role() -> None:
    as_run, mirrored = (Grouping("wheel").of_run(PAIR, CURVE, False, flag) for flag in (False, True))
    assert as_run[3, LEFT] == mirrored[3, RIGHT] == "3L"
    roles = [Grouping("axle_role").of_run(PAIR, CURVE, False, flag) for flag in (False, True)]
    assert roles[0] == roles[1]


def test_a_vehicle_that_is_not_turned_round_runs_backwards_on_the_way_back() -> None:
    shuttle, loop = Grouping("wheel", turns_round=False), Grouping("wheel", turns_round=True)
    assert shuttle.of_run(PAIR, CURVE, True, False)[1, LEFT] == "8R"
    assert shuttle.of_run(PAIR, CURVE, False, False)[1, LEFT] == "1L"
    assert loop.of_run(PAIR, CURVE, True, False)[1, LEFT] == "1L"
    assert Grouping("axle", turns_round=False).of_run(PAIR, CURVE, True, False)[1, LEFT] == "trailing"


def test_an_unknown_grouping_is_named() -> None:
    with pytest.raises(ValueError, match="groups = 'bogie': allowed all, axle"):
        Grouping("bogie")
