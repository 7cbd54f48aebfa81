"""Standard assessment of a run after UIC 518 / EN 14363, from its logs and its case alone.

===============  ====================================================================================
`sections`       test sections of the run's alignment: straights, transitions, curves by radius
`windows`        sliding means and effective values over distance
`accelerations`  of the body over its bogies and of the bogies over their wheelsets
`limits`         limit of each quantity: every number with its source, confirmed or not
`report`         `standard_assessment(run)`: the percentiles of every section and place
===============  ====================================================================================

Filters are those of `hh_exudyn.signals`. None of the standards was at hand. How quantities are processed was
read in GENSYS's table of UIC 518; most limits are unconfirmed and every table says which. The quality of the
track that a run went over is not judged here: `track.irregularity.quality` does that,
``hh-exudyn track plot CASE`` shows it.
"""
