"""The table ``[friction]`` of a case file, in place of one number for all wheels. See `hh_exudyn.case.case`.

Weather or coefficients of tread, gauge corner and flange, treatments, falling friction, and sections of the
track with other values::

    [friction]
    climate = "cold_dry"
    falling = "polach_dry"
    lubricated_wheelsets = [1, 6]

    [[friction.sections]]
    start_m = 300.0
    treatments = ["flange_lubrication"]

    [friction.sections.left]
    climate = "dry"
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Annotated, Any, Self, TypeVar

import numpy as np
from pydantic import AfterValidator, Discriminator, Field, Tag, model_validator

from hh_exudyn.case.errors import closest
from hh_exudyn.case.fields import CaseTable, number
from hh_exudyn.contact.friction import FILMS, FrictionTable
from track.friction import ZONES, Falling, Friction, FrictionSection, Zones, climate, falling, films, known

_Names = TypeVar("_Names", str, tuple[str, ...])


def _named(kind: str) -> AfterValidator:
    """A check of a name, or several, that the data file must have; its ValueError is the field's message."""

    def checked(value: _Names) -> _Names:
        names = known(kind)
        for name in (value,) if isinstance(value, str) else value:
            if name not in names:
                raise ValueError(f"allowed {', '.join(names)}{closest(name, names)}")
        return value

    return AfterValidator(checked)


_Climate = Annotated[str, _named("climate")]
_Falling = Annotated[str, _named("falling")]
_Treatment = Annotated[str, _named("treatment")]
_Treatments = Annotated[tuple[str, ...], _named("treatment")]
_A_LIST = 'a list of treatments, as ["flange_lubrication"]'
_WHEELSETS = "a list of whole numbers, 1 the leading wheelset"


class SurfaceCase(CaseTable):
    """Friction of a surface: a climate, or coefficients of tread, gauge corner and flange; treatments.

    Missing keys are those of the enclosing table. Climates and treatments: `track.friction.known`.
    """

    climate: _Climate | None = None
    tread: float | None = number("-", 0.01, 1.0, None)
    gauge_corner: float | None = number("-", 0.01, 1.0, None)
    flange: float | None = number("-", 0.01, 1.0, None)
    treatments: _Treatments | None = Field(None, strict=False, json_schema_extra={"allowed": _A_LIST})

    @model_validator(mode="after")
    def _check_one_way(self) -> Self:
        """A climate or all three coefficients, not both."""
        given = [name for name in ZONES if getattr(self, name) is not None]
        if given and self.climate is not None:
            raise ValueError(f'climate = "{self.climate}" and {given[0]}: allowed is one or the other')
        if given and len(given) < len(ZONES):
            missing = next(name for name in ZONES if name not in given)
            raise ValueError(f"{missing} is missing: allowed {', '.join(ZONES)} together, 0.01 to 1")
        return self

    def untreated(self) -> Zones | None:
        """The untreated surface of this table; None without one."""
        if self.climate is not None:
            return climate(self.climate)
        if self.tread is None or self.gauge_corner is None or self.flange is None:
            return None
        return Zones(self.tread, self.gauge_corner, self.flange)


class BothRailsCase(SurfaceCase):
    """A surface on both rails, with other values on the left or the right one."""

    left: SurfaceCase | None = None
    right: SurfaceCase | None = None

    def mirrored(self) -> Self:
        """The same with left and right exchanged."""
        return self.model_copy(update={"left": self.right, "right": self.left})


class FrictionSectionCase(BothRailsCase):
    """Friction from `start_m` to the next section."""

    start_m: float = number("m", 0, 1_000_000)


class FallingCase(CaseTable):
    """Falling friction mu(v) = mu(0) ((1 - ratio) exp(-decrease v) + ratio) (`track.friction.Falling`)."""

    ratio: float = number("-", 0, 1)
    decrease_s_per_m: float = number("s/m", 0, 10)


def _name_or_table(value: Any) -> str:
    return "table" if isinstance(value, dict | FallingCase) else "name"


_AnyFalling = Annotated[
    Annotated[_Falling, Tag("name")] | Annotated[FallingCase, Tag("table")], Discriminator(_name_or_table)
]


class FrictionCase(BothRailsCase):
    """Friction by place on the track, zone of the wheel and slip speed.

    `falling`: a characteristic of `track.friction.known`, or a table of its two numbers, from the
    coefficients at rest downwards; without it friction does not depend on slip. `lubricated_wheelsets` have
    the treatment `lubrication` everywhere. One section changes into the next over `ramp_m`.
    """

    falling: _AnyFalling | None = None
    lubricated_wheelsets: tuple[int, ...] = Field((), strict=False, json_schema_extra={"allowed": _WHEELSETS})
    lubrication: _Treatment = "flange_lubrication"
    ramp_m: float = number("m", 0.1, 100, 2.0)
    sections: tuple[FrictionSectionCase, ...] = Field(
        (), strict=False, json_schema_extra={"allowed": "tables [[friction.sections]]"}
    )

    @model_validator(mode="after")
    def _check_sections(self) -> Self:
        """Every section is as long as its ramp, and both rails have friction everywhere."""
        for i, (one, other) in enumerate(pairwise(self.sections)):
            least = one.start_m + self.ramp_m
            if other.start_m < least:
                raise ValueError(
                    f"sections[{i + 1}].start_m = {other.start_m:g} m: allowed from {least:g} m on, "
                    f"ramp_m = {self.ramp_m:g} m behind the section before it"
                )
        self.friction()
        return self

    def mirrored(self) -> Self:
        """The same with left and right exchanged."""
        sections = tuple(section.mirrored() for section in self.sections)
        return super().mirrored().model_copy(update={"sections": sections})

    def friction(self) -> Friction:
        """Friction along the track; before the first section it is that of the table itself.

        Raises
        ------
        ValueError
            A rail has neither climate nor coefficients.
        """
        return Friction(
            tuple(
                FrictionSection(start, _zones(left), _zones(right)) for start, left, right in self._places()
            ),
            _falling(self.falling),
            self.ramp_m,
        )

    def table(self, wheelsets: int) -> FrictionTable:
        """The table for the contact kernels, for a vehicle with that many wheelsets.

        Raises
        ------
        ValueError
            The vehicle does not have a lubricated wheelset.
        """
        return self.friction().table(self._own(wheelsets))

    def film_table(self, wheelsets: int) -> FrictionTable:
        """The films of lubricant, in a table as that of friction: numbers in `FILMS` instead of coefficients.

        Raises ValueError as `table`.

        Parameters
        ----------
        wheelsets : int
            Of the vehicle.
        """
        own = self._own(wheelsets)

        def codes(treatments: tuple[str, ...]) -> list[int]:
            return [FILMS.index(film) for film in films(*treatments)]

        numbers = [
            [
                [codes((*_treatments(rail), *of_wheelset)) for rail in (left, right)]
                for _, left, right in self._places()
            ]
            for of_wheelset in dict.fromkeys(own)
        ]
        return self.friction().table(own)._replace(friction=np.array(numbers, dtype=np.float64))

    def _places(self) -> list[tuple[float, list[SurfaceCase], list[SurfaceCase]]]:
        """Start of each section [m], and the tables that state its left and right rail, nearest first."""
        places = [(-self.ramp_m, (self,)), *((place.start_m, (place, self)) for place in self.sections)]
        return [
            (
                start,
                [table for around in tables for table in (around.left, around) if table is not None],
                [table for around in tables for table in (around.right, around) if table is not None],
            )
            for start, tables in places
        ]

    def _own(self, wheelsets: int) -> list[tuple[str, ...]]:
        """Treatments of each wheelset; raises ValueError for a lubricated one that the vehicle has not."""
        for i, wheelset in enumerate(self.lubricated_wheelsets):
            if not 1 <= wheelset <= wheelsets:
                raise ValueError(
                    f"friction.lubricated_wheelsets[{i}] = {wheelset}: allowed 1 to {wheelsets}, the "
                    "wheelsets of the vehicle"
                )
        return [
            (self.lubrication,) if w in self.lubricated_wheelsets else () for w in range(1, wheelsets + 1)
        ]


def _falling(said: str | FallingCase | None) -> Falling:
    """The characteristic of a name or of its numbers."""
    if isinstance(said, FallingCase):
        return Falling(said.ratio, said.decrease_s_per_m)
    return Falling() if said is None else falling(said)


def _treatments(said: Sequence[SurfaceCase]) -> tuple[str, ...]:
    """Treatments of one rail: those of the first table that has any."""
    return next((table.treatments for table in said if table.treatments is not None), ())


def _zones(said: Sequence[SurfaceCase]) -> Zones:
    """Friction of one rail: that of the first table with a surface."""
    zones = next((zones for table in said if (zones := table.untreated()) is not None), None)
    if zones is None:
        raise ValueError(f"climate is missing: allowed {', '.join(known('climate'))}; or {', '.join(ZONES)}")
    return zones.treated(*_treatments(said))
