"""Standard assessment of a run after UIC 518 / EN 14363, from its logs and its case alone.

===================  ====================================================================================
`sections`           elements of the run's track, and its test sections: straights, transitions, curves
`windows`            sliding means and effective values over distance
`accelerations`      of the body over its bogies and of the bogies over their wheelsets
`limits`             limit of each quantity: every number with its source, confirmed or not
`findings`           quantities, their courses along the track, their values in sections
`guiding_forces`     sum Y, Q, Y, and the quasi-static forces of curves
`derailment`         Y/Q after EN 14363, Nadal, Weinstock; unloading of wheels
`running_behaviour`  accelerations of the body, effective values that show instability
`ride`               Sperling's ride index, mean comfort after EN 12299
`report`             `standard_assessment(run)`: the percentiles of every section and place
`statistics`         estimated maxima of zones from the sections of one or several runs
`coupling_forces`    forces and displacements of logged couplings, by element of the track
`twist_test`         the track of a twist test, and its result
===================  ====================================================================================

Filters are those of `hh_exudyn.signals`. None of the standards was available. The processing of the
quantities is that of GENSYS's table of UIC 518; most limits are unconfirmed and marked so in every table.
Track quality is not assessed here, but by `track.irregularity.quality` and ``hh-exudyn track plot CASE``.
"""
