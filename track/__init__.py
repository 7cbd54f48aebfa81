"""The track: alignment, irregularities, gauge, rails and the flexible substructure under each wheelset.

====================  ==============================================================================
`alignment`           straights, transitions, curves; track frame at every arc length, `locate` (kernels)
`types`               NamedTuples that enter the alignment kernels
`spectra`             power spectral densities of irregularities: ERRI B176, FRA
`irregularity`        level, alignment, gauge, cross-level: signs, random tracks, scaling
`irregularity_csv`    measured irregularities from a file
`wavelength_bands`    3 to 25 m, 25 to 70 m: zero-phase filter
`irregularity_table`  splines of the four signals for the contact (kernels)
`quality`             classes QN1 to >QN3 by section after UIC 518
`rails`               which rail profile lies left and right
`flexibility`         rails on pads on a sleeper on ballast under one wheelset: parameters, forces (kernel)
====================  ==============================================================================
"""
