"""The table ``[track]`` of a case file: rails, foundation, irregularities, alignment."""

import os
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from typing import Any, Literal, Self

from pydantic import Field, ValidationInfo, field_validator, model_validator

from hh_exudyn.case.alignment import (
    NOMINAL_GAUGES_MM,
    CentreLineCase,
    GradeCase,
    SectionCase,
    with_nominal_gauge,
)
from hh_exudyn.case.check_rail import CheckRailCase
from hh_exudyn.case.fields import CaseTable, is_path, number
from hh_exudyn.case.rails import RailName, sided
from hh_exudyn.contact.geometry.rail_tables import CHANGE_LENGTH, RailCourse
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import GAUGE_MEASURING_DEPTH, LEFT, NOMINAL_GAUGE, RAIL_TOP_DISTANCE
from track.course.alignment import Alignment
from track.course.alignment_csv import read_alignment_csv
from track.irregularity.irregularity import Irregularity, random_irregularity
from track.irregularity.irregularity_csv import read_irregularity
from track.irregularity.spectra import spectrum_names
from track.irregularity.wavelength_bands import LEAST_SAMPLES
from track.rails import Rails, RailsAlong, RailSection, slope
from track.support.sleepers import sleeper_track

LONGEST_WAVELENGTH = 70.0  # m, of random irregularities
SHORTEST_IRREGULAR = 100.0  # m, of a random track: fading in and out takes 50 m each
RIGID = "rigid"  # value of `flexibility` for rigid track
_WAYS = ("sections", "alignment", "centre_line")  # keys, of which one gives the alignment
SMOOTH = "none"  # value of `irregularity` for smooth track


class TrackCase(CaseTable):
    """Rails, their foundation, irregularities, and the alignment.

    The alignment is given in one of three ways: `sections`, with `grades` as their vertical profile; the file
    `alignment` (`track.course.alignment_csv`); surveyed points, `centre_line`, a table or, for its
    defaults, a file name. `alignment_mirrored` is for the two files: sections have hands.

    `rail` lies on both sides, except where `rail_left`, `rail_right` or a section name another. One rail
    changes into another over `rail_change_m` about the middle of a transition, or about the end of a section.

    `nominal_gauge_mm` is the gauge of sections that state none, what recorded gauges are counted from, and,
    65 mm wider, the base of all cants. Gauges are measured as the least distance of the rails down to
    `gauge_depth_mm` below their tops (EN 13848-1; 15.875 mm in North America). The running plane turns about
    the track's centre line or its low rail (`cant_about`). On a cant ramp every rail has the slope at which
    it rises or falls; without `cant_ramp_slope` it is taken as parallel to the centre line there, as by
    programs that see a cross-section of the track at each wheelset (SIMPACK): a comparison with one needs it,
    no railway does.

    `irregularity` is ``"none"``, a spectrum (`track.irregularity.spectra.spectrum_names`) for a
    random track by `irregularity_seed` with wavelengths from `irregularity_shortest_m` to 70 m, or a
    measured file (`track.irregularity.irregularity_csv`). It begins ahead of the vehicle, faded in over 50
    m. Without `sleeper_passing` flexible track has constant stiffness along the track. `check_rail` sets
    check rails beside the running rails (`hh_exudyn.case.check_rail`).
    """

    rail: RailName = "60E1"
    rail_left: RailName | None = None
    rail_right: RailName | None = None
    rail_change_m: float = number("m", 0.5, 100, CHANGE_LENGTH)
    inclination: str | float = Field(default="1:30", json_schema_extra={"allowed": '"1:15" to "1:100", or 0'})
    flexibility: str = "concrete"
    sleeper_passing: bool = True
    nominal_gauge_mm: float = number("mm", *NOMINAL_GAUGES_MM, NOMINAL_GAUGE * 1000)
    gauge_depth_mm: float = number("mm", 5, 20, GAUGE_MEASURING_DEPTH * 1000)
    cant_about: Literal["centre", "low_rail"] = "centre"
    cant_ramp_slope: bool = True
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
    check_rail: CheckRailCase | None = None

    @field_validator("sections", "centre_line")
    @classmethod
    def _of_the_nominal_gauge(cls, value: Any, info: ValidationInfo) -> Any:
        """Sections and surveyed points without a gauge have the nominal one."""
        nominal = info.data.get("nominal_gauge_mm", NOMINAL_GAUGE * 1000)
        if isinstance(value, tuple):
            return tuple(with_nominal_gauge(section, nominal) for section in value)
        return None if value is None else with_nominal_gauge(value, nominal)

    @field_validator("centre_line", mode="before")
    @classmethod
    def _table_of_a_name(cls, value: Any) -> Any:
        return {"file": value} if isinstance(value, str) else value

    @model_validator(mode="after")
    def _check_one_alignment(self) -> Self:
        """Exactly one of three; keys for sections or for files alone are not given with the others."""
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
    def _check_samples(self) -> Self:
        """Measured samples hold the shortest wave that is asked for."""
        if is_path(self.irregularity):
            step = _measured(self.irregularity, self.nominal_gauge_mm).step
            largest = self.irregularity_shortest_m / LEAST_SAMPLES
            if step > largest * (1.0 + 1e-9):
                raise ValueError(
                    f"irregularity {self.irregularity}: a sample every {step:g} m, allowed up to "
                    f"{largest:g} m for irregularity_shortest_m = {self.irregularity_shortest_m:g} m"
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

    @field_validator("inclination", mode="before")
    @classmethod
    def _check_inclination(cls, value: Any) -> str | float:
        if isinstance(value, bool) or not isinstance(value, str | float | int):
            raise ValueError('allowed "1:15" to "1:100", or 0 for an upright rail')
        try:
            found = slope(value) if isinstance(value, str) else value
        except ValueError as error:
            raise ValueError(f"{error}, or 0 for an upright rail") from None
        if not (found == 0.0 or 1 / 100 <= found <= 1 / 15):
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
    def _check_irregularity(cls, value: str, info: ValidationInfo) -> str:
        if is_path(value):
            _measured(value, info.data.get("nominal_gauge_mm", NOMINAL_GAUGE * 1000))
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
            Sections or grades that do not join, a faulty file, points that give no alignment.
        """
        if self.alignment is not None:
            found = read_alignment_csv(self.alignment, nominal_gauge=self.nominal_gauge_mm / 1000)
        elif self.centre_line is not None:
            found = self.centre_line.fitted()
        else:
            plan = tuple(section.section() for section in self.sections or ())
            found = Alignment(plan, grades=tuple(grade.grade() for grade in self.grades))
        # a balanced cant of surveyed points is one across 1.5 m
        wider = 0.0 if self.centre_line else self.nominal_gauge_mm / 1000 - NOMINAL_GAUGE
        if wider or self.cant_about != "centre":
            found = replace(found, cant_about=self.cant_about, cant_base=RAIL_TOP_DISTANCE + wider)
        return found.mirrored() if self.alignment_mirrored else found

    def mirrored(self) -> Self:
        """The same track with left and right exchanged."""
        changes: dict[str, Any] = {
            "irregularity_mirrored": not self.irregularity_mirrored,
            "rail_left": self.rail_right,
            "rail_right": self.rail_left,
            "check_rail": None if self.check_rail is None else self.check_rail.mirrored(),
        }
        if self.sections is None:
            changes["alignment_mirrored"] = not self.alignment_mirrored
        else:
            changes["sections"] = tuple(section.mirrored() for section in self.sections)
        return self.model_copy(update=changes)

    def irregular(self, start: float, end: float) -> Irregularity | None:
        """The irregularities from arc length `start` to `end` [m]; None on smooth track.

        Parameters
        ----------
        start, end : float
            Arc lengths [m].

        Raises
        ------
        ValueError
            The stretch is shorter than 100 m, too short for a random track.
        """
        if self.irregularity == SMOOTH:
            return None
        if is_path(self.irregularity):
            found = replace(_measured(self.irregularity, self.nominal_gauge_mm), start=start)
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
        return slope(self.inclination) if isinstance(self.inclination, str) else float(self.inclination)

    @property
    def flexible(self) -> bool:
        """Whether rails and sleepers move."""
        return self.flexibility != RIGID

    @property
    def rails(self) -> Rails:
        """Both rails of sections without rails of their own, with their inclination."""
        both = Rails(left=self.rail, right=self.rail, inclination=self.rail_inclination)
        return sided(both, None, self.rail_left, self.rail_right)

    def rails_along(self) -> RailsAlong:
        """Rails along the track."""
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
            self.gauge_depth_mm / 1000,
        )


def _measured(path: str, nominal_gauge_mm: float) -> Irregularity:
    """Read a file of irregularities, again where it has changed."""
    try:
        found = os.stat(path)
    except OSError:  # the reader says why
        return read_irregularity(path)
    return _read_once(path, nominal_gauge_mm, found.st_mtime_ns, found.st_size)


@lru_cache(maxsize=2)
def _read_once(path: str, nominal_gauge_mm: float, _changed: int, _size: int) -> Irregularity:
    """A file of irregularities; a case asks for it three times, and 25 km of track take seconds."""
    return read_irregularity(path, nominal_gauge=nominal_gauge_mm / 1000)
