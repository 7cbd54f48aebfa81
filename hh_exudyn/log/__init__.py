"""Logs of a run as files on disk, read by damage, assessment and playback.

==============  ======================================================================================
`channels`      the one table of all columns: name, source, unit, meaning
`recorder`      rows in numpy, written to disk in parts
`store`         a run on disk, and reading it back
`wheel_forces`  Q and Y of every wheel over time
==============  ======================================================================================

A part is renamed into place when it is whole, so that a killed run leaves all its finished parts readable.
"""
