"""Kabo's life of an index, and the lives of Malmbanan's treads at a constant friction of 0.35."""

import math

import pytest
from scipy.optimize import brentq

from damage.material import ER7, ER9, WheelMaterial
from damage.rcf.miner import kabo_damage

FRICTION = 0.35
LIFE = {"ER7": 17.4e6, "ER9": 45.8e6}  # m, treads of IORE locomotives at that friction everywhere (issue 16)
TURN = math.pi * 1.25  # m, a new wheel of the locomotive


def index(material: WheelMaterial, pressure: float) -> float:
    """FI_surf in full slip at a pressure p0: 2 pi a b k/(3 P) = k/p0 (3.16)."""
    return FRICTION - material.shear_yield / pressure


def test_a_constant_index() -> None:
    """N_f = (1.78/FI)^4: an index (not a friction) of 0.35 is failure after 669 revolutions, 2.6 km."""
    revolutions = 1.0 / kabo_damage(FRICTION)
    assert revolutions == pytest.approx((1.78 / 0.35) ** 4, rel=1e-12)
    assert revolutions == pytest.approx(669.0, abs=0.5)
    assert revolutions * TURN == pytest.approx(2.63e3, rel=2e-3)


def test_lives_of_two_steels_at_one_friction() -> None:
    """What the lives of ER7 and ER9 say: the ratio gives the pressure, the length how often it acts.

    With one contact in full slip the ratio 45.8/17.4 is ((mu - k7/p0)/(mu - k9/p0))^4, so p0 = 1.32 GPa,
    that of a wheel of 15 t on the tread. 1 % of the revolutions there give the 17,400 km, and with it ER9
    has its 45,800 km. The local slope of life over friction, -4 mu/FI, is then -11.
    """
    ratio = LIFE["ER9"] / LIFE["ER7"]
    pressure = brentq(
        lambda p: kabo_damage(index(ER7, p)) / kabo_damage(index(ER9, p)) - ratio, 1.0e9, 3.0e9, xtol=1.0
    )
    assert pressure == pytest.approx(1.32e9, rel=5e-3)
    share = TURN / (LIFE["ER7"] * kabo_damage(index(ER7, pressure)))
    assert share == pytest.approx(0.010, abs=5e-4)
    assert TURN / (share * kabo_damage(index(ER9, pressure))) == pytest.approx(LIFE["ER9"], rel=1e-9)
    assert -4.0 * FRICTION / index(ER7, pressure) == pytest.approx(-11.4, abs=0.1)
    mean = (TURN / LIFE["ER7"]) ** 0.25 * 1.78  # the index that acts in every revolution for that life
    assert mean == pytest.approx(0.0388, abs=1e-4)
