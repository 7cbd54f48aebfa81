"""Wheel damage on heavy-haul railways: a multibody toolkit on Exudyn.

A `Case` (one vehicle on one track, a plain TOML file) is simulated into logs on disk; damage is computed
from the logs alone; playback and figures show both. Read in this order:

=============================  ====================================================================
`hh_exudyn.conventions`        frames, signs, units
`hh_exudyn.glossary`           terms and symbols
`hh_exudyn.case`               input of a run: vehicle, track, speed, friction, profiles, theories
`vehicles`                     descriptions of wagons and locomotives, friction laws, drives and trains
`track`                        course, irregularities, rails, friction, flexibility; a whole line
`hh_exudyn.contact`            one wheel on one rail: profiles, geometry, patches, creep forces
`hh_exudyn.multibody`          the only importer of Exudyn: forces, equilibrium, `simulate(case)`, hunting
`hh_exudyn.log`                contact log, motion log and energy ledger as Parquet
`damage`                       wear depth and rolling contact fatigue from the contact log
`hh_exudyn.campaign`           load collective of a line; many cases to the damage of wheels
`hh_exudyn.assessment`         forces and accelerations of a run after UIC 518 / EN 14363
`hh_exudyn.playback`           rerun recordings and headless pictures
`hh_exudyn.figures`            figures of patches, conicity, tracks, vehicles, forces, assessment, curving
`hh_exudyn.cli`                the command ``hh-exudyn``
`hh_exudyn.kernel`             compilation of kernels; the only importer of numba
`hh_exudyn.lanes`              eight adjacent numbers at once in a kernel
`hh_exudyn.arrays`             names of array types
`hh_exudyn.sourced`            numbers with unit, source and kind, from data files
`hh_exudyn.text_files`         files of users: read whole, or refused in a line
`hh_exudyn.number_lines`       numbers in lines of text: separators, decimal commas
`hh_exudyn.signals`            filters of forces, accelerations and track
`hh_exudyn.workers`            processes of one thread each, that end with the one that began them
`hh_exudyn.entry_points`       vehicles, lines and wear laws of other packages
=============================  ====================================================================

The package itself imports nothing, so that importing a kernel is fast.
"""

__version__ = "0.1.0"
