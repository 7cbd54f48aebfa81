"""The rail of the Manchester contact benchmark (Shackleton, Iwnicki 2006), built from its measures.

A UIC60 head inclined 1:40. It differs from EN 13674-1's 60E1 in where its arcs of 300, 80 and 13 mm join: the
crown ends 10.5 mm off the middle (60E1: 10.228 mm), and the corner runs into the flank of 1:20 at 36 mm, half
the head's width. That makes the gauge corner stand up to 0.04 mm higher. The measures were found from the
benchmark's file MBench_UIC60_v3.prr: all its points lie within 0.03 um of these arcs and flanks.
"""

import math

from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.profiles.standard import RailHead, head_coordinates

CROWN, SHOULDER, CORNER = 300.0, 80.0, 13.0  # radii [mm]
CROWN_END, FLANK_START = 10.5, 36.0  # lateral positions [mm]
TOP = -0.00596  # lateral position of the highest point in the benchmark's coordinates [mm]
INCLINATION = 1 / 40


def manchester_rail(depth: float = 0.0165) -> Profile:
    """The head in the benchmark's coordinates, highest point at z = 0, down to `depth` below it [m]."""
    crown_angle = math.asin(CROWN_END / CROWN)
    shoulder_centre = CROWN_END - SHOULDER * math.sin(crown_angle)
    corner_centre = FLANK_START - CORNER * math.sin(math.atan(20.0))
    # the shoulder and the corner have a common tangent where they meet, so also a common normal
    sine = (corner_centre - shoulder_centre) / (SHOULDER - CORNER)
    head = RailHead((CROWN, SHOULDER, CORNER), (CROWN_END, shoulder_centre + SHOULDER * sine))
    y, z = head_coordinates(head)
    angle = math.atan(INCLINATION)
    leaning_y = y * math.cos(angle) + z * math.sin(angle)
    leaning_z = -y * math.sin(angle) + z * math.cos(angle)
    # the highest point lies on the crown, straight above its centre
    leaning_y += 1e-3 * (CROWN * math.sin(angle) + TOP)
    leaning_z -= 1e-3 * CROWN * (1.0 - math.cos(angle))
    head_only = leaning_z > -depth
    return Profile("Manchester UIC60 1:40", "rail", leaning_y[head_only], leaning_z[head_only])
