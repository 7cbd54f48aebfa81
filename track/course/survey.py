"""Surveyed centre-line points: from a CSV table, and from latitude and longitude to metres."""

import math
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from track.course.sections import check
from track.csv_columns import read_columns

_SEMI_MAJOR = 6378137.0  # m, WGS 84
_FLATTENING = 1.0 / 298.257223563  # WGS 84
_LARGEST_EXTENT = 200e3  # m: lengths 1e5 m from the middle of the tangent plane are 1.2e-4 too short


def read_centre_line_csv(path: str | Path) -> FloatArray:
    """Points (n, 2) or (n, 3) in metres for `fit_centre_line`, in the order of the rows.

    Columns ``x_m``, ``y_m`` and perhaps ``z_m`` (any projected coordinates), or ``latitude_deg``,
    ``longitude_deg`` and perhaps ``height_m`` (WGS 84, as a satellite receiver gives them).

    Raises ValueError with line, name, value and what is allowed.
    """
    plane, globe = ("x_m", "y_m", "z_m"), ("latitude_deg", "longitude_deg", "height_m")
    rows = read_columns(path, (), (*plane, *globe))
    names = rows[0].fields
    if set(plane[:2]) <= set(names) <= set(plane):
        return np.array([[row.number(name, -1e8, 1e8) for name in plane if name in names] for row in rows])
    if not set(globe[:2]) <= set(names) <= set(globe):
        raise ValueError(
            f"{path}: columns are {', '.join(names)}, needed are either {', '.join(plane)} or "
            f"{', '.join(globe)} (the last one of each may be left out)"
        )
    xy = local_plane(
        np.array([row.number("latitude_deg", -89.0, 89.0) for row in rows]),
        np.array([row.number("longitude_deg", -180.0, 180.0) for row in rows]),
    )
    if "height_m" not in names:
        return xy
    return np.column_stack([xy, [row.number("height_m", -500.0, 6000.0) for row in rows]])


def local_plane(latitude: FloatArray, longitude: FloatArray) -> FloatArray:
    """East and north (n, 2) [m] in the plane that touches the WGS 84 ellipsoid in the middle of the points.

    Lengths are those at sea level: at 500 m above it the track is longer by 8e-5.

    Parameters
    ----------
    latitude, longitude : (n,) geodetic [deg]

    Raises
    ------
    ValueError
        Coordinates out of range, or points more than 200 km apart.
    """
    for name, values, limit in (("latitude", latitude, 89.0), ("longitude", longitude, 180.0)):
        for value in (values.min(), values.max()):
            check(name, float(value), (-limit, limit), "deg")
    if np.ptp(longitude) > 180.0:
        raise ValueError("longitude crosses 180 deg, allowed are points on one side of it")
    middle = [0.5 * (values.min() + values.max()) for values in (latitude, longitude)]
    centre = _geocentric(*(np.radians(np.array([value])) for value in middle))
    vector = _geocentric(np.radians(latitude), np.radians(longitude)) - centre
    lat, lon = (math.radians(value) for value in middle)
    east = np.array([-math.sin(lon), math.cos(lon), 0.0])
    north = np.array([-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat)])
    plane: FloatArray = np.column_stack([vector @ east, vector @ north])
    extent = float(np.hypot(*np.ptp(plane, axis=0)))
    if extent > _LARGEST_EXTENT:
        raise ValueError(f"extent of the points is {extent / 1e3:.0f} km, allowed are 200 km in one plane")
    return plane


def _geocentric(lat: FloatArray, lon: FloatArray) -> FloatArray:
    """Cartesian coordinates (n, 3) [m] of points on the ellipsoid at geodetic latitude, longitude [rad]."""
    square = _FLATTENING * (2.0 - _FLATTENING)  # of the eccentricity
    across = _SEMI_MAJOR / np.sqrt(1.0 - square * np.sin(lat) ** 2)  # radius of curvature, prime vertical
    return np.column_stack([
        across * np.cos(lat) * np.cos(lon),
        across * np.cos(lat) * np.sin(lon),
        across * (1.0 - square) * np.sin(lat),
    ])  # fmt: skip
