"""Surface-initiated rolling contact fatigue: the surface fatigue index of a contact state.

Ekberg, Kabo and Andersson (2002); Hossein-Nia (2018), equation 3.16 and figures 3-14 to 3-17.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FLANGE_ANGLE = math.radians(15.0)
"""Contact angle above which a contact counts as flange contact, flange root included [rad]. Treads stay
below 10 degrees; S1002 reaches 15 degrees 27 mm from the running circle, at the root of the flange. Flange
cells hold no fluid and grow no cracks, so they are reported apart. The value is this project's choice."""


def surface_fatigue_index(
    force_x: ArrayLike,
    force_y: ArrayLike,
    normal_force: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    shear_yield: float,
) -> NDArray[np.float64]:
    """Surface fatigue index FI_surf [-]: horizontal distance of the working point to the surface limit.

    Above zero the working point lies beyond shakedown (ratchetting). A contact without normal force has
    index -infinity, the limit of the formula for a vanishing load.

    Parameters
    ----------
    force_x, force_y
        Creep forces [N].
    normal_force
        Normal force [N], >= 0.
    a, b
        Semi-axes of the patch [m].
    shear_yield
        Yield strength in pure shear k [Pa], > 0.

    Raises
    ------
    ValueError
        Values outside these ranges.
    """
    if not (math.isfinite(shear_yield) and shear_yield > 0.0):
        raise ValueError(f"shear_yield = {shear_yield} Pa must be finite and > 0 Pa")
    normal = np.asarray(normal_force, dtype=np.float64)
    if not np.all(normal >= 0.0):  # also catches NaN
        raise ValueError(f"normal_force must be >= 0 N; {np.count_nonzero(~(normal >= 0.0))} values are not")
    tangential = np.hypot(np.asarray(force_x, dtype=np.float64), np.asarray(force_y, dtype=np.float64))
    bearing = 2.0 / 3.0 * math.pi * np.asarray(a, dtype=np.float64) * np.asarray(b, dtype=np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):
        index = (tangential - bearing * shear_yield) / normal  # (3.16)
    return np.where(normal > 0.0, index, -np.inf)
