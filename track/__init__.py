"""The track: alignment, gauge, rails and the flexible substructure under each wheelset.

=============  =========================================================================================
`alignment`    straights, transitions, curves; track frame at every arc length, `locate` (kernels)
`types`        NamedTuples that enter the alignment kernels
`rails`        which rail profile lies left and right, by country, radius and wear; gauge over the radius
`friction`     coefficient by section, zone of the wheel, weather, treatment and slip speed (kernel)
`line`         a line's statistics (`read_line`, a TOML file) as weighted track sections (`load_sections`)
`line_data`    what a line's file holds; `line_file` reads and checks it
`data_file`    data files read strictly, every number with unit, range and source
`flexibility`  rails on pads on a sleeper on ballast under one wheelset: parameters, forces (kernel)
=============  =========================================================================================
"""
