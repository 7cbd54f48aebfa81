"""From contact log to damage: wear depth and rolling contact fatigue on wheels and rails.

Start with `damage.report.assess`, which takes a run, files, a table or arrays.

==============  ====================================================================================
`report`        `assess`: damage of the wheels of a run, one row per wheel
`model`         `DamageModel`: settings of a damage computation
`material`      wheel steels
`parameters`    numbers with their sources, from ``damage/data``
`summary`       means and peaks per wheelset on stretches of track
`extremes`      a run in a handful of numbers, the largest over wheels and elements of track
`cells`         middles of the cells of a patch
`patch_strips`  strips of a patch on the wheel
`bounds`        checks of numbers against their bounds
`log_input`     the contact log, checked, each row with its output interval
`surface`       sums over contact states on a grid fixed to the wheel profile
`rails`         the same sums for the rails, per gross tonne
`wear`          wear laws, wear number
`rcf`           rolling contact fatigue: indices, counts, cracks, ratchetting, cracks with wear
`shakedown`     shakedown limits of line and point contact, working points
`evolution`     a wheel profile over its life: wear steps, measures, reprofiling
`life`          limits, turnings and the diameter of a wheel, to its end
`figures`       wear and fatigue over the profile, shakedown diagram, wear map
==============  ====================================================================================

A log row is read by `log_input`; `surface` places it on the profile, solves its patch and sums wear (`wear`)
and fatigue (`rcf`); `report` makes the table.
"""
