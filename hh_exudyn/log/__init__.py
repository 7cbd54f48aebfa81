"""Logs of a run as files on disk, read by damage, assessment and playback.

==============  ======================================================================================
`channels`      the one table of all columns: name, source, unit, meaning
`lock`          one writer in the folder of a run
`parts`         files that are whole or not there: parts of the logs, texts
`recorder`      writes the logs: rows buffered in numpy, to disk in parts
`ending`        how a run ended: results of one cut short need consent
`store`         a run on disk, and reading it back
`sensors`       values of an extension's sensors over time
`wheel_forces`  Q and Y of every wheel over time
==============  ======================================================================================

`hh_exudyn.multibody.recording` computes the rows, one output interval apart (`hh_exudyn.case.contact`). All
rows but those of the last second of wall time are on disk at any moment.
"""
