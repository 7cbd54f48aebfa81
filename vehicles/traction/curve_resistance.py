"""Curve resistance of the wagons of a train: after Roeckl, or as simulated with this toolkit's wagon.

Numbers and sources: ``data/curve_resistance.toml``. At R 450 m Roeckl says 1.65 per mille of the weight, 2.7
times the 0.61 of the loaded ore wagon as it is simulated on dry, unworn rails. Roeckl's is of old stock, but
near to figures in use for three-piece wagons on worn rails: the safer one for the load of a locomotive.
"""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.sourced import load_parameters

CURVE_RESISTANCES = ("roeckl", "simulated", "none")
_NUMBERS = load_parameters("vehicles", "curve_resistance")


def curve_resistance(kind: str, curvature: FloatArray, axle_load: float) -> FloatArray:
    """Resistance of wagons in curves over their weight [-], beyond that on straight track.

    Parameters
    ----------
    kind : one of `CURVE_RESISTANCES`
    curvature : [1/m], of either sign
    axle_load : of the wagons [t]; without influence in Roeckl's formula

    Raises
    ------
    ValueError
        The kind is not known.
    """
    if kind not in CURVE_RESISTANCES:
        raise ValueError(f"curve resistance {kind!r}: allowed {', '.join(CURVE_RESISTANCES)}")
    bent = np.abs(curvature)
    if kind == "roeckl":
        return _roeckl(bent)
    if kind == "simulated":
        return _simulated(bent, axle_load)
    return np.zeros_like(bent)


def source(kind: str) -> str:
    """Source of the numbers of a kind, in words."""
    if kind == "none":
        return "none"
    first = "roeckl.main_line.numerator" if kind == "roeckl" else "simulated.loaded.axle_load"
    return next(number.source for number in _NUMBERS.parameters if number.name == first)


def _roeckl(bent: FloatArray) -> FloatArray:
    """a/(R - b) = a k/(1 - b k), with other numbers in tight curves; radii below 100 m count as 100 m."""
    n = _NUMBERS
    if not bent.any():
        return np.zeros_like(bent)
    bent = np.minimum(bent, 1.0 / n["roeckl.tight.from"])
    wide = bent * n["roeckl.main_line.from"] <= 1.0
    numerator = np.where(wide, n["roeckl.main_line.numerator"], n["roeckl.tight.numerator"])
    less = np.where(wide, n["roeckl.main_line.less"], n["roeckl.tight.less"])
    return np.asarray(numerator * bent / (1.0 - less * bent))


def _simulated(bent: FloatArray, axle_load: float) -> FloatArray:
    """Between the empty and the loaded wagon by the axle load, between radii by the curvature."""
    light, heavy = (_NUMBERS[f"simulated.{load}.axle_load"] for load in ("empty", "loaded"))
    share = float(np.clip((axle_load - light) / (heavy - light), 0.0, 1.0))
    return (1.0 - share) * _of_table("empty", bent) + share * _of_table("loaded", bent)


def _of_table(load: str, bent: FloatArray) -> FloatArray:
    """Interpolated over the curvature, zero on the straight; proportional to it beyond the tightest curve."""
    radius, per_mille = (_column(f"simulated.{load}.{name}") for name in ("radius", "resistance"))
    within = np.interp(bent, np.append(0.0, 1.0 / radius[::-1]), np.append(0.0, per_mille[::-1]))
    return 1e-3 * np.where(bent * radius[0] > 1.0, per_mille[0] * radius[0] * bent, within)


def _column(name: str) -> FloatArray:
    """The numbers of a list in the data file."""
    return np.array([number.value for number in _NUMBERS.parameters if number.name.startswith(f"{name}[")])
