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
lies along the rail, and passings take the place of revolutions. Energy lost and, with one hardness and one
coefficient, volume are the same numbers on both sides.

What to expect, of a 120 t ore wagon with worn wheels (WP4_like) on new 60E1, R260, R 300 m, dry at friction
0.40, in 100 MGT: high rail 436 mm^2, 89 mm in the middle of a band of 5 mm at the gauge corner (at the edge
of seizure: new rails wear in first); low rail 173 mm^2, 18 mm on its top; straight 6 mm^2, 0.8 mm. Published:
on straights 0.5 to 1 mm, in curves some ten times that (raildamage.com, 2024); head-hardened rail at FAST, R
350 m, 1770 MGT of life (TTCI TD-04-010), which is some 60 mm^2 if a life is 1000 mm^2 of the head (assumed).
So curves come out 2 to 10 times too fast: real rails are not always dry and harden, and the coefficients are
the middle of wide ranges. Ratios (rails, wheelsets, lubrication, steels) are better founded than amounts.

Not in the whole-life rail model here: that cracks grow only where the traction opens them, and grinding.
"""
