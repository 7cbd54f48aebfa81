"""The vehicle of a case: a name of the catalogue, or a variant with all its changed numbers.

In a case file ``vehicle = "worn.toml"`` names a vehicle file (`vehicles.variants`); a table has the same
content::

    [vehicle]
    base = "iore_wagon_loaded"
    wedge = { friction = 0.35 }

Either way the `Case` has the numbers, not the file: later changes of the file change neither the case nor its
runs, as their ``case.toml`` has the table. A file with a whole vehicle remains a file: TOML
(`vehicles.whole`), or JSON (`vehicles.stored`) as in the folder of a run, whose ``case.toml`` refers to it.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import ConfigDict, Discriminator, Field, Tag, model_validator

from hh_exudyn.case.fields import CaseTable, from_folder
from vehicles.description import Vehicle
from vehicles.stored import VEHICLE_SUFFIX, origin_of, read_vehicle
from vehicles.variants import Variant, find_variant, is_vehicle_file, read_variant, variant_of_table
from vehicles.whole.file import is_whole_file, read_whole
from vehicles.whole.reading import is_whole


class ChangedNumber(CaseTable):
    """A changed number of a vehicle."""

    value: float
    unit: str
    source: str


class VehicleCase(CaseTable):
    """A variant: name, base in the catalogue, and a table of changed numbers for each part."""

    model_config = ConfigDict(frozen=True, extra="allow", strict=True, allow_inf_nan=False)
    __pydantic_extra__: dict[str, dict[str, ChangedNumber]]

    name: str
    base: str
    description: str = ""

    @model_validator(mode="before")
    @classmethod
    def _resolve(cls, data: Any) -> Any:
        """A base that is a file, and numbers without unit and source, become a full table."""
        if not isinstance(data, Mapping):
            return data
        named = {"name": "variant", **data}
        return variant_of_table(named, "case").to_table()

    def variant(self) -> Variant:
        """The table as a `Variant`."""
        return variant_of_table(self.model_dump(), "case")

    @classmethod
    def of(cls, variant: Variant) -> Self:
        """The table of a variant."""
        return cls(**variant.to_table())


def _name_or_table(value: Any) -> str:
    return "table" if isinstance(value, Mapping | VehicleCase) else "name"


VehicleField = Annotated[
    Annotated[str, Tag("name")] | Annotated[VehicleCase, Tag("table")],
    Discriminator(_name_or_table),
    Field(json_schema_extra={"allowed": "a name of the catalogue, a vehicle file, or a table [vehicle]"}),
]


def resolved(value: Any) -> Any:
    """The table of a vehicle file; a name of the catalogue unchanged.

    Raises
    ------
    ValueError
        An unknown name, or a faulty file.
    """
    if not isinstance(value, str):
        return value
    if not is_vehicle_file(value):
        find_variant(value)
    elif is_stored(value):
        read_vehicle(value)
    elif is_whole_file(value):
        read_whole(value)
    else:
        return read_variant(value).to_table()
    return value


def is_stored(value: Any) -> bool:
    """Whether the vehicle of a case is the path of a file as the folder of a run has it."""
    return isinstance(value, str) and value.endswith(VEHICLE_SUFFIX)


def described(value: str | VehicleCase) -> Vehicle:
    """The description that a run uses."""
    if isinstance(value, str) and is_stored(value):
        return read_vehicle(value)
    return (find_variant(value) if isinstance(value, str) else value.variant()).vehicle()


def variant_behind(value: str | VehicleCase) -> Variant | None:
    """The variant of a case's vehicle, with its sourced numbers; None for a vehicle built otherwise.

    A stored vehicle has the one that it was built from, if that still has the same numbers.
    """
    if isinstance(value, VehicleCase):
        return value.variant()
    if not is_stored(value):
        return find_variant(value)
    origin = origin_of(value)
    if origin is None:
        return None
    if is_whole(origin):
        return find_variant(value)
    try:
        variant = variant_of_table(origin, "case")
        return variant if variant.vehicle() == read_vehicle(value) else None
    except ValueError:  # of another version of the catalogue
        return None


def start_in(folder: Path, data: dict[str, Any]) -> None:
    """Make the paths of vehicle files in a raw case start at its folder."""
    value = data.get("vehicle")
    table, key = (value, "base") if isinstance(value, dict) else (data, "vehicle")
    if isinstance(table.get(key), str) and is_vehicle_file(table[key]):
        from_folder(table, folder, key)
