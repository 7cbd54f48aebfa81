"""From a run to the damage of its wheels, one row per wheel: `assess`."""

import math
import time
from dataclasses import dataclass

import numpy as np
import pyarrow

from damage.accumulate import accumulate
from damage.contact_states import ContactSource
from damage.material import ER7, WheelMaterial
from damage.rcf import FLANGE_ANGLE
from damage.wear.jendel import JENDEL_REGIMES, JendelMap
from damage.wheel_surface import FLANGE, TREAD, LateralGrid, WheelSurface

DEFAULT_GRID = LateralGrid()
DRY = JendelMap()


@dataclass(frozen=True)
class DamageReport:
    """Damage of the wheels of a run, and what it was computed with.

    Attributes
    ----------
    surface
        Sums over the contact states on the wheel profiles.
    material
        The wheel steel.
    wear_map
        The wear coefficients.
    theory
        Name of the tangential theory that the patches were solved with.
    cells
        Cells of a patch along and across.
    flange_angle
        Contact angle above which a contact counts as flange contact [rad].
    seconds_per_state
        Wall time per contact state [s], of this machine.
    """

    surface: WheelSurface
    material: WheelMaterial
    wear_map: JendelMap
    theory: str
    cells: tuple[int, int]
    flange_angle: float
    seconds_per_state: float

    def to_table(self) -> pyarrow.Table:
        """One row per wheel, for people: units are in the names of the columns.

        ``fatigue_share`` and ``fatigue_area_index`` are of the tread; ``flange_fatigue_share`` is the share
        of the flange contacts alone. ``wear_y_mm`` is where on the profile the wear is deepest (positive
        towards the flange). ``seizure_share`` is the part of the worn volume from pressures above the
        seizure limit of the wear map, whose coefficients are the least certain.
        """
        surface = self.surface
        wheels = np.array(surface.wheels, dtype=np.int32).reshape(-1, 4)
        depth = surface.depth_per_km
        volume = surface.worn_volume.sum(axis=1)
        seizure = surface.worn_volume[:, JENDEL_REGIMES.index("seizure")]
        return pyarrow.table(
            {
                "vehicle": wheels[:, 0],
                "bogie": wheels[:, 1],
                "wheelset": wheels[:, 2],
                "side": wheels[:, 3],
                "p_max_MPa": surface.max_pressure * 1e-6,
                "wear_number_N": surface.mean_wear_number,
                "fatigue_share": surface.fatigue_share[:, TREAD],
                "fatigue_area_index": surface.fatigue_area_index[:, TREAD],
                "flange_fatigue_share": surface.fatigue_share[:, FLANGE],
                "wear_depth_mm_per_1000_km": depth.max(axis=1) * 1e6,
                "wear_y_mm": surface.grid.centres[depth.argmax(axis=1)] * 1e3,
                "worn_area_mm2_per_km": surface.worn_area_per_km * 1e6,
                "seizure_share": np.divide(seizure, volume, out=np.zeros_like(volume), where=volume > 0.0),
                "flange_share": surface.flange_share,
            }
        )


def assess(
    run_or_table: ContactSource,
    material: WheelMaterial = ER7,
    theory: str = "fastrip",
    cells: tuple[int, int] = (50, 50),
    wear_map: JendelMap = DRY,
    flange_angle: float = FLANGE_ANGLE,
    grid: LateralGrid = DEFAULT_GRID,
    threads: int | None = None,
) -> DamageReport:
    """Wear and rolling contact fatigue of all wheels of a run.

    Every contact state is solved again on a fine grid for its pressure and slip field.

    Parameters
    ----------
    run_or_table
        A run, its directory, or its contact log as a table.
    material
        The wheel steel.
    theory
        Tangential theory, one of `hh_exudyn.contact.theories.FIELD_THEORIES`.
    cells
        Cells of a patch along and across [-].
    wear_map
        The wear coefficients.
    flange_angle
        Contact angle above which a contact counts as flange contact [rad], 0 to pi/2.
    grid
        Bins over the wheel profile.
    threads
        States that are solved at once; None takes the processors that this process may use. It has no
        influence on the result.

    Raises
    ------
    ValueError
        Unknown theory, bad values in the log, patches beyond the grid, or a run that does not move.
    """
    if not 0.0 < flange_angle < 0.5 * math.pi:
        raise ValueError(f"flange_angle = {flange_angle} rad must lie within 0..pi/2 rad")
    start = time.perf_counter()
    surface = accumulate(run_or_table, material, theory, cells, wear_map, flange_angle, grid, threads=threads)
    wall = time.perf_counter() - start
    if surface.distance <= 0.0:
        raise ValueError("the run does not move: wear per distance has no meaning")
    return DamageReport(surface, material, wear_map, theory, cells, flange_angle, wall / surface.rows)
