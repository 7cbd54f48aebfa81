"""Contact states as points of the shakedown diagram: utilised friction Q/P and relative pressure p0/k."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from damage.bounds import check_above_zero
from damage.log_input.bad_rows import BadRows
from damage.log_input.contact_source import ContactSource
from damage.log_input.contact_states import DAMAGE_COLUMNS, contact_chunks


@dataclass(frozen=True)
class WorkingPoints:
    """Working points of contact states in the shakedown diagram, one entry per row of the log.

    Attributes
    ----------
    utilised_friction
        Q/P = sqrt(force_x^2 + force_y^2) / normal_force [-].
    relative_pressure
        p0/k [-].
    flange
        True where the contact angle exceeds the flange angle.
    """

    utilised_friction: NDArray[np.float64]
    relative_pressure: NDArray[np.float64]
    flange: NDArray[np.bool_]


def working_point(
    force_x: ArrayLike,
    force_y: ArrayLike,
    normal_force: ArrayLike,
    max_pressure: ArrayLike,
    shear_yield: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Place of contact states in the shakedown diagram.

    Parameters
    ----------
    force_x, force_y
        Creep forces [N].
    normal_force
        Normal force [N], >= 0; a contact without normal force has Q/P = 0.
    max_pressure
        Hertz pressure p0 [Pa].
    shear_yield
        Yield strength in pure shear k [Pa], > 0.

    Returns
    -------
    utilised friction Q/P [-], relative pressure p0/k [-]
    """
    check_above_zero("shear_yield", shear_yield, "Pa")
    normal = np.asarray(normal_force, dtype=np.float64)
    tangential = np.hypot(np.asarray(force_x, dtype=np.float64), np.asarray(force_y, dtype=np.float64))
    loaded = normal > 0.0
    utilised = np.where(loaded, tangential, 0.0) / np.where(loaded, normal, 1.0)
    return utilised, np.asarray(max_pressure, dtype=np.float64) / shear_yield


def working_points(
    source: ContactSource, shear_yield: float, flange_angle: float, skip_bad_rows: bool = False
) -> WorkingPoints:
    """Working points of a whole contact log.

    Parameters
    ----------
    source
        A run, its directory, or a contact log as a table.
    shear_yield
        Yield strength in pure shear k [Pa].
    flange_angle
        Contact angle above which a contact is on the flange [rad].
    skip_bad_rows
        Impossible rows are skipped, the same as in `damage.surface.accumulate`; otherwise they raise.
    """
    wanted = ("time", "force_x", "force_y", "normal_force", "p_max", "contact_angle")
    columns = DAMAGE_COLUMNS if skip_bad_rows else wanted  # a row may be bad in any of them
    bad_rows = BadRows() if skip_bad_rows else None
    utilised, pressure, flange = [], [], []
    for chunk in contact_chunks(source, columns, bad_rows=bad_rows):
        point = working_point(
            chunk["force_x"], chunk["force_y"], chunk["normal_force"], chunk["p_max"], shear_yield
        )
        utilised.append(point[0])
        pressure.append(point[1])
        flange.append(chunk["contact_angle"] > flange_angle)
    if not utilised:
        return WorkingPoints(np.empty(0), np.empty(0), np.empty(0, dtype=np.bool_))
    return WorkingPoints(np.concatenate(utilised), np.concatenate(pressure), np.concatenate(flange))
