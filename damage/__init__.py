"""From contact log to damage: wear depth and rolling contact fatigue indices on the wheel.

Start with `damage.report.assess`, which takes a run, files, a table or arrays.

========================  ==========================================================================
`damage.report`           `assess`: one row per wheel, and the sums behind it
`damage.summary`          means per wheelset over the last part of a run
`damage.figures`          wear and fatigue over the wheel profile, shakedown diagram
`damage.wear`             wear laws, wear number
`damage.rcf`              surface fatigue index
`damage.rcf_number`       revolutions beyond shakedown, place by place in patch and profile
`damage.burstow`          how much of that is left beside wear
`damage.miner`            Kabo's life of a fatigue index, for Miner's sum
`damage.rcf_local`        stress and fatigue index over a patch, largest per strip
`damage.crack`            cycles to failure, Miner's sum, size of cracks
`damage.whole_life_rail`  damage over the wear number, fatigue against wear
`damage.ratchetting`      plastic shear of layers below the surface
`damage.shakedown`        shakedown limit of point contact, working points
`damage.evolution`        a profile over its life: wear steps, measures, reprofiling
`damage.wear_and_cracks`  what wear leaves of the cracks: by layers worn off, or by Burstow
`damage.wheel_surface`    the sums over contact states, on a grid fixed to the wheel
`damage.lateral_grid`     the bins of that grid, along the arc of the profile
`damage.accumulate`       the loop over the contact states; `damage.contact_sums` its kernel
`damage.model`            with what they are judged; `damage.patch_field` how they are solved
`damage.contact_source`   where contact states come from: runs, files, tables, arrays
`damage.contact_states`   the contact log in checked chunks; `damage.bad_rows` what is wrong with rows
`damage.material`         wheel steels
`damage.rcf_subsurface`   fatigue below the surface: FI_sub, FI_def
`damage.parameters`       numbers with their sources
========================  ==========================================================================
"""
