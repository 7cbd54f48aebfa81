"""A study of assumptions as tables."""

import pyarrow

from hh_exudyn.campaign.uncertainty.study import UNITS, Influence, Study


def bands_table(found: Study) -> pyarrow.Table:
    """One row per group of wheels and quantity: group, quantity, unit, nominal, p5, p50, p95.

    Parameters
    ----------
    found
        The study.
    """
    rows = [
        {
            "group": band.group,
            "quantity": band.quantity,
            "unit": UNITS[band.quantity],
            "nominal": band.nominal,
            "p5": band.low,
            "p50": band.median,
            "p95": band.high,
        }
        for band in found.bands
    ]
    return pyarrow.Table.from_pylist(rows)


def influences_table(found: Study) -> pyarrow.Table:
    """One row per quantity of all wheels and assumption, the most important ones first.

    Columns: quantity; rank; name and label of the assumption, its value, range, unit and source; method,
    importance and half width; the quantity at the ends of the range, with its unit, where it was computed.

    Parameters
    ----------
    found
        The study.
    """
    rows = [
        {"quantity": quantity, "rank": rank, **_row(one), "method": found.method, "at_unit": UNITS[quantity]}
        for quantity, influences in found.influences.items()
        for rank, one in enumerate(influences, start=1)
    ]
    return pyarrow.Table.from_pylist(rows)


def _row(one: Influence) -> dict[str, object]:
    parameter, (low, high) = one.assumption.parameter, one.assumption.ends
    at_low, at_high = (None, None) if one.at_ends is None else one.at_ends
    return {
        "name": parameter.name,
        "label": one.assumption.label,
        "value": parameter.value,
        "low": low,
        "high": high,
        "unit": parameter.unit,
        "source": parameter.source,
        "importance": one.importance,
        "half_width": one.half_width,
        "at_low": at_low,
        "at_high": at_high,
    }
