"""A loaded ore wagon through a curve of 450 m, with dry and with damp rails: who carries what.

    python examples/02_two_frictions.py [FOLDER]

A case is a value: the second one is a changed copy. Each run is a folder of logs, which everything else is
computed from. For the whole programme, with recording and damage: ``hh-exudyn demo --out DIR``.
"""

import sys
import tempfile
from pathlib import Path

from damage.summary import wheelset_summary
from hh_exudyn.case import Case, CurveCase, StraightCase, TrackCase, TransitionCase
from hh_exudyn.multibody.simulate import simulate

TRACK = TrackCase(
    sections=(
        StraightCase(length_m=20, gauge_mm=1445),
        TransitionCase(length_m=30),
        CurveCase(length_m=40, radius_m=450, hand="left", cant_mm=65, gauge_mm=1445),
    )
)
CURVE = (70.0, 90.0)  # m, where the wagon has settled in it


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="two-frictions-"))
    dry = Case(name="dry", speed_km_h=60, friction=0.45, track=TRACK)
    for case in (dry, dry.with_changes(name="damp", friction=0.20)):
        run = simulate(case, folder / case.name)
        print(f"\n{case.name}, friction {case.friction}: {run.directory}")
        for row in wheelset_summary(run, CURVE):
            print(
                f"  wheelset {row.wheelset}: Q {row.Q[0] / 1e3:5.1f} / {row.Q[1] / 1e3:5.1f} kN, "
                f"Y {row.Y[0] / 1e3:5.1f} / {row.Y[1] / 1e3:5.1f} kN, "
                f"angle of attack {row.angle_of_attack * 1e3:5.2f} mrad, "
                f"wear number {row.wear_number[0]:4.0f} / {row.wear_number[1]:4.0f} N"
            )


if __name__ == "__main__":
    main()
