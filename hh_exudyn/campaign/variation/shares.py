"""Shares in per cent that sum to 100: some are set, the others keep their proportions in what is left."""

import math
from collections.abc import Mapping
from typing import Any

SHARE = "share_percent"


def set_shares(items: list[dict[str, Any]], shares: Mapping[int, float], place: str) -> None:
    """Set some shares of a list of tables, and scale the others so that all sum to 100 %.

    Parameters
    ----------
    items
        Tables with ``share_percent``; changed.
    shares
        New shares by index [%].
    place
        Of the list in the file, for messages.

    Raises
    ------
    ValueError
        A share outside 0..100 %, all together above 100 %, or no other item that could take the rest.
    """
    for index, share in shares.items():
        if isinstance(share, bool) or not isinstance(share, int | float) or not 0.0 <= share <= 100.0:
            raise ValueError(f"{place}[{index}].{SHARE} = {share!r}: allowed 0 to 100 %")
    left = 100.0 - math.fsum(shares.values())
    others = [index for index in range(len(items)) if index not in shares]
    before = math.fsum(float(items[index][SHARE]) for index in others)
    if left < -1e-9 or (left > 1e-9 and before == 0.0):
        raise ValueError(
            f"{place}.{SHARE}: {100.0 - left:g} % are set, {before:g} % were in others: allowed 100 % in all"
        )
    for index in others:
        items[index][SHARE] = max(left, 0.0) * float(items[index][SHARE]) / before if before else 0.0
    for index, share in shares.items():
        items[index][SHARE] = float(share)
