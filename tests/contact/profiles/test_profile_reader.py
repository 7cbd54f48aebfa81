"""Readers of every format: axes, origins, what is refused; the shared files; writing and reading again."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from manchester_rail import manchester_rail
from scanned_wheel import hollow_wheel, scanned

from hh_exudyn.contact.profile import (
    RAIL_PROFILES,
    Profile,
    gauge_point,
    rail_profile,
    read_profile,
    read_rail_profile,
    read_wheel_profile,
    wheel_profile,
)
from hh_exudyn.contact.profiles.reader import ReadProfile
from hh_exudyn.contact.profiles.smoothing import RIPPLE_ALLOWED
from hh_exudyn.contact.profiles.spline import spline_evaluate, spline_table
from hh_exudyn.contact.profiles.writer import write_profile

MM = 1e-3
# Format, kind, points, of which dropped (duplicates, or overhangs of a file left as it is), smoothed
FILES = {
    "Car7216_0001r.whl": ("miniprof_2020", "wheel", 645, 0, True),
    "Car7422_0001r.whl": ("miniprof_2020", "wheel", 644, 0, True),
    "left-wheel-v1-pre-dry.whl": ("miniprof", "wheel", 667, 0, True),
    "avg_HR.BAN": ("miniprof", "rail", 147, 0, True),
    "MBench_S1002_v3.prw": ("simpack", "wheel", 399, 0, False),
    "MBench_UIC60_v3.prr": ("simpack", "rail", 495, 11, False),
    "worn_high_mileage.prw": ("simpack", "wheel", 638, 0, False),
    "site_b_hr.prr": ("simpack", "rail", 493, 31, False),
    "RUIC519A.dat": ("two_column", "wheel", 1001, 0, False),
    "RUIC519B.dat": ("two_column", "wheel", 1001, 0, False),
    "RUIC519H.dat": ("two_column", "wheel", 1001, 0, False),
    "RUIC519I.dat": ("two_column", "wheel", 1001, 0, False),
    "SUIC519A.dat": ("two_column", "rail", 1001, 0, False),
}
S1002, RAIL = wheel_profile("S1002"), rail_profile("60E1", 1 / 40)
OWN = (
    S1002, wheel_profile("WP4_like"), hollow_wheel(), manchester_rail(),
    *(rail_profile(name, 1 / 30) for name in RAIL_PROFILES),
)  # fmt: skip


def rows(y: np.ndarray, z: np.ndarray, scale: float = 1000.0) -> str:
    return "".join(f"{scale * a:.7f} {scale * b:.7f}\n" for a, b in zip(y, z, strict=True))


def simpack(y: np.ndarray, z: np.ndarray, kind: int, more: str = "", per_metre: float = 1000.0) -> str:
    return (
        f"header.begin\n version = 1 ! flag\n type = {kind}\nheader.end\nspline.begin\n"
        f" units.len.f = {per_metre} ! per metre\n{more} point.begin\n ! y z\n"
        f"{rows(y, z, per_metre)} point.end\nspline.end\n"
    )


def written(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


def is_smooth_in_side_coordinates(read: ReadProfile, largest_step: float = 9.0) -> None:
    """Whatever its file was like.

    `largest_step` of the second derivative, from node to node: at most a rail's crown to its shoulder
    (R300 to R80) [1/m].
    """
    profile, report = read.profile, read.report
    assert report.ripple_left <= RIPPLE_ALLOWED
    if report.smoothing:
        assert report.ripple > RIPPLE_ALLOWED
        assert report.smoothing.deviation <= 0.02 * MM
    if profile.kind == "wheel":
        assert np.interp(0.0, profile.y, profile.z) == pytest.approx(0.0, abs=1e-12)
        assert 48 * MM < profile.y[np.argmin(profile.z)] < 61 * MM  # the flange tip; of WP4_like at 59.8
        slope = np.polyfit(*(values[np.abs(profile.y) < 15 * MM] for values in (profile.y, profile.z)), 1)[0]
        assert -0.1 < slope < 0.0  # the wheel's radius grows towards the flange
    else:
        assert profile.z.max() == 0.0
        assert np.interp(gauge_point(profile), profile.y, profile.z) == pytest.approx(-14 * MM, abs=1e-9)
    table = spline_table(profile)
    start = -15 * MM if profile.kind == "wheel" else gauge_point(profile) - 51 * MM
    middle = [spline_evaluate(table, start + y)[2] for y in np.arange(0, 30, 0.25) * MM]
    assert np.all(np.isfinite(middle))
    assert np.abs(np.diff(middle)).max() < largest_step


def is_the_same_written_and_read(first: Profile, path: Path) -> None:
    for file_format in ("two_column", "miniprof"):
        write_profile(first, path, file_format)
        read = read_profile(path)
        assert read.report.format == file_format
        assert read.report.kind == first.kind
        assert read.report.smoothing is None
        np.testing.assert_allclose(read.profile.y, first.y, atol=1e-9)  # asked: 1 um
        np.testing.assert_allclose(read.profile.z, first.z, atol=2e-9)


@pytest.mark.parametrize("name", FILES)
def test_files_of_others_become_smooth_profiles(shared_profiles: Path, name: str) -> None:
    report = (read := read_profile(shared_profiles / name)).report
    found = (report.format, report.kind, report.points_read, report.points_dropped, bool(report.smoothing))
    assert found == FILES[name]
    kinked = name == "RUIC519H.dat"  # EN 15302's wheel H is two cones from 10 mm on
    is_smooth_in_side_coordinates(read, largest_step=np.inf if kinked else 9.0)


@pytest.mark.parametrize("name", FILES)
def test_files_of_others_are_the_same_written_and_read(
    shared_profiles: Path, tmp_path: Path, name: str
) -> None:
    is_the_same_written_and_read(read_profile(shared_profiles / name).profile, tmp_path / "again.txt")


@pytest.mark.parametrize("profile", OWN, ids=lambda profile: profile.name)
def test_own_shapes_become_smooth_profiles_written_and_read(tmp_path: Path, profile: Profile) -> None:
    """As drawn, in SIMPACK's axes, and as scanned with 5 um of noise; the scan lies on what was drawn."""
    kind = 1 if profile.kind == "wheel" else 0
    drawn = read_profile(written(tmp_path / "drawn.prx", simpack(-profile.y, -profile.z, kind)))
    assert (drawn.report.format, drawn.report.kind) == ("simpack", profile.kind)
    assert drawn.report.smoothing is None
    is_smooth_in_side_coordinates(drawn)
    y, z = scanned(profile, 5e-6, seed=2)
    scan = read_profile(written(tmp_path / "scan.txt", rows(y, z)))
    assert (scan.report.format, scan.report.kind) == ("two_column", profile.kind)
    assert scan.report.smoothing
    is_smooth_in_side_coordinates(scan)
    near = np.abs(scan.profile.y) < 25 * MM
    shift = scan.profile.z - np.interp(scan.profile.y, profile.y, profile.z)
    assert np.ptp(shift[near]) < 0.04 * MM  # 0.02 mm is what smoothing may move a point
    for read in (drawn, scan):
        is_the_same_written_and_read(read.profile, tmp_path / "again.txt")


def test_written_files_say_what_they_hold(tmp_path: Path) -> None:
    write_profile(S1002, tmp_path / "w.txt")
    head = (tmp_path / "w.txt").read_text().splitlines()[:2]
    assert "wheel" in head[0]
    assert "S1002" in head[0]
    assert "mm" in head[1]
    write_profile(S1002, tmp_path / "w.whl", "miniprof")
    header = read_profile(tmp_path / "w.whl").report.header
    written = [float(header[key]) for key in ("Sd", "Sh", "qR")]
    assert written == pytest.approx([32.5, 28.0, 10.794], abs=0.001)
    with pytest.raises(ValueError, match="format = 'csv', allowed two_column, miniprof"):
        write_profile(S1002, tmp_path / "w.csv", "csv")


def test_two_columns_in_side_coordinates_stay_as_they_are(tmp_path: Path) -> None:
    """Also where a rail's flanks stand at 1:20 and its lateral origin is odd."""
    for profile, shift in ((S1002, 0.0), (RAIL, 12.3 * MM)):
        text = "# comment\n" + rows(profile.y + shift, profile.z + 0.4 * MM)
        read = read_profile(written(tmp_path / "p.txt", text))
        assert not read.report.mirrored
        assert not read.report.upside_down
        assert read.report.points_dropped == 0
        np.testing.assert_allclose(read.profile.y, profile.y + shift, atol=1e-10)
        zero = np.interp(0.0, profile.y, profile.z) if profile.kind == "wheel" else 0.0
        np.testing.assert_allclose(read.profile.z, profile.z - zero, atol=2e-10)


@pytest.mark.parametrize("across", [1, -1])
@pytest.mark.parametrize("up", [1, -1])
@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("zero", ["running circle", "flange back"])
def test_a_wheel_is_turned_by_its_flange(tmp_path: Path, across: int, up: int, order: int, zero: str) -> None:
    y = S1002.y - (70 * MM if zero == "flange back" else 0.0)
    text = rows(across * y[::order], up * S1002.z[::order])
    read = read_wheel_profile(written(tmp_path / "w.txt", text))
    np.testing.assert_allclose(read.y, S1002.y, atol=1e-10)
    np.testing.assert_allclose(read.z, S1002.z, atol=1e-8)


def test_the_place_of_the_flange_back_may_be_told(tmp_path: Path) -> None:
    path = written(tmp_path / "w.txt", rows(S1002.y + 200 * MM, S1002.z))
    with pytest.raises(ValueError, match=r"255 mm from the file's lateral zero.*flange_back"):
        read_wheel_profile(path)
    read = read_profile(path, flange_back=270 * MM).profile
    np.testing.assert_allclose(read.y, S1002.y, atol=1e-10)


def test_a_rail_of_simpack_and_of_miniprof_has_its_habits(tmp_path: Path) -> None:
    """Both sides reach 14 mm down, so the file cannot tell the gauge side: here the format says which."""
    prr = written(tmp_path / "r.prr", simpack(-RAIL.y, -RAIL.z, 0))
    ban = written(
        tmp_path / "r.ban", f"Rail=L\nColumnDef=X,Y\nXYPoints={len(RAIL.y)}\n\n" + rows(RAIL.y, RAIL.z)
    )
    for path in (prr, ban):
        np.testing.assert_allclose(read_rail_profile(path).y, RAIL.y, atol=1e-10)
        other = read_rail_profile(path, mirrored=True)
        np.testing.assert_allclose(other.y, -RAIL.y[::-1], atol=1e-10)
        np.testing.assert_allclose(other.z, RAIL.z[::-1], atol=1e-10)


def test_a_rail_whose_field_side_ends_early_tells_its_gauge_side(tmp_path: Path) -> None:
    part = RAIL.z[: len(RAIL.z) // 2].searchsorted(-8 * MM)
    y, z = RAIL.y[part:], RAIL.z[part:]
    for across in (1, -1):
        read = read_rail_profile(written(tmp_path / "r.txt", rows(across * y, z)))
        np.testing.assert_allclose(read.y, y, atol=1e-10)
    with pytest.raises(ValueError, match="mirrored is for rails whose two sides reach 14 mm"):
        read_rail_profile(tmp_path / "r.txt", mirrored=True)


def test_simpack_flags_units_and_weights(tmp_path: Path) -> None:
    plain = read_wheel_profile(written(tmp_path / "a.prw", simpack(-S1002.y, -S1002.z, 1)))
    flags = " mirror.y = 1 ! mirrored\n shift.y = 2.0\n bound.y.min = 1\n bound.y.max = 0\n"
    path = written(tmp_path / "b.prw", simpack(S1002.y - 2 * MM, -S1002.z, 1, flags))
    metres = written(tmp_path / "c.prw", simpack(-S1002.y, -S1002.z, 1, per_metre=1.0))
    for other, tolerance in ((path, 1e-9), (metres, 1e-7)):
        np.testing.assert_allclose(read_wheel_profile(other).y, plain.y, atol=tolerance)
    bounds = written(
        tmp_path / "d.prw", simpack(-S1002.y, -S1002.z, 1, " bound.y.min = -100\n bound.y.max = 50\n")
    )
    assert read_wheel_profile(bounds).y[0] == pytest.approx(-50 * MM, abs=0.1 * MM)


def test_quoted_and_doubled_keys_of_miniprof(tmp_path: Path) -> None:
    """As in averaged rails: quoted keys, the later key right, more columns."""
    table = "".join(f"{1e3 * y:.6f} {1e3 * z:.6f} 0.1 0.2\n" for y, z in zip(RAIL.y, RAIL.z, strict=True))
    text = (
        f'"ColumnDef=X,Y,A"\nColumnDef=X,Y,A,C\nXOffset=3.0\nYOffset=0\n"XYPoints={len(RAIL.y)}"\n\n{table}'
    )
    read = read_rail_profile(written(tmp_path / "r.ban", text))
    np.testing.assert_allclose(read.y, RAIL.y + 3 * MM, atol=1e-9)


WHEEL_TEXT = rows(S1002.y[::3], S1002.z[::3])
RAIL_TEXT = rows(RAIL.y[::3], RAIL.z[::3])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file is empty"),
        (" \n\n", "the file is empty"),
        ("\0\1\2" * 50, "binary"),
        (WHEEL_TEXT.replace("\n", "\nnan nan\n", 1), "line 2: not a finite number"),
        (WHEEL_TEXT.replace("\n", "\n1e300 0\n", 1), "line 2: y = 1e.300 mm.*allowed up to 1000 mm"),
        (WHEEL_TEXT.replace("\n", "\n1 2 3\n", 1), "line 2: expected two numbers.*got '1 2 3'"),
        ("\n".join(WHEEL_TEXT.splitlines()[:19]), "19 points, at least 20 needed"),
        ("\n".join(WHEEL_TEXT.splitlines()[:200]), "no flange: lowest point 1.* mm below the tread"),
        ("".join(WHEEL_TEXT.splitlines(keepends=True)[150:]), "begins at y ="),
        (
            rows(S1002.y[::3], S1002.z[::3], 1.0),
            "spans 0.13 mm laterally, allowed 40 .. 300 mm; are these metres",
        ),
        (rows(S1002.y[::3], S1002.z[::3], 1 / 0.0254), "spans 5.1.. mm laterally.*are these inches"),
        (rows(S1002.y[::3], S1002.z[::3], 1e6), r"allowed up to 1000 mm; are these micrometres"),
        (
            rows(np.linspace(-0.06, 0.07, 19).repeat(2), np.zeros(38)),
            "19 different points, at least 20 needed",
        ),
        (RAIL_TEXT, "falls by 24.5 and 25.9 mm at its two sides.*is it a rail's"),
        ("#MINIRAILPROF\nx\n\n" + RAIL_TEXT, "the file says that it is a rail's"),
        (simpack(-RAIL.y, -RAIL.z, 0), "the file says that it is a rail's"),
        (simpack(-S1002.y, -S1002.z, 7), "header type = '7', allowed 0"),
        (simpack(-S1002.y, -S1002.z, 1, " rotate = 0.1\n"), "rotate = 0.1, allowed 0"),
        (simpack(-S1002.y, -S1002.z, 1, per_metre=0.0), "units.len.f = 0 .*allowed"),
        (simpack(-S1002.y, -S1002.z, 1).replace("point.end", ""), "spline.end'|cut off"),
        (simpack(-S1002.y, -S1002.z, 1).split(" point.end")[0], "is the file cut off"),
        ("Sd=1\nXYPoints=999\n\n" + WHEEL_TEXT, "points, but XYPoints = 999: is the file cut off"),
        ("Sd=1\nColumnDef=A,C\n\n" + WHEEL_TEXT, "ColumnDef = 'A,C', allowed with X and Y"),
    ],
)
def test_bad_wheel_files_are_told(tmp_path: Path, text: str, message: str) -> None:
    path = written(tmp_path / "bad.txt", text)
    with pytest.raises(ValueError, match=message) as caught:
        read_wheel_profile(path)
    assert str(path) in str(caught.value)


def test_other_bad_input_is_told(tmp_path: Path) -> None:
    wheel = written(tmp_path / "w.txt", WHEEL_TEXT)
    with pytest.raises(ValueError, match="spans 130 mm laterally, allowed up to 90 mm; is it a wheel's"):
        read_rail_profile(wheel)
    for keywords, message in (
        ({"kind": "tram"}, "kind = 'tram', allowed 'wheel', 'rail' or None"),
        ({"smoothing": "some"}, "smoothing = 'some', allowed auto, always, never"),
        ({"deviation": 1.0}, r"deviation = 1.0 m, allowed 1e-06 .. 0.0005 m"),
        ({"mirrored": True}, "mirrored is for rails"),
    ):
        with pytest.raises(ValueError, match=message):
            read_profile(wheel, **keywords)
    with pytest.raises(ValueError, match="allowed for wheels"):
        read_profile(written(tmp_path / "r.txt", RAIL_TEXT), flange_back=0.07)
    with pytest.raises(ValueError, match="is a folder, allowed is a file"):
        read_profile(tmp_path)


SAMPLES = (
    WHEEL_TEXT,
    RAIL_TEXT,
    simpack(-S1002.y[::3], -S1002.z[::3], 1),
    f"ProgramName=x\nColumnDef=X,Y\nXYPoints={len(S1002.y[::3])}\n\n" + WHEEL_TEXT,
    "#MINIWHEELPROF\nx\n1 2 3\n(Sd/Sh/qR)\n\n" + WHEEL_TEXT,
)


def read_or_refuse(path: Path, data: bytes) -> None:
    """Any bytes are a profile or a ValueError; warnings are errors in these tests."""
    path.write_bytes(data)
    try:
        profile = read_profile(path).profile
    except ValueError as error:
        assert str(path) in str(error)
    else:
        assert isinstance(profile, Profile)


FUZZ = settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])


@FUZZ
@given(data=st.binary(max_size=400))
def test_random_bytes_are_refused(tmp_path: Path, data: bytes) -> None:
    read_or_refuse(tmp_path / "fuzz.txt", data)


@FUZZ
@given(
    sample=st.sampled_from(SAMPLES),
    start=st.floats(0, 0.6),
    length=st.floats(0.02, 1),
    damage=st.lists(st.tuples(st.floats(0, 1), st.binary(max_size=6)), max_size=4),
)
def test_cut_and_damaged_files_are_read_or_refused(
    tmp_path: Path, sample: str, start: float, length: float, damage: list[tuple[float, bytes]]
) -> None:
    data = sample.encode()
    data = data[int(start * len(data)) :][: int(length * len(data))]
    for place, piece in damage:
        at = int(place * len(data))
        data = data[:at] + piece + data[at + len(piece) :]
    read_or_refuse(tmp_path / "fuzz.txt", data)


@FUZZ
@given(
    numbers=st.lists(
        st.tuples(*[st.floats(-200, 200) | st.floats(allow_nan=True, allow_infinity=True)] * 2), max_size=60
    )
)
def test_random_numbers_are_read_or_refused(tmp_path: Path, numbers: list[tuple[float, float]]) -> None:
    read_or_refuse(tmp_path / "fuzz.txt", "\n".join(f"{y!r} {z!r}" for y, z in numbers).encode())


@FUZZ
@given(
    sigma=st.sampled_from([1e-3, 0.03, 0.3, 1.0, 3.0]),
    seed=st.integers(0, 10_000),
    wheel=st.booleans(),
    start=st.integers(0, 200),
    stride=st.integers(1, 12),
)
def test_scribble_is_read_or_refused(
    tmp_path: Path, sigma: float, seed: int, wheel: bool, start: int, stride: int
) -> None:
    """Profiles under noise of up to 3 mm, with ends missing: loops, overhangs, no flange, no gauge point."""
    profile = S1002 if wheel else RAIL
    points = 1e3 * np.column_stack([profile.y, profile.z])[start::stride]
    points += np.random.default_rng(seed).normal(0.0, sigma, points.shape)
    read_or_refuse(tmp_path / "fuzz.txt", "\n".join(f"{y} {z}" for y, z in points).encode())
