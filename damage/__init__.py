"""From contact log to damage: wear depth and rolling contact fatigue indices on the wheel.

Start with `damage.report.assess`, which takes the directory of a run.

========================  ==========================================================================
`damage.report`           `assess`: one row per wheel, and the sums behind it
`damage.summary`          means per wheelset over the last part of a run
`damage.figures`          wear and fatigue over the wheel profile, shakedown diagram
`damage.wear`             Archard's law with Jendel's map, wear number
`damage.rcf`              surface fatigue index
`damage.rcf_local`        stress and fatigue index over a patch, largest per strip
`damage.crack`            cycles to failure, Miner's sum, size of cracks
`damage.whole_life_rail`  damage over the wear number, fatigue against wear
`damage.ratchetting`      plastic shear of layers below the surface
`damage.shakedown`        shakedown limit of point contact, working points
`damage.wheel_surface`    the sums over contact states, on a grid fixed to the wheel
`damage.accumulate`       the loop over the contact states
`damage.contact_states`   reading and checking the contact log
`damage.material`         wheel steels
========================  ==========================================================================
"""
