"""The track: alignment, irregularities, gauge, rails, friction, and what gives way under a wheelset.

Where it runs
    `sections`            what people write: straights, transitions, curves, ramps; grades
    `course`              how curvature, cant, gauge and gradient run along them, their kinks blended
    `alignment`           `Alignment`: sections checked and made into the kernel table
    `frame`               track frame at every arc length, arc length of a point (kernels)
    `alignment_csv`       an alignment from a table; `csv_columns` reads tables with units in their header
    `centre_line`         an alignment from surveyed points, smoothed to curvature; `survey` reads points
    `types`               NamedTuples that enter the alignment kernels

How even it is
    `spectra`             power spectral densities of irregularities: ERRI B176, FRA
    `irregularity`        level, alignment, gauge, cross-level: signs, random tracks, scaling
    `irregularity_csv`    measured irregularities from a file
    `wavelength_bands`    3 to 25 m, 25 to 70 m: zero-phase filter
    `irregularity_table`  splines of the four signals for the contact (kernels)
    `quality`             classes QN1 to >QN3 by section after UIC 518

What lies on it
    `rails`               which rail profile lies left and right, by country, radius and wear; gauge
    `friction`            coefficient by section, zone of the wheel, weather, treatment and slip speed

What gives way
    `sleepers`            parameter sets of tracks on sleepers, exact receptance of their rails
    `flexibility`         from sleepers to the lumped track under a wheelset, by name
    `substructure`        rails on pads on a sleeper on ballast under one wheelset: forces (kernel)

A whole line
    `line`                its statistics (`read_line`, TOML) as weighted track sections (`load_sections`)
    `line_data`           what a line's file holds; `line_file` reads and checks it
    `data_file`           data files read strictly, every number with unit, range and source
"""
