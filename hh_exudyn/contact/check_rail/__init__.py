"""The back of a flange on a check rail: the same strips, laid across the check rail's face.

A check rail (guard rail, restraining rail) stands beside the inner rail of a tight curve, a flangeway towards
the track centre. It holds the back of the inner wheel's flange, and with it the outer wheel's flange from its
rail.

==================  =================================================================================
`table`             check rail and flange back: descriptions, numbers of the kernels
`overlap`           overlap of the flange back with the face, slice by slice along the rail (kernels)
`forces`            loads, friction and wrench of a wheel on its check rail (kernel)
==================  =================================================================================

**Shape.** The back of a wheel is a plane across the axle that ends at its rim in an arc, R 20.5 mm on S1002
(EN 13715; `contact.profiles.standard`), upright at 9.5 mm below the tread and 18.5 mm above the flange tip.
The check rail's face is upright and ends at its top in an arc. With an angle of attack the back does not
touch below the axle: of the wheel only what dips below the upper end of the face counts, a chord of half
length sqrt(2 R d) with the depth d of the flange tip below it - 0.18 m for 35 mm - and the face meets its
leading end where the wheelset runs against the curve. With a check rail 20 mm above the running rail and 10
mrad the wheelset is stopped 1.3 mm earlier than a straight one, by a force 0.135 m ahead of the axle.

**Overlap.** The face is cut into slices along the rail, some 2.5 mm each. A point p of the face lies inside
the wheel by

    d = (p - c).l - t - recess(r),   r^2 = |p - c|^2 - ((p - c).l)^2,                                    (1)

c the wheelset's centre, l along its axle to this side, t half the distance of the flange backs. A slice has
the largest d over its height, which is unique as arc and recess are convex; yaw, roll, the curve of the rail
and the flare of the check rail's ends are in p, so the chord is not a formula but what comes out.

**Loads.** The slices are strips of `contact.strips`, with their length up the face and the arc's curvature
there: one linear complementarity problem of two half-spaces, continuous where contact widens from one end of
the chord (an angle of attack) to all of it (none). Check rail, fastening and wheel disc yield by more than
the half-spaces: their compliance is added to every influence.

**Friction.** The back slides: by its height over the running rail 1 to 2 % along the rail, and where it
touches ahead of the axle with x/R = 30 % of the speed downwards. Adhesion ends at some 0.5 %. So friction is
Coulomb's, against the slip of each slice, and loses its direction only below a creepage of 0.2 %. Ahead of
the axle it lifts the wheel, which unloads its running rail, and turns the wheelset.

**Limits.** The check rail moves with its running rail and loads the track where that does; its twist is left
out. The back is the standard one on every profile (it hardly wears), at the height of the profile's own
flange tip. Shapes are new ones: 50 kN at 10 mrad give 4 GPa, which steel does not bear, and which wears in.
Damage of flange backs is not computed.
"""
