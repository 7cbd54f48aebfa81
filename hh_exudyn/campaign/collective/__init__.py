"""The load collective: what a wheel meets on a line, as weighted cases (`Case` with a share of the distance).

    >>> collective = Collective.read("campaign.toml")
    >>> for weighted in collective.cases():
    ...     weighted.case, weighted.weight, weighted.mirrored, weighted.parts

A file (TOML) names a line, and gives shares of vehicles and loads, speeds, gauge, seasons, trains and states
of the rails. They are the axes of a product within every group of curve classes, so that their weights are
products; `design` and `stratified` say which cells of the product are run. Weights sum to 1, and for every
class and hand of the line to its share; for every other share of the file exactly, or for points in the mean
of many replicates. The error of what is computed with them is that of sampling, and that of the axes' steps
(`sampling`).

=================  ==================================================================================
`plan`             what a file says, as values
`plan_file`        reads and checks a file
`sourced_table`    a table of which every number has unit, source and range
`seasons`          the tables of the seasons: friction by zone, treatments, films
`template`         the text of a new file, with the sources of its numbers
`axes`             gauge, quality, seasons as steps with shares, and the halving of steps
`design`           cells of a product of axes: all, or an overlay with the same shares
`stratified`       a few weighted points of a product of axes, for a budget of runs
`allocation`       how many of the runs each group of classes gets
`groups`           groups of curve classes: what their sections have in common, and their members' shares
`strata`           a stratum with its labels, key and seed
`track`            the track of a stratum and its evaluated parts
`case_of_stratum`  the case of a stratum
`films`            natural and artificial lubricant for the wear coefficients of a case
`weighted`         strata and cases with their weights
`collective`       `Collective`: all weighted strata and cases of a plan, assumed numbers, halving of axes
`listing`          the strata as a table
`sampling`         errors of weighted sums, and which case is the next
`sizing`           replicates bought until a stated error or a budget: `size`
`refinement`       the discretisation error of an axis, by halving its steps
`nearest`          the replicates for a loop: those nearest to the mean of all
`bought`           what has been evaluated, nothing twice
=================  ==================================================================================
"""

from hh_exudyn.campaign.collective.bought import through_cases
from hh_exudyn.campaign.collective.collective import Collective
from hh_exudyn.campaign.collective.plan import HALVED, Films, Plan
from hh_exudyn.campaign.collective.plan_file import plan_of_text, read_plan
from hh_exudyn.campaign.collective.sizing import Quantity, Sizing, size
from hh_exudyn.campaign.collective.strata import Stratum
from hh_exudyn.campaign.collective.template import template_text
from hh_exudyn.campaign.collective.weighted import WeightedCase, WeightedStratum

__all__ = [
    "HALVED",
    "Collective",
    "Films",
    "Plan",
    "Quantity",
    "Sizing",
    "Stratum",
    "WeightedCase",
    "WeightedStratum",
    "plan_of_text",
    "read_plan",
    "size",
    "template_text",
    "through_cases",
]
