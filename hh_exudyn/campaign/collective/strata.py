"""A stratum: one cell of the load collective, with labels and values in the units of their names.

Its key is made of what defines its case, its replicate included; the seed of the irregularity is a hash of
the key. So a case has the same irregularity in every step of a campaign, whatever the wheels look like by
then (common random numbers), and different strata have independent ones.
"""

import hashlib
import math
from dataclasses import dataclass, fields, replace
from functools import cached_property

_MEMBER = ("curve_class", "hand")  # of the line: several share a case
_SHIFT = "gauge_shift_mm"  # in the gauges already
_SEEDS = 2**31


@dataclass(frozen=True)
class Stratum:
    """One cell of the collective and one member of its group of curve classes.

    Attributes
    ----------
    running, vehicle
        Name of the running in the file, and its vehicle.
    group, run_hand
        Group of classes with common cases, and the hand in which they are run.
    curve_class, hand
        Of the line: what the weight counts for.
    radius_m
        Infinity on straight track.
    gauge_mm, straight_gauge_mm
        Of the curve (or straight track), and of the straight track beside a curve.
    level_deviation_mm, alignment_deviation_mm
        Standard deviations of the random track of which the case has a stretch, wavelengths 3 to 25 m.
    friction_tread, friction_gauge_corner, friction_flange
        At rest, before treatments [-].
    replicate
        Number of the random sample, from 1.
    gauge_shift_mm
        Of the plan, in both gauges: its variants have the same irregularity.
    """

    running: str
    vehicle: str
    group: str
    run_hand: str
    curve_class: str
    hand: str
    radius_m: float
    cant_mm: float
    transition_m: float
    gauge_mm: float
    straight_gauge_mm: float
    rail_high: str
    rail_low: str
    rail_wear: str
    quality: str
    level_deviation_mm: float
    alignment_deviation_mm: float
    season: str
    friction_tread: float
    friction_gauge_corner: float
    friction_flange: float
    speed_km_h: float
    haul: str
    gradient_per_mille: float
    replicate: int
    gauge_shift_mm: float = 0.0

    @cached_property
    def key(self) -> str:
        """What defines the case, as a text; numbers to six digits."""
        return ";".join(
            f"{field.name}={_shown(getattr(self, field.name))}"
            for field in fields(self)
            if field.name not in (*_MEMBER, _SHIFT)
        )

    @property
    def digest(self) -> str:
        """Ten hexadecimal digits of the key's SHA-256, for names."""
        return hashlib.sha256(self.key.encode()).hexdigest()[:10]

    @property
    def seed(self) -> int:
        """Seed of the irregularity, from the key without the shift of gauge; on every machine the same."""
        shift = self.gauge_shift_mm
        gauges = round(self.gauge_mm - shift, 6), round(self.straight_gauge_mm - shift, 6)
        plain = replace(self, gauge_mm=gauges[0], straight_gauge_mm=gauges[1]) if shift else self
        return int.from_bytes(hashlib.sha256(plain.key.encode()).digest()[:8], "big") % _SEEDS

    @property
    def cell(self) -> str:
        """Key without the replicate: cases of one cell are repeated samples."""
        return replace(self, replicate=0).key

    @property
    def straight(self) -> bool:
        """Whether it is straight track."""
        return math.isinf(self.radius_m)


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
