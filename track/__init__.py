"""The track: alignment, gauge, rails and the flexible substructure under each wheelset.

===============  ===================================================================================
`sections`       what people write: straights, transitions, curves, ramps; grades
`course`         how curvature, cant, gauge and gradient run along them, their kinks blended
`alignment`      `Alignment`: sections checked and made into the kernel table; door to the two below
`frame`          track frame at every arc length, `locate` (kernels)
`types`          NamedTuples that enter the alignment kernels
`alignment_csv`  an alignment from a table; `csv_columns` reads tables with units in their header
`centre_line`    an alignment from surveyed points, smoothed to curvature; `survey` reads points
`rails`          which rail profile lies left and right
`flexibility`    rails on pads on a sleeper on ballast under one wheelset: parameters, forces (kernel)
===============  ===================================================================================
"""
