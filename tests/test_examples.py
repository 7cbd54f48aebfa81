"""Every example runs as its docstring says, and what it prints is what it promises."""

import importlib.util
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.campaign.objective import Objective
from hh_exudyn.contact.profile import Profile, wheel_profile
from hh_exudyn.contact.profiles.writer import write_profile
from vehicles.variants import find_variant

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def run(name: str, *words: str | Path) -> str:
    """Run an example in a process of its own, away from the checkout; its standard output."""
    result = subprocess.run(
        [sys.executable, "-W", "error", EXAMPLES / name, *map(str, words)],
        capture_output=True, text=True, cwd="/",
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_one_contact() -> None:
    """Forces rise with creepage to full friction; the two theories stay within 5 % of mu N of each other."""
    text = run("01_one_contact.py")
    assert text.startswith("147.2 kN: ")
    rows = [
        tuple(map(float, row)) for row in re.findall(r"^ +([\d.]+) +([\d.]+) +([\d.]+)$", text, re.MULTILINE)
    ]
    assert len(rows) == 5
    for column in (1, 2):
        forces = [row[column] for row in rows]
        assert forces == sorted(forces)
        assert 0.98 < forces[-1] <= 1.0
    assert all(abs(row[1] - row[2]) < 0.05 for row in rows)


def test_profiles_and_conicity(tmp_path: Path) -> None:
    """The stand-in's measures, the rail of highest conicity at either gauge, and a file of one's own."""
    text = run("04_profiles_and_conicity.py")
    assert text.startswith("WP4_like: Sh 29.08, Sd 26.89, qR 10.07 mm")
    rows = re.findall(r"^gauge (\d+) mm, (\w+) +([\d.]+) ([\d.]+) ([\d.]+)$", text, re.MULTILINE)
    conicity = {(gauge, rail): float(at_3_mm) for gauge, rail, _, at_3_mm, _ in rows}
    rails = ("60E1", "MB1_like", "MB4_like")
    assert max(rails, key=lambda rail: conicity["1435", rail]) == "60E1"
    assert max(rails, key=lambda rail: conicity["1445", rail]) == "MB4_like"
    write_profile(wheel_profile("S1002"), tmp_path / "mine.txt", format="miniprof")
    assert "Sh 28.00, Sd 32.50" in run("04_profiles_and_conicity.py", tmp_path / "mine.txt")


@pytest.fixture(scope="module")
def frictions(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    folder = tmp_path_factory.mktemp("examples")
    return folder, run("02_two_frictions.py", folder)


@pytest.mark.slow
def test_two_frictions(frictions: tuple[Path, str]) -> None:
    folder, text = frictions
    assert len(re.findall(r"^  wheelset \d: Q", text, re.MULTILINE)) == 8
    assert {path.name for path in folder.iterdir()} == {"dry", "damp"}


@pytest.mark.slow
def test_damage_of_a_run(frictions: tuple[Path, str], tmp_path: Path) -> None:
    """A harder steel (ER9) is never beyond shakedown for longer than a softer one (ER7)."""
    text = run("03_damage_of_a_run.py", frictions[0] / "dry", tmp_path)
    shares = dict(re.findall(r"^(ER\d): .* (\d+)% of the way$", text, re.MULTILINE))
    assert int(shares["ER9"]) <= int(shares["ER7"])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fatigue.png", "shakedown.png", "wear.png"]


@pytest.mark.slow
def test_savast(tmp_path: Path) -> None:
    """Ranges of Q hold the static loads, those of outer wheels lie higher; a second call runs nothing."""
    text = run("05_savast.py", tmp_path)
    assert len(list(tmp_path.glob("*/status.json"))) == 12
    ranges = {
        (force, load, what): [float(number) for number in numbers.split()]
        for force, table in re.findall(r"largest (Q|Y) [^\n]*\n((?:(?:loaded|empty).*\n)+)", text)
        for load, what, numbers in re.findall(r"(loaded|empty) +(from|to) +(.*)", table)
    }
    assert len(ranges) == 8
    for load, static in (("loaded", 120.0 * 9.81 / 8), ("empty", 21.6 * 9.81 / 8)):
        low, high = ranges["Q", load, "from"], ranges["Q", load, "to"]
        assert all(a < static < b for a, b in zip(low, high, strict=True))
    # Cant deficiency of 34 mm in a left curve: the outer side carries more, at every wheelset.
    for extreme in (ranges["Q", "loaded", "from"], ranges["Q", "loaded", "to"]):
        more = [right - left for left, right in zip(extreme[::2], extreme[1::2], strict=True)]
        assert min(more) > 10.0
    assert {path.name for path in tmp_path.glob("*.png")} == {"Q.png", "Y.png", "spectrum.png"}
    again = run("05_savast.py", tmp_path)
    assert "%" not in again  # no progress
    assert again.endswith(text[text.index("smallest") :])


@pytest.mark.slow
def test_wheel_life(tmp_path: Path) -> None:
    """On straight track alone the running circle loses some um per 1000 km (Table 1-8: 9 on the line).

    The flange touches nothing there. Called again for more kilometres, the first one is not made again.
    """
    text = run("06_wheel_life.py", tmp_path, 1, 1)
    (circle,) = re.findall(r"^WP4_like, circle: ([\d.]+) um per 1000 km$", text, re.MULTILINE)
    assert 3.0 < float(circle) < 30.0
    assert "WP4_like, flange: 0.0 um" in text
    assert {"profiles.png", "measures.png", "steps"} <= {path.name for path in tmp_path.iterdir()}
    again = run("06_wheel_life.py", tmp_path, 2, 1)
    assert re.findall(r"^(.*), circle", again, re.MULTILINE) == ["WP4_like after 2.000 km, Euler"]


@pytest.mark.slow
def test_curving(tmp_path: Path) -> None:
    """Tighter curves: the leading wheelset is turned outwards more, and lies further out."""
    text = run("08_curving.py", tmp_path, "iore_wagon_loaded", "400", "1500")
    rows = re.findall(r"wheelset 1 of unit 1: attack (\S+) mrad, position (\S+) mm", text)
    (tight_attack, tight_position), (wide_attack, wide_position) = [tuple(map(float, row)) for row in rows]
    assert tight_attack < wide_attack - 0.3  # left-hand curves: outwards is negative
    assert tight_position < wide_position - 0.5 < -1.0
    assert {path.name for path in tmp_path.iterdir()} == {"R400", "R1500", "curving.png"}


def test_y25_wagon(tmp_path: Path) -> None:
    """Python and file give one wagon; in the left-hand curve the right wheels carry more, and the leading
    wheelset of each bogie is turned towards the outer rail, the trailing one less."""
    text = run("07_y25_wagon.py", tmp_path)
    assert "the same from its file: True" in text
    rows = re.findall(r"wheelset \d: Q ([\d.]+) / ([\d.]+) kN, angle of attack (-?[\d.]+) mrad", text)
    loads = [(float(left), float(right)) for left, right, _ in rows]
    assert len(loads) == 4
    assert sum(map(sum, loads)) == pytest.approx(90.0 * 9.81, rel=0.02)  # the cant adds some 0.3 %
    assert all(right > left for left, right in loads)
    attack = [float(angle) for *_, angle in rows]
    for leading, trailing in ((0, 1), (2, 3)):
        assert attack[leading] < min(attack[trailing] - 1.0, 0.0)
    # bowl and side bearers rub: they hold the leading bogie outwards, the trailing one inwards
    assert attack[0] < attack[2] - 1.0
    assert {path.name for path in tmp_path.iterdir()} == {"run", "wagon.png", "y25.toml"}


def test_locomotive(tmp_path: Path) -> None:
    """Slip control keeps the wheelsets at the adhesion there is; without it they race at the same pull."""
    text = run("09_locomotive.py", tmp_path)
    assert text.startswith("two units hold 60 km/h up to 6.4 per mille; on 10: 41.7 km/h")
    found = re.findall(
        r"^slip control (on|off): largest slip +([\d.]+) %, last pull (\d+) kN$", text, re.MULTILINE
    )
    slips = {which: float(slip) for which, slip, _ in found}
    assert slips["on"] < 5.0
    assert slips["off"] > 50.0
    assert sorted(path.name for path in tmp_path.glob("*.png")) == ["efforts.png", "off.png", "on.png"]


def test_friction_loops(tmp_path: Path) -> None:
    """Every element of the bogie takes energy out of its cycle, as much as its loop encloses."""
    picture = tmp_path / "loops.png"
    text = run("10_friction_loops.py", picture)
    found = re.findall(
        r"^(\S.*\S) +(-?[\d.]+) J around the loop, +(-?[\d.]+) J dissipated$", text, re.MULTILINE
    )
    loops = {title: (float(area), float(dissipated)) for title, area, dissipated in found}
    assert len(loops) == len(text.splitlines()) == 10
    for area, dissipated in loops.values():
        assert area > 1.0
        assert area == pytest.approx(dissipated, rel=0.01, abs=0.1)
    assert loops["springs and wedges of a side"][0] == pytest.approx(
        2 * loops["wedge, vertical"][0], rel=0.02
    )
    assert picture.stat().st_size > 10_000


@pytest.mark.slow
def test_locomotive_in_curves(tmp_path: Path) -> None:
    """Softer axle boxes let the leading wheelset turn into the curve, actuators turn it all the way."""
    text = run("11_locomotive_in_curves.py", tmp_path, "450")
    found = {
        name: (float(attack), float(wear))
        for name, attack, wear in re.findall(
            r"^450 m (\w+): attack +([-\d.]+) mrad, wear (\d+) N", text, re.MULTILINE
        )
    }
    assert abs(found["stiff"][0]) > 1.2 * abs(found["soft"][0]) > 5 * abs(found["active"][0])
    assert found["stiff"][1] > 1.2 * found["soft"][1] > 5 * found["active"][1]
    assert [path.name for path in tmp_path.glob("*.png")] == ["curving.png"]


def test_hydraulic_damper(tmp_path: Path) -> None:
    """Its force stays under that of blow-off, which the track reaches nearly."""
    text = run("12_hydraulic_damper.py", tmp_path)
    found = re.match(r"damper 1L: up to ([\d.]+) kN", text)
    assert found is not None, text
    assert 4.0 < float(found[1]) < 8.0
    assert (tmp_path / "damper.png").stat().st_size > 10_000


@pytest.mark.slow
def test_flexible_car_body(tmp_path: Path) -> None:
    """The first bending frequency appears where the formula of the beam has it."""
    text = run("13_flexible_car_body.py", tmp_path)
    found = re.match(r"bending of the car body: ([\d.]+) Hz", text)
    assert found is not None, text
    assert float(found[1]) == pytest.approx(9.0, rel=0.02)


@pytest.mark.slow
def test_when_to_turn(tmp_path: Path) -> None:
    """Cracks come first; early turnings waste the metal below each crack; a plan has its quantiles."""
    text = run("15_when_to_turn.py", tmp_path)
    reached = re.findall(r"^(\w+) reaches [\d.]+ mm after (\d+) km$", text, re.MULTILINE)
    assert reached[0][0] == "crack_depth"
    late, early = map(int, re.findall(r"end after (\d+) km", text))
    assert 400_000 < early < late < 600_000
    quantiles = [int(km) for km in re.findall(r"% by (\d+) km", text)]
    assert quantiles == sorted(quantiles)
    assert quantiles[0] < int(reached[0][1]) < quantiles[-1]
    assert (tmp_path / "life.parquet").exists()
    assert (tmp_path / "lives.png").stat().st_size > 10_000


def test_wheel_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without Optuna the example says so; with it a minimum that is known is found beside the base's."""
    without = tmp_path / "without"
    without.mkdir()
    (without / "optuna.py").write_text("raise ImportError")
    with monkeypatch.context() as patch:
        patch.setenv(
            "PYTHONPATH", os.pathsep.join([str(without), *filter(None, [os.environ.get("PYTHONPATH")])])
        )
        said = run("16_wheel_profile.py", tmp_path / "campaign.toml", tmp_path, "2")
    assert said == "this example needs Optuna, which is not installed: pip install 'hh-exudyn[studies]'\n"
    pytest.importorskip("optuna", reason="the extra studies is not installed")
    spec = importlib.util.spec_from_file_location("wheel_profile", EXAMPLES / "16_wheel_profile.py")
    assert spec is not None
    assert spec.loader is not None
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    base = example.changed(0.0, 0.0)
    assert np.abs(base.z - wheel_profile("WP4_like").z).max() < 1e-12

    def of(parameters: Mapping[str, Profile]) -> Objective:
        """Least wear with 0.2 mm more in the root, least fatigue with a flatter tread."""
        lift = parameters["case.wheel_profile"].z - base.z
        root, cone = np.interp([30e-3, -50e-3], base.y, lift) * [-1e3, 1.0 / 50e-3]
        return Objective((root - 0.2) ** 2, (cone + 0.005) ** 2, 0.0, 0.0)

    study = example.search(of, 30)
    first, wear = study.trials[0], min(study.best_trials, key=lambda trial: trial.values[0])
    assert first.params == {"cone": 0.0, "root_mm": 0.0}
    assert wear.values[0] < 0.1 * first.values[0]
    assert abs(wear.params["root_mm"] - 0.2) < 0.1


def test_every_example_is_run_here() -> None:
    source = Path(__file__).read_text()
    for path in EXAMPLES.glob("*.py"):
        assert f'run("{path.name}"' in source


def test_a_variant_from_a_file() -> None:
    """Stiffer pads, another wheelbase, other wedges, and nothing else."""
    variant = find_variant(EXAMPLES / "14_stiffer_wagon.toml")
    changed = {one.name for one in variant.differences()}
    assert changed == {
        "axle_box_pad.longitudinal_stiffness", "axle_box_pad.lateral_stiffness", "wheelset.wheelbase",
        "wedge.friction", "wedge.preload",
    }  # fmt: skip
    wagon = variant.vehicle()
    places = [wagon.body(wheelset.body).position[0] for wheelset in wagon.wheelsets]
    assert places[0] - places[1] == pytest.approx(1.83)
