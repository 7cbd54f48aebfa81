"""Wear coefficients of lubricated runs by zone, track and wheelset; Archard's hardness is the steel's."""

from importlib import resources

import numpy as np
import pyarrow
import pytest

from damage.material import ER7, wheel_material
from damage.model import DamageModel
from damage.report import assess
from damage.surface.accumulate import accumulate
from damage.wear.archard import archard
from damage.wear.films import WearFilms
from damage.wear.laws import wear_law
from hh_exudyn.case import Case
from hh_exudyn.contact.friction import friction_at
from hh_exudyn.contact.profile import wheel_profile

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
SLIDING = {"a": 8e-3, "b": 6e-3, "normal_force": 100e3, "nu_x": 0.06, "speed": 15.0}
GREASED = {"climate": "dry", "treatments": ["flange_lubrication"]}
CELLS = (20, 20)


def films(
    wheelsets: tuple[int, ...] = (4,), vehicle: str = "iore_wagon_loaded", **friction: object
) -> WearFilms:
    case = Case.from_toml(DEMO).with_changes(vehicle=vehicle, friction=friction)
    return WearFilms(case.film_table(sum(wheelsets)), wheelsets)


def volume(log: pyarrow.Table, film: WearFilms | None, law: str = "archard") -> np.ndarray:
    model = DamageModel(law=wear_law(law), cells=CELLS, films=film)
    return accumulate(log, model).worn_volume.sum(axis=1)


@pytest.mark.parametrize(
    ("angle", "divisor"),
    [(0.0, 1.0), (np.radians(25.0), 6.0), (np.radians(60.0), 100.0)],  # T p. 70: Jendel's 6, Zhu's 100
)
def test_grease_divides_the_wear_of_its_zone(make_log, angle, divisor):
    """Tread below 4 degrees, root from 15 to 35, flange above 55."""
    log = make_log(**SLIDING, contact_angle=angle)
    np.testing.assert_allclose(volume(log, films(**GREASED)), volume(log, None) / divisor, rtol=1e-12)


def test_the_passage_from_root_to_flange_is_that_of_friction(make_log):
    log = make_log(**SLIDING, contact_angle=np.radians(45.0))  # the middle of 35 to 55 degrees
    factor = 0.5 * (1.0 / 6.0 + 1.0 / 100.0)
    np.testing.assert_allclose(volume(log, films(**GREASED)), factor * volume(log, None), rtol=1e-12)


def test_tread_and_root_blend_over_10_to_35_mm_of_a_new_wheel(make_log):
    """By no more than 5 % of dry wear over a millimetre."""
    factors, wheel = films(**GREASED).factors, wheel_profile("WP4_like")
    y = 1e-3 * np.arange(5, 39)
    angles = np.arctan(-np.interp(y, wheel.y, np.gradient(wheel.z, wheel.y)))
    factor = np.array([friction_at(factors, 0, 0, 0.0, angle, 0.0) for angle in angles])
    assert factor[y < 0.0095] == pytest.approx(1.0)
    assert factor[y > 0.0355] == pytest.approx(1.0 / 6.0)
    assert np.diff(factor).max() <= 0.0
    assert np.diff(factor).min() > -0.05


def test_sections_sides_and_wheelsets_have_their_own_films(make_log):
    """Grease on the left rail from s = 100 m on, and on wheelset 2 everywhere."""
    table = films(
        climate="dry",
        lubricated_wheelsets=[2],
        sections=[{"start_m": 100.0, "left": {"treatments": ["flange_lubrication"]}}],
    )
    for wheelset, side, s, divisor in (
        (1, 1, 50.0, 1.0), (1, 1, 150.0, 100.0), (1, -1, 150.0, 1.0),
        (2, -1, 50.0, 100.0), (2, 1, 150.0, 100.0),
    ):  # fmt: skip
        log = make_log(**SLIDING, contact_angle=1.1, wheelset=wheelset, side=side, s=s)
        np.testing.assert_allclose(volume(log, table), volume(log, None) / divisor, rtol=1e-12)
    assert table.named(1, 1, -1) == "dry"
    assert table.named(1, 1, 1) == "tread dry, root dry to lubricated, flange dry to greased"
    assert table.named(1, 2, -1) == "tread dry, root lubricated, flange greased"


def test_wheelsets_of_a_pair_count_through(make_log):
    table = films((4, 4), "iore_wagon_pair_loaded", climate="dry", lubricated_wheelsets=[5])
    log = make_log(**SLIDING, contact_angle=1.1, vehicle=2, wheelset=1)
    np.testing.assert_allclose(volume(log, table), volume(log, None) / 100.0, rtol=1e-12)
    with pytest.raises(ValueError, match="vehicle 3, wheelset 1: the run has vehicles of 4, 4 wheelsets"):
        volume(make_log(**SLIDING, vehicle=3), table)


def test_laws_without_such_coefficients_stay_dry(make_log):
    log = make_log(**SLIDING, contact_angle=1.1)
    np.testing.assert_array_equal(volume(log, films(**GREASED), "usfd"), volume(log, None, "usfd"))
    report = assess(log, law=wear_law("usfd"), cells=CELLS, films=films(**GREASED))
    assert report.to_table()["wear_surface"].to_pylist() == ["dry"]
    named = assess(log, law=archard("lubricated"), cells=CELLS, films=films(**GREASED))
    assert named.to_table()["wear_surface"].to_pylist() == ["lubricated"]  # as the caller said, everywhere


def test_a_friction_modifier_is_no_lubricant():
    assert films(climate="dry").dry
    assert films(climate="dry", treatments=["top_of_rail"]).dry
    assert not films(**GREASED).dry
    assert WearFilms(Case.from_toml(DEMO).film_table(4), (4,)).named(1, 1, 1) == "dry"


def test_the_hardness_is_the_steels(make_log):
    """ER7: 235 HB = 2.3046 GPa; ER9: 255 HB. Wear is as 1/H where nothing seizes: p0 = 0.99 GPa."""
    log = make_log(**SLIDING)
    steels = {name: wheel_material(name) for name in ("ER7", "ER9")}
    wear = {name: assess(log, steel, cells=CELLS).surface.worn_volume.sum() for name, steel in steels.items()}
    assert wear["ER7"] / wear["ER9"] == pytest.approx(255.0 / 235.0, rel=1e-12)
    model = DamageModel()
    assert model.law.numbers[-1] == pytest.approx(235 * 9.80665e6)
    assert model.seizure_pressure == pytest.approx(0.8 * 2.3046e9, rel=1e-4)
    given = DamageModel(law=archard(hardness=2.65e9))
    assert given.law.numbers[-1] == 2.65e9  # as the caller said
    volume_of = assess(log, ER7, law=archard(hardness=2.65e9), cells=CELLS).surface.worn_volume.sum()
    assert wear["ER7"] / volume_of == pytest.approx(2.65e9 / ER7.hardness, rel=1e-12)
