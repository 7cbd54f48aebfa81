"""The life of an ore wagon's wheel on the iron-ore line: where it wears, and its profile over the distance.

    python examples/06_wheel_life.py [FOLDER] [KM] [SECTIONS]

Each step runs the wagon, loaded and empty, over the SECTIONS (8) heaviest kinds of track, wears the
wheel by the weighted mean of all wheels (naturally lubricated, root and flange greased) and goes on with the
worn profile until KM (10). The same FOLDER is continued. Right-hand curves count as the
mirror image of left-hand ones; friction, irregularity and where there is grease are assumed.
"""

import operator
import sys
import tempfile
from functools import reduce
from pathlib import Path

import numpy as np
import pyarrow.compute as pc

from damage.evolution.loop import StepControl, evolve
from damage.evolution.profile_wear import ProfileWear, mean_wear
from damage.figures.evolution import measures_figure, profiles_figure
from damage.report import assess
from hh_exudyn.case import Case, StraightCase, TrackCase
from hh_exudyn.case_line import case_on, section_name
from hh_exudyn.contact.profile import Profile, wheel_profile
from hh_exudyn.contact.profile_writer import write_profile
from hh_exudyn.log.store import open_run
from hh_exudyn.multibody.simulate import simulate
from track.line import load_sections, read_line

FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="wheel-life-"))
SECTIONS = int(sys.argv[3]) if len(sys.argv) > 3 else 8
TRACK = TrackCase(sections=(StraightCase(length_m=150, gauge_mm=1437),), irregularity="erri_low")
GREASED = 0.020  # m on the profile, from where on towards the flange the wear coefficient is 1/100, else 1/6


def wear_of(wheel: Profile) -> ProfileWear:
    folder, parts = FOLDER / wheel.name.replace(" ", "_"), []
    folder.mkdir(parents=True, exist_ok=True)
    write_profile(wheel, folder / "wheel.txt")
    for vehicle in ("iore_wagon_loaded", "iore_wagon_empty"):
        base = Case(name=vehicle, vehicle=vehicle, speed_km_h=60, friction=0.35, track=TRACK)
        base = base.with_changes(wheel_profile=str(folder / "wheel.txt"))
        kinds = [
            s for s in load_sections(read_line("malmbanan"), vehicle, quality="QN1") if s.hand != "right"
        ]
        share = {kind: kind.weight * (1 if kind.hand == "straight" else 2) for kind in kinds}
        for section in sorted(kinds, key=lambda kind: -share[kind])[:SECTIONS]:
            run = folder / vehicle / section_name(section)
            if not (run.is_dir() and open_run(run).status["finished"]):
                simulate(case_on(base, section, length=150.0, approach=30.0), run)
            log = open_run(run).contact()
            log = log.filter(pc.greater(log["time"], pc.max(log["time"]).as_py() - 80.0 / section.speed))
            surface = assess(log, cells=(32, 16), profile=wheel).surface
            parts.append(share[section] * surface.scaled(1.0))
    dry = mean_wear(reduce(operator.add, parts))
    return ProfileWear(dry.y, dry.depth_per_km / np.where(dry.y > GREASED, 100.0, 6.0))


def main() -> None:
    wheel, start = wheel_profile("WP4_like"), FOLDER / "steps"
    history = evolve(
        wheel, 0.4575, wear_of, 1e3 * float(sys.argv[2] if len(sys.argv) > 2 else 10.0), start,
        StepControl(max_distance=10e6), progress=lambda done, text: print(f"{done:4.0%} {text}"),
    )  # fmt: skip
    wear = wear_of(wheel)  # from the runs that are there now
    for name, low, high in (("running circle", -5e-3, 5e-3), ("tread", -0.04, 0.02), ("flange", 0.02, 0.06)):
        depth = wear.depth_per_km[(wear.y >= low) & (wear.y <= high)] * 1e9
        print(f"new wheel, {name}: mean {depth.mean():.1f}, largest {depth.max():.1f} um per 1000 km")
    for row in history.to_table().to_pylist():
        print("  ".join(f"{key} {value:.2f}" for key, value in row.items()))
    profiles_figure(history).savefig(FOLDER / "profiles.png", dpi=150)
    measures_figure(history).savefig(FOLDER / "measures.png", dpi=150)


if __name__ == "__main__":
    main()
