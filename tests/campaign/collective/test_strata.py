"""Keys and seeds of strata, and the replicates of single cells."""

import hashlib
import math
import subprocess
import sys
from dataclasses import replace

import pytest
from collectives import product_text

from hh_exudyn.campaign.collective import Collective, plan_of_text, template_text

SMALL = product_text("full", quantiles=1).replace(
    "[100.0, 80.0], share_percent = [70.0, 30.0]", "[100.0], share_percent = [100.0]"
)


@pytest.fixture(scope="module")
def small() -> Collective:
    return Collective(plan_of_text(SMALL))


def test_a_seed_is_a_hash_of_the_key(small: Collective) -> None:
    one = small.strata[0].stratum
    digest = hashlib.sha256(one.key.encode()).digest()
    assert one.seed == int.from_bytes(digest[:8], "big") % 2**31
    assert one.digest == digest.hex()[:10]


def test_seeds_are_the_same_in_another_process() -> None:
    code = (
        "from hh_exudyn.campaign.collective import *; "
        "print(Collective(plan_of_text(template_text())).strata[5].stratum.seed)"
    )
    other = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], check=True, capture_output=True, text=True
    )
    assert int(other.stdout) == Collective(plan_of_text(template_text())).strata[5].stratum.seed


def test_members_of_a_group_share_case_and_seed_and_nothing_else_does(small: Collective) -> None:
    keys = {item.stratum.key for item in small.strata}
    assert len({item.stratum.seed for item in small.strata}) == len(keys)  # no collision in some thousands
    one = next(item.stratum for item in small.strata if item.stratum.hand == "left")
    assert replace(one, hand="right", curve_class="other").seed == one.seed
    for change in ({"replicate": 9}, {"season": "other"}, {"gauge_mm": 1436.0}, {"vehicle": "other"}):
        assert replace(one, **change).seed != one.seed


def test_seeds_do_not_depend_on_weights_or_on_the_wheels(small: Collective) -> None:
    worn = SMALL.replace("WP4_like", "S1002").replace("share_percent = 12.0", "share_percent = 13.0")
    worn = worn.replace("share_percent = 28.0", "share_percent = 27.5").replace("km = 150000", "km = 1000")
    other = Collective(plan_of_text(worn))
    assert [s.stratum.seed for s in other.strata] == [s.stratum.seed for s in small.strata]
    assert [s.weight for s in other.strata] != [s.weight for s in small.strata]


def test_resampled_cells_keep_their_weight_and_their_old_seeds(small: Collective) -> None:
    cell = next(s.stratum.cell for s in small.strata if s.stratum.curve_class == "<350")
    found = small.resampled({cell: 7})
    assert math.fsum(s.weight for s in found) == pytest.approx(1.0, abs=1e-12)

    def of_cell(strata: tuple) -> tuple[float, set[int]]:
        mine = [s for s in strata if s.stratum.cell == cell]
        return math.fsum(s.weight for s in mine), {s.stratum.seed for s in mine}

    (before, old), (after, new) = of_cell(small.strata), of_cell(found)
    assert after == pytest.approx(before, rel=1e-12)
    assert old < new
    assert (len(old), len(new)) == (3, 7)
    rest = {s.stratum.key for s in found if s.stratum.cell != cell}
    assert rest == {s.stratum.key for s in small.strata if s.stratum.cell != cell}


def test_overlays_of_single_groups_are_resampled() -> None:
    """Of overlays a unit is a group of a running: new ones are added, old ones keep seeds and shares."""
    found = Collective(plan_of_text(product_text()))
    more = found.resampled({"loaded;<350": 5})
    assert math.fsum(s.weight for s in more) == pytest.approx(1.0, abs=1e-12)
    for hand, share in (("left", 0.0115), ("right", 0.011)):  # Table 1-3: 2.3 and 2.2 %, half of it loaded
        mine = [
            s
            for s in more
            if (s.stratum.running, s.stratum.curve_class, s.stratum.hand) == ("loaded", "<350", hand)
        ]
        assert math.fsum(s.weight for s in mine) == pytest.approx(share, abs=1e-12)
        assert {s.stratum.replicate for s in mine} == {1, 2, 3, 4, 5}
    assert {s.stratum.key for s in found.strata} < {s.stratum.key for s in more}


def test_units_that_cannot_be_resampled(small: Collective) -> None:
    with pytest.raises(ValueError, match="1 replicates of unit 'none': allowed 1 or more of a known unit"):
        small.resampled({"none": 1})
    with pytest.raises(ValueError, match="0 replicates of unit 'loaded;<350'"):
        Collective(plan_of_text(template_text())).resampled({"loaded;<350": 0})
