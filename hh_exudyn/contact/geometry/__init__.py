"""Where wheels and rails touch, without any force.

===================  ================================================================================
`silhouette`         the line on which a rolled and yawed wheel can touch a prismatic rail
`search`             all contact patches of a wheel on its rail, for a full pose of the wheelset
`normal_overlap`     overlap of wheel and rail along the normal, its derivative and its extrema
`rail_tables`        the rail of one side along the track, changing from profile to profile
`functions`          rolling radius difference and equivalent conicity of EN 15302
`contact_geometry`   tables of how a wheel touches a rail over its lateral displacement
`conicity`           equivalent conicity from a table of rolling radius differences
`rigid`              lowest gap and roll of a rigid wheelset on rigid rails (kernels)
`merit`              figures of merit of a profile pair on a track: steering radius, smallest curve
`validation`         EN 15302's benchmark and cones, as rows of `hh-exudyn validate`
===================  ================================================================================
"""
