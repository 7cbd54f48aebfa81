"""Friction in a case file: a number or a table, what a table says of which rail, and its faults."""

from importlib import resources
from typing import Any

import numpy as np
import pytest

from hh_exudyn.case import Case, CaseError, FrictionCase, FrictionSectionCase, SurfaceCase

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text()
TABLE = """
[friction]
climate = "cold_dry"
falling = "polach_dry"
lubricated_wheelsets = [1, 4]
ramp_m = 4.0

[friction.right]
treatments = ["top_of_rail"]

[[friction.sections]]
start_m = 50.0
tread = 0.5
gauge_corner = 0.3
flange = 0.2

[[friction.sections]]
start_m = 120.0
treatments = ["flange_lubrication"]

[friction.sections.left]
climate = "humid"
treatments = []
"""


@pytest.fixture(scope="module")
def demo() -> Case:
    return Case.from_toml(DEMO)


def with_table(table: str) -> Case:
    return Case.from_toml(DEMO.replace("friction = 0.40\n", "") + table)


@pytest.fixture(scope="module")
def varied() -> Case:
    return with_table(TABLE)


def test_a_number_holds_everywhere(demo: Case) -> None:
    table = demo.friction_table(4)
    assert (table.friction == 0.40).all()
    assert table.surface.size == 4
    assert table.ratio == 1.0


def test_a_table_says_what_each_rail_has(varied: Case) -> None:
    """The nearest table that says something counts, for the climate and for the treatments each."""
    table = varied.friction_table(4)
    left, right = 0, 1
    dry = table.friction[table.surface[1]]  # of a wheelset without grease of its own
    assert dry[0, left] == pytest.approx([0.75, 0.75, 0.75])
    assert dry[0, right] == pytest.approx([0.35, 0.35, 0.75])  # top-of-rail conditioning
    assert dry[1, left] == pytest.approx([0.5, 0.3, 0.2])
    assert dry[1, right] == pytest.approx([0.35, 0.3, 0.2])
    assert dry[2, left] == pytest.approx([0.3, 0.3, 0.3])
    assert dry[2, right] == pytest.approx([0.75, 0.25, 0.15])
    greased = table.friction[table.surface[0]]
    assert greased == pytest.approx(np.minimum(dry, [1.0, 0.25, 0.15]))
    assert list(table.surface == table.surface[0]) == [True, False, False, True]
    assert table.begin[1:] == pytest.approx([48.0, 118.0])
    assert (table.ratio, table.decrease) == (0.4, 0.6)


def test_what_is_written_is_read(varied: Case) -> None:
    for case in (varied, varied.mirrored()):
        assert Case.from_toml(case.to_toml()) == case
        assert Case.from_toml(case.to_toml()).to_toml() == case.to_toml()


def test_python_and_file_say_the_same(demo: Case, varied: Case) -> None:
    made = FrictionCase(
        climate="cold_dry",
        falling="polach_dry",
        lubricated_wheelsets=(1, 4),
        ramp_m=4.0,
        right=SurfaceCase(treatments=("top_of_rail",)),
        sections=(
            FrictionSectionCase(start_m=50.0, tread=0.5, gauge_corner=0.3, flange=0.2),
            FrictionSectionCase(
                start_m=120.0,
                treatments=("flange_lubrication",),
                left=SurfaceCase(climate="humid", treatments=()),
            ),
        ),
    )
    assert demo.with_changes(friction=made) == varied


def test_mirrored_exchanges_the_rails(varied: Case) -> None:
    mirror = varied.mirrored()
    assert mirror.mirrored() == varied
    here, there = varied.friction_table(4), mirror.friction_table(4)
    assert (there.friction == here.friction[:, :, ::-1]).all()
    assert (there.friction != here.friction).any()


def test_changes(demo: Case, varied: Case) -> None:
    assert varied.with_changes(friction=0.3) == demo.with_changes(friction=0.3)
    assert demo.with_changes(friction=varied.friction) == varied
    steady = varied.with_changes(friction={"falling": None})
    assert steady.friction_table(4).ratio == 1.0
    assert (steady.friction_table(4).friction == varied.friction_table(4).friction).all()


def test_falling_by_its_own_two_numbers(demo: Case, varied: Case) -> None:
    own = varied.with_changes(friction={"falling": {"ratio": 0.25, "decrease_s_per_m": 0.5}})
    assert (own.friction_table(4).ratio, own.friction_table(4).decrease) == (0.25, 0.5)
    assert Case.from_toml(own.to_toml()) == own


FAULTS = {  # table: parts of the message
    "nothing": ("[friction]\n", ["friction: climate is missing: allowed very_humid,", "cold_dry; or tread"]),
    "one rail": ('[friction.left]\nclimate = "dry"', ["friction: climate is missing", "cold_dry"]),
    "climate": ('[friction]\nclimate = "cold_dri"', ['friction.climate = "cold_dri"', '"cold_dry"?']),
    "number": ("[friction]\nclimate = 3", ["friction.climate = 3: allowed a text"]),
    "both": (
        '[friction]\nclimate = "dry"\nflange = 0.2',
        ['friction: climate = "dry" and flange: allowed is one or the other'],
    ),
    "one zone": ("[friction]\ntread = 0.3", ["friction: gauge_corner is missing: allowed tread, gauge_c"]),
    "range": ("[friction]\ntread = 3.0", ["friction.tread = 3: allowed 0.01 to 1"]),
    "treatment": (
        '[friction]\nclimate = "dry"\ntreatments = ["flange_lubrication", "sand"]',
        ['friction.treatments = ["flange_lubrication", "sand"]: ', "allowed top_of_rail, flange_lubrication"],
    ),
    "no list": (
        '[friction]\nclimate = "dry"\ntreatments = "flange_lubrication"',
        ["friction.treatments", 'allowed a list of treatments, as ["flange_lubrication"]'],
    ),
    "falling": (
        '[friction]\nclimate = "dry"\nfalling = "polach"',
        ['friction.falling = "polach": allowed polach_dry, polach_wet'],
    ),
    "own falling": (
        '[friction]\nclimate = "dry"\nfalling = { ratio = 1.4, decrease_s_per_m = 0.5 }',
        ["friction.falling.ratio = 1.4: allowed 0 to 1"],
    ),
    "lubrication": (
        '[friction]\nclimate = "dry"\nlubrication = "oil"',
        ['friction.lubrication = "oil": allowed top_of_rail, flange_lubrication'],
    ),
    "wheelset": (
        '[friction]\nclimate = "dry"\nlubricated_wheelsets = [1, 6]',
        ["friction.lubricated_wheelsets[1] = 6: allowed 1 to 4"],
    ),
    "half a wheelset": (
        '[friction]\nclimate = "dry"\nlubricated_wheelsets = [1.5]',
        ["friction.lubricated_wheelsets[0] = 1.5: allowed a list of whole numbers"],
    ),
    "key": ('[friction]\nclimat = "dry"', ['unknown key friction.climat = "dry"; did you mean "climate"?']),
    "too close": (
        '[friction]\nclimate = "dry"\nsections = [{start_m = 10}, {start_m = 11}]',
        ["friction: sections[1].start_m = 11 m: allowed from 12 m on, ramp_m = 2 m"],
    ),
    "no start": (
        '[friction]\nclimate = "dry"\n[[friction.sections]]\nclimate = "humid"',
        ["friction.sections[0].start_m is missing"],
    ),
    "behind the end": (
        '[friction]\nclimate = "dry"\n[[friction.sections]]\nstart_m = 250',
        ["friction.sections[0].start_m = 250 m: allowed below 250 m, the length of the track"],
    ),
    "key of a rail": (
        '[friction]\nclimate = "dry"\nsections = [{start_m = 50, left = {zzz = 1}}]',
        ["unknown key friction.sections[0].left.zzz = 1; known keys: climate, tread"],
    ),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault_is_one_line(name: str) -> None:
    table, parts = FAULTS[name]
    with pytest.raises(CaseError) as caught:
        with_table(table)
    text = str(caught.value)
    assert "\n" not in text
    for part in parts:
        assert part in text


@pytest.mark.parametrize("value", [0, 1.01, True, "0.4", [0.4], None, float("nan")])
def test_what_is_neither_number_nor_table(demo: Case, value: Any) -> None:
    with pytest.raises(CaseError, match=r"^friction = .*: allowed 0.01 to 1, or a table \[friction\]$"):
        demo.with_changes(friction=value)
