"""Units of changed numbers: what a vehicle file may write instead of the unit of its base."""

from decimal import Decimal

_FACTORS = {  # base unit: other units, and how many of the base one of them is
    "N/m": {"kN/m": "1e3", "MN/m": "1e6", "GN/m": "1e9", "N/mm": "1e3", "kN/mm": "1e6"},
    "N s/m": {"kN s/m": "1e3", "MN s/m": "1e6", "N s/mm": "1e3", "kN s/mm": "1e6"},
    "N m/rad": {"kN m/rad": "1e3", "MN m/rad": "1e6"},
    "N m s/rad": {"kN m s/rad": "1e3", "MN m s/rad": "1e6"},
    "m": {"mm": "1e-3", "cm": "1e-2"},
    "kg": {"t": "1e3"},
    "kg m^2": {"t m^2": "1e3"},
    "N": {"kN": "1e3", "MN": "1e6"},
    "W": {"kW": "1e3", "MW": "1e6"},
    "deg": {"rad": "57.29577951308232"},
    "rad": {"deg": "0.017453292519943295", "mrad": "1e-3"},
    "-": {"%": "1e-2"},
}


def allowed_units(unit: str) -> tuple[str, ...]:
    """The unit itself, and the others that convert to it."""
    return (unit, *_FACTORS.get(unit, ()))


def converted(value: float, given: str, wanted: str) -> float:
    """A value in another unit, exact in decimals: 13.1345 MN/m are 13134500 N/m.

    Parameters
    ----------
    value : float
        In the unit `given`; finite.
    given, wanted : str
        The two units.

    Raises
    ------
    ValueError
        The one does not convert to the other; with the units that do.
    """
    if given == wanted:
        return value
    factor = _FACTORS.get(wanted, {}).get(given)
    if factor is None:
        allowed = ", ".join(f'"{unit}"' for unit in allowed_units(wanted))
        raise ValueError(f'in "{given}": allowed {allowed}')
    return float(Decimal(repr(float(value))) * Decimal(factor))
