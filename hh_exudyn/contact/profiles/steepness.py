"""Steep spots of a flange or a gauge face: a table of heights holds slopes up to 5, and must not end at the
first.

A wheel whose slopes are all up to S cannot tell a rail from its envelope by lines of slope S,

    z_S(y) = max over y' of  z(y') - S |y - y'|                                                          (1)

(from below, with min and +, for a wheel on such a rail): it touches both at the same places. So where the
profile goes on behind a steep spot, the table is that of the envelope, which leaves the profile at the spot
alone: on a flange it stands out by up to (1/S - 1/slope) of the spot's height, 0.06 mm for 1.5 mm of 82
degrees. More than `LARGEST_SHIFT` is an error, as then both could be steep where they touch. The last flank
of a rail and the face of a rim, behind which nothing stands out, end the table as before.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profiles.profile import Profile

MAX_SLOPE = 5.0  # |dz/dy| of a table, 78.7 degrees: no wheel in service touches a steeper rail flank
LARGEST_SHIFT = 0.25e-3  # m, lateral, of an envelope from its profile

_GRID = 10e-6  # m
_TOUCHING = 1e-6  # m, height of an envelope over its profile where they are the same
_TOLERANCE = 50e-6  # m of height, 10 um across: a flank that waves by less ends the table
_REACH = 0.040  # m below a rail's top: no flange reaches farther


def goes_on(profile: Profile, y: FloatArray, z: FloatArray, first: int, last: int) -> bool:
    """Whether something of the curve beyond a table can be touched by a profile no steeper than `MAX_SLOPE`.

    Parameters
    ----------
    profile : Profile
        Wheel or rail.
    y, z : FloatArray
        (n,) the curve from the field side on [m].
    first, last : int
        Indices of the ends of the table.
    """
    if profile.kind == "wheel":
        tip = last + int(np.argmin(z[last:]))
        line = z[first] + MAX_SLOPE * (y[first] - y[:first])
        return tip > last or bool(np.any(z[:first] < line - _TOLERANCE))
    deepest = z.max() - _REACH
    before = z[first] - MAX_SLOPE * (y[first] - y[:first])
    behind = z[last] - MAX_SLOPE * (y[last + 1 :] - y[last])
    return any(
        bool(np.any((part > line + _TOLERANCE) & (part > deepest)))
        for part, line in ((z[:first], before), (z[last + 1 :], behind))
    )


def envelope(profile: Profile, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The envelope of a profile by lines of slope `MAX_SLOPE` (equation 1), as far as it touches the profile.

    Parameters
    ----------
    profile : Profile
        Wheel or rail, for its kind and for messages.
    y, z : FloatArray
        (n,) the curve from the field side on; of a wheel up to its flange tip [m].

    Raises
    ------
    ValueError
        The envelope lies more than `LARGEST_SHIFT` from the profile across.
    """
    if profile.kind == "wheel":
        end = int(np.argmin(np.where(y > 0.0, z, np.inf))) + 1
        y, z = y[:end], z[:end]
    forwards = np.maximum.accumulate(y)
    grid = np.linspace(forwards[0], forwards[-1], int(np.ceil((forwards[-1] - forwards[0]) / _GRID)) + 1)
    sign = 1.0 if profile.kind == "wheel" else -1.0
    height = sign * np.interp(grid, forwards, z)
    run = MAX_SLOPE * grid
    found = np.minimum(
        np.minimum.accumulate(height - run) + run, np.minimum.accumulate((height + run)[::-1])[::-1] - run
    )
    touching = np.flatnonzero(height - found < _TOUCHING)
    inside = slice(int(touching[0]), int(touching[-1]) + 1)
    grid, height, found = grid[inside], height[inside], found[inside]
    worst = int(np.argmax(height - found))
    shift = float(height[worst] - found[worst]) / MAX_SLOPE
    if shift > LARGEST_SHIFT:
        raise ValueError(
            f"{profile.kind} profile {profile.name!r} is steeper than 78.7 deg about "
            f"y = {1e3 * grid[worst]:.2f} mm, z = {1e3 * sign * height[worst]:.2f} mm and goes on behind: "
            f"a table without it lies {1e3 * shift:.2g} mm off, allowed {1e3 * LARGEST_SHIFT:g} mm"
        )
    return grid, sign * found
