"""The commands about one contact: patch and conicity. Numbers, refusals, figures."""

import re
from pathlib import Path

import numpy as np
import pytest
from command_line import call, refused

from hh_exudyn.contact.geometry.functions import equivalent_conicity, rolling_radius_difference
from hh_exudyn.contact.profile import Profile, rail_profile, read_rail_profile, wheel_profile
from hh_exudyn.contact.tangential.api import creep_force
from hh_exudyn.contact.tangential.registry import PATCH_THEORIES

PATCH = ("patch", "--a-mm", "6", "--b-mm", "4", "--load-kn", "100")
CREEPAGE = ("--nu-x", "1e-3", "--nu-y", "-5e-4", "--spin", "0.1", "--friction", "0.3")


def rows(text: str, names: str) -> dict[str, list[str]]:
    """Lines of a table by their first word."""
    found = re.findall(rf"^ *({names}) +(.*)$", text, flags=re.MULTILINE)
    return {name: rest.split() for name, rest in found}


def test_patch_prints_the_forces_of_every_theory() -> None:
    result = call(*PATCH, *CREEPAGE)
    assert result.exit_code == 0, result.stderr
    table = rows(result.stdout, "|".join(PATCH_THEORIES))
    assert list(table) == list(PATCH_THEORIES)
    for name, cells in table.items():
        force = creep_force(name, 6e-3, 4e-3, 1e5, 1e-3, -5e-4, 0.1, 0.3, cells=(50, 50))
        values = [float(cell) for cell in cells[:4]]
        assert values[:3] == pytest.approx([force.x * 1e-3, force.y * 1e-3, force.moment], abs=0.0051)
        assert values[3] == pytest.approx((force.x**2 + force.y**2) ** 0.5 / 30e3 * 100.0, abs=0.051)
    # 3 N/(2 pi a b) = 1989 MPa
    assert "Hertz pressure 1989 MPa" in result.stdout
    assert "–" in table["polach"]  # no stress field
    assert 0.0 < float(table["fastrip"][4]) <= 0.3 * 1990.0
    assert 0.0 < float(table["fastrip"][5]) < 100.0
    assert max(map(len, result.stdout.splitlines())) <= 100
    assert "…" not in result.stdout


def test_patch_of_chosen_theories_with_a_figure(tmp_path: Path) -> None:
    path = tmp_path / "patch.png"
    result = call(
        *PATCH, *CREEPAGE, "--theory", "fastrip", "--theory", "linear", "--cells", "10", "--out", path
    )
    assert result.exit_code == 0, result.stderr
    assert list(rows(result.stdout, "|".join(PATCH_THEORIES))) == ["linear", "fastrip"]
    assert path.read_bytes().startswith(b"\x89PNG")
    assert f"figure: {path}" in result.stdout
    before = path.read_bytes()
    assert "exists already" in refused(*PATCH, "--out", path)
    assert path.read_bytes() == before


BAD_PATCHES = {
    "load": (("--load-kn", "-5"), "--load-kn -5 kN: allowed 0.001 to 1000 kN"),
    "axis": (("--a-mm", "0"), "--a-mm 0 mm: allowed 0.1 to 100 mm"),
    "creepage": (("--nu-x", "nan"), "--nu-x nan: allowed -1 to 1"),
    "friction": (("--friction", "0"), "--friction 0: allowed 0.001 to 2"),
    "cells": (("--cells", "2"), "--cells 2: allowed 5 to 400"),
    "theory": (("--theory", "contact"), f"--theory contact: unknown, allowed: {', '.join(PATCH_THEORIES)}"),
    "format": (("--out", "patch.doc"), "--out patch.doc: allowed are .png, .pdf, .svg"),
    "folder": (("--out", "/none/patch.png"), "--out /none/patch.png: there is no folder /none"),
}


@pytest.mark.parametrize("name", BAD_PATCHES)
def test_bad_patch_is_one_line_and_exit_code_2(name: str) -> None:
    words, message = BAD_PATCHES[name]
    assert message in refused(*PATCH, *words)


def test_missing_option_is_exit_code_2() -> None:
    result = call("patch", "--a-mm", "6")
    assert result.exit_code == 2
    assert "--b-mm" in result.stderr


CONICITY = ("conicity", "S1002", "60E1")


def conicity_and_difference(rail: Profile, amplitude: float, gauge: float, radius: float) -> list[float]:
    """What the library says of an S1002 wheelset: conicity [-] and rolling radius difference [mm]."""
    pair = (wheel_profile("S1002"), rail) * 2
    track = {"gauge": gauge, "tape_distance": 1.5, "radius_left": radius, "radius_right": radius}
    y = np.array([amplitude])
    return [
        equivalent_conicity(*pair, amplitudes=y, **track)[0],
        1e3 * rolling_radius_difference(*pair, lateral=y, **track)[0],
    ]


def test_conicity_over_amplitude_and_gauge() -> None:
    result = call(
        *CONICITY, "--gauge-mm", "1435", "--gauge-mm", "1445", "--amplitude-mm", "3", "--radius-mm", "500"
    )
    assert result.exit_code == 0, result.stderr
    assert "S1002 on 60E1 1:30" in result.stdout
    assert "wheel radius 500 mm, tape distance 1500 mm" in result.stdout
    values = [float(cell) for cell in rows(result.stdout, "3")["3"]]
    rail = rail_profile("60E1", 1 / 30)
    expected = [
        number for gauge in (1.435, 1.445) for number in conicity_and_difference(rail, 3e-3, gauge, 0.5)
    ]
    np.testing.assert_allclose(values[::2], expected[::2], atol=5.1e-4)
    np.testing.assert_allclose(values[1::2], expected[1::2], atol=5.1e-3)
    assert values[0] > 5.0 * values[2]  # a wide gauge takes S1002 away from the 60E1's gauge corner


@pytest.mark.parametrize(
    ("text", "inclination", "name"),
    [("30", 1 / 30, "1:30"), ("1:40", 1 / 40, "1:40"), ("upright", 0, "upright")],
)
def test_inclination_of_a_standard_rail(text: str, inclination: float, name: str) -> None:
    result = call(*CONICITY, "--amplitude-mm", "3", "--inclination", text)
    assert result.exit_code == 0, result.stderr
    assert f"S1002 on 60E1 {name}\n" in re.sub(" +\n", "\n", result.stdout)
    expected = conicity_and_difference(rail_profile("60E1", inclination), 3e-3, 1.435, 0.46)
    assert float(rows(result.stdout, "3")["3"][0]) == pytest.approx(expected[0], abs=5.1e-4)


def test_conicity_of_a_rail_from_a_file(tmp_path: Path) -> None:
    rail = rail_profile("60E1", 1 / 40)
    path = tmp_path / "measured.txt"
    path.write_text("".join(f"{1e3 * y:.6f} {1e3 * z:.6f}\n" for y, z in zip(rail.y, rail.z, strict=True)))
    result = call("conicity", "S1002", path, "--amplitude-mm", "4")
    assert result.exit_code == 0, result.stderr
    assert "S1002 on measured" in result.stdout
    expected = conicity_and_difference(read_rail_profile(path), 4e-3, 1.435, 0.46)
    values = [float(cell) for cell in rows(result.stdout, "4")["4"]]
    assert values == [pytest.approx(expected[0], abs=5.1e-4), pytest.approx(expected[1], abs=5.1e-3)]
    assert "for standard rails only" in refused("conicity", "S1002", path, "--inclination", "30")


def test_beyond_the_flange_clearance_there_is_no_conicity(tmp_path: Path) -> None:
    """S1002 on 60E1 at 1435 mm has some 6.5 mm to the flange."""
    path = tmp_path / "sheet.png"
    result = call(*CONICITY, "--gauge-mm", "1445", "--gauge-mm", "1435", "--amplitude-mm", "8", "--out", path)
    assert result.exit_code == 0, result.stderr
    cells = rows(result.stdout, "8")["8"]
    assert cells[0] == "–"  # the smaller gauge first
    assert float(cells[1]) > 10.0  # mm: the left wheel runs on its flange
    assert 0.0 < float(cells[2]) < 0.1
    at = re.findall(r"flange touches at -(\d+\.\d+) and (\d+\.\d+) mm", result.stdout)
    assert [float(left) for _, left in at] == pytest.approx([6.5, 11.5], abs=0.3)
    assert all(right == left for right, left in at)
    assert path.read_bytes().startswith(b"\x89PNG")


def test_gauge_on_which_nothing_touches_is_bad_input() -> None:
    assert "gauge = 1.6 m" in refused(*CONICITY, "--gauge-mm", "1600")


BAD_CONICITIES = {
    "wheel": (("conicity", "S1003", "60E1"), "WHEEL S1003: no file and no standard profile, known: S1002"),
    "rail": (("conicity", "S1002", "none.txt"), "RAIL none.txt: no file and no standard profile, known: "),
    "gauge": ((*CONICITY, "--gauge-mm", "1.435"), "--gauge-mm 1.435 mm: allowed 500 to 2000 mm"),
    "amplitude": ((*CONICITY, "--amplitude-mm", "0"), "--amplitude-mm 0 mm: allowed 0.1 to 20 mm"),
    "inclination": ((*CONICITY, "--inclination", "0.05"), "--inclination 0.05: allowed upright, or "),
    "radius": ((*CONICITY, "--radius-mm", "-460"), "--radius-mm -460 mm: allowed 100 to 2000 mm"),
    "tape": ((*CONICITY, "--tape-distance-mm", "1.5"), "--tape-distance-mm 1.5 mm: allowed 300 to 3000 mm"),
}


@pytest.mark.parametrize("name", BAD_CONICITIES)
def test_bad_conicity_is_one_line_and_exit_code_2(name: str) -> None:
    words, message = BAD_CONICITIES[name]
    assert message in refused(*words)


def test_file_that_is_no_profile_is_bad_input(tmp_path: Path) -> None:
    (tmp_path / "poem.txt").write_text("roses are red\n" * 30)
    assert "poem.txt" in refused("conicity", tmp_path / "poem.txt", "60E1")
    assert "poem.txt" in refused("conicity", "S1002", tmp_path / "poem.txt")


def test_fault_of_the_program_is_one_line_and_a_traceback_on_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("division\nby zero")

    monkeypatch.setattr("hh_exudyn.contact.tangential.api.creep_force", broken)
    result = call(*PATCH)
    assert result.exit_code == 1
    assert result.stderr.count("\n") == 1
    path = Path(result.stderr.split("traceback in ")[1].strip())
    assert "division" in path.read_text()
