"""Surfaces in files: numpy's npz, with the version of the form and a checksum of everything in it.

`pack` gives the same bytes for the same arrays, on every machine: files can be compared by content. A file
that was changed, cut off or half written is refused (`BrokenFile`), never read as other numbers.
"""

import hashlib
import io
import json
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from damage.surface.lateral_grid import LateralGrid, PatchGrid, ProfileArc
from damage.surface.wheel_surface import Wheel, WheelSurface
from hh_exudyn.log.parts import write_bytes

VERSION = 2  # of the form; files of others are refused
_HEADER = "header"
_ARRAYS = tuple(field.name for field in fields(WheelSurface) if field.type == NDArray[np.float64])
_UNREADABLE = (  # what a file cut off or with flipped bits may raise, the last one for an unknown flag
    *(OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error),
    NotImplementedError,
)
_LEVEL = 1  # of compression: most bins are zero, and higher levels take longer for little

Arrays = dict[str, NDArray[Any]]


class BrokenFile(ValueError):
    """A file is not what was written, or of another version; the message says file and reason."""


def save(surface: WheelSurface, path: Path | str) -> None:
    """Write a surface into a file: afterwards it is complete, or was not touched.

    Raises
    ------
    OSError
        It cannot be written, for instance on a full disk.
    """
    header, arrays = parts_of(surface)
    write_bytes(Path(path), pack(header, arrays))


def load(path: Path | str) -> WheelSurface:
    """Read a surface from a file.

    Raises
    ------
    FileNotFoundError
        There is none.
    BrokenFile
        It is not what was written, or of another version.
    """
    header, arrays = unpack(Path(path).read_bytes(), str(path))
    return surface_of(header, arrays, str(path))


def parts_of(surface: WheelSurface) -> tuple[dict[str, Any], Arrays]:
    """A surface as a header (JSON: grids, wheels, rows, time, distance) and arrays by name."""
    arrays: Arrays = {name: getattr(surface, name) for name in _ARRAYS}
    arc = surface.grid.profile_arc
    if arc is not None:
        arrays |= {"profile_y": arc.y, "profile_arc": arc.arc}
    grid = {"start": surface.grid.start, "step": surface.grid.step, "count": surface.grid.count}
    header = {
        "grid": grid,
        "patch_grid": asdict(surface.patch_grid),
        "wheels": [list(wheel) for wheel in surface.wheels],
        "rows": surface.rows,
        "time": surface.time,
        "distance": surface.distance,
    }
    return header, arrays


def surface_of(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], source: str) -> WheelSurface:
    """The surface of a header and arrays, as `parts_of` gives them.

    Parameters
    ----------
    header, arrays
        Of a surface.
    source
        Name of the file, for messages.

    Raises
    ------
    BrokenFile
        They are not those of a surface.
    """
    try:
        along = "profile_y" in arrays
        arc = ProfileArc(arrays["profile_y"], arrays["profile_arc"]) if along else None
        empty = WheelSurface.zero(
            tuple(Wheel(*map(int, wheel)) for wheel in header["wheels"]),
            LateralGrid(**header["grid"], profile_arc=arc),
            PatchGrid(**header["patch_grid"]),
        )
        sums = {name: arrays[name] for name in _ARRAYS}
        if any(values.shape != getattr(empty, name).shape for name, values in sums.items()):
            raise ValueError("arrays that do not fit its wheels and grids")
        return WheelSurface(
            grid=empty.grid,
            patch_grid=empty.patch_grid,
            wheels=empty.wheels,
            rows=int(header["rows"]),
            time=float(header["time"]),
            distance=float(header["distance"]),
            **sums,
        )
    except (KeyError, TypeError, ValueError) as error:
        raise BrokenFile(f"{source}: holds no surface: {error}") from None


def pack(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Content of a file of a header (of JSON) and arrays: the same bytes for the same values.

    Parameters
    ----------
    header
        Values of JSON; numbers that are finite.
    arrays
        By name.
    """
    whole = {"version": VERSION, "checksum": _checksum(header, arrays), "content": dict(header)}
    text = json.dumps(whole, sort_keys=True, allow_nan=False).encode()
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=_LEVEL) as archive:
        for name, values in {_HEADER: np.frombuffer(text, dtype=np.uint8), **arrays}.items():
            entry = zipfile.ZipInfo(f"{name}.npy")  # of 1980: the time of writing is no content
            entry.compress_type = zipfile.ZIP_DEFLATED
            member = io.BytesIO()
            np.lib.format.write_array(member, np.ascontiguousarray(values), allow_pickle=False)
            archive.writestr(entry, member.getvalue(), compresslevel=_LEVEL)
    return stream.getvalue()


def unpack(content: bytes, source: str) -> tuple[dict[str, Any], Arrays]:
    """Header and arrays of the content of a file.

    Parameters
    ----------
    content
        All of the file.
    source
        Its name, for messages.

    Raises
    ------
    BrokenFile
        It is not what `pack` gave, or of another version.
    """
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files if name != _HEADER}
            whole = json.loads(archive[_HEADER].tobytes().decode())
        version, checksum, header = whole["version"], whole["checksum"], dict(whole["content"])
    except _UNREADABLE as error:
        reason = " ".join(str(error).split())[:160]
        raise BrokenFile(f"{source}: cannot be read ({reason})") from None
    if version != VERSION:
        raise BrokenFile(f"{source}: is of version {version}, allowed is {VERSION}")
    if checksum != _checksum(header, arrays):
        raise BrokenFile(f"{source}: its checksum is not that of its content")
    return header, arrays


def _checksum(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> str:
    """SHA-256 over header and arrays, with their types and shapes."""
    digest = hashlib.sha256(json.dumps(dict(header), sort_keys=True).encode())
    for name in sorted(arrays):
        values = np.ascontiguousarray(arrays[name])
        digest.update(f"{name}{values.dtype.str}{values.shape}".encode())
        digest.update(values.tobytes())
    return digest.hexdigest()
