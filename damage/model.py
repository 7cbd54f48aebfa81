"""Settings of a damage computation: steel, wear law, theory, grids and thresholds, in one value."""

import math
from dataclasses import dataclass, field

import numpy as np

from damage.material import ER7, WheelMaterial
from damage.rails.model import RailModel
from damage.rcf.burstow import Burstow, BurstowLimits
from damage.rcf.surface_index import FLANGE_CONTACT_ANGLE
from damage.surface.lateral_grid import LateralGrid, PatchGrid
from damage.surface.normal_contact import ELLIPSE, check_contact
from damage.wear.archard import DRY, archard, read_archard
from damage.wear.films import WearFilms
from damage.wear.law import WearLaw
from hh_exudyn.contact.types import WheelRailModel

_NOTHING_WIPED = BurstowLimits(math.inf, 1.0, math.inf)  # infinite thresholds: no correction


@dataclass(frozen=True)
class DamageModel:
    """Settings of a damage computation.

    A report depends on these and the log alone.

    Attributes
    ----------
    material
        The wheel steel.
    law
        The wear law, see `damage.wear.laws.wear_law`; Archard's takes the hardness of the steel.
    theory
        Tangential theory, one of `damage.surface.patch_field.DAMAGE_THEORIES`.
    normal
        Normal contact, one of `damage.surface.normal_contact.NORMAL_CONTACTS`.
    contact
        Profiles and theory of the run, for rebuilt patches.
    pressure_limit
        Upper bound of the pressure of the half-space [Pa].
    cells
        Cells of a patch along and across [-]; of rebuilt strips along only, of the half-space with profiles
        none, whose elements have a size.
    flange_angle
        Contact angle above which a contact counts as flange contact [rad], 0 to pi/2.
    grid
        Bins across the wheel profile.
    patch_grid
        Bins along the patch.
    burstow
        Thresholds of Burstow's correction; None for no correction.
    films
        Lubricant in the run, by place, wheel and zone; None for none. They divide the wear of a law with dry
        coefficients that knows those of lubricated surfaces; for another law they are dry.
    wheels
        Vehicle, wheelset and side of the wheels that are summed, those of one profile; None for all.
    rails
        Rails that are summed beside the wheels; None for none.

    Raises
    ------
    ValueError
        Unknown theory, one that does not go with the normal contact, cells below 1, or an angle or a pressure
        limit out of range.
    """

    material: WheelMaterial = ER7
    law: WearLaw = field(default_factory=archard)
    theory: str = "fastrip"
    normal: str = ELLIPSE
    contact: WheelRailModel | None = field(default=None, compare=False, repr=False)
    pressure_limit: float = math.inf
    cells: tuple[int, int] = (50, 50)
    flange_angle: float = FLANGE_CONTACT_ANGLE
    grid: LateralGrid = field(default_factory=LateralGrid)
    patch_grid: PatchGrid = field(default_factory=PatchGrid)
    burstow: Burstow | None = None
    films: WearFilms | None = field(default=None, compare=False, repr=False)
    wheels: frozenset[tuple[int, int, int]] | None = None
    rails: RailModel | None = None

    def __post_init__(self) -> None:
        if self.rails is not None:
            object.__setattr__(self, "rails", self.rails.with_law(self.law, self.material))
        object.__setattr__(self, "law", self.law.on(self.material.hardness))
        if self.films is not None and not self.law.with_films:
            object.__setattr__(self, "films", self.films.without())
        check_contact(self.normal, self.theory, self.contact, self.pressure_limit)
        if min(self.cells) < 1:
            raise ValueError(f"cells = {self.cells} must be at least 1 along and across")
        if not 0.0 < self.flange_angle < 0.5 * math.pi:
            raise ValueError(f"flange_angle = {self.flange_angle} rad must lie within 0..pi/2 rad")

    def sums(self, vehicle: int, wheelset: int, side: int) -> bool:
        """Whether a wheel is summed."""
        return self.wheels is None or (vehicle, wheelset, side) in self.wheels

    @property
    def seizure_pressure(self) -> float:
        """Pressure above which unworn profiles wear in before anything is extrapolated [Pa].

        0.8 of the hardness: of the wear law where it is Archard's (the steel's, or one that the caller
        named), else of the steel, infinite where that is not known.
        """
        if self.law.name == "archard":
            return read_archard(np.array(self.law.numbers)).map.seizure_pressure
        hardness = self.material.hardness
        return math.inf if hardness is None else DRY.seizure_ratio * hardness

    @property
    def rail_seizure_pressure(self) -> float:
        """The same for the rails: of the softer body [Pa]; infinite without rails."""
        if self.rails is None:
            return math.inf
        if self.rails.wear.name == "archard":
            return read_archard(np.array(self.rails.wear.numbers)).map.seizure_pressure
        hardness = self.rails.material.hardness
        return min(self.seizure_pressure, math.inf if hardness is None else DRY.seizure_ratio * hardness)

    @property
    def limits(self) -> BurstowLimits:
        """Burstow's thresholds for the kernels."""
        return _NOTHING_WIPED if self.burstow is None else self.burstow.values
