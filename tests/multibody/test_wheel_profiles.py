"""Runs with wheels of their own: the same profile by another key changes no digit; others are felt."""

import numpy as np
import pytest

from hh_exudyn.cli.reports import wear_table
from hh_exudyn.multibody.simulate import simulate

STRAIGHT = {"sections": [{"kind": "straight", "length_m": 32.0, "gauge_mm": 1445.0}]}


def test_the_same_profile_by_another_key_gives_the_same_bytes(demo, tmp_path):
    case = demo.with_changes(track=STRAIGHT)
    plain = simulate(case, tmp_path / "plain")
    named = simulate(case.with_changes(wheel_profiles={"L": "S1002", "2R": "S1002"}), tmp_path / "named")
    assert named.contact() == plain.contact()
    assert named.motion() == plain.motion()


@pytest.mark.slow
def test_a_wheelset_with_two_wheels_runs_to_the_side(demo, tmp_path):
    """One wheel of larger conicity grows faster with the displacement: the wheelset leaves the middle until
    both roll on equal radii, as mirrored wheelsets do to the other side; damage has every wheel once.

    Its bogie takes the other wheelsets along, through the car body those of the other bogie too, by less.
    """
    case = demo.with_changes(track=STRAIGHT, wheel_profiles={"3L": "WPL9_like"})
    run = simulate(case, tmp_path / "run")
    mirrored = simulate(case.mirrored(), tmp_path / "mirrored")

    def last(run, wheelset):
        log = {name: np.asarray(run.contact()[name]) for name in ("time", "wheelset", "y_wheelset")}
        mine = (log["wheelset"] == wheelset) & (log["time"] == log["time"].max())
        return log["y_wheelset"][mine][0]

    assert abs(last(run, 3)) > 1e-3  # m
    assert abs(last(run, 3)) > 1.25 * abs(last(run, 1))
    assert last(mirrored, 3) == pytest.approx(-last(run, 3), rel=1e-6)
    wear = wear_table(run, unfinished=False)
    assert sorted(zip(wear["wheelset"].to_pylist(), wear["side"].to_pylist(), strict=True)) == [
        (wheelset, side) for wheelset in (1, 2, 3, 4) for side in (-1, 1)
    ]
