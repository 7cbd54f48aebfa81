"""Deviations of the track from its alignment, and classes of track quality.

===================  ================================================================================
`irregularity`       level, alignment, gauge, cross-level: signs, random tracks, scaling
`irregularity_csv`   measured irregularities from a file
`channels`           columns of recording cars: left and right rail, absolute gauge, units
`table`              splines of the four signals for the contact (kernels)
`spectra`            power spectral densities: ERRI B176, FRA
`wavelength_bands`   3 to 25 m, 25 to 70 m: zero-phase filter
`quality`            classes QN1 to >QN3 by section after UIC 518
===================  ================================================================================
"""
