"""Standard assessment of a run after UIC 518 / EN 14363, from its logs and its case alone.

===============  ====================================================================================
`sections`       test sections of the run's alignment: straights, transitions, curves by radius
`windows`        sliding means and effective values over distance
`accelerations`  of the body over its bogies and of the bogies over their wheelsets
`limits`         limit of each quantity: every number with its source, confirmed or not
`report`         `standard_assessment(run)`: the percentiles of every section and place
===============  ====================================================================================

Filters are those of `hh_exudyn.signals`. None of the standards was available. The processing of the
quantities is that of GENSYS's table of UIC 518; most limits are unconfirmed and marked so in every table.
Track quality is not assessed here, but by `track.irregularity.quality` and ``hh-exudyn track plot CASE``.
"""
