"""Frames, signs and units of all modules.

Units: SI in all computations. Millimetres, km/h and kN are for files, command line and plots only, with the
unit in the name (``speed_km_h``, ``gauge_mm``).

Frames, all right-handed:

* Global frame: inertial, the track starts at its origin along +X, +Y to the left, +Z up.
* Track frame T at arc length s: x along the track forward, y to the LEFT, z UP; z = 0 is the running
  plane through the two rail tops at nominal gauge.
* Rail frame R of each rail: x along this rail, T turned by irregularity, ramps and deflection
  (`track.course.rail_frame`).
* Wheelset frame: y along the axle to the left; the wheelset's pitch axis is y, forward rolling has a
  positive angular velocity about y.
* Contact frame C: x rolling direction, z the normal from the rail into the wheel, y completes it.
* Profiles are stored once, in side coordinates: y positive TOWARDS THE TRACK CENTRE, z up. A wheel's
  origin is its nominal running circle, `FLANGE_BACK_TO_RUNNING_CIRCLE` from the flange back (the flange
  lies at positive y); a rail's highest point has z = 0.

Signs: the left side is `LEFT` = +1, the right `RIGHT` = -1. Creepages are the velocity of the wheel
relative to the rail over the speed; forces given by the library act ON THE WHEEL, so force = -C creepage.
`Q` (vertical) and `Y` (lateral, positive outwards, that is away from the track centre) are the forces of
one wheel ON THE RAIL in the track plane, as in EN 14363. Left-hand curves have positive curvature. The cant
of a curve is positive where its outer rail is higher; the signed cant of alignment tables and the cross-level
are positive where the RIGHT rail is higher.
"""

GRAVITY = 9.81  # m/s^2
LEFT = 1
RIGHT = -1

NOMINAL_GAUGE = 1.435  # m, EN 15302
GAUGE_MEASURING_DEPTH = 0.014  # m below the running plane, EN 13848-1
RAIL_TOP_DISTANCE = 1.500  # m, lateral distance of the rail tops that cant refers to, EN 13848-1
FLANGE_BACK_TO_RUNNING_CIRCLE = 0.070  # m, UIC 510-2
BACK_TO_BACK = 1.360  # m, UIC 510-2, nominal distance of the flange backs
