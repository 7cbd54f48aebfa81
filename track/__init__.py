"""The track: alignment, gauge, rails and the flexible substructure under each wheelset.

=============  =====================================================================================
`alignment`    straights, transitions, curves; track frame at every arc length, `locate` (kernels)
`types`        NamedTuples that enter the alignment kernels
`rails`        which rail profile lies left and right
`flexibility`  rails on pads on a sleeper on ballast under one wheelset: parameters, forces (kernel)
=============  =====================================================================================
"""
