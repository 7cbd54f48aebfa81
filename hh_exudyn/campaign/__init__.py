"""A campaign: from a line and its vehicles to the life of their wheels.

=================  ==================================================================================
`engine`           cases to damage sums: over processes or a cluster, results kept in files
=================  ==================================================================================
"""
