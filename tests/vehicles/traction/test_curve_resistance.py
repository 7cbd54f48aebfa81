"""Curve resistance of wagons: Roeckl's formula, and the table of the toolkit's own wagon."""

import numpy as np
import pytest

from vehicles.traction.curve_resistance import CURVE_RESISTANCES, curve_resistance, source


def of(kind, radius, axle_load=30.0):
    return 1e3 * float(curve_resistance(kind, np.array([1.0 / radius]), axle_load)[0])


def test_roeckl():
    """0.650/(R - 55), below 300 m 0.5/(R - 30), below 100 m as at 100 m, whatever the load and the hand."""
    assert of("roeckl", 400.0) == pytest.approx(650.0 / 345.0)
    assert of("roeckl", -200.0, 5.0) == pytest.approx(500.0 / 170.0)
    assert of("roeckl", 50.0) == of("roeckl", 100.0)


@pytest.mark.parametrize("kind", CURVE_RESISTANCES)
def test_straight_track_has_none_and_tighter_curves_more(kind):
    assert curve_resistance(kind, np.zeros(3), 30.0) == pytest.approx(0.0, abs=1e-6)
    radii = np.geomspace(300.0, 1e4, 50)  # at 300 m Roeckl's two branches do not meet
    values = curve_resistance(kind, 1.0 / radii, 30.0)
    assert (np.diff(values) <= 0.0).all()
    assert np.array_equal(values, curve_resistance(kind, -1.0 / radii, 30.0))
    assert source(kind).startswith(("assumed", "derived", "none"))


def test_the_wagons_table():
    """Its own points, between them by curvature and axle load; 2.7 times less than Roeckl's at 450 m."""
    assert of("simulated", 450.0) == pytest.approx(0.610)
    assert of("simulated", 450.0, 5.4) == pytest.approx(1.237)
    assert of("simulated", 450.0, 3.0) == of("simulated", 450.0, 5.4)
    assert of("simulated", 450.0, 17.7) == pytest.approx(0.5 * (0.610 + 1.237))
    middle = 2.0 / (1.0 / 450.0 + 1.0 / 700.0)
    assert of("simulated", middle) == pytest.approx(0.5 * (0.610 + 0.324))
    assert of("simulated", 150.0) == pytest.approx(2.0 * 1.034)
    assert of("roeckl", 450.0) / of("simulated", 450.0) == pytest.approx(2.7, abs=0.05)


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="curve resistance 'davis': allowed roeckl, simulated, none"):
        curve_resistance("davis", np.zeros(1), 30.0)
