"""The life of an ore wagon's wheel on the iron-ore line: where it wears, and its profile over the distance.

    python examples/06_wheel_life.py FOLDER KM SECTIONS

Each step runs the wagon, loaded and empty, over the SECTIONS (try 8) heaviest kinds of track and wears the
wheel by the weighted mean of all wheels, until KM; called again it goes on. Curves are left-hand ones.
"""

import sys
from pathlib import Path

import numpy as np
import pyarrow.compute as pc

from damage.evolution.loop import evolve
from damage.evolution.profile_wear import ProfileWear, mean_wear
from damage.figures.evolution import measures_figure, profiles_figure
from damage.report import assess
from hh_exudyn.case import Case, StraightCase, TrackCase
from hh_exudyn.case.line import case_on, section_name
from hh_exudyn.contact.profile import Profile, wheel_profile
from hh_exudyn.contact.profiles.writer import write_profile
from hh_exudyn.log.store import open_run
from hh_exudyn.multibody.simulate import simulate
from track.line.line import load_sections, read_line

FOLDER, KM, SECTIONS = Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
TRACK = TrackCase(sections=(StraightCase(length_m=150, gauge_mm=1437),), irregularity="erri_low")
BASE = Case(name="life", speed_km_h=60, friction=0.35, track=TRACK)  # friction and irregularity: assumed


def wear_of(wheel: Profile) -> ProfileWear:
    parts, file = [], FOLDER / f"{wheel.name}.txt"
    write_profile(wheel, file)
    for vehicle in ("iore_wagon_loaded", "iore_wagon_empty"):
        case = BASE.with_changes(vehicle=vehicle, wheel_profile=str(file))
        line = load_sections(read_line("malmbanan"), vehicle, quality="QN1")
        share = {kind: kind.weight * (1 + (kind.hand == "left")) for kind in line if kind.hand != "right"}
        for kind in sorted(share, key=lambda kind: -share[kind])[:SECTIONS]:
            run = FOLDER / wheel.name / vehicle / section_name(kind)
            simulate(case_on(case, kind, length=150.0, approach=30.0), run, resume=True)
            log = open_run(run).contact()
            end = log.filter(pc.greater(log["time"], pc.max(log["time"]).as_py() - 80.0 / kind.speed))
            parts.append(share[kind] * assess(end, cells=(32, 16), profile=wheel).surface.scaled(1.0))
    dry = mean_wear(sum(parts))
    flange = np.clip((dry.y - 0.010) / 0.025, 0.0, 1.0)
    film = 6.0 * (100.0 / 6.0) ** flange  # divides the wear: lubricated tread, greased flange
    wear = ProfileWear(dry.y, dry.depth_per_km / film, dry.pressure)
    for place, low, high in (("circle", -0.005, 0.005), ("tread", -0.04, 0.02), ("flange", 0.02, 0.06)):
        print(f"{wheel.name}, {place}: {1e9 * wear.at(np.linspace(low, high, 99)).max():.1f} um per 1000 km")
    return wear


if __name__ == "__main__":
    history = evolve(wheel_profile("WP4_like"), 0.4575, wear_of, 1e3 * KM, FOLDER / "steps")
    print("\n".join(f"{name} {value:.3f}" for name, value in history.to_table().to_pylist()[-1].items()))
    for name, draw in (("profiles", profiles_figure), ("measures", measures_figure)):
        draw(history).savefig(FOLDER / f"{name}.png", dpi=150)
