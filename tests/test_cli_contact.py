"""The commands about one contact: patch, validate, conicity. Numbers, refusals, figures."""

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from hh_exudyn.cli import app
from hh_exudyn.contact.tangential import creep_force
from hh_exudyn.contact.theories import THEORIES

PATCH = ("patch", "--a-mm", "6", "--b-mm", "4", "--load-kn", "100")
CREEPAGE = ("--nu-x", "1e-3", "--nu-y", "-5e-4", "--spin", "0.1", "--friction", "0.3")


def call(*words: str | Path) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words])


def refused(*words: str | Path) -> str:
    """The one line on stderr of a command that is refused; nothing on stdout."""
    result = call(*words)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr.startswith("hh-exudyn: ")
    assert result.stderr.count("\n") == 1
    return result.stderr


def rows(text: str, names: str) -> dict[str, list[str]]:
    """Lines of a table by their first word."""
    found = re.findall(rf"^ *({names}) +(.*)$", text, flags=re.MULTILINE)
    return {name: rest.split() for name, rest in found}


def test_patch_prints_the_forces_of_every_theory() -> None:
    result = call(*PATCH, *CREEPAGE)
    assert result.exit_code == 0, result.stderr
    table = rows(result.stdout, "|".join(THEORIES))
    assert list(table) == list(THEORIES)
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
    assert list(rows(result.stdout, "|".join(THEORIES))) == ["linear", "fastrip"]
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
    "theory": (("--theory", "contact"), f"--theory contact: unknown, allowed: {', '.join(THEORIES)}"),
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
