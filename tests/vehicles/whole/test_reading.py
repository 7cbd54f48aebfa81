"""Vehicle files written by hand: every form of a number, mirrored entries, and every way to get one wrong."""

import copy
import tomllib

import pytest

from vehicles.variants import find_variant, read_variant
from vehicles.whole.reading import read_tables

TROLLEY = """
name = "trolley"
source = "assumed: a drawing"

bodies = [
    { part = "frame", name = "frame", position = [0.0, 0.0, 0.9] },
    { part = "wheelset", name = "wheelset_1", position = [1.5, 0.0, 0.46] },
    { part = "wheelset", name = "wheelset_2", position = [-1.5, 0.0, "460 mm"] },
]
couplings = [
    { part = "pad", name = "pad_1L", body_b = "wheelset_1", point = [1.5, 1.0, 0.46], mirror = true },
    { part = "pad", name = "left_pad_2", body_b = "wheelset_2", point = [-1.5, 1.0, 0.46], mirror = true },
]
wheelsets = [
    { body = "wheelset_1", bogie = 1, radius = 0.46 },
    { body = "wheelset_2", bogie = 1, radius = "460 mm" },
]

[frame]
kind = "bogie_frame"
mass = "2.5 t"
inertia = [1000, { value = 2.0, unit = "t m^2" }, "3e3 kg m^2"]

[wheelset]
kind = "wheelset"
mass = { value = 1300, unit = "kg", source = "published: table 4", range = [1000, 1600] }
inertia = { value = [0.7, 0.1, 0.7], unit = "t m^2", source = "derived: a bar" }

[pad]
type = "AxleBoxPad"
body_a = "frame"
source = "published: table 5"
stiffness = { value = [10, 5, 1], unit = "MN/m" }
damping = [1e4, 1e4, "10 kN s/m"]
roll_stiffness = 0.0
yaw_stiffness = 0.0

[coupler]
bodies = ["frame"]
points = [[0.0, 0.0, 0.9]]
stiffness = "0.1 MN/m"
damping = "1 kN s/m"

[dimensions]
wheelbase = 3.0
"""


def trolley(**changes):
    tables = tomllib.loads(TROLLEY)
    tables.update(changes)
    return tables


def test_numbers_in_every_form():
    vehicle = read_tables(trolley()).vehicle()
    frame, *wheelsets = vehicle.bodies
    assert (frame.mass, frame.inertia) == (2500.0, (1000.0, 2000.0, 3000.0))
    assert {body.inertia for body in wheelsets} == {(700.0, 100.0, 700.0)}
    assert {body.position[2] for body in wheelsets} == {0.46}
    assert {pad.stiffness for pad in vehicle.couplings} == {(10e6, 5e6, 1e6)}
    assert {pad.damping for pad in vehicle.couplings} == {(1e4, 1e4, 1e4)}
    assert vehicle.coupler.stiffness == 1e5


def test_mirrored_entries_follow_theirs():
    pads = read_tables(trolley()).vehicle().couplings
    assert [pad.name for pad in pads] == ["pad_1L", "pad_1R", "left_pad_2", "right_pad_2"]
    for left, right in (pads[:2], pads[2:]):
        assert right.point == (left.point[0], -left.point[1], left.point[2])
        assert (right.body_b, right.stiffness) == (left.body_b, left.stiffness)


def test_sources_of_the_number_the_part_and_the_file():
    numbers = read_tables(trolley()).parameters()
    assert numbers.parameter("wheelset.mass").source == "published: table 4"
    assert numbers.parameter("wheelset.mass").range == (1000.0, 1600.0)
    assert numbers.parameter("pad.stiffness_y").source == "published: table 5"
    assert numbers.parameter("frame.mass").source == "assumed: a drawing"
    tables = trolley()
    del tables["source"]
    numbers = read_tables(tables).parameters()
    assert numbers.parameter("frame.mass").source == "assumed: no source is stated"


def test_a_variant_of_a_whole_vehicle(tmp_path):
    """Mirrored copies follow the changed part; the variant itself says what differs."""
    (tmp_path / "trolley.toml").write_text(TROLLEY)
    path = tmp_path / "soft.toml"
    path.write_text('base = "trolley.toml"\n[pad]\nstiffness_y = { value = 2, unit = "MN/m" }\n')
    soft = read_variant(path)
    assert {pad.stiffness for pad in soft.vehicle().couplings} == {(10e6, 2e6, 1e6)}
    assert [(one.name, one.before.value, one.after.value) for one in soft.differences()] == [
        ("pad.stiffness_y", 5e6, 2e6)
    ]
    path.write_text(f'base = "{tmp_path}/trolley.toml"\n[pad]\nstiffness_w = 2.0\n')
    with pytest.raises(ValueError, match=r"did you mean pad\.stiffness_"):
        read_variant(path)
    assert find_variant(tmp_path / "trolley.toml").vehicle() == read_tables(trolley()).vehicle()


def put(*place):
    """A change of the tables: keys, then the value; None deletes."""

    def change(tables):
        *path, key, value = place
        for step in path:
            tables = tables[step]
        if value is None:
            del tables[key]
        else:
            tables[key] = value

    return change


FAULTS = {
    'pad.stiffness_x is in "kN": allowed "N/m"': put("pad", "stiffness", {"value": [1, 2, 3], "unit": "kN"}),
    "frame.mass = 'heavy': allowed a number": put("frame", "mass", "heavy"),
    "frame.mass = True: allowed a number": put("frame", "mass", True),
    'frame.mass is in "stone": allowed "kg", "t"': put("frame", "mass", "2 stone"),
    "frame.mass = nan: allowed is a finite number": put("frame", "mass", float("nan")),
    "frame.inertia = [1, 2]: allowed 3 numbers in brackets": put("frame", "inertia", [1, 2]),
    "frame.inertia = 3.0: allowed a list": put("frame", "inertia", 3.0),
    "frame.mass: source starts with 'guess'": put(
        "frame", "mass", {"value": 1.0, "unit": "kg", "source": "guess"}
    ),
    "frame.mass = {'value': 1.0, 'why': 2}: allowed": put("frame", "mass", {"value": 1.0, "why": 2}),
    "value 2500 lies outside its range 1 to 2": put(
        "frame", "mass", {"value": 2500.0, "unit": "kg", "range": [1.0, 2.0]}
    ),
    "frame.colour: unknown key of Body; known: name, kind, mass": put("frame", "colour", 1.0),
    'pad.stifness: unknown key of AxleBoxPad; did you mean "stiffness"?': put("pad", "stifness", 1.0),
    "pad_1L: damping [N s/m] of AxleBoxPad is missing": put("pad", "damping", None),
    "couplings pad_1L: type is missing: allowed AxleBoxPad": put("pad", "type", None),
    "type = 'AxleBoxPed'; did you mean \"AxleBoxPad\"?": put("pad", "type", "AxleBoxPed"),
    "bodies frame: unknown key type": put("frame", "type", "Body"),
    "part = 'pads' is no table of the file; did you mean \"pad\"?": put("couplings", 0, "part", "pads"),
    "part frame is one of bodies, allowed are entries of one class": put("couplings", 0, "part", "frame"),
    "no entry has part = 'pan'; did you mean \"pad\"?": put("pan", {"mass": 1.0}),
    "unknown key speed = 60": put("speed", 60),
    "coupler is missing": put("coupler", None),
    "coupler = 3: allowed a table": put("coupler", 3),
    "wheelsets: allowed a list of tables": put("wheelsets", {"body": "wheelset_1"}),
    "bodies[0] = 3: allowed a table": put("bodies", [3]),
    "wheelset_1.bogie = 1.5: allowed a whole number": put("wheelsets", 0, "bogie", 1.5),
    "pad_1L.body_a = 3: allowed a text": put("couplings", 0, "body_a", 3),
    "coupler.bodies = 'frame': allowed a list of texts": put("coupler", "bodies", "frame"),
    "mirror = 1: allowed true or false": put("couplings", 0, "mirror", 1),
    "has mirror = true: allowed a name with a side": put("couplings", 0, "name", "pad"),
    "name = 3: allowed a text": put("name", 3),
    "no body named chassis": put("couplings", 0, "body_a", "chassis"),
    "frame.position_x is given twice": put("bodies", 1, "name", "frame"),
    "kind of body frame is 'cart'; allowed: car_body": put("frame", "kind", "cart"),
    "frame.mass = -1 kg is no plausible mass": put("frame", "mass", -1.0),
    "dimensions.wheelbase = [3]: allowed a number": put("dimensions", "wheelbase", [3]),
}


@pytest.mark.parametrize("message", FAULTS)
def test_faults_are_one_line_that_names_the_thing(message):
    tables = copy.deepcopy(trolley())
    FAULTS[message](tables)
    with pytest.raises(ValueError) as caught:
        read_tables(tables)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_file_is_either_a_variant_or_whole(tmp_path):
    path = tmp_path / "both.toml"
    path.write_text('base = "iore_wagon_loaded"\n' + TROLLEY)
    with pytest.raises(ValueError, match=r"both\.toml: has base and bodies: allowed one of them"):
        find_variant(path)
    path.write_text("[wedge]\nfriction = 0.3\n")
    with pytest.raises(ValueError, match=r"base is missing.*a whole vehicle has bodies"):
        find_variant(path)
