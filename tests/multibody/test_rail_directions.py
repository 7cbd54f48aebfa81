"""Rails that run otherwise than the track: wheels roll over bends, and slip as on the same alignment.

Rigid track and a free wheelset throughout, so that everything is cheap and exact: the train pulls it at the
middle of its axle, and rolling is all that steers it.
"""

from types import SimpleNamespace

import numpy as np
import pytest
from run_tables import table
from scipy.optimize import least_squares

from hh_exudyn.contact.profile import gauge_point, rail_profile
from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from hh_exudyn.multibody.free_wheelset import CONICITY, RADIUS, conical_wheel, free_wheelset
from hh_exudyn.multibody.simulate import simulate
from track.course.alignment import track_frame
from vehicles.catalogue import vehicle
from vehicles.start import start_front

FRONT = 1.0  # m, arc length where measured irregularities begin for a free wheelset
HALF_DISTANCE = 0.7175 + gauge_point(rail_profile("60E1", inclination=1 / 20))
# A wheelset that moves sideways on its cones rolls (about x) by conicity / half distance, and so its contacts
# move sideways by more than its centre (Wickens 2003, equation 2.9 with r0 Gamma / l)
ROLLING = RADIUS * CONICITY / HALF_DISTANCE


@pytest.fixture(scope="module")
def cone(tmp_path_factory) -> str:
    return conical_wheel(tmp_path_factory.mktemp("cone") / "cone.txt")


def irregularity(path, length=400.0, front=FRONT, **signals) -> str:
    """A recording car's file with signals that are functions of the arc length [m], every 0.1 m."""
    s = np.arange(0.0, length, 0.1)
    names = ("level", "alignment", "gauge", "cross_level")
    columns = [1e3 * signals[name](front + s) if name in signals else 0.0 * s for name in names]
    header = "position_m," + ",".join(f"{name}_mm" for name in names)
    rows = np.column_stack([s, *columns])
    np.savetxt(path, rows, delimiter=",", header=header, comments="", fmt="%.9f")
    return str(path)


def straight(length: float) -> list[dict]:
    return [{"kind": "straight", "length_m": length, "gauge_mm": 1435.0}]


def wheelset_log(demo, directory, wheel, speed=15.0, interval=0.8, **track) -> SimpleNamespace:
    track = {"inclination": "1:20", "flexibility": "rigid", **track}
    integration = {"output_interval_ms": interval}
    # ellipses, whose points move with the cone exactly: these tests hold the frames of the rails
    case = demo.with_changes(
        speed_km_h=speed,
        wheel_profile=wheel,
        track=track,
        integration=integration,
        contact={"normal": "hertz"},
    )
    return table(simulate(case, directory, vehicle=free_wheelset()), "contact")


def of_wheel(log: SimpleNamespace, wheelset: int, side: int) -> SimpleNamespace:
    """The deepest patch of one wheel."""
    chosen = (log.wheelset == wheelset) & (log.side == side) & (log.patch == 0)
    return SimpleNamespace(**{name: values[chosen] for name, values in vars(log).items()})


def test_a_wheelset_rolls_on_over_a_kink(demo, tmp_path, cone) -> None:
    """Rails with a bend of 1 mrad: rolling takes it on straight ahead, but for conicity and roll.

    Without slip (1 + rolling) y' = psi + rolling y_rail', psi' = -conicity (y - y_rail) / (r0 e), so that
    behind the kink y = bend x (rolling + conicity x^2 / (6 r0 e)) / (1 + rolling).
    """
    kink, bend = 65.0, 1e-3
    path = irregularity(tmp_path / "kink.csv", 140.0, alignment=lambda s: bend * np.maximum(s - kink, 0.0))
    log = wheelset_log(demo, tmp_path / "run", cone, sections=straight(70.0), irregularity=path)
    left = of_wheel(log, 1, 1)
    for behind in (0.3, 0.5, 1.0):
        expected = bend * behind * (ROLLING + CONICITY * behind**2 / (6 * RADIUS * HALF_DISTANCE))
        moved = np.interp(kink + behind, left.s, left.y_wheelset)
        assert moved == pytest.approx(expected / (1 + ROLLING), rel=0.03)  # 18 um at 0.5 m, where rails: 500
    after = (left.s > kink + 0.15) & (left.s < kink + 1.0)
    for name in ("nu_x", "nu_y"):
        assert np.abs(getattr(left, name)[after]).max() < 2e-6
    assert left.angle_of_attack[after] == pytest.approx(-bend, abs=0.1e-3)  # against the rail
    assert np.abs(left.yaw[after]).max() < 0.1e-3  # to the track


def forced_wave(s, y, wave_number, natural) -> tuple[complex, float]:
    """Complex amplitude of a forced wave [m], by least squares with a free wave, and that one's number."""

    def columns(parameters):
        k, decay = parameters
        free = np.exp(-decay * (s - s[0]))
        found = [free * np.sin(k * s), free * np.cos(k * s), np.ones_like(s)]
        if wave_number > 0.0:
            found += [np.sin(wave_number * s), np.cos(wave_number * s)]
        return np.column_stack(found)

    def remainder(parameters):
        matrix = columns(parameters)
        return 1e6 * (matrix @ np.linalg.lstsq(matrix, y, rcond=None)[0] - y)

    fit = least_squares(remainder, [natural, 0.0])
    assert np.abs(fit.fun).max() < 0.01e6 * np.abs(y).max()  # nothing else is in the motion
    solution = np.linalg.lstsq(columns(fit.x), y, rcond=None)[0]
    return (complex(*solution[3:]) if wave_number > 0.0 else 0j), float(fit.x[0])


@pytest.fixture(scope="module")
def klingel_number(demo, runs, cone) -> float:
    """Wave number of the free wheelset behind a step of 0.01 mm [1/m]."""
    path = irregularity(runs / "step.csv", alignment=lambda s: 1e-3 * (s > 61.0))
    track = {"sections": straight(230.0), "irregularity": path, "irregularity_scale": 0.01}
    left = of_wheel(wheelset_log(demo, runs / "free_wave", cone, interval=8.0, **track), 1, 1)
    behind = left.s > 120.0
    klingel = np.sqrt(CONICITY / (RADIUS * HALF_DISTANCE))
    _, number = forced_wave(left.s[behind], left.y_wheelset[behind], 0.0, klingel)
    assert number == pytest.approx(klingel, rel=0.02)
    return number


@pytest.mark.parametrize("wavelength", [40.0, 10.0])
def test_an_alignment_wave_forces_klingels_oscillation(demo, runs, cone, klingel_number, wavelength) -> None:
    """Amplitude and phase within 1 % of y'' + k^2 y = k^2 y_rail + rolling / (1 + rolling) y_rail''."""
    number, size = 2 * np.pi / wavelength, 1e-5
    path = irregularity(
        runs / f"wave_{wavelength:g}.csv", alignment=lambda s: 100 * size * np.sin(number * s)
    )
    track = {"sections": straight(230.0), "irregularity": path, "irregularity_scale": 0.01}
    left = of_wheel(wheelset_log(demo, runs / f"wave_{wavelength:g}", cone, interval=8.0, **track), 1, 1)
    behind = left.s > 120.0
    found, _ = forced_wave(left.s[behind], left.y_wheelset[behind], number, klingel_number)
    k2, forced2 = klingel_number**2, number**2
    expected = size * (k2 - ROLLING / (1 + ROLLING) * forced2) / (k2 - forced2)
    assert abs(found) == pytest.approx(abs(expected), rel=0.01)
    assert abs(np.angle(found / expected)) < 0.02  # the wheelset's mass: 11 mrad at 10 m


GAUGE = {"gauge_mm": 1435.0}
RAMP_START, RAMP_END = 60.0, 70.0  # m
UPHILL = [
    {"length_m": RAMP_START, "gradient_per_mille": 0.0},
    {"length_m": RAMP_END - RAMP_START, "gradient_per_mille": 0.0, "end_per_mille": 0.6},
    {"length_m": 45.0, "gradient_per_mille": 0.6},
]


def curve_with_ramp(radius: float, cant_mm=(60.0, 60.0), gauge_mm=(1435.0, 1435.0)) -> list[dict]:
    """A left-hand curve in which cant and gauge go from one value to another on the way."""
    ramp = {"kind": "ramp", "radius_m": [radius, radius]}
    parts = [[(ends[0],) * 2, ends, (ends[1],) * 2] for ends in (cant_mm, gauge_mm)]
    lengths = (RAMP_START - 35.0, RAMP_END - RAMP_START, 45.0)
    return [
        {"kind": "straight", "length_m": 15.0, **GAUGE},
        {"kind": "transition", "length_m": 20.0},
        *(
            {**ramp, "length_m": length, "cant_mm": list(cant), "gauge_mm": list(gauge)}
            for length, cant, gauge in zip(lengths, *parts, strict=True)
        ),
    ]


TRACKS = {
    "level": lambda radius: {"sections": curve_with_ramp(radius), "grades": UPHILL},
    "cross_level": lambda radius: {"sections": curve_with_ramp(radius, cant_mm=(60.0, 70.0))},
    "gauge": lambda radius: {"sections": curve_with_ramp(radius, gauge_mm=(1435.0, 1439.0))},
}


def signal_of(name: str, demo, track: dict):
    """What an alignment has more than the one without ramp, as a function of the arc length [m]."""
    alignment = demo.with_changes(track=track).alignment()
    plain = demo.with_changes(track={"sections": curve_with_ramp(450.0)}).alignment()

    def at(s):
        _, _, z, _, roll, _, gauge = track_frame(alignment.table, min(s, alignment.table.end))
        *_, plain_roll, _, plain_gauge = track_frame(plain.table, min(s, plain.table.end))
        cant = -RAIL_TOP_DISTANCE * (np.sin(roll) - np.sin(plain_roll)) if s > 40.0 else 0.0
        return {"level": z, "cross_level": cant, "gauge": gauge - plain_gauge}[name]

    return np.vectorize(at)


def check_same_forces(
    one: SimpleNamespace, other: SimpleNamespace, wheelset: int = 1, creepage: float = 1e-6
) -> None:
    """Forces within 0.2 % of the load but for a metre about the ramp's ends; behind 0.1 %, and creepages."""
    for side in (1, -1):
        a, b = (of_wheel(log, wheelset, side) for log in (one, other))
        at = np.arange(RAMP_START - 5.0, min(a.s.max(), b.s.max()), 0.05)
        at = at[(np.abs(at - RAMP_START) > 1.0) & (np.abs(at - RAMP_END) > 1.0)]
        behind = at > RAMP_END + 5.0
        load = a.normal_force.mean()
        for name in ("normal_force", "force_x", "force_y", "nu_x", "nu_y"):
            difference = np.interp(at, a.s, getattr(a, name)) - np.interp(at, b.s, getattr(b, name))
            if name in ("nu_x", "nu_y"):
                assert np.abs(difference[behind]).max() < creepage, (wheelset, side, name)
            else:
                assert np.abs(difference).max() < 2e-3 * load, (wheelset, side, name)
                assert np.abs(difference[behind]).max() < 1e-3 * load, (wheelset, side, name)


@pytest.mark.parametrize("name", TRACKS)
def test_on_and_behind_a_ramp_all_is_as_on_that_alignment(demo, tmp_path, cone, name) -> None:
    """A bend uphill, a ramp of cross-level and one of gauge; the same as vertical curve, cant and gauge."""
    track = TRACKS[name](3000.0)
    path = irregularity(tmp_path / "ramp.csv", 185.0, **{name: signal_of(name, demo, TRACKS[name](450.0))})
    plain = {"sections": curve_with_ramp(3000.0), "irregularity": path}
    logs = [
        wheelset_log(demo, tmp_path / f"run_{k}", cone, 40.0, **changes)
        for k, changes in enumerate((plain, track))
    ]
    check_same_forces(*logs)


@pytest.mark.slow
@pytest.mark.parametrize("name", TRACKS)
def test_on_a_ramp_a_wheel_in_its_flange_root_is_as_on_that_alignment(demo, tmp_path, name) -> None:
    """The wagon in a curve of 450 m: its leading outer wheels run on their flange roots.

    On rails that rise it swings behind the bend, by creepages of 1.1e-6 otherwise than on a slope, where the
    train's couplers rise too; the largest is 3.8e-3.
    """
    track, front = TRACKS[name](450.0), start_front(vehicle(demo.vehicle))
    signal = signal_of(name, demo, track)
    path = irregularity(tmp_path / "ramp.csv", 185.0, front, **{name: signal})
    logs = []
    for k, changes in enumerate(({"sections": curve_with_ramp(450.0), "irregularity": path}, track)):
        case = demo.with_changes(track={"flexibility": "rigid", **changes})
        logs.append(table(simulate(case, tmp_path / f"run_{k}"), "contact"))
    assert of_wheel(logs[0], 1, -1).contact_angle[-1] > np.radians(15.0)
    for wheelset in (1, 2, 3, 4):
        check_same_forces(*logs, wheelset, creepage=2e-6)


def test_a_wave_of_the_track_is_the_same_as_irregularity_and_as_alignment(demo, runs, cone) -> None:
    """Galilei: waves of 4 mm and 30 m as rails that wind on a straight track, and as a track that winds.

    Every force within 1 % of the largest of its kind.
    """
    largest = 2e-4  # 1/m, of a curvature that goes linearly to and fro, begun so that the mean heading is 0
    values = np.array([0.0, 0.0, 0.5, *[0.0, -1.0, 0.0, 1.0] * 4])[:16] * largest
    lengths = np.array([40.0, *[7.5] * 15])
    winding = runs / "winding_alignment.csv"
    rows = np.column_stack([lengths, values])
    np.savetxt(winding, rows, delimiter=",", header="length_m,curvature_1_per_m", comments="", fmt="%.9f")
    s = np.arange(0.0, 300.0, 0.01)
    curvature = np.interp(s, np.cumsum(lengths), values)
    heading = np.cumsum(curvature) * 0.01
    lateral = np.cumsum(heading) * 0.01
    path = irregularity(runs / "winding.csv", 250.0, alignment=lambda at: np.interp(at, s, lateral))
    rails, track = (
        wheelset_log(demo, runs / name, cone, 40.0, **changes)
        for name, changes in (
            ("winding_rails", {"sections": straight(152.5), "irregularity": path}),
            ("winding_track", {"sections": None, "alignment": str(winding)}),
        )
    )
    at = np.arange(60.0, 145.0, 0.05)
    for side in (1, -1):
        one, other = (of_wheel(log, 1, side) for log in (rails, track))
        for name in ("normal_force", "force_x", "force_y"):
            a, b = (np.interp(at, log.s, getattr(log, name)) for log in (one, other))
            assert np.abs(a - b).max() < 0.01 * np.abs(b).max(), (side, name)
        assert np.ptp(one.y_wheel) > 2e-3
