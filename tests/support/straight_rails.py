"""Rails that run along the track frame, and empty results, as the contact kernel takes them."""

import numpy as np

from hh_exudyn.contact.geometry.rail_tables import gauge_point_at
from hh_exudyn.contact.state import PATCH_COLUMNS
from hh_exudyn.contact.strips.table import CAPACITY
from hh_exudyn.contact.types import MAX_PATCHES, ContactForces, RailMotion, WheelRailModel


def straight_rails(
    model: WheelRailModel,
    gauge: np.ndarray,
    arc_length: np.ndarray | None = None,
    displacement: np.ndarray | float = 0.0,
    velocity: np.ndarray | None = None,
) -> RailMotion:
    """Rails at a gauge (n,) [m], displaced by (n, 2, 2) [m] and moving with (n, 2, 2) [m/s]."""
    n = len(gauge)
    places = np.zeros(n) if arc_length is None else np.asarray(arc_length, dtype=float)
    points = [[gauge_point_at(rails, s) for rails in (model.rails_left, model.rails_right)] for s in places]
    position = np.zeros((n, 2, 2))
    position[:, :, 0] = (0.5 * np.asarray(gauge)[:, None] + np.array(points)) * [1.0, -1.0]
    return RailMotion(
        arc_length=places,
        position=position + displacement,
        rotation=np.tile(np.eye(3), (n, 2, 1, 1)),
        turn=np.zeros((n, 3)),
        velocity=np.zeros((n, 2, 2)) if velocity is None else velocity,
    )


def no_forces(n: int, fill: float = np.nan) -> ContactForces:
    """Results that the kernel must overwrite."""
    return ContactForces(
        wrench=np.full((n, 6), fill),
        rail_force=np.full((n, 2, 2), fill),
        patches=np.full((n, 2, MAX_PATCHES, PATCH_COLUMNS), fill),
        in_contact=np.zeros((n, 2, CAPACITY)),
        refine=np.ones(1),
    )
