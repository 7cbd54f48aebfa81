"""Figures of damage, as papers show them. They need no display: matplotlib's own Figure is used.

==================================  ====================================================================
`damage.figures.profile_panels`     wear and fatigue over the wheel profile, one panel per wheel
`damage.figures.wear_map`           contacts in Jendel's map, one point per cell that slips
`damage.figures.wear_ratio`         wear ratio over the lateral position on the wheel
`damage.figures.working_points`     a run's contact states in the shakedown diagram of a point contact
==================================  ====================================================================
"""
