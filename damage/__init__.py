"""From contact log to damage: wear depth and rolling contact fatigue indices on the wheel.

Start with `damage.report.assess`, which takes the directory of a run.

========================  ==========================================================================
`damage.report`           `assess`: one row per wheel, and the sums behind it
`damage.summary`          means per wheelset over the last part of a run
`damage.figures`          wear and fatigue over the wheel profile, shakedown diagrams, stresses
`damage.wear`             Archard's law with Jendel's map, wear number
`damage.rcf`              surface fatigue indices FI_surf and FI_ssurf, area index, probability
`damage.rcf_subsurface`   fatigue below the surface: FI_sub, FI_def
`damage.shakedown`        elastic and shakedown limits of line and point contact, working points
`damage.wheel_surface`    the sums over contact states, on a grid fixed to the wheel
`damage.accumulate`       the loop over the contact states
`damage.contact_states`   reading and checking the contact log
`damage.material`         wheel steels, their numbers and sources
========================  ==========================================================================
"""
