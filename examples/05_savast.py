"""The measurement station at Sävast: ranges of Q and Y per wheel over speed, load and friction of a year.

    python examples/05_savast.py [FOLDER]

Some four minutes; runs that FOLDER (savast) holds already are not repeated. Writes Q.png and Y.png, like
Figures 1-20 and 1-21 of Hossein-Nia's thesis, and spectrum.png, there.
"""

import sys
from importlib.resources import files
from itertools import product
from pathlib import Path

import numpy as np

from hh_exudyn.case import read_case
from hh_exudyn.figures.wheel_forces import force_histograms, force_spectra
from hh_exudyn.log.wheel_forces import wheel_forces
from hh_exudyn.multibody.once import simulate_once
from track.support.sleepers import sleeper_track

SPEEDS = {"loaded": (50, 60), "empty": (60, 70)}  # km/h: the larger from the thesis, the lower assumed
FRICTIONS = (0.20, 0.35, 0.50)  # the thesis: 0.2 to 0.5
CUTOFF = 20.0  # Hz, as the thesis filters
CURVE = (150.0, 499.0)  # m: from 50 m behind the transition to where the irregularities fade out


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "savast")
    case = read_case(str(files("hh_exudyn") / "data" / "savast.toml"))
    found = {}
    for load, friction in product(SPEEDS, FRICTIONS):
        for speed in SPEEDS[load]:
            print(f"{load}, {speed} km/h, friction {friction:<40}")
            changes = {"vehicle": f"iore_wagon_{load}", "speed_km_h": float(speed), "friction": friction}
            run = simulate_once(case.with_changes(**changes), folder / f"{load}-{speed}-{friction}", show)
            found[load, speed, friction] = wheel_forces(run)

    for force in ("Q", "Y"):
        ranges = {}
        print(f"\nsmallest and largest {force} [kN] of wheel 1L, 1R, 2L, ... below {CUTOFF:g} Hz")
        for load in SPEEDS:
            mine = (one.filtered(CUTOFF).between(*CURVE) for key, one in found.items() if key[0] == load)
            ranges[load] = np.concatenate([getattr(one, force) for one in mine])
            for what, bound in (("from", ranges[load].min(axis=0)), ("to", ranges[load].max(axis=0))):
                print(f"{load:7} {what:4}", *(f"{1e-3 * value:7.1f}" for value in bound.ravel()))
        title = f"Sävast, below {CUTOFF:g} Hz"
        force_histograms(title, force, ranges).savefig(folder / f"{force}.png", dpi=150)
    spectra = {f"friction {mu}": found["loaded", 60, mu].between(*CURVE).spectrum("Q") for mu in FRICTIONS}
    marks = {"speed over sleeper spacing": 60 / 3.6 / sleeper_track(case.track.flexibility).sleeper_spacing}
    force_spectra("Sävast, loaded, 60 km/h", "Q", spectra, marks).savefig(folder / "spectrum.png", dpi=150)


def show(done: float, text: str) -> None:
    print(f"{done:4.0%} {text:50}", end="\r")


if __name__ == "__main__":
    main()
