"""The track: alignment, irregularities, gauge, rails, friction, and its flexibility under a wheelset.

===============  =====================================================================================
`course`         where it runs: sections, alignment, track frame, surveyed points
`irregularity`   its deviations: spectra, random and measured irregularities, quality classes
`support`        its flexibility: sleepers, and the lumped track under one wheelset
`line`           a whole line: statistics, known lines, weighted track sections
`rails`          rail profiles left and right, by country, radius and wear; gauge over radius
`friction`       friction coefficient by section, zone of the wheel, weather, treatment and slip speed
`csv_columns`    CSV tables with units in the names of their columns
===============  =====================================================================================

The numbers of the data files stand with their sources in ``data/<name>.toml`` (`hh_exudyn.sourced`).
"""
