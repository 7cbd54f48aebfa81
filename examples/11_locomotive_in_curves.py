"""The leading wheelset of a locomotive in curves: stiff, soft and actively steered axle boxes.

    python examples/11_locomotive_in_curves.py FOLDER [RADIUS ...]

At 60 km/h on flexible track with the cant that balances this, at most 150 mm.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow

from hh_exudyn.case import Case, CurveCase, StraightCase, TrackCase, TransitionCase
from hh_exudyn.case.traction import SteeringCase
from hh_exudyn.figures.traction import bogie_curving_figure
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle

SOFT = vehicle("iore_locomotive")  # 12 MN/m along the track in every axle box
BOXES = {c.name for c in SOFT.couplings if c.name.startswith("primary")}
STIFF = replace(SOFT, couplings=tuple(
    replace(c, stiffness=(40e6, *c.stiffness[1:])) if c.name in BOXES else c for c in SOFT.couplings
))  # fmt: skip
VARIANTS = {"stiff": (STIFF, None), "soft": (SOFT, None), "active": (SOFT, SteeringCase(gain=1.0))}
ENTRY = StraightCase(length_m=30, gauge_mm=1440), TransitionCase(length_m=60)
LABELS = ("attack [mrad]", "y [mm]", "Q outer [kN]", "Y outer [kN]", "wear number outer [N]")


def leading_outer_wheel(log: pyarrow.Table) -> list[float]:
    """Means over the last second, as `LABELS`, in a left-hand curve."""
    c = {name: log[name].to_numpy() for name in log.column_names}
    rows = (c["time"] > c["time"].max() - 1.0) & (c["wheelset"] == 1) & (c["side"] == -1)
    first = rows & (c["patch"] == 0)
    lost = np.abs(c["force_x"] * c["nu_x"] + c["force_y"] * c["nu_y"] + c["moment_z"] * c["phi"])
    scaled = (("angle_of_attack", 1e3), ("y_wheelset", 1e3), ("Q", 1e-3), ("Y", 1e-3))
    return [scale * c[name][first].mean() for name, scale in scaled] + [lost[rows].sum() / first.sum()]


def main() -> None:
    folder, radii = Path(sys.argv[1]), np.array(sys.argv[2:] or [250, 300, 400, 600, 1e3, 2e3], dtype=float)
    found = {name: np.zeros((len(radii), len(LABELS))) for name in VARIANTS}
    for i, radius in enumerate(radii):
        cant = min(150.0, 11.8 * 60**2 / radius)  # balanced
        curve = CurveCase(length_m=70, radius_m=radius, hand="left", cant_mm=cant, gauge_mm=1440)
        track = TrackCase(sections=(*ENTRY, curve))
        for name, (unit, steering) in VARIANTS.items():
            case = Case(name=name, vehicle=SOFT.name, speed_km_h=60, friction=0.4, track=track)
            case = case.with_changes(steering=steering)
            run = simulate(case, folder / f"{name}_{radius:g}", vehicle=unit)
            found[name][i] = leading_outer_wheel(run.contact())
            print(f"{radius:g} m {name}: attack {found[name][i, 0]:.2f} mrad, wear {found[name][i, 4]:.0f} N")
    panels = {label: {n: v[:, k : k + 1] for n, v in found.items()} for k, label in enumerate(LABELS)}
    bogie_curving_figure("leading outer wheel", radii, panels).savefig(folder / "curving.png")


if __name__ == "__main__":
    main()
