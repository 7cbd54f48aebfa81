"""A campaign: from a line and its vehicles to the life of their wheels.

=================  ==================================================================================
`collective`       the load collective: weighted cases of a line, vehicles, loads and seasons
=================  ==================================================================================
"""
