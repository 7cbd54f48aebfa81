"""Malformed options of every command, and malformed vehicle files: exit code 2, one line, nothing written."""

from importlib import resources
from pathlib import Path

import pytest
from malformed import check_refused

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
PATCH = "patch --a-mm 6 --b-mm 5 --load-kn 100"
CURVES = "creep-curve --a-mm 6 --b-mm 5 --load-kn 100"

USAGE = {  # command: the whole line
    "demo": "Missing option '--out'; see hh-exudyn demo --help",
    "dmo": "No such command 'dmo'",
    "run": "Missing argument 'CASE.toml'; see hh-exudyn run --help",
    "run --out": "requires an argument; see hh-exudyn",
    "track plt": "No such command 'plt'",
    "conicity S1002": "Missing argument 'RAIL'; see hh-exudyn conicity --help",
    "conicity S1002 60E1 --nope": "No such option: --nope",
    "patch --a-mm x": "Invalid value for '--a-mm'",
    f"{PATCH} --cellls 3": "No such option: --cellls",
    "conicity S1003 60E1": "S1003",
    "conicity S1002 61E1": "61E1",
    "conicity HERE/none.prf 60E1": "none.prf",
}

OPTIONS = USAGE | {  # command, HERE for the folder of the test: part of the line
    f"{PATCH} --a-mm 0": "--a-mm 0 mm: allowed 0.1 to 100 mm",
    f"{PATCH} --a-mm nan": "--a-mm nan mm: allowed 0.1 to 100 mm",
    f"{PATCH} --b-mm 1e9": "--b-mm 1e+09 mm: allowed 0.1 to 100 mm",
    f"{PATCH} --load-kn -1": "--load-kn -1 kN: allowed 0.001 to 1000 kN",
    f"{PATCH} --friction 3": "--friction 3: allowed 0.001 to 2",
    f"{PATCH} --nu-x 2": "--nu-x 2: allowed -1 to 1",
    f"{PATCH} --nu-y inf": "--nu-y inf: allowed -1 to 1",
    f"{PATCH} --spin 1000": "--spin 1000 1/m: allowed -100 to 100 1/m",
    f"{PATCH} --cells 3": "--cells 3: allowed 5 to 400",
    f"{PATCH} --theory contact": "--theory contact: unknown, allowed: carter, linear",
    f"{PATCH} --out HERE/x.doc": "allowed are .png, .pdf, .svg",
    f"{PATCH} --out HERE/no/x.png": "there is no folder",
    f"{PATCH} --out HERE/loop.png": "exists already",
    f"{CURVES} --over yaw": "--over yaw: unknown, allowed: longitudinal, lateral, spin",
    f"{CURVES} --reach 0": "--reach 0: allowed 0.01 to 100",
    f"{CURVES} --points 1": "--points 1: allowed 2 to 1000",
    f"{CURVES} --cells 2": "--cells 2: allowed 6 to 200",
    f"{CURVES} --table HERE/x.txt": "allowed is .csv",
    f"{CURVES} --theory x": "--theory x: unknown, allowed: carter",
    "track plot malmbana": "no such file and no known line; known lines: malmbanan",
    "track plot HERE": "is a folder, allowed is a case file or a line's file",
    "track plot HERE/none.toml": "no such file and no known line",
    "track plot HERE/good.toml --speed-km-h 500": "--speed-km-h 500 km/h: allowed 5 to 130 km/h",
    "track plot malmbanan --speed-km-h 60": "for cases only, a line has speeds of its own",
    "track plot malmbanan --vehicle tram": "has no speed for vehicle 'tram', there are: iore_locomotive",
    "track plot malmbanan --out HERE/x.txt": "allowed are .png, .pdf, .svg",
    "vehicle show tram": "vehicle 'tram' is not known; known: ",
    "vehicle show HERE/none.toml": "none.toml: cannot be read: No such file or directory",
    "vehicle show iore_wagon_loaded --figure HERE/x.doc": "--figure",
    "vehicle compare iore_wagon_loaded tram": "vehicle 'tram' is not known; known: ",
    "parameters wheels": "GROUP wheels: allowed vehicle, track, profiles, steel, wear, assessment",
    "modes HERE/none.toml": "cannot be read: No such file or directory",
    "modes HERE/good.toml --speed-km-h 1e4": "--speed-km-h 10000 km/h: allowed 5 to 500 km/h",
    "critical-speed HERE/good.toml --from-km-h 0": "--from-km-h 0 km/h: allowed 5 to 500 km/h",
    "critical-speed HERE/good.toml --from-km-h 99 --to-km-h 50": "allowed above --from-km-h 99 km/h",
    "critical-speed HERE/good.toml --step-km-h 0": "--step-km-h 0 km/h: allowed 0.1 to 500 km/h",
    "playback HERE/none": "is not a directory",
    "playback HERE/run": "no finished part of the log 'contact'",
    "damage HERE/none": "is not a directory",
    "damage HERE/good.toml": "is not a directory",
    "damage HERE/run": "no finished part of the log 'contact'",
    "damage HERE/run --distance-km nan": "--distance-km nan km: allowed 0.001 to 1e+07 km",
    "damage HERE/run --pressure-limit 0": "--pressure-limit 0 MPa: allowed 1 to 100000 MPa",
    "damage HERE/run --model x": "wear law = 'x'; known: archard",
    "damage HERE/run --model krause_poll": "needs coefficients and power_densities",
    "damage HERE/run --material ER70": "wheel material 'ER70' is not known; known: ER7, ER8, ER9",
    "damage HERE/run --surface wet": "surface = 'wet'; known: dry, lubricated, greased",
    "damage HERE/run --theory polach": "theory = 'polach'; theories with a slip field",
    "damage HERE/run --out HERE/good.toml": "is a file, allowed is a new or an empty folder",
    "assess HERE/none": "is not a directory",
    "assess HERE/run": "the run is not finished",
    "assess HERE/run --unfinished": "no finished part of the log 'contact'",
    "assess HERE/run --section-length-m 5": "--section-length-m 5 m: allowed 10 to 1000 m",
    "assess HERE/run --table HERE/x.txt": "allowed is .csv",
}

BASE = 'base = "iore_wagon_loaded"\n'
VEHICLES = {  # vehicle file: part of the line
    "": "base is missing: allowed a name of the catalogue or a vehicle file",
    "base = 3": "base = 3: allowed a text",
    'base = "wagon"': "vehicle 'wagon' is not known; known: ",
    'base = "veh.toml"': "its base leads back to itself: veh.toml -> veh.toml",
    'base = "loop.png"': "Too many levels of symbolic links",
    f"{BASE}wedge.friction = 'a'": "wedge.friction = 'a': allowed a number, a text as",
    f"{BASE}wedge.friction = true": "wedge.friction = True: allowed is a finite number",
    f"{BASE}wedge.friction = nan": "wedge.friction = nan: allowed is a finite number",
    f"{BASE}wedge.friction = 3": "wedge.friction = 3 is no plausible friction: allowed 0 to 1",
    f"{BASE}wagon.payload = 98.4": "wagon.payload = 98.4 kg is no plausible payload",
    f"{BASE}wagon.payload = 3e5": "wagon.payload = 300000 kg is no plausible payload",
    f"{BASE}wheelset.wheelbase = 1778": "wheelset.wheelbase = 1778 m is no plausible length",
    f"{BASE}bolster.height = -0.6": "bolster.height = -0.6 m is no plausible height: allowed 0.05 to 6 m",
    f"{BASE}wagon.centre_plate_distance = 11": "outside the vehicle: allowed -5.145 to 5.145 m",
    f"{BASE}axle_box_pad.lateral_stiffness = 8.7": "stiffness: allowed 0, or 10000 to 1e+10 N/m",
    f"{BASE}axle_box.stop_stiffness = 1e15": "axle_box.stop_stiffness = 1e+15 N/m is no plausible stiffness",
    f"{BASE}centre_plate.stick_stiffness = 175130": "where the base has 1.7513e+08 N/m: in another unit?",
    f'{BASE}wheelset.radius = {{value = 18, unit = "inch"}}': 'is in "inch": allowed "m", "mm", "cm"',
    f'{BASE}wheelset.radius = {{unit = "mm"}}': 'allowed a number, a text as "1.5 kN", or a table of value',
    f"{BASE}nothing = 3": "nothing = 3: unknown key; known are name, base, description and tables",
    f"{BASE}wedge.colour = 3": "unknown parameter wedge.colour",
    f"{BASE}wedge = [1, 2]": "wedge = [1, 2]: unknown key",
    f"{BASE}description = 3": "description = 3: allowed a text",
    f"a = {'[' * 3000}{']' * 3000}": "nested too deep",
    "base = ": "not valid TOML",
}


@pytest.fixture
def here(tmp_path: Path) -> Path:
    """A folder with a good case, a run without logs, and a link to itself."""
    (tmp_path / "good.toml").write_text(DEMO)
    (tmp_path / "loop.png").symlink_to(tmp_path / "loop.png")
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "case.toml").write_text(DEMO)
    return tmp_path


@pytest.mark.parametrize("command", OPTIONS)
def test_options(here: Path, command: str) -> None:
    words = tuple(word.replace("HERE", str(here)) for word in command.split())
    check_refused(here, words, OPTIONS[command])


@pytest.mark.parametrize("text", VEHICLES)
def test_vehicle_files(here: Path, text: str) -> None:
    (here / "veh.toml").write_text(text)
    check_refused(here, ("vehicle", "show", here / "veh.toml"), VEHICLES[text])


def test_vehicle_files_in_a_case(here: Path) -> None:
    """One of them through a case, which names both files."""
    (here / "veh.toml").write_text(f"{BASE}wagon.payload = 98.4")
    (here / "case.toml").write_text(DEMO.replace('"iore_wagon_loaded"', '"veh.toml"'))
    words = ("run", here / "case.toml", "--out", here / "out")
    check_refused(here, words, "case.toml: vehicle = ")
    check_refused(here, words, "veh.toml: wagon.payload = 98.4 kg is no plausible payload")
