"""The command ``hh-exudyn``.

===============  ======================================================================================
`app`            the command itself
`run`            run, demo, playback
`changes`        other inputs for a case: --vehicle, --set, --vary
`matrix`         many runs at once
`campaign`       campaigns: new, run, vary, error, status
`campaign_show`  what campaigns have found: show, compare
`compare`        runs beside each other
`elements`       tables of a run by element of its track
`check_rails`    forces of check rails on flange backs
`contact`        conicity, patch
`validate`       the toolkit beside numbers from outside
`creep_curve`    creep force over creepage by every theory
`damage`         wear and fatigue of a run
`rails`          rails of a run: elements, table, figure
`reports`        damage reports of a run, one for the wheels of each profile
`evaluation`     folder and settings of a damage evaluation
`assess`         assessment of runs after UIC 518 / EN 14363
`assess_tables`  its tables
`twist_test`     twist test of a vehicle
`variation`      variants of a campaign, and their comparison
`track`          alignment, irregularities, lines
`campaign`       campaigns; in `campaign_uncertainty` bands of life and wear
`vehicle`        vehicles and their numbers
`linear`         modes and critical speeds
`parameters`     every number of the data files
`names`          names of registries in help texts
`inputs`         common arguments, refusal of bad input, reading of a run
`usage`          missing or misspelt options in one line
`output`         lines, tables, figures, exit codes
===============  ======================================================================================
"""
