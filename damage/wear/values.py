"""A wear law as the kernels take it: one NamedTuple for every law, so that one compiled kernel does all."""

from typing import NamedTuple

REGIMES = 4  # columns of a strip's depth: the regimes of the law in use, unused ones stay 0

ARCHARD = 1
BRITISH_RAIL = 2
USFD = 3
WARD = 4
KRAUSE_POLL = 5
LAWS: dict[str, int] = {
    "archard": ARCHARD,
    "british_rail": BRITISH_RAIL,
    "usfd": USFD,
    "ward": WARD,
    "krause_poll": KRAUSE_POLL,
}


class MapValues(NamedTuple):
    """Jendel's map; the attributes of `damage.wear.jendel.JendelMap` say what is what."""

    mild_slow: float
    severe: float
    mild_fast: float
    seizure: float
    severe_from: float
    severe_to: float
    seizure_pressure: float  # [Pa]
    hardness: float


class RateValues(NamedTuple):
    """A piecewise linear rate of wear: slope times energy plus offset, in the regime that holds.

    The regime is the number of limits at or below the quantity that the law looks at; SI units of the law.
    """

    limits: tuple[float, ...]  # REGIMES - 1, rising; inf where there are fewer regimes
    slopes: tuple[float, ...]  # REGIMES
    offsets: tuple[float, ...]  # REGIMES


class LawValues(NamedTuple):
    """A wear law."""

    law: int  # a value of `LAWS`
    rigid: bool  # sliding distances from the rigid slip in the slip zone, not from the field's own slip
    map: MapValues  # of Archard's law
    rate: RateValues  # of the other laws


_NAN = float("nan")
NO_MAP = MapValues(*[_NAN] * 8)
NO_RATE = RateValues((_NAN,) * 3, (_NAN,) * 4, (_NAN,) * 4)
