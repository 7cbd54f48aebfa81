"""Figures of damage, as papers show them. They need no display: matplotlib's own Figure is used.

====================================  ====================================================================
`damage.figures.line_stress`          stresses below a line contact: principal shear, surface, first yield
`damage.figures.profile_panels`       wear and fatigue over the wheel profile, one panel per wheel
`damage.figures.shakedown_map`        limits of line and point contact over traction
`damage.figures.stress_trajectories`  Johnson's circles around the stresses of all depths
`damage.figures.working_points`       a run's contact states in the shakedown diagram of a point contact
====================================  ====================================================================
"""
