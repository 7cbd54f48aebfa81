"""From a run on disk to wear and fatigue of its wheels: a table of the worst, and figures.

    hh-exudyn demo --out demo
    python examples/03_damage_of_a_run.py demo [FOLDER FOR FIGURES]

Damage reads the contact log and the profiles of the case: another steel or another wear map needs no new
simulation, nor does the exact half-space (``normal="halfspace"``).
"""

import sys
from pathlib import Path

from damage.figures.profile_panels import fatigue_figure, wear_figure
from damage.figures.working_points import shakedown_figure
from damage.material import ER7, ER9
from damage.report import assess
from hh_exudyn.case import read_case
from hh_exudyn.log.store import open_run


def main() -> None:
    run = open_run(sys.argv[1])
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else ".")
    case = read_case(run.directory / "case.toml")
    wheel, contact = case.wheel, case.contact_model()  # strips of the run are rebuilt from them

    for steel in (ER7, ER9):
        report = assess(run, material=steel, profile=wheel, contact=contact)
        wheels = report.to_table().to_pylist()
        worst = max(wheels, key=lambda row: row["fatigue_share"])
        share = worst["fatigue_share"]
        print(f"{steel.name}: most fatigue at wheelset {worst['wheelset']}, {share:.0%} of the way")

    report = assess(run, profile=wheel, contact=contact)
    figures = {
        "wear.png": wear_figure(report, wheel),
        "fatigue.png": fatigue_figure(report, wheel),
        "shakedown.png": shakedown_figure(run),
    }
    for name, figure in figures.items():
        figure.savefig(folder / name, dpi=150)
        print(folder / name)


if __name__ == "__main__":
    main()
