"""A `Case`: the complete input of a run, one vehicle on one track, as a frozen value.

A case is written to and read from TOML. Units are in the names of its keys (``speed_km_h``, ``gauge_mm``);
properties and methods such as `speed` and `alignment` give SI. Every case is checked when it is made, and
every fault is a `CaseError` of one line with file, key, value, unit and what is allowed.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np
import tomli_w
from pydantic import (
    BaseModel,
    Discriminator,
    Field,
    Tag,
    ValidationError,
    field_validator,
    model_validator,
)

from hh_exudyn.case.alignment import WIDENING_MM, gauges_mm
from hh_exudyn.case.contact import ContactCase, IntegrationCase
from hh_exudyn.case.errors import CaseError, explain
from hh_exudyn.case.fields import CaseTable, number
from hh_exudyn.case.files import start_at
from hh_exudyn.case.friction import FrictionCase
from hh_exudyn.case.track import TrackCase
from hh_exudyn.case.traction import SteeringCase, TractionCase, require_drives
from hh_exudyn.case.train import BrakeCase, TrainCase
from hh_exudyn.case.vehicle import VehicleField, described, resolved
from hh_exudyn.case.wheels import WheelProfilesCase, read_wheel, wheel_names, widest_flanges
from hh_exudyn.contact.friction import FrictionTable, constant_friction
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.tangential.given import given_contact_model
from hh_exudyn.contact.types import GivenCreep, WheelRailModel
from hh_exudyn.contact.wheel_rail import wheel_rail_model
from hh_exudyn.contact.wheels import with_wheels
from hh_exudyn.conventions import BACK_TO_BACK, LEFT, NOMINAL_GAUGE, RIGHT
from hh_exudyn.text_files import parsed_toml, read_bytes
from track.course.alignment import Alignment
from vehicles.description import Vehicle

_LARGEST_FILE = 20_000_000  # bytes of a case
_PLAY_MM = (60.0, 100.0)  # nominal gauge less the distance of the flange backs
SHORTEST_TRACK_M = 30.0  # a wagon of 10.29 m and some track ahead


def _number_or_table(value: Any) -> str:
    """Form of the friction in a case, as a tag of `_Friction`."""
    return "table" if isinstance(value, dict | FrictionCase) else "number"


_Friction = Annotated[
    Annotated[float, Field(ge=0.01, le=1.0), Tag("number")] | Annotated[FrictionCase, Tag("table")],
    Discriminator(_number_or_table),
]


class Case(CaseTable):
    """The complete input of a run: one vehicle on one track.

    Units are in the names of the attributes, allowed ranges in the fields. `vehicle` is a name of the
    catalogue or a variant; the path of a vehicle file becomes the table of its changed numbers
    (`hh_exudyn.case.vehicle`). `wheel_profiles` are those of single wheels (`hh_exudyn.case.wheels`),
    `wheel_profile` that of all others. It is a published
    profile (``"S1002"``) or the path of a profile file; `back_to_back_mm` is the distance of the flange
    backs, without it 75 mm less than the nominal gauge of the track. `friction` is one coefficient for all
    patches, or a table for friction by place, zone and slip (`hh_exudyn.case.friction`). `traction` and
    `steering` are for vehicles with drives (`hh_exudyn.case.traction`); such a vehicle without the first has
    the default table. `train` passes a force through a hauled vehicle, `brake` presses the brake shoes of one
    that has them (`hh_exudyn.case.train`). With `free_rolling` nothing holds the speed after the start.
    `start_m` is the arc length of the vehicle's middle at the start, on the first straight. `extension` names
    a function that added Exudyn items to the vehicle of a run; it is written by that run.

    Raises
    ------
    CaseError
        For any unknown key or value that is not allowed, with key, value, unit and allowed range.
    """

    name: str = Field(min_length=1, json_schema_extra={"allowed": "a text"})
    vehicle: VehicleField = "iore_wagon_loaded"
    speed_km_h: float = number("km/h", 5, 130)
    friction: _Friction = Field(json_schema_extra={"allowed": "0.01 to 1, or a table [friction]"})
    wheel_profile: str = "S1002"
    wheel_profiles: WheelProfilesCase | None = None
    back_to_back_mm: float | None = number("mm", 800, 1650, None)
    track: TrackCase
    contact: ContactCase = ContactCase()
    integration: IntegrationCase = IntegrationCase()
    traction: TractionCase | None = None
    steering: SteeringCase | None = None
    train: TrainCase | None = None
    brake: BrakeCase | None = None
    free_rolling: bool = False
    start_m: float | None = number("m", 0, 1_000_000, None)
    extension: str | None = None

    if not TYPE_CHECKING:  # type checkers keep the signature made from the fields

        def __init__(self, /, **data: Any) -> None:
            try:
                super().__init__(**data)
            except ValidationError as error:
                raise CaseError(explain(error, Case)) from None

    @field_validator("name")
    @classmethod
    def _check_name(cls, value: str) -> str:
        if not (value.isprintable() and value.strip()):
            raise ValueError("allowed a text of one line without control characters")
        return value

    @field_validator("vehicle", mode="before")
    @classmethod
    def _resolve_vehicle(cls, value: Any) -> Any:
        return resolved(value)

    @field_validator("wheel_profile")
    @classmethod
    def _check_wheel_profile(cls, value: str) -> str:
        read_wheel(value)
        return value

    @model_validator(mode="after")
    def _check_track(self) -> Self:
        """The vehicle fits on the track, no gauge jams the wheelset, and the sections follow each other."""
        sections = self.track.sections or ()
        largest = self.track.nominal_gauge_mm + WIDENING_MM
        allowed = (
            f"allowed above {self.least_gauge * 1000:.1f} up to {largest:g} mm with wheel profile "
            f"{self.wheel_profile}"
        )
        for i, section in enumerate(sections):
            for gauge in gauges_mm(section):
                if gauge <= self.least_gauge * 1000:
                    raise ValueError(
                        f"track.sections[{i}].gauge_mm = {gauge:g} mm leaves no flange clearance: {allowed}"
                    )
                if gauge > largest:
                    raise ValueError(f"track.sections[{i}].gauge_mm = {gauge:g} mm is too wide: {allowed}")
        nominal = self.track.nominal_gauge_mm
        if not _PLAY_MM[0] <= nominal - 1000 * self.back_to_back <= _PLAY_MM[1]:
            raise ValueError(
                f"back_to_back_mm = {self.back_to_back_mm:g} mm: allowed {nominal - _PLAY_MM[1]:g} to "
                f"{nominal - _PLAY_MM[0]:g} mm for track.nominal_gauge_mm = {nominal:g} mm"
            )
        key = f"track.{self.track.alignment_key}"
        try:
            alignment = self.alignment()
        except ValueError as error:
            raise ValueError(f"{key}: {error}") from None
        if alignment.length < SHORTEST_TRACK_M:
            raise ValueError(
                f"{key}: length {alignment.length:g} m in all: allowed from {SHORTEST_TRACK_M:g} m, "
                "so that the vehicle fits"
            )
        # blended kinks of gauge ramps overshoot by micrometres
        narrow, wide = (round(1000 * float(end(alignment.table.gauge)), 1) for end in (np.min, np.max))
        if not (sections or self.least_gauge * 1000 < narrow <= wide <= largest):
            raise ValueError(f"{key}: gauge is {narrow:g} to {wide:g} mm: {allowed}")
        return self

    @model_validator(mode="after")
    def _check_friction(self) -> Self:
        """Friction sections lie on the track, and the vehicle has the lubricated wheelsets."""
        if isinstance(self.friction, FrictionCase):
            end = self.alignment().length
            for i, section in enumerate(self.friction.sections):
                if section.start_m >= end:
                    raise ValueError(
                        f"friction.sections[{i}].start_m = {section.start_m:g} m: allowed below {end:g} m, "
                        "the length of the track"
                    )
            if self.friction.lubricated_wheelsets:
                self.friction_table(len(self.described_vehicle().wheelsets))
        return self

    @model_validator(mode="after")
    def _check_drives(self) -> Self:
        """Only a vehicle with drives has a driver and steering actuators."""
        if self.traction is not None or self.steering is not None:
            require_drives(self.described_vehicle(), self.traction, self.steering)
        return self

    @model_validator(mode="after")
    def _check_hauled(self) -> Self:
        """The vehicle has both couplers for the force of a train, and the braked wheels."""
        if self.train is not None:
            self.train.require_through(self.described_vehicle())
        if self.brake is not None:
            self.brake.thrusts(self.described_vehicle())
        if self.free_rolling and (self.train is not None or self.described_vehicle().drives):
            raise ValueError("free_rolling = true: allowed without train, for a vehicle without drives")
        return self

    @property
    def traction_or_default(self) -> TractionCase:
        """The driver of a vehicle with drives."""
        return TractionCase() if self.traction is None else self.traction

    @property
    def speed(self) -> float:
        """Speed of the vehicle [m/s]."""
        return self.speed_km_h / 3.6

    @property
    def wheel(self) -> Profile:
        """The wheel profile in side coordinates."""
        return read_wheel(self.wheel_profile)

    def wheels(self, wheelsets: int) -> list[tuple[Profile, Profile]]:
        """Left and right wheel profile of every wheelset. Raises ValueError for a wheelset too many."""
        names = wheel_names(self.wheel_profiles, self.wheel_profile, wheelsets)
        read = {name: read_wheel(name) for pair in names for name in pair}
        return [(read[left], read[right]) for left, right in names]

    @property
    def least_gauge(self) -> float:
        """The gauge with zero flange clearance of the wheelset that needs most [m]."""
        wheelsets = 1 if self.wheel_profiles is None else len(self.described_vehicle().wheelsets)
        names = wheel_names(self.wheel_profiles, self.wheel_profile, wheelsets)
        return self.back_to_back + widest_flanges(names)

    @property
    def back_to_back(self) -> float:
        """Distance of the flange backs [m]: as given, else narrower than the nominal gauge by 75 mm (UIC
        510-2)."""
        if self.back_to_back_mm is not None:
            return self.back_to_back_mm / 1000
        return BACK_TO_BACK + (self.track.nominal_gauge_mm / 1000 - NOMINAL_GAUGE)

    def alignment(self) -> Alignment:
        """The track's alignment in SI."""
        return self.track.aligned()

    def friction_table(self, wheelsets: int) -> FrictionTable:
        """Friction of every patch of the run, for a vehicle with that many wheelsets.

        Raises
        ------
        ValueError
            The vehicle does not have a lubricated wheelset.
        """
        if isinstance(self.friction, FrictionCase):
            return self.friction.table(wheelsets)
        return constant_friction([[self.friction, self.friction]] * wheelsets)

    def film_table(self, wheelsets: int) -> FrictionTable:
        """The films of lubricant that treatments leave, by place, wheel and zone, as numbers in
        `hh_exudyn.contact.friction.FILMS`.

        Raises ValueError as `friction_table`.

        Parameters
        ----------
        wheelsets : int
            Of the vehicle.
        """
        if isinstance(self.friction, FrictionCase):
            return self.friction.film_table(wheelsets)
        return constant_friction(np.zeros((wheelsets, 2)))  # all dry

    def described_vehicle(self) -> Vehicle:
        """The description of the vehicle, that of the catalogue or of a variant."""
        return described(self.vehicle)

    def contact_model(self, vehicle: Vehicle | None = None) -> WheelRailModel:
        """The contact of every wheel of the run, for the run and for computations on its logged patches.

        Parameters
        ----------
        vehicle : Vehicle or None
            The vehicle with its wheel radius; None: the case's own.

        Raises
        ------
        ValueError
            The wheels of the vehicle differ in radius, or the theory is "given" and the vehicle states none.
        """
        vehicle = vehicle or self.described_vehicle()
        radii = {wheelset.radius for wheelset in vehicle.wheelsets}
        if len(radii) > 1:
            raise ValueError(f"vehicle {vehicle.name}: wheel radii {sorted(radii)} m must be equal")
        if self.contact.theory == "given":
            if vehicle.contact is None:
                raise ValueError(f"contact.theory = 'given': vehicle {vehicle.name} states no contact")
            stated = vehicle.contact
            return given_contact_model(
                GivenCreep(stated.longitudinal, stated.lateral, stated.conicity),
                stated.half_distance,
                radii.pop(),
                self.contact.damping_s_per_m,
            )
        model = wheel_rail_model(
            self.wheel,
            self.wheel,
            self.track.rail_course(LEFT),
            self.track.rail_course(RIGHT),
            nominal_radius=radii.pop(),
            back_to_back=self.back_to_back,
            damping=self.contact.damping_s_per_m,
            normal=self.contact.normal,
            theory=self.contact.theory,
            cells=self.contact.cells,
            material=self.contact.material,
            smoothing=self.contact.profile_smoothing_mm / 1000,
        )
        if self.wheel_profiles is None:
            return model
        smoothing = self.contact.profile_smoothing_mm / 1000
        return with_wheels(model, self.wheels(len(vehicle.wheelsets)), smoothing)

    def mirrored(self) -> "Case":
        """The same case with left and right exchanged."""
        wheels = None if self.wheel_profiles is None else self.wheel_profiles.mirrored()
        return self.with_changes(
            wheel_profiles=None
        ).with_changes(  # in place of the table, not merged with it
            track=self.track.mirrored(),
            wheel_profiles=wheels,
            friction=self.friction.mirrored() if isinstance(self.friction, FrictionCase) else self.friction,
        )

    def with_changes(self, /, **changes: Any) -> "Case":
        """A changed copy, checked again.

        A table is changed key by key: ``case.with_changes(friction=0.3, track={"flexibility": "rigid"})``.
        """
        here = self.model_dump()
        if "normal" not in self.contact.model_fields_set:  # it follows from the tangential theory
            del here["contact"]["normal"]
        return Case(**_merged(here, changes))

    def to_toml(self) -> str:
        """The case as TOML; `read_case` gives an equal case."""
        return tomli_w.dumps(self.model_dump(exclude_none=True))

    @classmethod
    def from_toml(cls, text: str | bytes, source: str = "case", folder: Path | None = None) -> "Case":
        """A case from TOML text.

        Parameters
        ----------
        text
            The TOML document; bytes are UTF-8.
        source
            Name of the file, for error messages.
        folder
            Start of the relative paths; the working directory if None.

        Raises
        ------
        CaseError
            One line with file, key, value, unit and what is allowed.
        """
        try:
            data = parsed_toml(text, source)
        except ValueError as error:
            raise CaseError(str(error)) from None
        if folder is not None:
            start_at(folder, data)
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
        data = read_bytes(path, _LARGEST_FILE)
    except ValueError as error:
        raise CaseError(str(error)) from None
    return Case.from_toml(data, source=str(path), folder=path.parent)


def _merged(old: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """`old` with `changes`, tables merged key by key."""
    new = dict(old)
    for key, value in changes.items():
        if isinstance(value, BaseModel):
            value = value.model_dump()
        both = isinstance(value, dict) and isinstance(old.get(key), dict)
        new[key] = _merged(old[key], value) if both else value
    return new
