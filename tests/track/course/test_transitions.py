"""Shapes of transitions and courses of the cant against closed forms and numbers of others."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import fsolve

from track.course.alignment import (
    Alignment,
    Curve,
    Grade,
    Ramp,
    Straight,
    Transition,
    inclined_frame,
    track_frame,
)
from track.course.alignment_csv import read_alignment_csv
from track.course.shapes import SHAPES, share

# End of a 100 m transition from straight to R 300 m to the left (x ahead, y to the left) [m]: point lists of
# bSI-RailwayRoom's IFC-Rail-Unit-Test-Reference-Code; the Viennese bend there has 100 mm of cant across 1.5 m
# and the gravity height 1.8 m. Tolerance 1e-8 m.
ENDS = {
    "clothoid": (99.72257922, 5.54454237),
    "bloss": (99.746806417, 4.989811042),
    "cosine": (99.748455358, 4.945820688),
    "helmert": (99.751763446, 4.851060523),
    "sine": (99.75698050971550, 4.70132070248442),
    "viennese": (99.7631986781913, 4.49991547594814),
}


def end_of(shape: str, hand: str = "left", length: float = 100.0, radius: float = 300.0) -> np.ndarray:
    """Place and heading at the end of a transition that begins 10 m behind the origin."""
    plan = (Straight(10.0), Transition(length, shape=shape), Curve(50.0, radius, hand, 0.1))
    x, y, _, heading, *_ = track_frame(Alignment(plan, blend=0.25).table, 10.0 + length)
    return np.array([x - 10.0, y, heading])


@pytest.mark.parametrize("hand", ["left", "right"])
@pytest.mark.parametrize("shape", ENDS)
def test_transitions_end_where_experts_say(shape: str, hand: str) -> None:
    x, y = ENDS[shape]
    assert end_of(shape, hand)[:2] == pytest.approx([x, y if hand == "left" else -y], abs=1e-8)


def test_a_cubic_transition_is_the_cubic_parabola() -> None:
    """y = a x^3 of the arc length of the transition, with the curve's curvature at its end."""
    length, radius = 100.0, 300.0

    def conditions(unknown: np.ndarray) -> list[float]:
        a, x = unknown
        arc = quad(lambda t: np.sqrt(1.0 + (3.0 * a * t * t) ** 2), 0.0, x, epsabs=1e-12)[0]
        return [arc - length, radius * 6.0 * a * x / (1.0 + (3.0 * a * x * x) ** 2) ** 1.5 - 1.0]

    a, x = fsolve(conditions, [1.0 / (6.0 * radius * length), length], xtol=1e-14)
    found = end_of("cubic", length=length, radius=radius)
    assert found == pytest.approx([x, a * x**3, np.arctan(3.0 * a * x * x)], abs=1e-8)
    back = Alignment(
        (Curve(50.0, radius, "left"), Transition(length, shape="cubic"), Straight(10.0)), blend=0.25
    )
    ahead = Alignment(
        (Straight(10.0), Transition(length, shape="cubic"), Curve(50.0, radius, "left")), blend=0.25
    )
    for s in (0.0, 20.0, 61.7, 99.9):
        one, other = track_frame(ahead.table, 10.0 + s), track_frame(back.table, 50.0 + length - s)
        assert one[5] == pytest.approx(other[5], abs=1e-12)  # the curvature, run backwards


@pytest.mark.parametrize("shape", SHAPES)
def test_shares_run_from_0_to_1_with_their_slopes(shape: str) -> None:
    t = np.linspace(0.0, 1.0, 1001)
    kind, turn = np.full(t.size, SHAPES.index(shape)), np.full(t.size, 0.3)
    part, slope = share(kind, t, turn)
    assert part[[0, -1]] == pytest.approx([0.0, 1.0], abs=1e-12)
    assert np.abs(np.gradient(part, t)[2:-2] - slope[2:-2]).max() < 2.1e-3  # at the kink of the Helmert
    if shape != "cubic":
        assert np.abs(part + part[::-1] - 1.0).max() < 1e-12


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        (
            (Curve(20.0, 500.0, "left"), Transition(50.0, shape="cubic"), Curve(20.0, 300.0, "left")),
            "section 2 is a cubic Transition between two curves",
        ),
        (
            (Straight(20.0), Transition(150.0, shape="cubic"), Curve(20.0, 300.0, "left")),
            r"section 2 is a cubic Transition of 150 m to a radius of 300 m, allowed is up to 0.35 times",
        ),
    ],
)
def test_cubic_parabolas_that_are_none_are_refused(plan: tuple, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Alignment(plan)


def test_other_transitions_are_refused() -> None:
    with pytest.raises(ValueError, match=r"shape of a Transition is 'spiral', allowed are .*, cubic"):
        Transition(10.0, shape="spiral")
    with pytest.raises(ValueError, match=r"gravity_height of a Transition is -1.0 m, allowed are 0 to 3 m"):
        Transition(10.0, shape="viennese", gravity_height=-1.0)


def test_cant_about_the_low_rail_lifts_the_centre_line_by_half_of_it() -> None:
    for hand in ("left", "right"):
        plan = (
            Straight(50.0),
            Transition(60.0),
            Curve(80.0, 400.0, hand, 0.12),
            Transition(60.0),
            Straight(50.0),
        )
        about = {
            name: Alignment(plan, grades=(Grade(250.0, 0.005),), cant_about=name)
            for name in ("centre", "low_rail")
        }
        for s in np.linspace(0.0, 300.0, 91):
            one, other = (np.array(inclined_frame(about[name].table, s)) for name in ("centre", "low_rail"))
            cant = float(np.interp(s, [50, 110, 190, 250], [0.0, 0.12, 0.12, 0.0]))
            assert other[2] - one[2] == pytest.approx(
                0.5 * cant, abs=4.2e-5
            )  # the blended kinks of the ramps
            assert other[[0, 1, 3]] == pytest.approx(one[[0, 1, 3]], abs=1e-12)
    reverse = (Curve(50.0, 400.0, "left", 0.1), Transition(60.0), Curve(50.0, 400.0, "right", 0.1))
    with pytest.raises(ValueError, match=r"cants of both hands, -100 and 100 mm.*allowed about the low rail"):
        Alignment(reverse, cant_about="low_rail")
    with pytest.raises(ValueError, match="cant_about is 'outer', allowed are centre, low_rail"):
        Alignment(reverse, cant_about="outer")


def test_cants_of_another_gauge_have_another_base() -> None:
    """100 mm across 1.13 m (gauge 1067 mm) turn the running plane more than across 1.5 m."""
    plan = (Curve(100.0, 400.0, "left", 0.1, 1.067),)
    roll = inclined_frame(Alignment(plan, cant_base=1.132).table, 50.0)[5]
    assert abs(roll) == pytest.approx(np.arcsin(0.1 / 1.132), rel=1e-12)


def test_a_cant_ramp_may_begin_ahead_of_its_transition(tmp_path: Path) -> None:
    path = tmp_path / "line.csv"
    rows = ["100,,straight,0", "20,,straight,20", "60,400,right,80", "20,400,right,100", "80,400,right,100"]
    path.write_text("\n".join(["length_m,radius_m,hand,cant_mm", *rows]))
    table = read_alignment_csv(path).table
    made = Alignment(
        (
            Straight(100.0),
            Ramp(20.0, (0.0, 0.0), (0.0, -0.02)),
            Ramp(60.0, (0.0, -1 / 400), (-0.02, -0.08)),
            Ramp(20.0, (-1 / 400, -1 / 400), (-0.08, -0.1)),
            Curve(80.0, 400.0, "right", 0.1),
        )
    )
    for s in np.linspace(0.0, 280.0, 57):
        assert inclined_frame(table, s) == pytest.approx(inclined_frame(made.table, s), abs=1e-12)
    assert inclined_frame(table, 119.0)[5] == pytest.approx(np.arcsin(0.019 / 1.5), rel=1e-6)
    between = ["50,300,left,50", "50,,straight,20", "50,300,right,50"]
    path.write_text("\n".join(["length_m,radius_m,hand,cant_mm", *between]))
    with pytest.raises(ValueError, match="line 3: cant_mm is 20 on the straight between curves of diff"):
        read_alignment_csv(path)


def test_wide_radii_and_tables_of_spreadsheets(tmp_path: Path) -> None:
    path = tmp_path / "line.csv"
    path.write_bytes(
        "length_m;radius_m;hand;cant_mm\r\n100,5;;straight;0\r\n50;26000;left;10,5\r\n".encode("utf-16")
    )
    found = read_alignment_csv(path)
    assert found.length == 150.5
    assert float(found.table.curvature[-1]) == pytest.approx(1 / 26000, rel=1e-12)
    with pytest.raises(ValueError, match=r"radius of a Curve is 200000.0 m, allowed are 100 to 100000 m"):
        Curve(10.0, 2e5, "left")


def test_a_track_that_no_memory_holds_is_refused() -> None:
    with pytest.raises(ValueError, match=r"length of all sections is 2000000.0 m, allowed are 0 to 200000 m"):
        Alignment(tuple(Straight(1e5) for _ in range(20)))


def test_the_shared_ends_of_transitions(shared_cases: Path) -> None:
    lines = (shared_cases / "bench_transitions.csv").read_text().splitlines()[2:]
    names = {"SineCurve": "sine", "VienneseBend": "viennese"}
    for line in lines:
        name, x, y = line.split(",")
        name = name.partition(" ")[0]
        assert end_of(names.get(name, name))[:2] == pytest.approx([float(x), float(y)], abs=1e-8)
