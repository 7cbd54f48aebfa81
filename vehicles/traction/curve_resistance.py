"""What curves take from the wagons of a train: Roeckl's formula, or what this toolkit's own wagon needs.

Numbers and sources: ``data/curve_resistance.toml``. At R 450 m Roeckl says 1.65 per mille of the weight, 2.7
times the 0.61 of the loaded ore wagon as it is simulated on dry, unworn rails. Roeckl's is of old stock, but
near to what is used for three-piece wagons on worn rails: the safer number for what a locomotive can haul.
"""

import tomllib
from importlib.resources import files
from typing import Any

import numpy as np

from hh_exudyn.arrays import FloatArray

CURVE_RESISTANCES = ("roeckl", "simulated", "none")
_DATA: dict[str, Any] = tomllib.loads(
    files("vehicles").joinpath("data/curve_resistance.toml").read_text(encoding="utf-8")
)


def curve_resistance(kind: str, curvature: FloatArray, axle_load: float) -> FloatArray:
    """Resistance of wagons in curves over their weight [-], beyond that on straight track.

    Parameters
    ----------
    kind : one of `CURVE_RESISTANCES`
    curvature : [1/m], of either sign
    axle_load : of the wagons [t]; Roeckl's formula knows none

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
    """How the numbers of a kind are known, for people."""
    if kind == "none":
        return "none"
    table = _DATA[kind]
    return str(table["source"] if kind == "roeckl" else table["loaded"]["source"])


def _roeckl(bent: FloatArray) -> FloatArray:
    """a/(R - b) = a k/(1 - b k), with other numbers in tight curves, none of which counts as below 100 m."""
    main, tight = _DATA["roeckl"]["main_line"], _DATA["roeckl"]["tight"]
    bent = np.minimum(bent, 1.0 / tight["from_radius_m"])
    wide = bent * main["from_radius_m"] <= 1.0
    numerator = np.where(wide, main["numerator_m"], tight["numerator_m"])
    less = np.where(wide, main["less_m"], tight["less_m"])
    return np.asarray(numerator * bent / (1.0 - less * bent))


def _simulated(bent: FloatArray, axle_load: float) -> FloatArray:
    """Between the empty and the loaded wagon by the axle load, between radii by the curvature."""
    empty, loaded = _DATA["simulated"]["empty"], _DATA["simulated"]["loaded"]
    light, heavy = empty["axle_load_t"], loaded["axle_load_t"]
    share = float(np.clip((axle_load - light) / (heavy - light), 0.0, 1.0))
    return (1.0 - share) * _of_table(empty, bent) + share * _of_table(loaded, bent)


def _of_table(table: dict[str, Any], bent: FloatArray) -> FloatArray:
    """By the curvature, from nothing on the straight; beyond the tightest radius in proportion."""
    radius, per_mille = np.array(table["radius_m"]), np.array(table["per_mille"])
    within = np.interp(bent, np.append(0.0, 1.0 / radius[::-1]), np.append(0.0, per_mille[::-1]))
    return 1e-3 * np.where(bent * radius[0] > 1.0, per_mille[0] * radius[0] * bent, within)
