"""Shakedown: limits of the load of a rolling contact, and contact states in the shakedown diagram.

==================================  ======================================================================
`damage.shakedown.line_contact`     limits of line contact, in full slip and in partial slip
`damage.shakedown.stress_circle`    their construction: a circle around the stresses of all depths
`damage.shakedown.circle`           the smallest circle around points of the plane
`damage.shakedown.point_contact`    limit of point contact in full slip
`damage.shakedown.working_points`   contact states in the diagram of Q/P and p0/k
==================================  ======================================================================
"""

from damage.shakedown.line_contact import partial_slip_limit, partial_slip_surface_limit, shakedown_limit
from damage.shakedown.point_contact import point_contact_limit
from damage.shakedown.stress_circle import StressCircle, stress_circle
from damage.shakedown.working_points import WorkingPoints, working_point, working_points

__all__ = [
    "StressCircle",
    "WorkingPoints",
    "partial_slip_limit",
    "partial_slip_surface_limit",
    "point_contact_limit",
    "shakedown_limit",
    "stress_circle",
    "working_point",
    "working_points",
]
