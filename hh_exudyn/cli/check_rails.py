"""What commands say about flange backs on check rails.

Large packages are imported inside the functions, so that ``--help`` is fast.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hh_exudyn.log.store import Run


def check_rail_rows(run: "Run") -> int:
    """Rows of a run's check-rail log; 0 of one without.

    Parameters
    ----------
    run
        The run.
    """
    try:
        return int(run.read("check_rail", ["time"]).num_rows)
    except FileNotFoundError:
        return 0


def largest_forces(run: "Run") -> str:
    """The largest normal force of every wheel that touched a check rail, in a line; empty where none did.

    Parameters
    ----------
    run
        The run.
    """
    import numpy as np

    if not check_rail_rows(run):
        return ""
    log = run.read("check_rail", ["vehicle", "wheelset", "side", "normal_force"])
    columns = [log[name].to_numpy() for name in log.column_names]
    wheels = np.column_stack(columns[:3])
    several = len(np.unique(wheels[:, 0])) > 1
    parts = []
    for vehicle, wheelset, side in sorted({tuple(row) for row in wheels.tolist()}, key=_place):
        mine = (wheels == (vehicle, wheelset, side)).all(axis=1)
        name = f"{f'{vehicle}.' if several else ''}{wheelset}{'L' if side > 0 else 'R'}"
        parts.append(f"{name} {columns[3][mine].max() * 1e-3:.1f}")
    return f"largest force of a check rail on the flange back [kN]: {', '.join(parts)}; it is in Q and Y"


def _place(wheel: tuple[int, int, int]) -> tuple[int, int, int]:
    """Order of the tables: vehicle, wheelset, left before right."""
    return wheel[0], wheel[1], -wheel[2]
