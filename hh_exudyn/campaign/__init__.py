"""A campaign: from a line and its vehicles to the life of their wheels.

=================  ==================================================================================
`collective`       the load collective: weighted cases of a line, vehicles, loads and seasons
`engine`           cases to damage sums: over processes or a cluster, results kept in files
`life`             groups of wheels over the distance: rates, steps, folder
`results`          what a campaign has found: tables, figures, one page
`variation`        other values of a campaign's file, every combination a campaign of its own
`objective`        wear and fatigue as a function of such values, for optimisation
`uncertainty`      bands of life and wear from what is assumed, without new runs
=================  ==================================================================================
"""
