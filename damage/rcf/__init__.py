"""Rolling contact fatigue: indices, numbers of revolutions, cracks.

===================  ================================================================================
`surface_index`      surface fatigue index of a whole patch
`local`              stress and fatigue index over a patch, largest per strip
`subsurface`         fatigue below the surface: FI_sub, FI_def
`number`             RCF number: revolutions beyond shakedown, by place in patch and profile
`burstow`            correction of that number for wear
`miner`              Kabo's life of a fatigue index, for Miner's sum
`crack`              cycles to failure, Miner's sum, size of cracks
`ratchetting`        plastic shear of layers below the surface
`whole_life_rail`    damage over the wear number, fatigue against wear
`wear_and_cracks`    competition of wear and cracks: by layers worn off, or by Burstow
===================  ================================================================================
"""
