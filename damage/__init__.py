"""From contact log to damage: wear depth and rolling contact fatigue indices on the wheel.

Start with `damage.report.assess`, which takes the directory of a run.

========================  ==========================================================================
`damage.report`           `assess`: one row per wheel, and the sums behind it
`damage.summary`          means per wheelset over the last part of a run
`damage.figures`          wear and fatigue over the wheel profile, shakedown diagram
`damage.wear`             wear laws, wear number
`damage.rcf`              surface fatigue index
`damage.shakedown`        shakedown limit of point contact, working points
`damage.wheel_surface`    the sums over contact states, on a grid fixed to the wheel
`damage.accumulate`       the loop over the contact states
`damage.contact_states`   reading and checking the contact log
`damage.material`         wheel steels
`damage.parameters`       numbers with their sources
========================  ==========================================================================
"""
