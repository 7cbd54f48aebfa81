"""Variants of a campaign: other values of some keys of its file, every combination a campaign of its own.

    found = variants("campaign.toml", {"axle_load": [30, 32.5], "gauge": [1437, 1442]})
    with ProcessWorkers() as workers:
        outcomes = run_variants(found, Path("out"), workers)

=================  ==================================================================================
`keys`             a value put at a dotted key of the file's tables
`shares`           shares of the distance that are set, and the others that make room
`handy`            names for what is varied most: axle load, gauge, lubrication, material
`changed`          the text of a file with changes
`variants`         every combination of values, checked before anything runs
`runner`           variants run one after the other, each in its folder
`comparison`       wear and cracks of the variants' wheels at a common distance
=================  ==================================================================================
"""

from hh_exudyn.campaign.variation.changed import changed_text
from hh_exudyn.campaign.variation.runner import run_variants
from hh_exudyn.campaign.variation.variants import variants

__all__ = ["changed_text", "run_variants", "variants"]
