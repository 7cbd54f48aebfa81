"""Checks of numbers against their bounds, with one form of error."""

import math


def check_above_zero(name: str, value: float, unit: str, of: str = "") -> None:
    """Raise ValueError unless a number is finite and above zero.

    Parameters
    ----------
    name, value, unit
        Of the number; the unit "-" for none.
    of
        The thing that it belongs to, for the message: "the crack".
    """
    _check(name, value, unit, of, math.isfinite(value) and value > 0.0, ">")


def check_not_below_zero(name: str, value: float, unit: str, of: str = "") -> None:
    """Raise ValueError unless a number is finite and at least zero; parameters as `check_above_zero`."""
    _check(name, value, unit, of, math.isfinite(value) and value >= 0.0, ">=")


def _check(name: str, value: float, unit: str, of: str, good: bool, sign: str) -> None:
    if not good:
        bound = "0" if unit == "-" else f"0 {unit}"
        thing = f" of {of}" if of else ""
        raise ValueError(f"{name} = {value} {unit}{thing} must be finite and {sign} {bound}")
