"""From a run to the damage of its wheels, one row per wheel: `assess`."""

import math
import time
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import pyarrow
from numpy.typing import NDArray

from damage.log_input.bad_rows import BadRows
from damage.log_input.contact_source import ContactSource, run_of
from damage.material import ER7, WheelMaterial
from damage.model import DamageModel
from damage.patch_strips import FLANGE, TREAD
from damage.rails.model import RailModel
from damage.rails.pieces import RailPair
from damage.rcf.burstow import Burstow
from damage.rcf.surface_index import FLANGE_CONTACT_ANGLE
from damage.surface.accumulate import Progress, accumulate_both
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.normal_contact import chosen_contact
from damage.surface.wheel_surface import DEFAULT_PATCH_GRID, WheelSurface
from damage.wear.archard import archard
from damage.wear.films import WearFilms
from damage.wear.law import WearLaw
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.types import WheelRailModel
from hh_exudyn.log.ending import require_finished

DRY_ARCHARD = archard()


NOT_EXTRAPOLATED = "not to be extrapolated"
"""Mark of flange wear under seizure: an unworn flange is worn in first, in some 1000 km, and nobody goes on
with the rate of its first ones."""


def _of_parts(surface: WheelSurface, burstow: bool) -> dict[str, NDArray[np.float64]]:
    """The largest RCF numbers and crack damage of every wheel, (W,): on the tread, on the flange."""
    table = {}
    for part, prefix in ((TREAD, ""), (FLANGE, "flange_")):
        table[f"{prefix}rcf_number"] = surface.rcf_number[:, part].max(axis=(1, 2))
        if burstow:
            table[f"{prefix}corrected_rcf_number"] = surface.corrected_rcf_number[:, part].max(axis=(1, 2))
        table[f"{prefix}crack_damage"] = surface.crack_damage[:, part].max(axis=1)
        table[f"{prefix}global_crack_damage"] = surface.global_crack_damage[:, part].max(axis=1)
    return table


@dataclass(frozen=True)
class DamageReport:
    """Damage of the wheels of a run, with the settings of its computation.

    Attributes
    ----------
    surface
        Sums over the contact states on the wheel profiles.
    model
        Steel, wear law, theory, grids and thresholds.
    bad_rows
        Rows of the log that were skipped.
    seconds_per_state
        Wall time per contact state [s], of this machine.
    ending
        "finished", or why the run ended early; empty for a log without a run.
    rails
        Left and right rail of each stretch that the model names, as summed; `damage.rails.report` goes on.
    """

    surface: WheelSurface
    model: DamageModel
    bad_rows: BadRows
    seconds_per_state: float
    ending: str = ""
    rails: tuple[RailPair, ...] = ()

    @property
    def normal_contact(self) -> str:
        """The normal contact that was used, one of `damage.surface.normal_contact.NORMAL_CONTACTS`."""
        return self.model.normal

    @property
    def seized(self) -> NDArray[np.bool_]:
        """(W,) whether flange contact was beyond the pressure of seizure, 0.8 of the hardness."""
        seized: NDArray[np.bool_] = self.surface.pressure_by_part[:, FLANGE] > self.model.seizure_pressure
        return seized

    def _flange_notes(self) -> NDArray[np.generic]:
        """(W,) the mark of flange wear that is not to be extrapolated, empty where it may be."""
        return np.where(self.seized, NOT_EXTRAPOLATED, "")

    @property
    def wear_surfaces(self) -> tuple[str, ...]:
        """Of every wheel, the surface that its wear coefficients are for: "dry", or the films by zone."""
        films = self.model.films
        if films is None or not self.model.law.with_films:
            return (self.model.law.surface,) * len(self.surface.wheels)
        return tuple(films.named(wheel.vehicle, wheel.wheelset, wheel.side) for wheel in self.surface.wheels)

    def _settings(self) -> dict[str, NDArray[np.generic]]:
        """Columns of every table, (W,): end of the run, and surface of the wear coefficients."""
        return {
            "run": np.full(len(self.surface.wheels), self.ending),
            "wear_surface": np.array(self.wear_surfaces, dtype=np.str_),
        }

    def to_table(self) -> pyarrow.Table:
        """One row per wheel, with units in the names of the columns.

        Wear depth and fatigue without "flange" in the name are of the tread. ``wear_y_mm`` is the place of
        the tread's deepest wear on the profile (lateral coordinate, positive towards the flange).
        ``run`` is the end of the run, ``wear_surface`` what the wear coefficients are for: dry, or by zone
        the films of the case. ``flange_wear_note`` marks flange wear under seizure: unworn profiles wear in
        first.
        ``wear_<regime>_share`` is the part of the worn volume in each regime of the wear law; of Archard's,
        "seizure" has the least certain coefficients. The RCF numbers are the largest of all places of patch
        and profile (the corrected one is missing without Burstow's thresholds), and the crack damage is the
        largest Miner's sum of all bins, by the local and (global) by the patch's index.
        """
        surface = self.surface
        wheels = np.array(surface.wheels, dtype=np.int32).reshape(-1, 4)
        depth = surface.depth_by_part[:, TREAD] / surface.distance
        flange_depth = surface.depth_by_part[:, FLANGE] / surface.distance
        volume = surface.worn_volume.sum(axis=1)
        table: dict[str, NDArray[np.generic]] = {
            "vehicle": wheels[:, 0],
            "bogie": wheels[:, 1],
            "wheelset": wheels[:, 2],
            "side": wheels[:, 3],
            "law": np.full(len(wheels), self.model.law.name),
            "steel": np.full(len(wheels), self.model.material.name),
            "normal_contact": np.full(len(wheels), self.normal_contact),
            "p_max_MPa": surface.max_pressure * 1e-6,
            "wear_number_N": surface.mean_wear_number,
            "fatigue_share": surface.fatigue_share[:, TREAD],
            "fatigue_area_index": surface.fatigue_area_index[:, TREAD],
            "flange_fatigue_share": surface.fatigue_share[:, FLANGE],
            "flange_share": surface.flange_share,
            "wear_depth_mm_per_1000_km": depth.max(axis=1) * 1e9,
            "flange_wear_depth_mm_per_1000_km": flange_depth.max(axis=1) * 1e9,
            "flange_wear_note": self._flange_notes(),
            "wear_y_mm": surface.grid.lateral[depth.argmax(axis=1)] * 1e3,
            "worn_area_mm2_per_km": surface.worn_area_per_km * 1e6,
        }
        for name, values in _of_parts(surface, self.model.burstow is not None).items():
            table[f"{name}_per_km"] = values * 1e3 / surface.distance
        for column, regime in enumerate(self.model.law.regimes):
            name = f"wear_{'_'.join(regime.replace(',', '').split())}_share"
            worn = surface.worn_volume[:, column]
            table[name] = np.divide(worn, volume, out=np.zeros_like(volume), where=volume > 0.0)
        return pyarrow.table(table | self._settings())

    def distance_table(self, distance: float) -> pyarrow.Table:
        """Damage after a distance of the same rolling, one row per wheel.

        Parameters
        ----------
        distance
            Distance rolled [m], > 0.

        Raises
        ------
        ValueError
            The distance is not finite and above zero.
        """
        if not 0.0 < distance < math.inf:
            raise ValueError(f"distance = {distance} m must be finite and > 0 m")
        surface = self.surface.scaled(distance)
        wheels = np.array(surface.wheels, dtype=np.int32).reshape(-1, 4)
        table: dict[str, NDArray[np.generic]] = {
            "vehicle": wheels[:, 0],
            "wheelset": wheels[:, 2],
            "side": wheels[:, 3],
            "law": np.full(len(wheels), self.model.law.name),
            "steel": np.full(len(wheels), self.model.material.name),
            "distance_km": np.full(len(wheels), distance * 1e-3),
            "wear_depth_mm": surface.depth_by_part[:, TREAD].max(axis=1) * 1e3,
            "flange_wear_depth_mm": surface.depth_by_part[:, FLANGE].max(axis=1) * 1e3,
            "flange_wear_note": self._flange_notes(),
            "worn_area_mm2": surface.worn_area.sum(axis=1) * 1e6,
        }
        parts = _of_parts(surface, self.model.burstow is not None)
        return pyarrow.table(table | parts | self._settings())


def assess(
    source: ContactSource,
    material: WheelMaterial = ER7,
    theory: str | None = None,
    cells: tuple[int, int] = (50, 50),
    law: WearLaw = DRY_ARCHARD,
    flange_angle: float = FLANGE_CONTACT_ANGLE,
    grid: LateralGrid | None = None,
    patch_grid: PatchGrid = DEFAULT_PATCH_GRID,
    profile: Profile | None = None,
    burstow: Burstow | None = None,
    skip_bad_rows: bool = False,
    threads: int | None = None,
    contact: WheelRailModel | None = None,
    normal: str | None = None,
    pressure_limit: float = math.inf,
    progress: Progress | None = None,
    films: WearFilms | None = None,
    unfinished: bool = False,
    wheels: Iterable[tuple[int, int, int]] | None = None,
    rails: RailModel | None = None,
) -> DamageReport:
    """Wear and rolling contact fatigue of all wheels of a run, and of its rails where they are asked for.

    Every contact state is solved again on a fine grid for its stresses and slip: by the strips of the run
    where its contact is given and was that of coupled strips, else by the equivalent ellipse of the log.

    Twenty arguments: settings of `damage.model.DamageModel` from `material` on, each with a default, so
    that a call names only those that differ.

    Parameters
    ----------
    source
        A run, its directory, Parquet files, a table, or arrays:
        `damage.log_input.contact_source.ContactSource`.
    material
        The wheel steel.
    theory
        Tangential theory, one of `damage.surface.patch_field.DAMAGE_THEORIES`; None takes FaStrip, and the
        half-space's own where `normal` is "halfspace".
    cells
        Cells of a patch along and across [-].
    law
        The wear law, see `damage.wear.laws.wear_law`; Archard's without a hardness takes the material's.
    flange_angle
        Contact angle above which a contact counts as flange contact [rad], 0 to pi/2.
    grid
        Bins across the wheel profile; None takes bins of 1 mm along the arc of `profile`, or over the lateral
        coordinate where there is none.
    patch_grid
        Bins along the patch.
    profile
        The wheel profile, the same for all wheels that are assessed.
    burstow
        Thresholds of Burstow's correction; None takes those of the material, or no correction where the
        material lacks its yield strength or its tensile strength.
    skip_bad_rows
        Impossible rows (NaN, values out of range, forces above friction) are skipped and counted; otherwise
        they raise.
    threads
        Number of threads; None takes the processors that this process may use. It has no influence on the
        result.
    contact
        Profiles and theory of the run: ``case.contact_model()``. A log alone has ellipses.
    normal
        Normal contact, one of `damage.surface.normal_contact.NORMAL_CONTACTS`; None: see
        `damage.surface.normal_contact.chosen_contact`.
    pressure_limit
        Upper bound of the pressure of the half-space [Pa]: area grows, force is kept.
    progress
        Called with the number of rows that have been summed.
    films
        Lubricant of the run, for a law with dry coefficients that knows those of lubricated surfaces.
    unfinished
        Whether a run that ended early is taken.
    wheels
        Vehicle, wheelset and side (+1 left, -1 right) of the wheels that are assessed; None for all. Wheels
        of other profiles need reports of their own.
    rails
        Stretches of track whose rails are summed too, in the same pass; None for none.

    Raises
    ------
    FileNotFoundError
        There is no such run or file.
    ValueError
        Unknown theory or normal contact, a choice that does not go together, missing columns, bad rows,
        patches beyond the grid, both a grid and a profile, a rail's profile, a run that does not move, or
        one that ended early.
    """
    end = ""
    if (run := run_of(source)) is not None:
        end = require_finished(run, unfinished)
    if grid is not None and profile is not None:
        raise ValueError(
            "both a grid and a profile were given; LateralGrid.along(profile) is the grid of one"
        )
    if profile is not None and profile.kind != "wheel":
        raise ValueError(f"profile {profile.name!r} is a {profile.kind}'s; damage needs a wheel's")
    if grid is None:
        grid = LateralGrid() if profile is None else LateralGrid.along(profile)
    if burstow is None and material.yield_strength and material.tensile_strength:
        burstow = Burstow.of(material)
    normal, theory = chosen_contact(normal, theory, contact)
    model = DamageModel(
        material, law, theory, normal, contact, pressure_limit, cells, flange_angle, grid, patch_grid,
        burstow, films, None if wheels is None else frozenset(wheels), rails,
    )  # fmt: skip
    bad_rows = BadRows()
    start = time.perf_counter()
    skipped = bad_rows if skip_bad_rows else None
    sums = accumulate_both(source, model, threads=threads, bad_rows=skipped, progress=progress)
    surface = sums.wheels
    wall = time.perf_counter() - start
    if surface.rows == 0:
        raise ValueError(f"the contact log has no good rows: {bad_rows}")
    if surface.distance <= 0.0:
        raise ValueError("the run does not move: wear per distance has no meaning")
    return DamageReport(surface, model, bad_rows, wall / surface.rows, end, sums.rails)
