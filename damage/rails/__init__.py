"""The other side of the contact log: wear and fatigue of the rails, by stretch of track and per gross tonne.

==============  ==================================================================================
`steel`         rail steels, and the wear law of a rail beside that of its wheels
`model`         `RailModel`: stretches of track with the bins on their rails, steel, thresholds
`rail_surface`  `RailSurface`: the sums of one rail; they add, take weights, and pass once
`side`          kernel: a patch that was solved for the wheel is added to its rail
`pieces`        rows of a log by stretch and rail; their sums
`report`        `RailReport`: a row for each rail of each stretch, per million gross tonnes
`stored`        sums of rails in files
==============  ==================================================================================

Wear of the rail by the same law as the wheel's. A strip of the patch of width w wears off the volume
d w per metre rolled, where d is the depth of the law (`damage.wear.law.LawKernel`). The wheel spreads it over
its circumference, d per revolution. The rail spreads it over the metre that was rolled: every place of the
rail loses d in the passing of the wheel. So the rail's sums are those of a wheel of 1 m circumference that
lies along the rail, and passings take the place of revolutions.
"""
