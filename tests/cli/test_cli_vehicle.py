"""``hh-exudyn vehicle``: tables of the catalogue, of a vehicle and its file, comparisons, refusals."""

import re
from functools import partial
from pathlib import Path

import command_line
import pytest

from hh_exudyn.sourced import load_parameters
from vehicles.catalogue import VEHICLES
from vehicles.catalogue import vehicle as described
from vehicles.stored import to_json
from vehicles.variants import find_variant
from vehicles.whole.file import read_whole
from vehicles.whole.templates import TEMPLATES

call = partial(command_line.call, "vehicle")
refused = partial(command_line.refused, "vehicle")


def said(*words: str | Path) -> str:
    result = call(*words)
    assert result.exit_code == 0, result.stderr
    assert max(map(len, result.stdout.splitlines())) <= 120
    return result.stdout


@pytest.fixture
def worn(tmp_path: Path) -> Path:
    path = tmp_path / "worn.toml"
    path.write_text('base = "iore_wagon_loaded"\ndescription = "tired"\n[wedge]\nfriction = 0.35\n')
    return path


def cells(text: str, pattern: str) -> list[str]:
    """The line of a table that begins so."""
    found = re.findall(rf"^ *{pattern}\b.*$", text, flags=re.MULTILINE)
    assert len(found) == 1, text
    return found[0].split()


def test_list_has_every_vehicle() -> None:
    text = said("list")
    for name in VEHICLES:
        cells(text, name)
    # thesis Table 1-1: 4 x 30 t; tare 21.6 t
    assert cells(text, "iore_wagon_loaded")[1:3] == ["120.0", "4"]
    assert cells(text, "iore_wagon_empty")[1:3] == ["21.6", "4"]


def test_show_has_every_number_and_counts_the_guesses() -> None:
    text = said("show", "iore_wagon_loaded")
    parameters = load_parameters("vehicles", "iore_wagon")
    for number in {parameter.name.split(".")[1] for parameter in parameters.parameters}:
        assert number in text
    assert f"{len(parameters.of_kind('assumed'))} assumed (?)" in text
    assert len(re.findall(r" \? +assumed", text)) == len(parameters.of_kind("assumed"))
    assert "differ" not in text
    assert cells(text, "1 +1")[2:] == ["4.274", "915", "294.3", "30.00"]  # (6.77 + 1.778) / 2, 30 t


def test_show_says_what_a_file_changes(worn: Path) -> None:
    text = said("show", worn)
    assert "worn: tired" in text
    assert "based on iore_wagon_loaded, 1 number differs" in text
    assert "1 variant (!)" in text
    assert re.search(r"friction +0\.35 +- +! +variant: worn\.toml", text)
    assert cells(text, r"wedge\.friction")[1:] == ["-", "0.3", "0.35", "variant:", "worn.toml"]


def test_compare(worn: Path) -> None:
    text = said("compare", "iore_wagon_empty", worn)
    assert cells(text, r"wagon\.payload")[1:4] == ["kg", "0", "98400"]
    assert cells(text, r"wedge\.friction")[2:4] == ["0.3", "0.35"]
    assert "2 numbers differ" in text
    assert "no numbers differ" in said("compare", worn, worn)


def test_drawing_is_written_to_a_new_file(worn: Path, tmp_path: Path) -> None:
    figure = tmp_path / "worn.svg"
    assert f"figure: {figure}" in said("show", worn, "--figure", figure)
    assert figure.read_text().startswith("<?xml")
    assert "--figure" in refused("show", worn, "--figure", figure)
    assert "allowed are .png" in refused("show", worn, "--figure", tmp_path / "worn.doc")


def test_refusals(worn: Path, tmp_path: Path) -> None:
    assert 'did you mean "iore_wagon_loaded"?' in refused("show", "iore_wagon_lodaed")
    assert "no.toml: cannot be read" in refused("compare", "iore_wagon_loaded", tmp_path / "no.toml")
    worn.write_text(worn.read_text().replace("friction", "fiction"))
    assert "worn.toml: unknown parameter wedge.fiction; did you mean wedge.friction?" in refused("show", worn)


def test_export_and_show_are_the_same_vehicle(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    said("export", "iore_wagon_loaded", "-o", path)
    assert read_whole(path).vehicle() == described("iore_wagon_loaded")
    text = said("show", path)
    assert "coordinates of places are in its file" in text
    assert cells(text, "1 +1")[2:] == ["4.274", "915", "294.3", "30.00"]
    assert "0 numbers" not in text
    assert "no numbers differ" in said("compare", path, path)
    # without -o onto the screen, the same text
    assert call("export", "iore_wagon_loaded").stdout == path.read_text()


def test_export_of_a_variant_and_of_a_run(worn: Path, tmp_path: Path) -> None:
    path = tmp_path / "whole.toml"
    said("export", worn, "-o", path)
    assert read_whole(path).vehicle() == find_variant(worn).vehicle()
    assert 'friction = { value = 0.35, unit = "-", source = "variant: worn.toml" }' in path.read_text()
    stored = tmp_path / "vehicle.json"
    stored.write_text(to_json(find_variant(worn).vehicle(), find_variant(worn).origin()))
    assert call("export", stored).stdout.splitlines()[1:] == path.read_text().splitlines()[1:]
    said("show", stored)


@pytest.mark.parametrize("name", TEMPLATES)
def test_a_template_is_a_vehicle_with_an_explained_file(name: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    said("new", name, "-o", path)
    assert path.read_text().startswith("# ")
    assert "Wheelsets at rest" in said("show", path)
    assert read_whole(path).name == "mine"  # after its file
    assert max(len(line) for line in path.read_text().splitlines() if line.startswith("#")) <= 120


def test_refusals_of_export_and_new(tmp_path: Path, worn: Path) -> None:
    assert "vehicle 'iore_wagon' is not known" in refused("export", "iore_wagon")
    assert "exists already, allowed is a new file" in refused("export", "iore_wagon_loaded", "-o", worn)
    assert "allowed is .toml" in refused("export", "iore_wagon_loaded", "-o", tmp_path / "a.json")
    assert 'did you mean "three_piece_wagon"?' in refused("new", "three_piece")
    assert "there is no folder" in refused("new", "co_co", "-o", tmp_path / "none" / "a.toml")
