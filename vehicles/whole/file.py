"""A file with a whole vehicle: TOML by hand or export (`reading`), or JSON, the copy in a run's folder."""

from functools import lru_cache
from pathlib import Path

from hh_exudyn.text_files import parsed_toml, read_bytes
from vehicles.stored import VEHICLE_SUFFIX, from_json, origin_in
from vehicles.whole.document import Document
from vehicles.whole.export import document_of
from vehicles.whole.reading import NO_SOURCE, is_whole, read_tables


def is_whole_file(path: str | Path) -> bool:
    """Whether a vehicle file holds a whole vehicle, not a variant of another one.

    Raises
    ------
    ValueError
        It cannot be read, or is not TOML.
    """
    return str(path).endswith(VEHICLE_SUFFIX) or is_whole(parsed_toml(read_bytes(path), str(path)))


def read_whole(path: str | Path) -> Document:
    """The document in a file with a whole vehicle.

    Raises
    ------
    ValueError
        One line that begins with the file: it cannot be read, or is no valid vehicle.
    """
    path = Path(path)
    content = read_bytes(path)
    read = _of_json if path.suffix == VEHICLE_SUFFIX else _of_toml
    try:
        return read(content, path.stem)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


@lru_cache(maxsize=8)  # the numbers of a vehicle are asked for many times
def _of_toml(content: bytes, name: str) -> Document:
    tables = parsed_toml(content, f"{name}.toml")
    if "base" in tables:
        raise ValueError("has base and bodies: allowed one of them, a variant or a whole vehicle")
    return read_tables(tables, name)


@lru_cache(maxsize=8)
def _of_json(content: bytes, name: str) -> Document:
    """The document in a run's folder: the one that the vehicle was written in, if it is the same."""
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise ValueError(f"not UTF-8 at byte {error.start}") from None
    vehicle = from_json(text)
    origin = origin_in(text)
    if origin is not None and is_whole(origin):
        document = read_tables(origin, name)
        if document.vehicle() == vehicle:
            return document
    return document_of(vehicle, NO_SOURCE)
