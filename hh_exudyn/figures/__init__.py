"""Figures of contact, track and vehicles, as papers show them: plain results in, matplotlib's figures out.

================  ======================================================================================
`patch`           one patch, all theories side by side: traction, stick and slip, slip velocity, forces
`creep_curve`     creep force over creepage and spin, all theories beside the half-space
`conicity`        panels over the lateral displacement: conicity, radius difference, contact positions
`conicity_sheet`  these panels on one sheet, for a wheel on a rail at several gauges
`track`           a track over its length, with irregularities and quality classes; a line as shares
`vehicle`         a vehicle to scale, side and top view, from the description that a run uses
`hysteresis`      friction loops: force over deflection, with the energy of a cycle
`hunting`         amplitude of hunting over the speed, down from a limit cycle
`root_locus`      eigenvalues of a vehicle over its speed, and their damping ratios
`traction`        a locomotive: drives over time, efforts over speed, bogies in curves by variant of steering
`assessment`      quantities of EN 14363 over the track with their limits; test sections against them
`curving`         angle of attack, place and forces of every wheelset over the radius of the curve
`comparison`      runs beside each other, a panel for each quantity
`wheel_forces`    Q and Y of every wheel: distributions with their ranges, and spectra
`style`           sizes and colours that the figures have in common
================  ======================================================================================

They need no display and compute no physics.
"""
