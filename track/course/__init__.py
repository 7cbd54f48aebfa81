"""Where the track runs: the centre line, its frames, and the frames of its rails.

================  ===================================================================================
`alignment`       `Alignment`: sections checked and made into the kernel table
`sections`        straights, transitions, curves, ramps; grades
`course`          curvature, cant, gauge and gradient along them; blended kinks
`shapes`          shapes of transitions, from the clothoid to the cubic parabola
`frame`           track frame at every arc length, arc length of a point (kernels)
`rail_frame`      the frame of one rail: irregularity, ramps and deflection turn it (kernel)
`types`           NamedTuples that enter the alignment kernels
`alignment_csv`   an alignment from a table
`centre_line`     an alignment from surveyed points, smoothed to curvature
`survey`          surveyed points from a file
================  ===================================================================================
"""
