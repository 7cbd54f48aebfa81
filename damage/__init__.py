"""From contact log to damage: wear depth and rolling contact fatigue indices on the wheel.

Start with `damage.report.assess`, which takes a run, files, a table or arrays.

========================  ==========================================================================
`damage.report`           `assess`: one row per wheel, and the sums behind it
`damage.summary`          means per wheelset over the last part of a run
`damage.figures`          wear and fatigue over the wheel profile, shakedown diagram
`damage.wear`             wear laws, wear number
`damage.rcf.surface_index`              surface fatigue index
`damage.rcf.number`       revolutions beyond shakedown, place by place in patch and profile
`damage.rcf.burstow`          how much of that is left beside wear
`damage.rcf.miner`            Kabo's life of a fatigue index, for Miner's sum
`damage.rcf.local`        stress and fatigue index over a patch, largest per strip
`damage.rcf.crack`            cycles to failure, Miner's sum, size of cracks
`damage.rcf.whole_life_rail`  damage over the wear number, fatigue against wear
`damage.rcf.ratchetting`      plastic shear of layers below the surface
`damage.shakedown`        shakedown limit of point contact, working points
`damage.evolution`        a profile over its life: wear steps, measures, reprofiling
`damage.rcf.wear_and_cracks`  what wear leaves of the cracks: by layers worn off, or by Burstow
`damage.surface.wheel_surface`    the sums over contact states, on a grid fixed to the wheel
`damage.surface.lateral_grid`     the bins of that grid, along the arc of the profile
`damage.surface.accumulate`       the loop over the contact states; `damage.surface.contact_sums` its kernel
`damage.model`            with what they are judged; `damage.surface.patch_field` how they are solved
`damage.log_input.contact_source`   where contact states come from: runs, files, tables, arrays
`damage.log_input.contact_states`   the contact log in checked chunks; `damage.log_input.bad_rows` what is
wrong with rows `damage.material`         wheel steels
`damage.rcf.subsurface`   fatigue below the surface: FI_sub, FI_def
`damage.parameters`       numbers with their sources
========================  ==========================================================================
"""
