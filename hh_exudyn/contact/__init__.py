"""A wheel on a rail: from profiles and pose to patches, pressures and creep forces. No Exudyn, no plots.

Folders, in the order of the computation; each has a map of its own.

==================  =================================================================================
`profiles`          shapes of wheels and rails, files, measures, spline tables
`geometry`          where wheels and rails touch, without any force; equivalent conicity
`normal`            Hertz and non-elliptic patches; stresses below a patch
`strips`            coupled strips: normal contact and creep forces of a whole wheel, a run's default
`tangential`        creep forces and tractions by all theories
`halfspace`         the exact solution: half-spaces, pressure, rolling, stresses below
`check_rail`        the back of a flange on a check rail
==================  =================================================================================

Their composition.

==================  =================================================================================
`types`             inputs and results of the contact kernels (NamedTuples)
`material`          elastic constants
`friction`          friction coefficient of one patch by place, zone of the wheel and slip speed
`state`             state of one patch: the kernels' record, and a row of the contact log by attributes
`contact_frame`     axes of a contact on a rail that turns and slopes
`patch_forces`      forces of one patch: normal force with its damping, creepages, creep forces
`strip_forces`      forces of one wheel by coupled strips
`wheels`            wheels of one vehicle that differ in their profiles
`wheel_rail`        pose and velocity of wheelsets and rails -> wrenches and patches, in one kernel
`wheelset`          a wheel or a wheelset at rest on its rails: the height that carries the load
`patch_shape`       strips and tractions of a logged patch
`comparison`        a number of ours beside one from outside: rows of `hh-exudyn validate`
`validation`        creep forces by theory and Kalker's coefficients, as such rows
==================  =================================================================================

Fronts: import paths for callers from outside.

==================  =================================================================================
`profile`           `Profile`, standard shapes, readers: from `profiles`
`functions`         contact geometry functions and equivalent conicity: from `geometry`
`hertz`             Hertz's ellipse: from `normal`
`kalker`            creep coefficients: from `tangential`
==================  =================================================================================
"""
