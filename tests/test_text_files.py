"""One door for files of users: what is read, and what is refused before it hangs or fills the memory."""

import os
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from hh_exudyn.case import CaseError, read_case
from hh_exudyn.contact.profile import read_rail_profile, read_wheel_profile
from hh_exudyn.number_lines import has_decimal_commas, leading_numbers, number
from hh_exudyn.text_files import read_bytes, read_text, read_toml
from track.course.alignment_csv import read_alignment_csv
from track.course.survey import read_centre_line_csv
from track.irregularity.irregularity_csv import read_irregularity
from track.line.line import read_line
from vehicles.variants import read_variant


@pytest.mark.parametrize(
    "data",
    [
        "Å 3,5".encode(), b"\xef\xbb\xbf" + "Å 3,5".encode(), "Å 3,5".encode("latin-1"),
        "Å 3,5".encode("utf-16"), b"\xfe\xff" + "Å 3,5".encode("utf-16-be"),
    ],
)  # fmt: skip
def test_text_in_any_encoding_of_instruments(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(data)
    assert read_text(path) == "Å 3,5"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "is empty"),
        (b" \n", "is empty"),
        (b"a\0\0b", "a binary file"),
        (b"x" * 11, "larger than 10 bytes"),
    ],
)
def test_no_text_is_told(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(data)
    with pytest.raises(ValueError, match=message) as caught:
        read_text(path, largest=10)
    assert str(path) in str(caught.value)


def pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe.csv")
    return folder / "pipe.csv"


def loop(folder: Path) -> Path:
    (folder / "a.csv").symlink_to(folder / "b.csv")
    (folder / "b.csv").symlink_to(folder / "a.csv")
    return folder / "a.csv"


def endless(folder: Path) -> Path:
    (folder / "zero.csv").symlink_to("/dev/zero")
    return folder / "zero.csv"


def nested(folder: Path) -> Path:
    (folder / "deep.toml").write_text("a = " + "[" * 5000 + "]" * 5000)
    return folder / "deep.toml"


ODD: dict[str, tuple[Callable[[Path], Path], str]] = {
    "pipe": (pipe, "is a named pipe, allowed is a file"),
    "loop": (loop, "cannot be read: Too many levels of symbolic links|file not found"),
    "device": (endless, "is a device, allowed is a file"),
    "folder": (lambda folder: folder, "is a folder, allowed is a file"),
    "null": (lambda folder: folder / "a\0b.csv", "null|file not found"),
}
READERS = {
    "bytes": read_bytes, "text": read_text, "toml": read_toml, "case": read_case, "wheel": read_wheel_profile,
    "rail": read_rail_profile, "alignment": read_alignment_csv, "points": read_centre_line_csv,
    "recording": read_irregularity, "vehicle": read_variant, "line": read_line,
}  # fmt: skip


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes and links are those of POSIX")
@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("kind", ODD)
def test_what_is_no_file_is_refused_at_once(tmp_path: Path, kind: str, reader: str) -> None:
    make, message = ODD[kind]
    if reader == "line":  # of which some are known by name
        message = "is no file, and not one of the known lines"
    begin = time.perf_counter()
    with pytest.raises(ValueError, match=message) as caught:
        READERS[reader](make(tmp_path))
    assert "\n" not in str(caught.value)
    assert time.perf_counter() - begin < 5.0


@pytest.mark.parametrize("reader", ["toml", "case", "vehicle", "line"])
def test_deep_nesting_is_refused(tmp_path: Path, reader: str) -> None:
    with pytest.raises(ValueError, match="nested too deep"):
        READERS[reader](nested(tmp_path))


CASE = """
name = "odd"
speed_km_h = 40.0
friction = 0.3
wheel_profile = "{wheel}"
[track]
rail = "{rail}"
irregularity = "{irregularity}"
{alignment}
"""
SECTION = "[[track.sections]]\nkind = 'straight'\nlength_m = 50.0"
PLACES = {
    "wheel": {"wheel": "{}"},
    "rail": {"rail": "{}"},
    "irregularity": {"irregularity": "{}"},
    "alignment": {"alignment": 'alignment = "{}"'},
    "centre line": {"alignment": 'centre_line = "{}"'},
}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes and links are those of POSIX")
@pytest.mark.parametrize("kind", ["pipe", "loop", "device"])
@pytest.mark.parametrize("place", PLACES)
def test_a_case_that_names_no_file_is_refused_at_once(tmp_path: Path, place: str, kind: str) -> None:
    make, message = ODD[kind]
    name = make(tmp_path).name
    plain = {"wheel": "S1002", "rail": "60E1", "irregularity": "none", "alignment": SECTION}
    (tmp_path / "case.toml").write_text(
        CASE.format(**plain | {k: v.format(name) for k, v in PLACES[place].items()})
    )
    with pytest.raises(CaseError, match=message):
        read_case(tmp_path / "case.toml")


def test_numbers_of_other_programs() -> None:
    for word, value in {
        "1.0D-3": 1e-3,
        "-2.5d2": -250.0,
        ".5": 0.5,
        "5.": 5.0,
        "\N{MINUS SIGN}3": -3.0,
    }.items():
        assert number(word) == value
    for word in ("1_000", "0x10", "1e", "--1", "", "1.2.3", "١"):
        assert number(word) is None
    assert leading_numbers("1.5, 2.5;3 % dent 4") == ([1.5, 2.5, 3.0], ["%", "dent", "4"])
    assert has_decimal_commas(["1,5;2,5"])
    assert has_decimal_commas(["1,5\t2,5", "1 2"])
    assert has_decimal_commas(["-1,5 2,25"])
    assert not has_decimal_commas(["1.5,2.5"])
    assert not has_decimal_commas(["1, 2"])
    assert not has_decimal_commas(["12,34"])
    with pytest.raises(ValueError, match="'1,5,2,5' is two numbers or four"):
        has_decimal_commas(["1,5,2,5"])
