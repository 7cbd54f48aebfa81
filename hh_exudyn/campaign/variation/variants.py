"""Every combination of some values of some keys of a campaign's file, checked before anything runs."""

import math
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

from hh_exudyn.campaign.life.plan import campaign_of_text
from hh_exudyn.campaign.variation.changed import changed_text
from hh_exudyn.case.matrix import variant_name

MOST = 1000  # campaigns


def variants(file: Path | str, values: Mapping[str, Sequence[Any]]) -> dict[str, str]:
    """The texts of the campaigns' files by name, ``axle_load=30,gauge=1437``.

    All have the random numbers of the file: equal strata have equal irregularities, so that their differences
    are known better than they themselves. A vehicle of another name, another share of a season, and a mass
    that moves runs from one vehicle to another change the sample.

    Parameters
    ----------
    file
        Of the campaign.
    values
        By key (`hh_exudyn.campaign.variation.changed.changed_text`); the last key varies fastest.

    Raises
    ------
    ValueError
        A key or a value that is not allowed, a case that cannot be made of it, two of one name, too many.
    """
    count = math.prod(len(each) for each in values.values())
    if count > MOST:
        raise ValueError(f"{count} variants: allowed up to {MOST}")
    found: dict[str, str] = {}
    for chosen in product(*values.values()):
        changes = dict(zip(values, chosen, strict=True))
        name = variant_name(changes)
        if name in found:
            raise ValueError(f"two variants are named {name}: allowed values that differ, files of one name")
        try:
            found[name] = changed_text(file, changes)
            campaign_of_text(found[name], str(file), Path()).of_steps.cases()
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None
    return found
