"""Malformed vehicle files: refused by every command that takes one, with one line, and nothing is written."""

from pathlib import Path

import pytest
from malformed import check_refused

from vehicles.variants import find_variant
from vehicles.whole.writing import to_toml

CASE = """name = "short"
speed_km_h = 60.0
friction = 0.4
vehicle = "mine.toml"

[track]
flexibility = "rigid"

[[track.sections]]
kind = "straight"
length_m = 30.0
gauge_mm = 1445.0
"""
WHOLE = to_toml(find_variant("iore_wagon_loaded").document())

FAULTS: dict[str, tuple[str, str] | bytes] = {  # part of the line: what is replaced by what, or a whole file
    "not valid TOML": ("[wedge]", "[wedge"),
    "not valid TOML: not UTF-8 at byte 0": b"\xff\xff",
    "base is missing": b"",
    "bodies: allowed a list of tables": b'bodies = "car_body"\n',
    "couplings is missing": b"bodies = []\n",
    "has base and bodies": ("name = ", 'base = "iore_wagon_loaded"\nname = '),
    "unknown key colour": ("name = ", 'colour = "red"\nname = '),
    "no entry has part = 'wdge'; did you mean \"wedge\"?": ("[wedge]", "[wdge]\nfriction = 1\n[wedge]"),
    "type = 'Wege'; did you mean \"Wedge\"?": ('type = "Wedge"', 'type = "Wege"'),
    "no body named bolster_7": ('body_b = "bolster_1"', 'body_b = "bolster_7"'),
    "wedge.friction = nan: allowed is a finite number": (
        "friction = { value = 0.3",
        "friction = { value = nan",
    ),
    "wedge.friction = 'dry': allowed a number": ("friction = { value = 0.3", 'friction = { value = "dry"'),
    'side_frame.mass is in "N": allowed "kg", "t"': ('558.74, unit = "kg"', '558.74, unit = "N"'),
    "source starts with 'guess'": ("assumed: A has 0.01", "guess: A has 0.01"),
    "wedge_1L_front jams": ("friction = { value = 0.3,", "friction = { value = 1.3,"),
    "wheelset_1.bogie = 1.5: allowed a whole number": ("bogie = 1 }", "bogie = 1.5 }"),
    "bolster_1.position = [1.0]: allowed 3 numbers in brackets": ("[3.385, 0.0, 0.67]", "[1.0]"),
    "lies 50 m above the rails: allowed 0 to 8 m": ("[3.385, 0.0, 0.67]", "[3.385, 0.0, 50.0]"),
}


@pytest.mark.parametrize("part", FAULTS)
def test_a_fault_in_a_vehicle_file(tmp_path: Path, part: str) -> None:
    fault = FAULTS[part]
    if isinstance(fault, tuple):
        assert fault[0] in WHOLE
        content = WHOLE.replace(fault[0], fault[1], 1).encode()
    else:
        content = fault
    (tmp_path / "mine.toml").write_bytes(content)
    (tmp_path / "case.toml").write_text(CASE)
    for words in (
        ("vehicle", "show", tmp_path / "mine.toml"),
        ("vehicle", "export", tmp_path / "mine.toml", "-o", tmp_path / "new.toml"),
        ("run", tmp_path / "case.toml", "--out", tmp_path / "out"),
        ("modes", tmp_path / "case.toml"),
    ):
        check_refused(tmp_path, words, part)


@pytest.mark.parametrize("content", [b"", b"[1]", b"{", b"\xff", b'{"bodies": 3}'])
def test_a_fault_in_a_stored_vehicle(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "vehicle.json").write_bytes(content)
    check_refused(tmp_path, ("vehicle", "show", tmp_path / "vehicle.json"), "vehicle.json: ")
    (tmp_path / "case.toml").write_text(CASE.replace("mine.toml", "vehicle.json"))
    check_refused(tmp_path, ("run", tmp_path / "case.toml", "--out", tmp_path / "out"), "vehicle.json: ")
