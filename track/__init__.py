"""The track: alignment, gauge, rails and the flexible substructure under each wheelset.

============== =====================================================================================
`alignment`    straights, transitions, curves; track frame at every arc length, `locate` (kernels)
`types`        NamedTuples that enter the alignment kernels
`rails`        which rail profile lies left and right
`sleepers`     parameter sets of tracks on sleepers, exact receptance of their rails
`flexibility`  from sleepers to the lumped track under a wheelset, by name
`substructure` rails on pads on a sleeper on ballast under one wheelset: forces (kernel)
============== =====================================================================================
"""
