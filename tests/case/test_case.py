"""Cases: what is written is what is read, and every fault is one line that helps."""

import math
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hh_exudyn.case import Case, CaseError, read_case
from hh_exudyn.contact.profile import wheel_profile
from track.line.line import read_line

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text()


@pytest.fixture(scope="module")
def demo() -> Case:
    return Case.from_toml(DEMO)


def sections(case: Case, index: int, **changes: Any) -> dict[str, Any]:
    """The change of one section, as `with_changes` takes it; None removes a key."""
    listed = [section.model_dump() for section in case.track.sections]
    listed[index] |= changes
    listed[index] = {key: value for key, value in listed[index].items() if value is not None}
    return {"track": {"sections": listed}}


def test_savast_is_the_section_of_the_thesis() -> None:
    """Hossein-Nia (2018), 1.2.2: around 550 m, left-hand; radius of Palo et al. (2012)."""
    case = read_case(str(resources.files("hh_exudyn") / "data" / "savast.toml"))
    assert case.alignment().length == pytest.approx(550.0)
    curve = case.alignment().sections[-1]
    assert (curve.radius, curve.hand) == (484.0, "left")  # type: ignore[union-attr]
    assert 0.2 <= case.friction <= 0.5
    # the gauge is that of the line's rule, to a tenth of a millimetre
    assert curve.gauge == pytest.approx(read_line("malmbanan").gauge.at(484.0), abs=5e-5)  # type: ignore[union-attr]


def test_demo_is_the_case_of_the_issue(demo: Case) -> None:
    assert (demo.vehicle, demo.wheel_profile) == ("iore_wagon_loaded", "S1002")
    assert (demo.track.rail, demo.track.rails.inclination) == ("60E1", pytest.approx(1 / 30))
    assert demo.speed == pytest.approx(60 / 3.6)
    assert demo.friction == 0.40
    straight, transition, curve = demo.alignment().sections
    assert (straight.length, transition.length, curve.length) == (50.0, 50.0, 150.0)
    assert (curve.radius, curve.cant, curve.hand) == (450.0, pytest.approx(0.065), "left")  # type: ignore[union-attr]
    assert straight.gauge == curve.gauge == pytest.approx(1.445)
    assert demo.alignment().length == pytest.approx(250.0)


def test_round_trip_through_a_file(demo: Case, tmp_path: Path) -> None:
    changed = demo.with_changes(
        speed_km_h=47.3, track={"inclination": 0.025, "flexibility": "rigid"}, contact={"cells": [15, 31]}
    )
    assert changed != demo
    for case in (demo, changed, demo.mirrored()):
        path = tmp_path / "case.toml"
        path.write_text(case.to_toml())
        assert read_case(path) == case
        assert read_case(path).to_toml() == case.to_toml()


def test_windows_text_is_read(demo: Case, tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_bytes(b"\xef\xbb\xbf" + DEMO.replace("\n", "\r\n").encode())
    assert read_case(path) == demo


def test_mirrored_exchanges_hands_only(demo: Case) -> None:
    mirror = demo.mirrored()
    assert mirror.alignment().sections == demo.alignment().mirrored().sections
    assert mirror.mirrored() == demo
    assert mirror.with_changes(track=demo.track) == demo


def test_changes_keep_the_rest_and_the_original(demo: Case) -> None:
    changed = demo.with_changes(track={"flexibility": "rigid"})
    assert changed.track.flexibility == "rigid"
    assert changed.with_changes(track={"flexibility": "concrete"}) == demo
    assert demo.track.flexibility == "concrete"
    with pytest.raises(ValueError, match="frozen"):
        demo.friction = 0.3


def test_wheel_profile_path_starts_at_the_case_file(demo: Case, tmp_path: Path) -> None:
    s1002 = wheel_profile("S1002")
    (tmp_path / "profiles").mkdir()
    np.savetxt(tmp_path / "profiles" / "worn.txt", np.column_stack([s1002.y, s1002.z]) * 1000, fmt="%.8f")
    path = tmp_path / "case.toml"
    path.write_text(DEMO.replace('"S1002"', '"profiles/worn.txt"'))
    case = read_case(path)
    assert Path(case.wheel_profile) == tmp_path / "profiles" / "worn.txt"
    assert case.least_gauge == pytest.approx(demo.least_gauge, abs=1e-7)
    assert Case.from_toml(case.to_toml()) == case


@pytest.mark.parametrize("gauge", [1425.001, 1424.9, 1300.0, 0.0, -5.0])
def test_gauge_without_clearance_is_refused(demo: Case, gauge: float) -> None:
    """Either gauge may be the narrow one; the least gauge is said to 0.1 mm."""
    least = demo.least_gauge * 1000
    assert least == pytest.approx(1425.0, abs=0.01)
    if gauge > least:
        demo.with_changes(**sections(demo, 0, gauge_mm=gauge))
        return
    for index in (0, 2):
        with pytest.raises(CaseError) as caught:
            demo.with_changes(**sections(demo, index, gauge_mm=gauge))
        text = str(caught.value)
        assert f"track.sections[{index}].gauge_mm = {gauge:g} mm" in text
        assert f"allowed above {least:.1f} up to 1470 mm" in text


FAULTS: dict[str, tuple[dict[str, Any], list[str]]] = {  # change: parts of the message
    "too fast": ({"speed_km_h": 300}, ["speed_km_h = 300 km/h", "allowed 5 to 130 km/h"]),
    "too slow": ({"speed_km_h": 4.999}, ["speed_km_h = 4.999 km/h", "allowed 5 to 130 km/h"]),
    "not a number": ({"speed_km_h": math.nan}, ["speed_km_h = nan km/h", "allowed 5 to 130 km/h"]),
    "infinite": ({"friction": math.inf}, ["friction = inf", "allowed 0.01 to 1"]),
    "text": ({"speed_km_h": "60"}, ['speed_km_h = "60"', "allowed 5 to 130 km/h"]),
    "truth": ({"friction": True}, ["friction = true", "allowed 0.01 to 1"]),
    "friction": ({"friction": 0.0}, ["friction = 0", "allowed 0.01 to 1"]),
    "misspelt": ({"speed_kmh": 60}, ["unknown key speed_kmh = 60", 'did you mean "speed_km_h"?']),
    "foreign": ({"zzz": 60}, ["unknown key zzz = 60", "known keys: name, vehicle, speed_km_h"]),
    "self": ({"self": 1}, ["unknown key self = 1"]),
    "inner key": ({"track": {"flexibilty": "x"}}, ["unknown key track.flexibilty", '"flexibility"?']),
    "vehicle": ({"vehicle": "iore_wagon_laden"}, ["vehicle =", "iore_wagon_empty", '"iore_wagon_loaded"?']),
    "normal": ({"contact": {"normal": "hertzian"}}, ["contact.normal", "hertz, analyn, kik_piotrowski"]),
    "normal and theory": (
        {"contact": {"normal": "analyn", "theory": "polach"}},
        ["contact", "theory = 'polach'", "'fastsim'", "'fastrip'"],
    ),
    "slip of every strip": (
        {"contact": {"normal": "coupled_strips", "theory": "fastsim"}},
        ["contact", "theory = 'fastsim' does not take the patches of normal = 'coupled_strips'"],
    ),
    "theory": (
        {"contact": {"theory": "fastrap"}},
        ["contact.theory", "_elliptic, fastrip", '"fastrip"?'],
    ),
    "rail": ({"track": {"rail": "61E1"}}, ["track.rail", "61E1", "60E1"]),
    "rail file": ({"track": {"rail": "no/such.txt"}}, ["track.rail", "no/such.txt", "not found"]),
    "left rail": ({"track": {"rail_left": "61E1"}}, ["track.rail_left", "61E1", "60E1"]),
    "change of rails": ({"track": {"rail_change_m": 0.1}}, ["rail_change_m = 0.1 m", "allowed 0.5 to 100 m"]),
    "flexibility": ({"track": {"flexibility": "soft"}}, ["track.flexibility", "wooden_frozen, rigid"]),
    "inclination": ({"track": {"inclination": "1:5"}}, ['track.inclination = "1:5"', '"1:15" to "1:100"']),
    "inclination text": ({"track": {"inclination": "flat"}}, ['"flat"', '"1:15" to "1:100"']),
    "inclination zero": ({"track": {"inclination": "1:0"}}, ['"1:0"', '"1:15" to "1:100"']),
    "cells": ({"contact": {"cells": [20, 101]}}, ["contact.cells[1] = 101", "from 5 to 100"]),
    "one cell": ({"contact": {"cells": [20]}}, ["contact.cells[1] is missing", "from 5 to 100"]),
    "half cells": ({"contact": {"cells": [20, 20.5]}}, ["contact.cells[1] = 20.5", "whole numbers"]),
    "damping": ({"contact": {"damping_s_per_m": -1}}, ["contact.damping_s_per_m = -1 s/m", "s/m"]),
    "step": ({"integration": {"step_ms": 2.0}}, ["integration.step_ms = 2 ms", "allowed 0.05 to 1 ms"]),
    "output": (
        {"integration": {"step_ms": 0.3, "output_interval_ms": 5.0}},
        ["integration: output_interval_ms = 5 ms", "whole multiples of step_ms = 0.3 ms"],
    ),
    "output below step": (
        {"integration": {"step_ms": 0.5, "output_interval_ms": 0.25}},
        ["output_interval_ms = 0.25 ms", "whole multiples of step_ms = 0.5 ms"],
    ),
    "no sections": ({"track": {"sections": []}}, ["track.sections = []", "one or more sections"]),
    "no table": ({"track": 5}, ["track = 5", "allowed a table"]),
    "no name": ({"name": ""}, ['name = ""', "allowed a text"]),
    "wheel": ({"wheel_profile": "S1003"}, ['wheel_profile = "S1003"', "S1002"]),
    "wheel file": ({"wheel_profile": "no/such.txt"}, ["wheel_profile", "no/such.txt", "not found"]),
    "wheel folder": ({"wheel_profile": "/"}, ['wheel_profile = "/"']),
}


@pytest.mark.parametrize("name", FAULTS)
def test_fault_is_one_line_with_key_value_and_range(demo: Case, name: str) -> None:
    changes, parts = FAULTS[name]
    with pytest.raises(CaseError) as caught:
        demo.with_changes(**changes)
    text = str(caught.value)
    assert "\n" not in text
    for part in parts:
        assert part in text


SECTION_FAULTS: dict[str, tuple[dict[str, Any], list[str]]] = {
    "radius": ({"radius_m": 50}, ["track.sections[2].radius_m = 50 m", "allowed 100 to 100000 m"]),
    "no radius": ({"radius_m": None}, ["track.sections[2].radius_m is missing", "100 to 100000 m"]),
    "misspelt": (
        {"radius_m": None, "radius": 450},
        ["unknown key track.sections[2].radius = 450", "radius_m"],
    ),
    "hand": ({"hand": "lefft"}, ["track.sections[2].hand", "left, right", '"left"?']),
    "cant": ({"cant_mm": 200}, ["track.sections[2].cant_mm = 200 mm", "allowed 0 to 180 mm"]),
    "wide": ({"gauge_mm": 1500}, ["track.sections[2].gauge_mm = 1500 mm", "up to 1470 mm"]),
    "kind": (
        {"kind": "curv"},
        ['track.sections[2].kind = "curv"', "straight, transition, curve", '"curve"?'],
    ),
    "no kind": ({"kind": None}, ["track.sections[2].kind is missing", "straight, transition, curve"]),
    "wrong kind": (
        {"kind": "straight"},
        ["unknown key track.sections[2].", "known keys: kind, length_m, gauge_mm"],
    ),
}


@pytest.mark.parametrize("name", SECTION_FAULTS)
def test_fault_in_a_section_says_which(demo: Case, name: str) -> None:
    changes, parts = SECTION_FAULTS[name]
    with pytest.raises(CaseError) as caught:
        demo.with_changes(**sections(demo, 2, **changes))
    for part in parts:
        assert part in str(caught.value)


def test_sections_must_follow_each_other(demo: Case) -> None:
    straight, _, curve = (section.model_dump() for section in demo.track.sections)
    with pytest.raises(CaseError, match="curvature jumps"):
        demo.with_changes(track={"sections": [straight, curve]})
    with pytest.raises(CaseError, match="length 29 m in all: allowed from 30 m"):
        demo.with_changes(track={"sections": [straight | {"length_m": 29}]})


TEXT_FAULTS = {
    "syntax": ("speed_km_h = = 3", ["not valid TOML", "line 1, column 14"]),
    "line": ('name = "x"\n[track\n', ["not valid TOML", "line 2"]),
    "twice": ("name = 'x'\nname = 'y'\n", ["not valid TOML", "line 2"]),
    "empty": ("", ["is missing"]),
}


@pytest.mark.parametrize("name", TEXT_FAULTS)
def test_faulty_text_names_file_line_and_column(tmp_path: Path, name: str) -> None:
    text, parts = TEXT_FAULTS[name]
    path = tmp_path / "faulty.toml"
    path.write_text(text)
    with pytest.raises(CaseError) as caught:
        read_case(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)
    for part in parts:
        assert part in str(caught.value)


def test_unreadable_files(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"no\.toml: cannot be read: No such file"):
        read_case(tmp_path / "no.toml")
    with pytest.raises(CaseError, match="is a folder, allowed is a file"):
        read_case(tmp_path)
    (tmp_path / "bytes.toml").write_bytes(b"name = '\xff'")
    with pytest.raises(CaseError, match="not UTF-8 at byte 8"):
        read_case(tmp_path / "bytes.toml")


@pytest.mark.parametrize(
    "row, fault", [("10.0 nan", "finite"), ("-80.0 1.0", "from the point before"), ("one two", "two numbers")]
)
def test_bad_profile_file_is_named_with_its_line(tmp_path: Path, row: str, fault: str) -> None:
    s1002 = wheel_profile("S1002")
    rows = [f"{1000 * y:.6f} {1000 * z:.6f}" for y, z in zip(s1002.y, s1002.z, strict=True)]
    rows[50] = row
    (tmp_path / "bad.txt").write_text("\n".join(rows))
    (tmp_path / "case.toml").write_text(DEMO.replace('"S1002"', '"bad.txt"'))
    with pytest.raises(CaseError) as caught:
        read_case(tmp_path / "case.toml")
    text = str(caught.value)
    assert "wheel_profile" in text
    assert "bad.txt" in text
    assert "line 51" in text
    assert fault in text


def test_several_faults_are_counted(demo: Case) -> None:
    with pytest.raises(CaseError, match=r"friction = 7: .* \(and 1 more\)$"):
        demo.with_changes(friction=7, track={"inclination": "1:5"})
