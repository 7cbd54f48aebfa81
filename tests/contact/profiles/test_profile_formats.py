"""Files as people's programs write them: the same profile whatever the form, or a refusal that names the
line."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.contact.profile import Profile, gauge_point, rail_profile, wheel_profile
from hh_exudyn.contact.profiles.measures import flange_height, flange_thickness
from hh_exudyn.contact.profiles.reader import read_profile, read_rail_profile
from hh_exudyn.contact.profiles.wild_points import wild_points

MM = 1e-3
S1002, RAIL = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
W = 1e3 * np.column_stack([S1002.y, S1002.z])[::5]
W[:, 1] -= np.interp(0.0, *W.T)  # as the reader sets it
R = 1e3 * np.column_stack([RAIL.y, RAIL.z])[::5]
R[:, 1] -= R[:, 1].max()
X = np.column_stack([70.0 - W[:, 0], -W[:, 1]])  # a wheel in MiniProf's axes


def table(points: np.ndarray = W, form: str = "{:.6f} {:.6f}", end: str = "\n") -> str:
    return "".join(form.format(*row) + end for row in points)


def comma(text: str) -> str:
    return text.replace(".", ",")


def written(path: Path, text: str | bytes) -> Path:
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def is_the_wheel(profile: Profile, tolerance: float = 2e-9) -> None:
    np.testing.assert_allclose(profile.y, W[:, 0] * MM, atol=tolerance)
    np.testing.assert_allclose(profile.z, W[:, 1] * MM, atol=tolerance)


def moved(row: int, by: float) -> np.ndarray:
    """The wheel with one point off by `by` [mm] across the line."""
    points = W.copy()
    along = W[row + 1] - W[row - 1]
    points[row] += by * np.array([-along[1], along[0]]) / np.hypot(*along)
    return points


KEYS = f"ProgramName=x\nColumnDef=X,Y,A,C\nSd=32.5\nXYPoints={len(X)}\n\n"
OLD = "MINIPROF 101 148 1994 3 24\ntest.prd\nCar Number..:\nWheel ID....:\n32.50 28.00 10.79  (Sd/Sh/qR)\n\n"
KEYED = table(X, "{:.6f} {:.6f} 0.0 0.0").splitlines()
FORMS: dict[str, str | bytes] = {
    "header": "y_mm,z_mm\n" + table(form="{:.6f},{:.6f}"),
    "header in words": "Profile of wheel 12, 3 March\nAxle no. 4\ny [mm] z [mm]\n" + table(),
    "metres": "y_m;z_m\n" + table(W * MM, "{:.9f};{:.9f}"),
    "inches": "Y (inch), Z (inch)\n" + table(W / 25.4, "{:.8f}, {:.8f}"),
    "centimetres stated": "units: cm\n" + table(W / 10, "{:.7f} {:.7f}"),
    "columns exchanged": "z y\n" + table(W[:, ::-1]),
    "x lateral, y up": "x\ty\n" + table(form="{:.6f}\t{:.6f}"),
    "numbered": "".join(f"{n} {a:.6f} {b:.6f}\n" for n, (a, b) in enumerate(W, 1)),
    "number of points": f"{len(W)}\n" + table(),
    "decimal comma": comma(table(form="{:.6f};{:.6f}")),
    "decimal comma and tab": comma(table(form="{:.6f}\t{:.6f}")),
    "exponent of Fortran": table(form="{:.8e} {:.8e}").replace("e", "D"),
    "byte order mark, CRLF": b"\xef\xbb\xbf" + table(end="\r\n").encode(),
    "UTF-16": table().encode("utf-16"),
    "UTF-16 without a mark": table().encode("utf-16-le"),
    "Latin-1": "# Messung Lulea, 21 \xb0C, \xc5ke\n".encode("latin-1") + table().encode(),
    "comments behind": table(form="{:.6f} {:.6f}   % as measured"),
    "quoted cells": table(form='"{:.6f}","{:.6f}"'),
    "typographic minus": table().replace("-", "\N{MINUS SIGN}"),
    "doubled points": "".join(line + line for line in table().splitlines(keepends=True)),
    "reversed": table(W[::-1]),
    "mirrored": table(W * [-1, 1]),
    "downwards": table(W * [1, -1]),
    "words behind columns":
    KEYS + "\n".join([*KEYED[:3], KEYED[3] + "  % dent", KEYED[4] + "  dent", *KEYED[5:]]),
    "a point switched off":
    KEYS + "\n".join([*KEYED[:40], '"' + "50.0 -20.0 0 0", *KEYED[40:]]),
    "sections":
    "[FileInfo]\nVersion=2\n[Profile1Info]\nColumnDef=X,Y\nSh=28\n[Profile1XYPoints]\n" + table(X),
    "sections in two parts": "[FileInfo]\nSh=28\n[Profile1XYPoints]\n" + table(X[:100])
    + "[Profile2XYPoints]\n" + table(X[100:]),
    "Excel's separator": "sep=;\ny;z\nmm;mm\n" + comma(table(form="{:.6f};{:.6f}")),
    "a line of units": "y;z\nm;m\n" + table(W * MM, "{:.9f};{:.9f}"),
    "end of file of DOS": table(end="\r\n") + "\x1a",
    "title above keys": "Wheel 7, left\n" + KEYS + "\n".join(KEYED),
    "odd keys, columns exchanged": "Date/Time (UTC)=x\nColumnDef=Y,X\n\n" + table(X[:, ::-1]),
    "1994": OLD + table(X, "{:.6f} {:.6f} 0.000"),
}  # fmt: skip


@pytest.mark.parametrize("form", FORMS)
def test_a_wheel_is_the_same_in_every_form(tmp_path: Path, form: str) -> None:
    read = read_profile(written(tmp_path / "w.txt", FORMS[form]), "wheel", smoothing="never")
    is_the_wheel(read.profile)
    assert read.report.kind == "wheel"


def test_the_header_of_1994_gives_kind_and_measures(tmp_path: Path) -> None:
    report = read_profile(written(tmp_path / "w.whl", FORMS["1994"])).report
    assert (report.format, report.kind) == ("miniprof_1994", "wheel")
    assert [report.header[key] for key in ("Sd", "Sh", "qR")] == ["32.50", "28.00", "10.79"]


def test_points_that_are_switched_off_are_noted(tmp_path: Path) -> None:
    report = read_profile(written(tmp_path / "w.whl", FORMS["a point switched off"])).report
    assert any("1 points switched off by a quote (line 46)" in note for note in report.notes)


VAMPIRE_WHEEL = "WHEELPROFILE\ntitle\nTREADDATUM EUROPEAN\nFLANGEBACK 1360.0\n"
VAMPIRE_RAIL = "RAILPROFILE\ntitle\nGAUGEPOINT EUROPEAN\nGAUGE 1435.0\n"


def both_sides(points: np.ndarray, origin: float, left: np.ndarray | None = None) -> str:
    left = points if left is None else left
    return "".join(
        f"{b - origin:.6f}, {c:.6f}, {origin - a:.6f}, {d:.6f}\n"
        for (a, d), (b, c) in zip(points, left, strict=True)
    )


def test_vampire_wheel_and_rail(tmp_path: Path) -> None:
    """Sides from the track's centre; the running circle is 70 mm from the flange back whatever the datum."""
    wheel = read_profile(written(tmp_path / "w.whe", VAMPIRE_WHEEL + both_sides(W, 750.0)))
    assert (wheel.report.format, wheel.report.kind) == ("vampire", "wheel")
    is_the_wheel(wheel.profile)
    american = VAMPIRE_WHEEL.replace("EUROPEAN", "US1").replace("1360.0", "1347.4")
    is_the_wheel(read_profile(written(tmp_path / "u.whe", american + both_sides(W, 743.7))).profile)
    rail = read_profile(written(tmp_path / "r.rai", VAMPIRE_RAIL + both_sides(R, 753.0)))
    assert (rail.report.format, rail.report.kind) == ("vampire", "rail")
    np.testing.assert_allclose(np.diff(rail.profile.y), np.diff(R[:, 0]) * MM, atol=2e-9)
    np.testing.assert_allclose(rail.profile.z, R[:, 1] * MM, atol=2e-9)


def test_vampire_with_different_sides(tmp_path: Path) -> None:
    worn = R.copy()
    worn[:, 1] -= 0.01 * np.maximum(R[:, 0], 0.0)
    path = written(tmp_path / "r.rai", VAMPIRE_RAIL + both_sides(R, 753.0, worn))
    with pytest.raises(ValueError, match=r"left and right side differ by up to 0\.3.* mm; say which one"):
        read_rail_profile(path)
    left, right = (read_rail_profile(path, side=side) for side in ("left", "right"))
    np.testing.assert_allclose(right.z, R[:, 1] * MM, atol=2e-9)
    np.testing.assert_allclose(left.z, (worn[:, 1] - worn[:, 1].max()) * MM, atol=2e-9)


REFUSED: dict[str, tuple[str | bytes, str]] = {
    "trailing garbage":
    (table() + "end of file\n", f"line {len(W) + 1}: expected two numbers.*got 'end of file'"),
    "half a line": (table() + "68.0\n", f"line {len(W) + 1}: expected two numbers.*got '68.0'"),
    "three columns": (table(form="{:.4f} {:.4f} 0.5"), "line 1: 3 columns; allowed are two"),
    "two profiles":
    (table() + "\n" + table(moved(3, 0.01)), f"two profiles, from line 1 and from line {len(W) + 2}"),
    "two sections": (
        "[FileInfo]\nSh=28\n[Profile1XYPoints]\n" + table(X) + "[Profile2XYPoints]\n" + table(X),
        "two profiles, from line 4 and from line",
    ),
    "fewer points than stated":
    (f"{len(W) + 7}\n" + table(), "line 1: .* points stated.*cut off"),
    "comma for everything": (comma(table(form="{:.3f},{:.3f}")), "is two numbers or four"),
    "metres without a word": (table(W * MM, "{:.9f} {:.9f}"), "are these metres"),
    "a code for nothing seen": (table(moved(60, -9999.0)), "line 61: y = .*allowed up to 1000 mm"),
    "not a number": (table().replace("\n", "\n5.0 nan\n", 1), "line 2: not a finite number"),
    "gap": (table(np.delete(W, slice(100, 150), 0)), "line 101: y = .* mm lies .* mm from the point before"),
    "text only": ("a letter\nabout wheels\n", "line 1: expected two numbers"),
    "tread datum":
    (VAMPIRE_WHEEL.replace("EUROPEAN", "MOON") + both_sides(W, 750.0), "line 3: TREADDATUM 'MOON'"),
    "no flange back":
    (VAMPIRE_WHEEL.replace("FLANGEBACK 1360.0", "") + both_sides(W, 750.0), "line 4: expected FLA"),
    "vampire cut": (VAMPIRE_WHEEL + both_sides(W, 750.0) + "1 2 3\n", "expected four numbers"),
}  # fmt: skip


@pytest.mark.parametrize("form", REFUSED)
def test_other_files_are_refused_in_one_line(tmp_path: Path, form: str) -> None:
    text, message = REFUSED[form]
    path = written(tmp_path / "w.txt", text)
    with pytest.raises(ValueError, match=message) as caught:
        read_profile(path, "wheel")
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_face_of_a_rim_in_one_step_is_left_out(tmp_path: Path) -> None:
    rim = np.vstack([[[-65.0, 20.0], [-65.0, 7.6357]], W])
    read = read_profile(written(tmp_path / "w.txt", table(rim)))
    inside = read.profile.y >= -60 * MM
    np.testing.assert_allclose(read.profile.y[inside], W[:, 0] * MM, atol=2e-9)
    np.testing.assert_allclose(read.profile.z[inside], W[:, 1] * MM, atol=2e-9)
    assert read.profile.z[0] == pytest.approx(7.6357 * MM)
    assert "1 points beyond an upright face left out" in read.report.notes


LIP = np.array([[34.5, -7.2], [35.8, -8.6], [36.6, -9.8], [37.0, -11.0], [36.8, -12.0],
                [36.2, -13.2], [35.9, -15.0], [35.9, -18.0]])  # fmt: skip


def test_the_gauge_of_a_rail_with_a_lip_is_measured_at_the_lip(tmp_path: Path) -> None:
    """EN 13848-1: the least distance within 14 mm below the running surface."""
    crown = R[(R[:, 0] < 33.0) & (R[:, 1] > np.where(R[:, 0] < 0.0, -12.0, -6.0))]
    read = read_profile(written(tmp_path / "r.txt", table(np.vstack([crown, LIP]))), "rail")
    assert gauge_point(read.profile) == pytest.approx(37.0 * MM, abs=1e-6)
    assert any("upright face below the lip at y = 37.00 mm" in note for note in read.report.notes)
    cut = written(tmp_path / "c.txt", table(np.vstack([crown, LIP[:5]])))
    with pytest.raises(ValueError, match=r"ends 11.00 mm below its top on the gauge side, needed to 14 mm"):
        read_profile(cut, "rail")


def test_the_depth_of_the_gauge_point_is_a_choice() -> None:
    for depth in (10e-3, 14e-3, 15.875e-3):
        assert np.interp(gauge_point(RAIL, depth), RAIL.y, RAIL.z) == pytest.approx(-depth, abs=1e-9)
    with pytest.raises(ValueError, match=r"reaches 2.* mm below its top on the gauge side, needed 40 mm"):
        gauge_point(RAIL, 40e-3)


@pytest.mark.parametrize("size", [0.1, -0.1, 0.4, -1.5, 5.0])
@pytest.mark.parametrize("row", [20, 90, 140, 200])
def test_a_wild_point_is_found_by_its_neighbours_and_left_out(tmp_path: Path, size: float, row: int) -> None:
    read = read_profile(written(tmp_path / "w.txt", table(moved(row, size))))
    is_left_out = np.delete(W, row, 0) * MM
    np.testing.assert_allclose(read.profile.y, is_left_out[:, 0], atol=2e-9)
    np.testing.assert_allclose(read.profile.z, is_left_out[:, 1], atol=2e-9)
    assert any(f"wild point left out: line {row + 1} " in note for note in read.report.notes)


def test_two_wild_points_in_a_row_and_a_bad_scan(tmp_path: Path) -> None:
    points = moved(90, 0.5)
    points[91, 1] += 0.4
    read = read_profile(written(tmp_path / "w.txt", table(points)))
    assert len(read.profile.y) == len(W) - 2
    for row in range(20, 200, 30):
        points[row, 1] += 0.5
    with pytest.raises(
        ValueError, match=r"other points lie off the curve of their neighbours.*allowed are 3"
    ):
        read_profile(written(tmp_path / "w.txt", table(points)))


@pytest.mark.parametrize("noise", [0.0, 2e-6, 10e-6])
@pytest.mark.parametrize("shape", [lambda: S1002, lambda: wheel_profile("WP4_like"), lambda: RAIL])
def test_no_point_of_a_good_profile_is_wild(noise: float, shape: Callable[[], Profile]) -> None:
    """Neither where the arcs of a drawing join nor in the noise of an instrument."""
    profile = shape()
    z = profile.z[::4] + np.random.default_rng(5).normal(0.0, noise, len(profile.z[::4]))
    assert wild_points(profile.y[::4], z) == []


ACCEPTED = ("trailing_words.ban", "old_miniprof.whl", "rim_face.txt", "header_line.csv", "lipped_rail.txt")


@pytest.mark.parametrize("name", ACCEPTED)
def test_the_shared_cases_are_read(shared_cases: Path, name: str) -> None:
    profile = read_profile(shared_cases / name).profile
    if name == "trailing_words.ban":
        clean = read_profile(shared_cases / "clean_control.ban")
        assert clean.report.points_read == len(clean.profile.y) == 115
        np.testing.assert_array_equal(profile.z, clean.profile.z)
    elif name == "lipped_rail.txt":
        assert gauge_point(profile) == pytest.approx(37.0 * MM, abs=1e-6)
    else:
        assert flange_height(profile) == pytest.approx(28.0 * MM, abs=0.01 * MM)
        assert flange_thickness(profile) == pytest.approx(32.5 * MM, abs=0.015 * MM)
        if name != "old_miniprof.whl":
            part = (profile.y >= -58.0 * MM) & (profile.y < 54 * MM)
            nominal = np.interp(profile.y[part], S1002.y, S1002.z)
            np.testing.assert_allclose(profile.z[part], nominal, atol=1e-6)
