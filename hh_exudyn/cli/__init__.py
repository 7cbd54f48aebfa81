"""The command ``hh-exudyn``.

============  ======================================================================================
`app`         the command itself: run, demo, playback
`contact`     conicity, patch, validate
`damage`      wear and fatigue of a run
`assess`      assessment of a run after UIC 518 / EN 14363
`track`       alignment, irregularities, lines
`vehicle`     vehicles and their numbers
`linear`      modes and critical speeds
`parameters`  the numbers of the data files with unit, source and kind
`output`      errors, exit codes, tables, figures
============  ======================================================================================
"""
