"""The tables of a case file: track with its sections, contact, integration. See `hh_exudyn.case`."""

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, field_validator, model_validator

from hh_exudyn.contact.non_elliptic import check_combination
from hh_exudyn.contact.profile import Profile, read_rail_profile
from hh_exudyn.contact.rail_tables import CHANGE_LENGTH, RailCourse
from hh_exudyn.conventions import LEFT, NOMINAL_GAUGE
from track.alignment import Curve, Straight, Transition
from track.flexibility import track_flexibility
from track.irregularity import Irregularity, random_irregularity
from track.irregularity_csv import read_irregularity
from track.rails import RailPair, Rails, RailsAlong
from track.spectra import spectrum_names

LONGEST_WAVELENGTH = 70.0  # m, of random irregularities
SHORTEST_IRREGULAR = 100.0  # m, of a random track: fading in and out takes 50 m each
LARGEST_GAUGE_MM = 1470.0  # beyond it a wheel may drop between the rails
RIGID = "rigid"  # the flexibility of a track without any
SMOOTH = "none"  # the irregularity of a track without any


def number(unit: str, low: float, high: float, default: Any = ...) -> Any:
    """Field of a number from `low` to `high` [unit]; the error messages read the same texts."""
    extra: dict[str, Any] = {"unit": unit, "allowed": f"{low:g} to {high:g}"}
    return Field(default, ge=low, le=high, json_schema_extra=extra)


def _gauge() -> Any:
    """Field of a gauge [mm]; the least gauge follows from the wheel profile, see `Case`."""
    extra: dict[str, Any] = {"unit": "mm", "allowed": f"up to {LARGEST_GAUGE_MM:g}"}
    return Field(NOMINAL_GAUGE * 1000, le=LARGEST_GAUGE_MM, json_schema_extra=extra)


def _check_rail(name: str) -> str:
    """A rail is a known name, or a file that can be read."""
    if is_path(name):
        read_profile(read_rail_profile, name)
    else:
        Rails(left=name, right=name).left_profile()
    return name


RailName = Annotated[str, AfterValidator(_check_rail)]


class CaseTable(BaseModel):
    """Frozen; no unknown keys, no numbers in quotes, no NaN or infinity."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class StraightCase(CaseTable):
    """A straight; where it says nothing of its rails, they are those of the track."""

    kind: Literal["straight"] = "straight"
    length_m: float = number("m", 1, 100_000)
    gauge_mm: float = _gauge()
    rail: RailName | None = None
    rail_left: RailName | None = None
    rail_right: RailName | None = None

    def rails(self, track: Rails) -> Rails:
        """Its rails, on a track with those."""
        return _sided(track, self.rail, self.rail_left, self.rail_right)

    def section(self) -> Straight:
        """The section in SI."""
        return Straight(length=self.length_m, gauge=self.gauge_mm / 1000)


class TransitionCase(CaseTable):
    """A clothoid with a linear cant ramp between its two neighbours."""

    kind: Literal["transition"] = "transition"
    length_m: float = number("m", 1, 10_000)

    def section(self) -> Transition:
        """The section in SI."""
        return Transition(length=self.length_m)

    def rails(self, track: Rails) -> None:
        """None of its own: they change in its middle from one neighbour's to the other's."""


class CurveCase(CaseTable):
    """A curve of constant radius; the cant raises its outer rail.

    Where it says nothing of its high (outer) or low rail, it is that of the track.
    """

    kind: Literal["curve"] = "curve"
    length_m: float = number("m", 1, 100_000)
    radius_m: float = number("m", 100, 20_000)
    hand: Literal["left", "right"]
    cant_mm: float = number("mm", 0, 180, 0.0)
    gauge_mm: float = _gauge()
    rail_high: RailName | None = None
    rail_low: RailName | None = None

    def rails(self, track: Rails) -> Rails:
        """Its rails, on a track with those."""
        high, low = (track.right, track.left) if self.hand == "left" else (track.left, track.right)
        return RailPair(self.rail_high or high, self.rail_low or low).rails(self.hand, track.inclination)

    def section(self) -> Curve:
        """The section in SI."""
        return Curve(
            length=self.length_m,
            radius=self.radius_m,
            hand=self.hand,
            cant=self.cant_mm / 1000,
            gauge=self.gauge_mm / 1000,
        )


Section = Annotated[StraightCase | TransitionCase | CurveCase, Field(discriminator="kind")]


class TrackCase(CaseTable):
    """Rails, their foundation, irregularities, and the alignment section by section.

    `rail` lies on both sides but where `rail_left`, `rail_right` or a section say otherwise. One rail passes
    into another over `rail_change_m` about the middle of a transition, or about the end of a section.

    `irregularity` is ``"none"``, a spectrum (`track.spectra.spectrum_names`) of which `irregularity_seed`
    draws a random track with wavelengths from `irregularity_shortest_m` to 70 m, or a measured file
    (`track.irregularity_csv`). It begins ahead of the vehicle, faded in over 50 m.
    """

    rail: RailName = "60E1"
    rail_left: RailName | None = None
    rail_right: RailName | None = None
    rail_change_m: float = number("m", 0.5, 100, CHANGE_LENGTH)
    inclination: str | float = Field(default="1:30", json_schema_extra={"allowed": '"1:15" to "1:100", or 0'})
    flexibility: str = "concrete"
    irregularity: str = SMOOTH
    irregularity_seed: int = number("-", 0, 2**31 - 1, 1)
    irregularity_shortest_m: float = number("m", 0.5, 25, 3.0)
    irregularity_scale: float = number("-", 0, 10, 1.0)
    irregularity_mirrored: bool = False
    sections: tuple[Section, ...] = Field(
        strict=False, min_length=1, json_schema_extra={"allowed": "one or more sections"}
    )

    @model_validator(mode="after")
    def _check_rail_changes(self) -> Self:
        starts = [part.start for part in self.rails_along().sections[1:]]
        for one, other in pairwise(starts):
            if other - one < self.rail_change_m:
                raise ValueError(
                    f"sections: rails change at s = {one:g} m and at {other:g} m: allowed at least "
                    f"rail_change_m = {self.rail_change_m:g} m apart"
                )
        return self

    @field_validator("inclination")
    @classmethod
    def _check_inclination(cls, value: str | float) -> str | float:
        slope = _slope(value)
        if not (slope == 0.0 or 1 / 100 <= slope <= 1 / 15):
            raise ValueError('allowed "1:15" to "1:100", or 0 for an upright rail')
        return value

    @field_validator("flexibility")
    @classmethod
    def _check_flexibility(cls, value: str) -> str:
        if value != RIGID:
            try:
                track_flexibility(value)
            except ValueError as error:
                raise ValueError(f"{error}, {RIGID}") from None
        return value

    @field_validator("irregularity")
    @classmethod
    def _check_irregularity(cls, value: str) -> str:
        if is_path(value):
            _measured(value)
        elif value != SMOOTH and value not in spectrum_names():
            raise ValueError(f"allowed {', '.join((SMOOTH, *spectrum_names()))}, or a file (.csv)")
        return value

    def irregular(self, start: float, end: float) -> Irregularity | None:
        """The irregularities from arc length `start` to `end` [m]; None on smooth track.

        Raises
        ------
        ValueError
            The stretch is shorter than 100 m, too short for a random track.
        """
        if self.irregularity == SMOOTH:
            return None
        if is_path(self.irregularity):
            found = replace(_measured(self.irregularity), start=start)
        else:
            if end - start < SHORTEST_IRREGULAR:
                raise ValueError(
                    f"track.irregularity: {end - start:.4g} m of track ahead of the vehicle, allowed from "
                    f"{SHORTEST_IRREGULAR:g} m"
                )
            found = random_irregularity(
                self.irregularity,
                end - start,
                self.irregularity_seed,
                wavelengths=(self.irregularity_shortest_m, LONGEST_WAVELENGTH),
                step=self.irregularity_shortest_m / 12.0,
                start=start,
            )
        found = replace(found, values=found.values * self.irregularity_scale)
        return found.mirrored() if self.irregularity_mirrored else found

    @property
    def rail_inclination(self) -> float:
        """Inclination of the rails towards the track centre as a slope [-], e.g. 1/30."""
        return _slope(self.inclination)

    @property
    def flexible(self) -> bool:
        """Whether rails and sleepers move."""
        return self.flexibility != RIGID

    @property
    def rails(self) -> Rails:
        """Both rails where no section says otherwise, with their inclination."""
        both = Rails(left=self.rail, right=self.rail, inclination=self.rail_inclination)
        return _sided(both, None, self.rail_left, self.rail_right)

    def rails_along(self) -> RailsAlong:
        """Which rails lie where."""
        track = self.rails
        return RailsAlong.of_stretches((part.length_m, part.rails(track)) for part in self.sections)

    def rail_course(self, side: int) -> RailCourse:
        """The profiles of one side, `LEFT` or `RIGHT`, along the track."""
        along = self.rails_along().sections
        found: list[tuple[float, str, Profile]] = []
        for part in along:
            name = part.rails.left if side == LEFT else part.rails.right
            if not found or found[-1][1] != name:
                profile = part.rails.left_profile() if side == LEFT else part.rails.right_profile()
                found.append((part.start, name, profile))
        return RailCourse(
            tuple(profile for _, _, profile in found),
            tuple(start for start, _, _ in found[1:]),
            self.rail_change_m,
        )


_Cells = Annotated[int, Field(ge=5, le=100)]


class ContactCase(CaseTable):
    """Normal and tangential theory, grid, and the damping d of the normal force N (1 + d * approach rate).

    The default of d is assumed: at 150 kN it is a damper of 45 kN s/m, 5 % of critical for the 150 kg of a
    rail on a contact spring of 1.7 GN/m. With 32 cells along each of 16 strips the lateral wheel forces of
    the demo are within 0.5 % of those with 50 x 50 cells and half the step; strips in eights fill the vector
    registers.
    """

    normal: Literal["hertz", "analyn", "kik_piotrowski"] = "hertz"
    theory: Literal["fastrip", "fastsim", "fastsim_single", "fastsim_elliptic", "strip", "polach"] = "fastrip"
    cells: tuple[_Cells, _Cells] = Field(
        default=(32, 16), strict=False, json_schema_extra={"allowed": "two whole numbers from 5 to 100"}
    )
    damping_s_per_m: float = number("s/m", 0, 3, 0.3)

    @model_validator(mode="after")
    def _check_combination(self) -> Self:
        check_combination(self.normal, self.theory)
        return self


class IntegrationCase(CaseTable):
    """Step of the time integration and distance in time of the logged states."""

    step_ms: float = number("ms", 0.05, 0.5, 0.4)
    output_interval_ms: float = number("ms", 0.05, 1000, 4.0)

    @model_validator(mode="after")
    def _whole_steps(self) -> Self:
        steps = self.output_interval_ms / self.step_ms
        if round(steps) < 1 or abs(steps - round(steps)) > 1e-6 * steps:
            raise ValueError(
                f"output_interval_ms = {self.output_interval_ms:g} ms: allowed whole multiples of "
                f"step_ms = {self.step_ms:g} ms"
            )
        return self


def _sided(rails: Rails, both: str | None, left: str | None, right: str | None) -> Rails:
    """`rails` with what is given for both sides, and for each."""
    return replace(rails, left=left or both or rails.left, right=right or both or rails.right)


def is_path(name: str) -> bool:
    """Whether a profile is a file: names of published profiles have neither folder nor ending."""
    return "/" in name or "\\" in name or "." in name


def read_profile(reader: Callable[[Path], Profile], path: str) -> Profile:
    """Read a profile; a file that may not be read is bad input too."""
    try:
        return reader(Path(path))
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror}") from None


def _measured(path: str) -> Irregularity:
    """Read a file of irregularities; one that may not be read is bad input too."""
    try:
        return read_irregularity(path)
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror}") from None


def _slope(value: str | float) -> float:
    """``"1:30"`` or a number as a slope [-]."""
    if not isinstance(value, str):
        return float(value)
    match = re.fullmatch(r"1:(\d+(?:\.\d+)?)", value.replace(" ", ""))
    if match is None or float(match[1]) == 0.0:
        raise ValueError('allowed "1:15" to "1:100", or 0 for an upright rail')
    return 1.0 / float(match[1])
