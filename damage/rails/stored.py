"""Sums of rails in files, by the form of those of the wheels (`damage.surface.stored`)."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from damage.rails.rail_surface import RailSurface
from damage.surface.stored import Arrays, BrokenFile, pack, parts_of, surface_of, unpack
from hh_exudyn.log.parts import write_bytes


def save_rail(rail: RailSurface, path: Path | str) -> None:
    """Write the sums of a rail into a file: afterwards it is complete, or was not touched.

    Raises
    ------
    OSError
        It cannot be written, for instance on a full disk.
    """
    write_bytes(Path(path), pack(*rail_parts(rail)))


def load_rail(path: Path | str) -> RailSurface:
    """Read the sums of a rail from a file.

    Raises
    ------
    FileNotFoundError
        There is none.
    BrokenFile
        It is not what was written, or of another version.
    """
    return rail_of(*unpack(Path(path).read_bytes(), str(path)), str(path))


def rail_parts(rail: RailSurface) -> tuple[dict[str, Any], Arrays]:
    """The sums of a rail as a header (of JSON) and arrays by name."""
    header, arrays = parts_of(rail.by_wheel)
    header |= {"rail": rail.side, "mass": rail.mass}
    return header, arrays | {"whole_life": rail.whole_life, "rolled": rail.rolled}


def rail_of(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], source: str) -> RailSurface:
    """The sums of a header and arrays, as `rail_parts` gives them.

    Parameters
    ----------
    header, arrays
        Of a rail.
    source
        Name of the file, for messages.

    Raises
    ------
    BrokenFile
        They are not those of a rail.
    """
    by_wheel = surface_of(header, arrays, source)
    try:
        empty = RailSurface.zero(int(header["rail"]), by_wheel.wheels, by_wheel.grid, by_wheel.patch_grid)
        own: dict[str, Any] = {name: np.asarray(arrays[name]) for name in ("whole_life", "rolled")}
        if any(values.shape != getattr(empty, name).shape for name, values in own.items()):
            raise ValueError("arrays that do not fit its wheels and bins")
        return replace(empty, by_wheel=by_wheel, mass=float(header["mass"]), **own)
    except (KeyError, TypeError, ValueError) as error:
        raise BrokenFile(f"{source}: holds no sums of a rail: {error}") from None
