"""Friction by place, zone, weather, treatment and slip speed."""

import math

import numpy as np
import pytest

from hh_exudyn.contact.friction import friction_at
from hh_exudyn.contact.tangential.polach import Contamination, polach_force
from hh_exudyn.contact.types import RollingPatch
from track.friction import (
    Falling,
    Friction,
    FrictionSection,
    Zones,
    climate,
    falling,
    friction_numbers,
    known,
)

LEFT, RIGHT = 0, 1  # side indices
ZONES = Zones(0.6, 0.3, 0.1)


def test_constant_friction_is_constant() -> None:
    table = Friction.everywhere(Zones.even(0.4)).table([()])
    for s in (-1e4, 0.0, 123.4, 1e5):
        for angle in np.radians([-20.0, 0.0, 15.0, 45.0, 75.0]):
            assert friction_at(table, 0, LEFT, s, angle, 0.0) == pytest.approx(0.4, abs=1e-15)
            assert friction_at(table, 0, RIGHT, s, angle, 3.0) == pytest.approx(0.4, abs=1e-15)


def test_zones_by_contact_angle() -> None:
    table = Friction.everywhere(ZONES).table([()])
    for degrees, expected in ((-30, 0.6), (3, 0.6), (15, 0.45), (27, 0.3), (45, 0.2), (70, 0.1)):
        angle = math.radians(degrees)
        assert friction_at(table, 0, LEFT, 0.0, angle, 0.0) == pytest.approx(expected, abs=1e-12)


def test_zones_pass_smoothly_into_each_other() -> None:
    """No jump and no kink over the contact angle: second differences vanish with the square of the step."""
    table = Friction.everywhere(ZONES).table([()])

    def largest(step: float) -> tuple[float, float]:
        angles = np.arange(0.0, math.radians(80.0), step)
        values = np.array([friction_at(table, 0, LEFT, 0.0, angle, 0.0) for angle in angles])
        return float(np.abs(np.diff(values)).max()), float(np.abs(np.diff(values, 2)).max())

    coarse, fine = largest(2e-3), largest(1e-3)
    assert fine[0] == pytest.approx(coarse[0] / 2, rel=0.02)  # a jump would stay
    assert fine[1] == pytest.approx(coarse[1] / 4, rel=0.05)  # a kink would halve


def test_sections_left_and_right_with_a_ramp() -> None:
    dry, greased = Zones.even(0.5), Zones.even(0.2)
    sections = (
        FrictionSection(0.0, dry, dry),
        FrictionSection(100.0, greased, dry),
        FrictionSection(200.0, greased, greased),
        FrictionSection(300.0, dry, greased),
    )
    table = Friction(sections, ramp=4.0).table([()])

    def at(s: float) -> tuple[float, float]:
        return friction_at(table, 0, LEFT, s, 0.0, 0.0), friction_at(table, 0, RIGHT, s, 0.0, 0.0)

    for s, expected in (
        (-50.0, (0.5, 0.5)),
        (97.9, (0.5, 0.5)),
        (100.0, (0.35, 0.5)),  # the middle of the ramp
        (102.1, (0.2, 0.5)),
        (200.0, (0.2, 0.35)),
        (250.0, (0.2, 0.2)),
        (302.1, (0.5, 0.2)),
        (1e5, (0.5, 0.2)),
    ):
        assert at(s) == pytest.approx(expected, abs=1e-12)
    s = np.arange(90.0, 310.0, 0.01)
    values = np.array([at(x)[0] for x in s])
    assert np.abs(np.diff(values)).max() < 1.5 * 0.3 / 4.0 * 0.01 * 1.001  # steepest slope of the ramp


def test_falling_friction_is_polachs() -> None:
    """Half of the fall after ln 2 / B, A at infinity, and the library's Polach force with the same A, B."""
    table = Friction.everywhere(Zones.even(0.55), falling("polach_dry")).table([()])
    assert friction_at(table, 0, LEFT, 0.0, 0.0, 0.0) == pytest.approx(0.55)
    assert friction_at(table, 0, LEFT, 0.0, 0.0, math.log(2.0) / 0.6) == pytest.approx(0.55 * 0.7)
    assert friction_at(table, 0, LEFT, 0.0, 0.0, 1e3) == pytest.approx(0.55 * 0.4)
    for nu_x, nu_y in ((1e-3, 0.0), (0.02, 0.01), (0.3, -0.1)):
        friction = friction_at(table, 0, LEFT, 0.0, 0.0, 15.0 * math.hypot(nu_x, nu_y))
        patch = RollingPatch(6e-3, 5e-3, 1.4e5, nu_x, nu_y, 0.1, 0.55, 82e9, 0.28)
        surface = Contamination(friction_ratio=0.4, friction_decrease=0.6)
        built_in = polach_force(patch, surface, speed=15.0)
        constant = polach_force(patch._replace(friction=friction), Contamination())
        assert constant == pytest.approx(built_in, rel=1e-12)


def test_climates_span_the_range_of_the_thesis() -> None:
    """0.2 in very humid to 0.75 in extremely dry weather (Hossein-Nia 2018, section 1.1.5)."""
    levels = {name: climate(name).tread for name in known("climate")}
    assert min(levels, key=levels.__getitem__) == "very_humid"
    assert max(levels, key=levels.__getitem__) == "cold_dry"
    assert (levels["very_humid"], levels["cold_dry"]) == (0.2, 0.75)


def test_treatments_lower_their_zones_and_never_raise() -> None:
    cold = climate("cold_dry")
    greased = cold.treated("flange_lubrication")
    assert greased.flange < greased.gauge_corner < greased.tread == cold.tread
    conditioned = cold.treated("top_of_rail")
    assert 0.3 <= conditioned.tread <= 0.4
    assert conditioned.flange == cold.flange
    both = cold.treated("top_of_rail", "flange_lubrication")
    assert both == cold.treated("flange_lubrication", "top_of_rail")
    wet = climate("very_humid")
    assert wet.treated("top_of_rail") == wet


def test_every_number_has_a_source() -> None:
    for kind in ("climate", "treatment", "falling"):
        for name in known(kind):
            for number in friction_numbers(kind, name).parameters:
                assert number.source.startswith(("published: ", "derived: ", "assumed: "))


def test_bad_input_says_what_is_wrong() -> None:
    with pytest.raises(
        ValueError, match=r"climate 'arctic' is not known, there are: very_humid, humid, .*cold_dry"
    ):
        climate("arctic")
    with pytest.raises(ValueError, match="treatment 'sand' is not known, there are: top_of_rail, flange_lub"):
        climate("dry").treated("sand")
    with pytest.raises(ValueError, match="falling 'x' is not known, there are: polach_dry, polach_wet"):
        falling("x")
    with pytest.raises(ValueError, match=r"friction of the flange is nan \[-\], allowed are 0.01 to 1"):
        Zones(0.3, 0.3, math.nan)
    with pytest.raises(ValueError, match=r"ratio of Falling is 1.5 \[-\], allowed are 0 to 1"):
        Falling(ratio=1.5)
    with pytest.raises(ValueError, match="at least one"):
        Friction(())
    one = FrictionSection(10.0, ZONES, ZONES)
    with pytest.raises(ValueError, match="start of friction section 2 is 11 m, allowed is from 12 m on"):
        Friction((one, FrictionSection(11.0, ZONES, ZONES)))
