"""Malformed case files: each is refused with exit code 2 and one line, and nothing is written."""

import os
import re
from importlib import resources
from pathlib import Path

import pytest
from malformed import check_refused

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
HEAD, TAIL = DEMO[: DEMO.index("[[track.sections]]")], DEMO[DEMO.index("[contact]") :]
ALLOWED_FRICTION = "allowed 0.01 to 1, or a table [friction]"
ONE_LINE = "allowed a text of one line without control characters"

KEYS = [  # table, key, value, part of the line
    ("", "name", "3", "name = 3: allowed a text"),
    ("", "name", '""', 'name = "": allowed a text'),
    ("", "name", r'"a\nb"', ONE_LINE),
    ("", "name", r'"\u001b[31m"', ONE_LINE),
    ("", "name", '"  "', ONE_LINE),
    ("", "name", "true", "name = true: allowed a text"),
    ("", "vehicle", '"iore"', "vehicle 'iore' is not known; known: "),
    ("", "vehicle", "3", "allowed a name of the catalogue, a vehicle file, or a table [vehicle]"),
    ("", "vehicle", "true", "allowed a name of the catalogue, a vehicle file, or a table [vehicle]"),
    ("", "vehicle", '["iore_wagon_loaded"]', "allowed a name of the catalogue"),
    ("", "vehicle", '"none.toml"', "cannot be read: No such file or directory"),
    ("", "vehicle", '"./loop"', "cannot be read: Too many levels of symbolic links"),
    ("", "speed_km_h", '"60"', 'speed_km_h = "60": allowed 5 to 130 km/h'),
    ("", "speed_km_h", "4.9", "speed_km_h = 4.9 km/h: allowed 5 to 130 km/h"),
    ("", "speed_km_h", "131", "speed_km_h = 131 km/h: allowed 5 to 130 km/h"),
    ("", "speed_km_h", "nan", "speed_km_h = nan km/h: allowed 5 to 130 km/h"),
    ("", "speed_km_h", "inf", "speed_km_h = inf km/h: allowed 5 to 130 km/h"),
    ("", "speed_km_h", "1e400", "speed_km_h = inf km/h: allowed 5 to 130 km/h"),
    ("", "speed_km_h", "-60", "speed_km_h = -60 km/h: allowed 5 to 130 km/h"),
    ("", "speed_km_h", "true", "speed_km_h = true km/h: allowed 5 to 130 km/h"),
    ("", "speed_km_h", "[60]", "speed_km_h = [60]: allowed 5 to 130 km/h"),
    ("", "friction", "0", f"friction = 0: {ALLOWED_FRICTION}"),
    ("", "friction", "1.5", f"friction = 1.5: {ALLOWED_FRICTION}"),
    ("", "friction", "-0.4", f"friction = -0.4: {ALLOWED_FRICTION}"),
    ("", "friction", "nan", f"friction = nan: {ALLOWED_FRICTION}"),
    ("", "friction", '"dry"', f'friction = "dry": {ALLOWED_FRICTION}'),
    ("", "friction", "true", f"friction = true: {ALLOWED_FRICTION}"),
    ("", "wheel_profile", "3", "wheel_profile = 3: allowed a text"),
    ("", "wheel_profile", '"S1003"', "unknown wheel profile 'S1003'; known: S1002"),
    ("", "wheel_profile", '"none.prf"', "none.prf"),
    ("", "wheel_profile", '"loop/x.prf"', "loop/x.prf"),
    ("", "wheel_profile", '"."', "wheel_profile"),
    ("", "colour", '"red"', 'unknown key colour = "red"; known keys: name, vehicle'),
    ("", "speed", "60", 'unknown key speed = 60; did you mean "speed_km_h"?'),
    ("track", "rail", '"61E1"', "unknown rail profile '61E1'; known: 54E1"),
    ("track", "rail", "3", "track.rail = 3: allowed a text"),
    ("track", "rail", '"none.txt"', "none.txt"),
    ("track", "inclination", '"1:10"', 'track.inclination = "1:10": allowed "1:15" to "1:100"'),
    ("track", "inclination", '"30"', 'track.inclination = "30": allowed'),
    ("track", "inclination", "0.5", "track.inclination = 0.5: allowed"),
    ("track", "inclination", "nan", "track.inclination = nan: allowed"),
    ("track", "inclination", "true", "track.inclination = true: allowed"),
    ("track", "inclination", "[30]", "track.inclination = [30]: allowed"),
    ("track", "inclination", '"1:0"', 'track.inclination = "1:0": allowed'),
    ("track", "flexibility", '"wood"', "track flexibility 'wood' is not known, there are: concrete"),
    ("track", "flexibility", "true", "track.flexibility = true: allowed a text"),
    ("track", "sleeper_passing", '"yes"', 'track.sleeper_passing = "yes": allowed true or false'),
    ("track", "sleeper_passing", "1", "track.sleeper_passing = 1: allowed true or false"),
    ("track", "irregularity", '"erri"', "allowed none, erri_low, erri_high"),
    ("track", "irregularity", "3", "track.irregularity = 3: allowed a text"),
    ("track", "irregularity", '"none.csv"', "cannot be read: No such file or directory"),
    ("track", "irregularity", '"loop/x.csv"', "cannot be read: Too many levels of symbolic links"),
    ("track", "irregularity_seed", "-1", "track.irregularity_seed = -1: allowed 0 to"),
    ("track", "irregularity_seed", "1.5", "track.irregularity_seed = 1.5: allowed 0 to"),
    ("track", "irregularity_scale", "11", "track.irregularity_scale = 11: allowed 0 to 10"),
    ("track", "irregularity_scale", "nan", "track.irregularity_scale = nan: allowed 0 to 10"),
    ("track", "irregularity_shortest_m", "0.1", "track.irregularity_shortest_m = 0.1 m: allowed 0.5 to 25 m"),
    ("track", "irregularity_mirrored", '"no"', "track.irregularity_mirrored"),
    ("track", "rail_change_m", "0", "track.rail_change_m = 0 m: allowed 0.5 to 100 m"),
    ("track", "gauge_mm", "1435", "unknown key track.gauge_mm = 1435"),
    ("contact", "normal", '"hertzian"', 'did you mean "hertz"?'),
    ("contact", "theory", '"fastripp"', 'did you mean "fastrip"?'),
    ("contact", "theory", '"halfspace"', 'contact.theory = "halfspace": allowed strip'),
    ("contact", "cells", "[4, 16]", "contact.cells[0] = 4: allowed two whole numbers from 5 to 100"),
    ("contact", "cells", "[32]", "contact.cells[1] is missing: allowed two whole numbers"),
    ("contact", "cells", "[32, 16, 8]", "contact.cells = [32, 16, 8]: allowed two whole numbers"),
    ("contact", "cells", "32", "contact.cells = 32: allowed two whole numbers"),
    ("contact", "cells", "[32.5, 16]", "contact.cells[0] = 32.5: allowed two whole numbers"),
    ("contact", "damping_s_per_m", "-1", "contact.damping_s_per_m = -1 s/m: allowed 0 to 3 s/m"),
    ("contact", "damping_s_per_m", "nan", "contact.damping_s_per_m = nan s/m: allowed 0 to 3 s/m"),
    ("integration", "step_ms", "0", "integration.step_ms = 0 ms: allowed 0.05 to 1 ms"),
    ("integration", "step_ms", '"0.4"', 'integration.step_ms = "0.4": allowed 0.05 to 1 ms'),
    ("integration", "output_interval_ms", "0.5", "allowed whole multiples of step_ms = 0.4 ms"),
    ("integration", "output_interval_ms", "1e9", "allowed 0.05 to 1000 ms"),
]

STRAIGHT, RAMP = 'kind = "straight"\nlength_m = 50', 'kind = "transition"\nlength_m = 50'
CURVE = 'kind = "curve"\nlength_m = 50\n'
SECTIONS = {  # part of the line: sections
    'sections[0].kind = "bend": allowed straight, transition': ('kind = "bend"\nlength_m = 50',),
    "sections[0].kind is missing: allowed straight, transition": ("length_m = 50",),
    "length 10 m in all: allowed from 30 m": ('kind = "straight"\nlength_m = 10',),
    "sections[0].length_m = -5 m: allowed 1 to": ('kind = "straight"\nlength_m = -5',),
    'sections[0].length_m = "50": allowed 1 to': ('kind = "straight"\nlength_m = "50"',),
    "sections[0].length_m = true m: allowed 1 to": ('kind = "straight"\nlength_m = true',),
    "sections[0].length_m = nan m: allowed 1 to": ('kind = "straight"\nlength_m = nan',),
    "sections[0].gauge_mm = 1410 mm leaves no flange clearance": (f"{STRAIGHT}\ngauge_mm = 1410",),
    "unknown key track.sections[0].cant_mm = 20": (f"{STRAIGHT}\ncant_mm = 20",),
    "sections[0].rail = \"61E1\": unknown rail": (f'{STRAIGHT}\nrail = "61E1"',),
    "sections[2].radius_m = 45 m: allowed 100 to": (STRAIGHT, RAMP, f'{CURVE}radius_m = 45\nhand = "left"'),
    'sections[2].hand = "links": allowed left, right': (
        STRAIGHT, RAMP, f'{CURVE}radius_m = 450\nhand = "links"'
    ),
    "sections[2].cant_mm = 250 mm: allowed": (
        STRAIGHT, RAMP, f'{CURVE}radius_m = 450\nhand = "left"\ncant_mm = 250'
    ),
    "sections[2].cant_mm = -20 mm: allowed": (
        STRAIGHT, RAMP, f'{CURVE}radius_m = 450\nhand = "left"\ncant_mm = -20'
    ),
    "curvature jumps from 0 to 0.00222222 1/m": (STRAIGHT, f'{CURVE}radius_m = 450\nhand = "left"'),
    'sections[1].shape = "spline": allowed clothoid': (STRAIGHT, f'{RAMP}\nshape = "spline"', STRAIGHT),
    "radius_m has 50 m: allowed 0 in a straight": (
        STRAIGHT, 'kind = "ramp"\nlength_m = 50\nradius_m = [0.0, 50.0]'
    ),
    "radius_m[1] is missing: allowed two radii in m": (
        STRAIGHT, 'kind = "ramp"\nlength_m = 50\nradius_m = [0.0]'
    ),
}  # fmt: skip

SECTION = "[[friction.sections]]\nstart_m = "
FRICTIONS = {  # part of the line: table
    'friction.climate = "arctic": allowed very_humid': 'climate = "arctic"',
    'climate = "dry" and tread: allowed is one or the other': 'climate = "dry"\ntread = 0.4',
    "gauge_corner is missing: allowed tread, gauge_corner, flange": "tread = 0.4\nflange = 0.3",
    "friction.gauge_corner = 2: allowed 0.01 to 1": "tread = 0.4\ngauge_corner = 2\nflange = 0.1",
    'friction.treatments = ["oil"]: allowed top_of_rail': 'climate = "dry"\ntreatments = ["oil"]',
    "allowed a list of treatments": 'climate = "dry"\ntreatments = "oil"',
    "lubricated_wheelsets[0] = 9: allowed 1 to 4": 'climate = "dry"\nlubricated_wheelsets = [9]',
    "lubricated_wheelsets[0] = 1.5: allowed": 'climate = "dry"\nlubricated_wheelsets = [1.5]',
    'friction.falling = "polach": allowed polach_dry': 'climate = "dry"\nfalling = "polach"',
    "friction.ramp_m = 0 m: allowed 0.1 to 100 m": 'climate = "dry"\nramp_m = 0',
    "start_m = 400 m: allowed below 250 m": f'climate = "dry"\n{SECTION}400\nclimate = "humid"',
    "start_m = 50 m: allowed from 102 m on": f'climate = "dry"\n{SECTION}100\n{SECTION}50',
    "friction: climate is missing": "ramp_m = 2.0",
    "friction.left = 3: allowed a table": 'climate = "dry"\nleft = 3',
}

TEXTS = {  # part of the line: the whole file
    "name is missing: allowed a text (and 3 more)": "",
    "not valid TOML: Expected '=' after a key": DEMO.replace("name =", "name"),
    "not valid TOML: Cannot declare ('contact',) twice": f"{DEMO}\n[contact]\n",
    "nested too deep": f"a = {'[' * 3000}{']' * 3000}",
    "not valid TOML: Invalid statement": '{"name": 3}',
    "name is missing: allowed a text\n": DEMO.replace('name = "demo"\n', ""),
    "track is missing": DEMO[: DEMO.index("[track]")],
    "track = 3: allowed a table": DEMO[: DEMO.index("[track]")] + "track = 3\n",
    "sections and alignment given: allowed exactly one": DEMO.replace(
        "[track]\n", '[track]\nalignment = "x"\n'
    ),
    "gradient_per_mille = 90 per mille: allowed -50 to 50": DEMO.replace(
        "[track]\n", "[track]\ngrades = [{length_m = 5000, gradient_per_mille = 90}]\n"
    ),
    "traction given: vehicle iore_wagon_loaded has no drives": f"{DEMO}\n[traction]\n",
    "steering given: vehicle iore_wagon_loaded has no drives": f"{DEMO}\n[steering]\n",
    "train.draft_kN = 1e+09 kN: allowed -2000 to 2000 kN": f"{DEMO}\n[train]\ndraft_kN = 1e9\n",
    'unknown key brake.force_kN = -1; did you mean "shoe_force_kN"?': f"{DEMO}\n[brake]\nforce_kN = -1\n",
}


def changed(table: str, key: str, value: str) -> str:
    """The demo's case with another value of a key at the top or in a table."""
    start = 0 if not table else DEMO.index(f"[{table}]\n") + len(table) + 3
    end = DEMO.find("\n[", start) + 1 or len(DEMO)
    inside = re.sub(rf"(?m)^{key} = .*\n", "", DEMO[start:end])
    return f"{DEMO[:start]}{key} = {value}\n{inside}{DEMO[end:]}"


def refuse(folder: Path, text: str, part: str) -> None:
    (folder / "loop").symlink_to(folder / "loop")
    (folder / "case.toml").write_text(text, encoding="utf-8")
    check_refused(folder, ("run", folder / "case.toml", "--out", folder / "out"), part)


@pytest.mark.parametrize(("table", "key", "value", "part"), KEYS)
def test_keys(tmp_path: Path, table: str, key: str, value: str, part: str) -> None:
    refuse(tmp_path, changed(table, key, value), part)


@pytest.mark.parametrize("part", SECTIONS)
def test_sections(tmp_path: Path, part: str) -> None:
    sections = "".join(f"[[track.sections]]\n{section}\n\n" for section in SECTIONS[part])
    refuse(tmp_path, HEAD + sections + TAIL, part)


@pytest.mark.parametrize("part", FRICTIONS)
def test_friction(tmp_path: Path, part: str) -> None:
    refuse(tmp_path, f"{DEMO.replace('friction = 0.40', '')}\n[friction]\n{FRICTIONS[part]}\n", part)


@pytest.mark.parametrize("part", TEXTS)
def test_texts(tmp_path: Path, part: str) -> None:
    refuse(tmp_path, TEXTS[part], part)


def test_files_that_are_none(tmp_path: Path) -> None:
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe\x00name")
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    for name, part in (
        ("bytes.toml", "not valid TOML: not UTF-8 at byte 0"),
        ("none.toml", "cannot be read: No such file or directory"),
        ("loop", "cannot be read: Too many levels of symbolic links"),
    ):
        check_refused(tmp_path, ("run", tmp_path / name, "--out", tmp_path / "out"), part)


@pytest.mark.parametrize(
    ("out", "part"),
    [
        ("loop", "File exists"),
        ("case.toml", "is a file, allowed is a new or an empty folder"),
        ("case.toml/x", "--out"),
        ("full", "is not empty, allowed is a new or an empty folder"),
        ("x" * 300, "File name too long"),
        ("/proc/hh-exudyn/run", "No such file or directory"),
    ],
)
def test_folders_that_take_no_run(tmp_path: Path, out: str, part: str) -> None:
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "precious").write_text("mine")
    (tmp_path / "case.toml").write_text(DEMO)
    check_refused(tmp_path, ("run", tmp_path / "case.toml", "--out", tmp_path / out), part)


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_without_leave_to_write(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(DEMO)
    (tmp_path / "mine").mkdir(mode=0o500)
    out = tmp_path / "mine" / "run"
    check_refused(tmp_path, ("run", tmp_path / "case.toml", "--out", out), "Permission denied")
