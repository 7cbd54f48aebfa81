"""Spectra against GENSYS's table, exact integrals and units."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from hh_exudyn.conventions import RAIL_TOP_DISTANCE
from track.irregularity.spectra import SIGNALS, spectrum, spectrum_names

GENSYS = Path(__file__).resolve().parents[2] / "reference" / "gensys_erri_b176.csv"


def gensys(column: str) -> list[tuple[float, float]]:
    """Wave numbers [1/m] and densities [m2/(1/m)] of a column."""
    lines = [line for line in GENSYS.read_text().splitlines() if not line.startswith("#")]
    return [(float(row["f"]), float(row[column])) for row in csv.DictReader(lines) if row[column]]


def density_per_cycle(name: str, signal: str, wave_number: float) -> float:
    """Over the wave number [m2/(1/m)]."""
    omega = np.array([2.0 * math.pi * wave_number])
    return float(2.0 * math.pi * spectrum(name).density(signal, omega)[0])


@pytest.mark.parametrize(("column", "signal"), [("lateral", "alignment"), ("vertical", "level")])
def test_erri_high_is_that_of_gensys(column: str, signal: str) -> None:
    rows = gensys(column)
    assert len(rows) == 4
    for wave_number, expected in rows:
        assert density_per_cycle("erri_high", signal, wave_number) == pytest.approx(expected, rel=0.01)
    for wave_number, expected in rows[1:]:
        assert density_per_cycle("erri_high", signal, wave_number) == pytest.approx(expected, rel=1e-4)


def test_the_gauge_of_gensys_is_another_spectrum() -> None:
    """As the docstring says; if this ever fails, somebody found which one and the text must change."""
    ratios = [value / density_per_cycle("erri_high", "gauge", f) for f, value in gensys("gauge")]
    assert np.allclose(ratios, [9.5, 4.4, 5.0], rtol=0.02)


def lorentz(edge: float, low: float, high: float) -> float:
    """Integral of 1 / (O^2 + edge^2)."""
    return (math.atan(high / edge) - math.atan(low / edge)) / edge


@pytest.mark.parametrize("band", [(3.0, 25.0), (25.0, 70.0), (3.0, 70.0), (0.5, 300.0)])
def test_standard_deviations_are_the_exact_integrals(band: tuple[float, float]) -> None:
    """By partial fractions."""
    low, high = 2.0 * math.pi / band[1], 2.0 * math.pi / band[0]
    for name in ("erri_low", "erri_high"):
        given = spectrum(name)
        p = given.parameters
        oc, osq, orr = p["omega_c"], p["omega_s"], p["omega_r"]
        smooth = oc**2 / (oc**2 - orr**2) * (lorentz(orr, low, high) - lorentz(oc, low, high))
        for signal in ("level", "alignment"):
            variance = p["a_" + signal] * smooth
            assert given.standard_deviation(signal, band) == pytest.approx(math.sqrt(variance), rel=1e-8)
        parts = {
            e: -(e**2) / math.prod(f**2 - e**2 for f in (oc, osq, orr) if f != e) for e in (oc, osq, orr)
        }
        rough = oc**2 * sum(part * lorentz(edge, low, high) for edge, part in parts.items())
        assert given.standard_deviation("gauge", band) == pytest.approx(
            math.sqrt(p["a_gauge"] * rough), rel=1e-8
        )
        variance = RAIL_TOP_DISTANCE**2 * p["a_level"] / 0.75**2 * rough
        assert given.standard_deviation("cross_level", band) == pytest.approx(math.sqrt(variance), rel=1e-8)
    for number in range(1, 7):
        given = spectrum(f"fra_{number}")
        p = given.parameters
        oc, osq = p["omega_c"], p["omega_s"]
        variance = p["k"] * p["a_level"] * (1.0 / low - 1.0 / high - lorentz(oc, low, high))
        assert given.standard_deviation("level", band) == pytest.approx(math.sqrt(variance), rel=1e-8)
        both = (lorentz(osq, low, high) - lorentz(oc, low, high)) / (oc**2 - osq**2)
        variance = 4.0 * p["k"] * p["a_level"] * oc**2 * both
        assert given.standard_deviation("gauge", band) == pytest.approx(math.sqrt(variance), rel=1e-8)
        given = spectrum(f"fra_{number}_fryba")
        a, n1, n2 = (given.parameters[name] for name in ("a_level", "n1", "n2"))
        n_low, n_high = 1.0 / band[1], 1.0 / band[0]
        # (n^2 + n1^2) n2^2 / (n^4 (n^2 + n2^2)) = u / n^2 + n1^2 / n^4 - u / (n^2 + n2^2), u = 1 - n1^2/n2^2
        u = 1.0 - (n1 / n2) ** 2
        integral = u * (1.0 / n_low - 1.0 / n_high) + n1**2 / 3.0 * (n_low**-3 - n_high**-3)
        integral -= u * lorentz(n2, n_low, n_high)
        assert given.standard_deviation("level", band) == pytest.approx(math.sqrt(a * integral), rel=1e-8)


def test_short_waves_come_from_two_independent_rails() -> None:
    """The level is their mean, the cross-level their difference: four times the density."""
    short = np.array([100.0])
    for name in ("erri_low", "erri_high"):
        given = spectrum(name)
        ratio = given.density("cross_level", short) / given.density("level", short)
        assert ratio[0] == pytest.approx(4.0, rel=1e-4)


def test_worse_classes_are_rougher() -> None:
    band = (3.0, 70.0)
    for signal in SIGNALS:
        low, high = (spectrum(name).standard_deviation(signal, band) for name in ("erri_low", "erri_high"))
        assert low < high
        classes = [spectrum(f"fra_{i}").standard_deviation(signal, band) for i in range(1, 7)]
        assert classes == sorted(classes, reverse=True)


def test_what_is_unconfirmed_is_marked() -> None:
    assert spectrum("erri_low").unconfirmed == ()
    assert {"a_alignment", "omega_s", "cross_level"} <= set(spectrum("fra_4").unconfirmed)
    assert spectrum("fra_4_fryba").signals == ("level",)
    assert len(spectrum_names()) == 14


def test_bad_input_says_what_is_wrong() -> None:
    with pytest.raises(ValueError, match=r"'erri' is not known, there are: erri_low, erri_high, fra_1"):
        spectrum("erri")
    with pytest.raises(ValueError, match=r"'gauge' is not known, there are: level"):
        spectrum("fra_1_fryba").density("gauge", np.array([1.0]))
    for band in ((25.0, 3.0), (0.1, 25.0), (3.0, math.nan), (3.0, 1000.0)):
        with pytest.raises(ValueError, match=r"wavelengths is .* between 0\.5 and 300 m"):
            spectrum("erri_low").standard_deviation("level", band)
