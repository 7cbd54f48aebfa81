"""The tables of a case file: track, contact, integration. See `hh_exudyn.case`."""

import re
from dataclasses import replace
from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import Field, field_validator, model_validator

from hh_exudyn.case_alignment import CentreLineCase, GradeCase, SectionCase
from hh_exudyn.case_fields import CaseTable, is_path, number
from hh_exudyn.case_rails import RailName, sided
from hh_exudyn.contact.non_elliptic import check_combination
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.rail_tables import CHANGE_LENGTH, RailCourse
from hh_exudyn.conventions import LEFT
from track.alignment import Alignment
from track.alignment_csv import read_alignment_csv
from track.irregularity import Irregularity, random_irregularity
from track.irregularity_csv import read_irregularity
from track.rails import Rails, RailsAlong, RailSection
from track.sleepers import sleeper_track
from track.spectra import spectrum_names

LONGEST_WAVELENGTH = 70.0  # m, of random irregularities
SHORTEST_IRREGULAR = 100.0  # m, of a random track: fading in and out takes 50 m each
RIGID = "rigid"  # the flexibility of a track without any
_WAYS = ("sections", "alignment", "centre_line")  # to give an alignment
SMOOTH = "none"  # the irregularity of a track without any


class TrackCase(CaseTable):
    """Rails, their foundation, irregularities, and the alignment.

    The alignment is given in one of three ways: `sections`, with `grades` as their vertical profile; the file
    `alignment` (`track.alignment_csv`); surveyed points, `centre_line`, a file name alone if the defaults
    will do. `alignment_mirrored` is for the two files: sections have hands.

    `rail` lies on both sides but where `rail_left`, `rail_right` or a section say otherwise. One rail passes
    into another over `rail_change_m` about the middle of a transition, or about the end of a section.

    `irregularity` is ``"none"``, a spectrum (`track.spectra.spectrum_names`) of which `irregularity_seed`
    draws a random track with wavelengths from `irregularity_shortest_m` to 70 m, or a measured file
    (`track.irregularity_csv`). It begins ahead of the vehicle, faded in over 50 m. Without `sleeper_passing`
    flexible track is alike on and between its sleepers.
    """

    rail: RailName = "60E1"
    rail_left: RailName | None = None
    rail_right: RailName | None = None
    rail_change_m: float = number("m", 0.5, 100, CHANGE_LENGTH)
    inclination: str | float = Field(default="1:30", json_schema_extra={"allowed": '"1:15" to "1:100", or 0'})
    flexibility: str = "concrete"
    sleeper_passing: bool = True
    irregularity: str = SMOOTH
    irregularity_seed: int = number("-", 0, 2**31 - 1, 1)
    irregularity_shortest_m: float = number("m", 0.5, 25, 3.0)
    irregularity_scale: float = number("-", 0, 10, 1.0)
    irregularity_mirrored: bool = False
    sections: tuple[SectionCase, ...] | None = Field(
        default=None, strict=False, min_length=1, json_schema_extra={"allowed": "one or more sections"}
    )
    grades: tuple[GradeCase, ...] = Field(default=(), strict=False)
    alignment: str | None = Field(default=None, min_length=1, json_schema_extra={"allowed": "a file (.csv)"})
    centre_line: CentreLineCase | None = None
    alignment_mirrored: bool = False

    @field_validator("centre_line", mode="before")
    @classmethod
    def _table_of_a_name(cls, value: Any) -> Any:
        return {"file": value} if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check_one_alignment(self) -> Self:
        """One of three; what belongs to sections alone, or to files alone, does not stand with the others."""
        ways = [name for name in _WAYS if getattr(self, name) is not None]
        if len(ways) != 1:
            found = " and ".join(ways) if ways else "none"
            raise ValueError(f"{found} given: allowed exactly one of sections, alignment, centre_line")
        if self.grades and self.sections is None:
            raise ValueError(
                f"grades given with {ways[0]}: allowed with sections, a file has its own gradient"
            )
        if self.alignment_mirrored and self.sections is not None:
            raise ValueError(
                "alignment_mirrored = true: allowed with alignment or centre_line, sections have hands"
            )
        return self

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
                sleeper_track(value)  # the name; fitting the track itself takes a while
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

    @property
    def alignment_key(self) -> str:
        """The one of `sections`, `alignment` and `centre_line` that is given."""
        return next(name for name in _WAYS if getattr(self, name) is not None)

    def aligned(self) -> Alignment:
        """The alignment in SI.

        Raises
        ------
        ValueError
            Sections or grades that do not follow each other, a faulty file, points that are no railway.
        """
        if self.alignment is not None:
            found = read_alignment_csv(self.alignment)
        elif self.centre_line is not None:
            found = self.centre_line.fitted()
        else:
            plan = tuple(section.section() for section in self.sections or ())
            found = Alignment(plan, grades=tuple(grade.grade() for grade in self.grades))
        return found.mirrored() if self.alignment_mirrored else found

    def mirrored(self) -> Self:
        """The same track with left and right exchanged."""
        changes: dict[str, Any] = {
            "irregularity_mirrored": not self.irregularity_mirrored,
            "rail_left": self.rail_right,
            "rail_right": self.rail_left,
        }
        if self.sections is None:
            changes["alignment_mirrored"] = not self.alignment_mirrored
        else:
            changes["sections"] = tuple(section.mirrored() for section in self.sections)
        return self.model_copy(update=changes)

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
        return sided(both, None, self.rail_left, self.rail_right)

    def rails_along(self) -> RailsAlong:
        """Which rails lie where."""
        track = self.rails
        stretches = [(part.length_m, part.rails(track)) for part in self.sections or ()]
        if all(rails is None for _, rails in stretches):  # a file of the alignment, ramps alone
            return RailsAlong((RailSection(0.0, track),))
        return RailsAlong.of_stretches(stretches)

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

    The default of d is assumed, from the range of steel: d = 1.5 c with the coefficient of restitution 1 -
    c v at low speeds v of impact (Hunt and Crossley, J. Applied Mechanics 1975), c = 0.08 to 0.32 s/m (quoted
    from memory), so d = 0.12 to 0.48 s/m. It is a damper of 24 kN s/m at 80 kN; SIMPACK's usual one is about
    140, d = 1.75 s/m, which steadies more than steel does. In the demo 0.3 s/m take 0.1 % of the energy lost
    in the contacts and 1.75 take 0.6 %; on ERRI-low down to 0.5 m the vertical forces above 100 Hz are 4 to
    45 N (rms) with either, on rigid track 10 % less with 1.75. Only where a wheel jumps between root and
    flange (R 250 m, friction 0.5) does it count: 6 and 13 % of the energy, peaks of 640 and 490 kN, rms above
    100 Hz alike. Contact modes near 580 Hz are damped to 17 and 39 % of critical.

    With 32 cells along each of 16 strips the lateral wheel forces of
    the demo are within 0.5 % of those with 50 x 50 cells and half the step; strips in eights fill the vector
    registers. With the theory "given" profiles, coefficients and conicity are those that the vehicle states.
    """

    normal: Literal["hertz", "analyn", "kik_piotrowski"] = "hertz"
    theory: Literal[
        "fastrip", "fastsim", "fastsim_single", "fastsim_elliptic", "strip", "polach", "given"
    ] = "fastrip"
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
