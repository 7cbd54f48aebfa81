"""Logs of a run as files on disk, read by damage, assessment and playback.

==============  ======================================================================================
`channels`      the one table of all columns: name, source, unit, meaning
`recorder`      writes the logs: rows buffered in numpy, to disk in parts
`ending`        how a run ended: results of one cut short need consent
`store`         a run on disk, and reading it back
`wheel_forces`  Q and Y of every wheel over time
==============  ======================================================================================

`hh_exudyn.multibody.recording` computes the rows, one output interval apart (`hh_exudyn.case.contact`). A
part is renamed into place when it is complete, so that a killed run leaves all its finished parts readable.
"""
