"""Figures of damage, as papers show them. They need no display: matplotlib's own Figure is used.

====================================  ======================================================================
`damage.figures.profile_panels`       wear and fatigue over the wheel profile, one panel per wheel
`damage.figures.rail_wear`            wear over the profiles of the rails, by stretch of track
`damage.figures.rcf_bins`             revolutions with fatigue over the profile, per wheel or case by case
`damage.figures.rcf_maps`             RCF number and energy over wheel profile and contact patch
`damage.figures.local_index`          global and local fatigue indices across a wheel's patches
`damage.figures.damage_function`      the whole-life rail function
`damage.figures.ratchetting_strain`   stress, strain and failure of layers over the depth
`damage.figures.wear_map`             contacts in Jendel's map, one point per cell that slips
`damage.figures.wear_ratio`           wear ratio over the lateral position on the wheel
`damage.figures.evolution`            a profile over its life: shapes, wear and measures over the distance
`damage.figures.lives`                diameter over the distance, what every turning was for
`damage.figures.working_points`       a run's contact states in the shakedown diagram of a point contact
`damage.figures.line_stress`          stresses below a line contact: principal shear, surface, first yield
`damage.figures.shakedown_map`        limits of line and point contact over traction
`damage.figures.stress_trajectories`  Johnson's circles around the stresses of all depths
====================================  ======================================================================
"""
