"""Axes of a load collective as steps with shares, and the halving of steps.

A continuous quantity is represented by steps, each the mean of an interval of its distribution. Halving
splits the interval of every step: the shares are halved and means are kept, so that weighted means of what is
linear in the quantity do not move, and the change of the weighted result is the discretisation error
(`hh_exudyn.campaign.collective.sampling.halving_error`).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.stats import norm

from hh_exudyn.arrays import FloatArray
from hh_exudyn.campaign.collective.plan import GaugeSpread, QualityRule, Season
from track.friction import Zones
from track.irregularity.irregularity import BAND, random_irregularity
from track.irregularity.quality import CLASSES, quality_limits
from track.irregularity.wavelength_bands import D1

_SAMPLE = 5000.0  # m of random track for the standard deviations of a spectrum


@dataclass(frozen=True)
class Step:
    """An interval of a quantity: its mean, half of its width, and its share of the distribution."""

    value: float
    half_width: float
    share: float


def halved(steps: Sequence[Step], times: int) -> tuple[Step, ...]:
    """Steps with each interval split in the middle, `times` over; one without width stays whole.

    Parameters
    ----------
    steps : sequence of Step
        Their shares sum to 1, and still do afterwards.
    times : int
        How often.
    """
    found = tuple(steps)
    for _ in range(times):
        found = tuple(
            replace(step, value=step.value + sign * step.half_width / 2, half_width=step.half_width / 2,
                    share=step.share / 2)
            if step.half_width > 0.0 else step
            for step in found
            for sign in ((-1.0, 1.0) if step.half_width > 0.0 else (1.0,))
        )  # fmt: skip
    return found


def gauge_deviations(spread: GaugeSpread, halvings: int = 0) -> tuple[Step, ...]:
    """Deviations from the mean gauge [m]: means of intervals of equal shares of the cut normal distribution.

    The mean of a standard normal variable between a and b is (phi(a) - phi(b)) / (Phi(b) - Phi(a)); the
    weighted mean of the steps is exactly 0.

    Parameters
    ----------
    spread : GaugeSpread
        The distribution.
    halvings : int
        Each doubles the number of intervals.
    """
    count = spread.quantiles * 2**halvings
    if spread.deviation == 0.0 or count == 1:
        return (Step(0.0, 0.0, 1.0),)
    cut = spread.truncation
    edges = norm.ppf(np.linspace(norm.cdf(-cut), norm.cdf(cut), count + 1))
    edges[0], edges[-1] = -cut, cut
    means = (norm.pdf(edges[:-1]) - norm.pdf(edges[1:])) / np.diff(norm.cdf(edges))
    means = 0.5 * (means - means[::-1])  # symmetric to the last bit
    half = 0.5 * spread.deviation * np.diff(edges)
    return tuple(
        Step(float(spread.deviation * mean), float(width), 1.0 / count)
        for mean, width in zip(means, half, strict=True)
    )


def quality_places(halvings: int = 0) -> tuple[Step, ...]:
    """Places within the interval of a quality class, 0 at its lower and 1 at its upper limit."""
    return halved((Step(0.5, 0.5, 1.0),), halvings)


def target_deviations(rule: QualityRule, quality: str, place: float) -> FloatArray:
    """Largest standard deviations of level and alignment [m] at a place within a quality class, (2,).

    Parameters
    ----------
    rule : QualityRule
        The speed of the limits, and how the two open classes are closed.
    quality : str
        One of `track.irregularity.quality.CLASSES`.
    place : float
        0 to 1, between the limits of the class.
    """
    limits = quality_limits(rule.speed)  # (2, 3)
    edges = np.column_stack([rule.lowest * limits[:, 0], limits, rule.highest * limits[:, 2]])
    i = CLASSES.index(quality)
    found: FloatArray = (1.0 - place) * edges[:, i] + place * edges[:, i + 1]
    return found


@lru_cache
def spectrum_deviations(spectrum: str, shortest: float) -> tuple[float, float]:
    """Standard deviations of level and alignment [m] of a spectrum, in the band of track quality (D1).

    Parameters
    ----------
    spectrum : str
        Of the random track.
    shortest : float
        Its shortest wavelength [m].
    """
    track = random_irregularity(
        spectrum, _SAMPLE, 1, wavelengths=(shortest, BAND[1]), step=min(0.25, shortest / 12.0)
    )
    return track.standard_deviation("level", D1), track.standard_deviation("alignment", D1)


@lru_cache
def irregularity_scale(rule: QualityRule, quality: str, place: float, shortest: float) -> float:
    """Factor on the spectrum with which the worse of its two signals has the deviation of the class [-].

    Parameters
    ----------
    rule, quality, place
        As `target_deviations`.
    shortest : float
        Shortest wavelength [m].
    """
    wanted = target_deviations(rule, quality, place)
    return float(np.min(wanted / np.array(spectrum_deviations(rule.spectrum, shortest))))


def halved_seasons(seasons: Sequence[Season], times: int) -> tuple[Season, ...]:
    """Seasons with their interval of tread friction split in the middle, `times` over.

    The intervals reach half-way to the next friction; gauge corner and flange change in proportion.

    Parameters
    ----------
    seasons : sequence of Season
        Their shares sum to 1.
    times : int
        How often.
    """
    if times == 0:
        return tuple(seasons)
    widths = half_widths([season.friction.tread for season in seasons])
    found = []
    for season, width in zip(seasons, widths, strict=True):
        tread = season.friction.tread
        for step in halved((Step(tread, width, season.share),), times):
            factor = step.value / tread
            zones = Zones(*(min(1.0, factor * value) for value in season.friction.coefficients))
            named = season.name if width == 0.0 else f"{season.name} {step.value:.4g}"
            found.append(replace(season, name=named, share=step.share, friction=zones))
    return tuple(found)


def half_widths(values: Sequence[float]) -> list[float]:
    """Half of the distance to the nearest other value, for each; 0 where there is no other.

    Parameters
    ----------
    values : sequence of float
        Values of the steps of an axis.
    """
    widths = []
    for value in values:
        others = [abs(value - other) for other in values if not math.isclose(value, other)]
        widths.append(0.5 * min(others, default=0.0))
    return widths
