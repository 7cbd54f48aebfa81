"""Figures of contact and track, as the papers show them: plain results in, matplotlib's own figures out.

================  ======================================================================================
`patch`           one patch, all theories side by side: traction, stick and slip, slip velocity, forces
`conicity`        panels over the lateral displacement: conicity, radius difference, contact positions
`conicity_sheet`  these panels on one sheet, for a wheel on a rail at several gauges
`track`           a track over its length, with irregularities and quality classes; a line as shares
`hysteresis`      friction loops: force over deflection, with what a cycle takes
`traction`        a locomotive: drives over time, efforts over speed, curving over radius
`wheel_forces`    Q and Y of every wheel: distributions with their ranges, and spectra
================  ======================================================================================

They need no display and compute no physics.
"""
