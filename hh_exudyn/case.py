"""A `Case`: one vehicle on one track, everything a run needs, as a frozen value.

A case is written to and read from TOML. Its keys carry their units (``speed_km_h``, ``gauge_mm``), for this
is the edge of the toolkit; the properties `speed` and `alignment` give SI. A case that exists is valid: it is
checked whenever it is made, and every fault is a `CaseError` of one line with file, key, value, unit and
what is allowed.
"""

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import tomli_w
from pydantic import BaseModel, Field, ValidationError, field_validator, model_validator

from hh_exudyn.case_errors import CaseError, closest, explain
from hh_exudyn.case_tables import (
    LARGEST_GAUGE_MM,
    CaseTable,
    ContactCase,
    CurveCase,
    IntegrationCase,
    StraightCase,
    TrackCase,
    TransitionCase,
    is_path,
    number,
    read_profile,
)
from hh_exudyn.contact.profile import Profile, read_wheel_profile, wheel_profile
from hh_exudyn.contact.profile_measures import flange_thickness
from hh_exudyn.contact.types import WheelRailModel
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.conventions import BACK_TO_BACK, LEFT, RIGHT
from track.alignment import Alignment
from vehicles.catalogue import VEHICLES
from vehicles.catalogue import vehicle as vehicle_by_name
from vehicles.description import Vehicle

__all__ = [
    "Case",
    "CaseError",
    "ContactCase",
    "CurveCase",
    "IntegrationCase",
    "StraightCase",
    "TrackCase",
    "TransitionCase",
    "read_case",
]

_RAILS = ("rail", "rail_left", "rail_right", "rail_high", "rail_low")
_FILES = ("wheel_profile", "irregularity", *_RAILS)  # keys whose value may be the path of a file
SHORTEST_TRACK_M = 30.0  # a wagon of 10.29 m and some way to run


class Case(CaseTable):
    """One vehicle on one track: what a run is made from.

    Attributes carry their units; see the field bounds for the allowed ranges. `wheel_profile` is a published
    profile (``"S1002"``) or the path of a profile file.

    Raises
    ------
    CaseError
        For any unknown key or value that is not allowed, with key, value, unit and allowed range.
    """

    name: str = Field(min_length=1, json_schema_extra={"allowed": "a text"})
    vehicle: str = "iore_wagon_loaded"
    speed_km_h: float = number("km/h", 5, 130)
    friction: float = number("-", 0.01, 1.0)
    wheel_profile: str = "S1002"
    track: TrackCase
    contact: ContactCase = ContactCase()
    integration: IntegrationCase = IntegrationCase()

    if not TYPE_CHECKING:  # type checkers keep the signature made from the fields

        def __init__(self, /, **data: Any) -> None:
            try:
                super().__init__(**data)
            except ValidationError as error:
                raise CaseError(explain(error, Case)) from None

    @field_validator("vehicle")
    @classmethod
    def _check_vehicle(cls, value: str) -> str:
        if value not in VEHICLES:
            raise ValueError(f"allowed {', '.join(sorted(VEHICLES))}{closest(value, VEHICLES)}")
        return value

    @field_validator("wheel_profile")
    @classmethod
    def _check_wheel_profile(cls, value: str) -> str:
        _wheel(value)
        return value

    @model_validator(mode="after")
    def _check_track(self) -> Self:
        """The vehicle fits on the track, no gauge jams the wheelset, and the sections follow each other."""
        length = sum(section.length_m for section in self.track.sections)
        if length < SHORTEST_TRACK_M:
            raise ValueError(
                f"track.sections: length {length:g} m in all: allowed from {SHORTEST_TRACK_M:g} m, "
                "so that the vehicle fits"
            )
        least = self.least_gauge * 1000
        for i, section in enumerate(self.track.sections):
            if not isinstance(section, TransitionCase) and section.gauge_mm <= least:
                raise ValueError(
                    f"track.sections[{i}].gauge_mm = {section.gauge_mm:g} mm leaves no flange clearance: "
                    f"allowed above {least:.1f} up to {LARGEST_GAUGE_MM:g} mm with wheel profile "
                    f"{self.wheel_profile}"
                )
        self.alignment()
        return self

    @property
    def speed(self) -> float:
        """Speed of the vehicle [m/s]."""
        return self.speed_km_h / 3.6

    @property
    def wheel(self) -> Profile:
        """The wheel profile in side coordinates."""
        return _wheel(self.wheel_profile)

    @property
    def least_gauge(self) -> float:
        """The gauge at which the flange clearance is used up [m]."""
        return BACK_TO_BACK + 2 * flange_thickness(self.wheel)

    def alignment(self) -> Alignment:
        """The track's alignment in SI."""
        return Alignment(tuple(section.section() for section in self.track.sections))

    def contact_model(self, vehicle: Vehicle | None = None) -> WheelRailModel:
        """The contact of every wheel of the run, for the run and for whoever solves logged patches again.

        Parameters
        ----------
        vehicle : Vehicle or None
            Whose wheel radius counts; None: the case's own vehicle.

        Raises
        ------
        ValueError
            The wheels of the vehicle differ in radius.
        """
        vehicle = vehicle or vehicle_by_name(self.vehicle)
        radii = {wheelset.radius for wheelset in vehicle.wheelsets}
        if len(radii) > 1:
            raise ValueError(f"vehicle {vehicle.name}: wheel radii {sorted(radii)} m must be equal")
        return wheel_rail_model(
            self.wheel,
            self.wheel,
            self.track.rail_course(LEFT),
            self.track.rail_course(RIGHT),
            nominal_radius=radii.pop(),
            damping=self.contact.damping_s_per_m,
            normal=self.contact.normal,
            theory=self.contact.theory,
            cells=self.contact.cells,
        )

    def mirrored(self) -> "Case":
        """The same case with left and right exchanged."""
        other = {"left": "right", "right": "left"}
        sections = [section.model_dump() for section in self.track.sections]
        for section in sections:
            if "hand" in section:
                section["hand"] = other[section["hand"]]
            if "rail_left" in section:
                section |= {"rail_left": section["rail_right"], "rail_right": section["rail_left"]}
        return self.with_changes(
            track={
                "sections": sections,
                "rail_left": self.track.rail_right,
                "rail_right": self.track.rail_left,
                "irregularity_mirrored": not self.track.irregularity_mirrored,
            }
        )

    def with_changes(self, /, **changes: Any) -> "Case":
        """A changed copy, checked again.

        A table is changed key by key: ``case.with_changes(friction=0.3, track={"flexibility": "rigid"})``.
        """
        return Case(**_merged(self.model_dump(), changes))

    def to_toml(self) -> str:
        """The case as TOML; `read_case` gives an equal case."""
        return tomli_w.dumps(self.model_dump(exclude_none=True))

    @classmethod
    def from_toml(cls, text: str, source: str = "case", folder: Path | None = None) -> "Case":
        """A case from TOML text.

        Parameters
        ----------
        text
            The TOML document.
        source
            Name of the file, for error messages.
        folder
            Where a relative path of a profile or of irregularities starts; the working directory if None.

        Raises
        ------
        CaseError
            One line with file, key, value, unit and what is allowed.
        """
        try:
            data = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            raise CaseError(f"{source}: not valid TOML: {error}") from None
        if folder is not None:
            for table in _tables(data):
                for key in _FILES:
                    name = table.get(key)
                    if isinstance(name, str) and is_path(name):
                        table[key] = str((folder / name).resolve())
        try:
            return cls(**data)
        except CaseError as error:
            raise CaseError(f"{source}: {error}") from None


def read_case(path: str | Path) -> Case:
    """Read a case file (TOML). A relative path in it starts at the folder of the case file.

    Raises
    ------
    CaseError
        One line: the file cannot be read, is not TOML (line and column), has unknown keys or values that
        are not allowed.
    """
    path = Path(path)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise CaseError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise CaseError(f"{path}: not valid TOML: not UTF-8 at byte {error.start}") from None
    return Case.from_toml(text, source=str(path), folder=path.parent)


def _wheel(name: str) -> Profile:
    return read_profile(read_wheel_profile, name) if is_path(name) else wheel_profile(name)


def _tables(data: dict[str, Any]) -> list[dict[str, Any]]:
    """The tables of a case file that may name files, whatever else it holds."""
    track = data.get("track")
    sections = track.get("sections") if isinstance(track, dict) else None
    inner = sections if isinstance(sections, list) else []
    return [table for table in (data, track, *inner) if isinstance(table, dict)]


def _merged(old: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """`old` with `changes`, tables merged key by key."""
    new = dict(old)
    for key, value in changes.items():
        if isinstance(value, BaseModel):
            value = value.model_dump()
        both = isinstance(value, dict) and isinstance(old.get(key), dict)
        new[key] = _merged(old[key], value) if both else value
    return new
