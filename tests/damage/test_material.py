"""Wheel steels: where k comes from, what a material lacks, and the sources of the grades."""

import math
from dataclasses import replace

import pytest

from damage.material import ER7, ER8, ER9, WheelMaterial, material_parameters, wheel_material


def test_shear_yield_says_how_it_was_derived() -> None:
    """ER7: 300 MPa after von Mises fits Table 3-2 of Hossein-Nia (2018); 260 MPa after Tresca (3.1)."""
    assert ER7.shear_yield == pytest.approx(300e6, rel=1e-3)
    assert ER7.shear_yield_derivation == "yield strength / sqrt 3, after von Mises"
    tresca = replace(ER7, criterion="tresca")
    assert tresca.shear_yield == pytest.approx(260e6)
    assert tresca.shear_yield_derivation == "yield strength / 2, after Tresca"
    measured = replace(ER7, measured_shear_yield=330e6)
    assert (measured.shear_yield, measured.shear_yield_derivation) == (330e6, "measured")


def test_grades_of_en_13262() -> None:
    """Harder grades are stronger in every respect, as steels are: Rm is some 3.4 times HB (ISO 18265)."""
    for softer, harder in ((ER7, ER8), (ER8, ER9)):
        for quantity in ("yield_strength", "tensile_strength", "hardness", "shear_yield"):
            assert softer.require(quantity, "a test") < harder.require(quantity, "a test")
    for grade in (ER7, ER8, ER9):
        assert 3.3 < grade.tensile_strength * 1e-6 / (grade.hardness / 9.80665e6) < 4.0
        assert {"yield_strength", "tensile_strength", "hardness"} == set(material_parameters(grade.name))
    # Burstow's thresholds with ER7 are 40, 121 and 404 N (3.33)
    limit = 1e-4 * (ER7.yield_strength + ER7.tensile_strength) / (2.0 * math.sqrt(3.0))
    assert [round(creepage * limit) for creepage in (0.001, 0.003, 0.01)] == [40, 121, 404]


def test_a_missing_strength_names_material_and_model() -> None:
    bare = WheelMaterial("SUPERLOS")
    with pytest.raises(
        ValueError, match="material 'SUPERLOS' has no hardness, which Archard's law needs: give it hardness"
    ):
        bare.require("hardness", "Archard's law")
    with pytest.raises(ValueError, match=r"no shear_yield, .* needs: give it yield_strength or measured"):
        _ = bare.shear_yield
    with pytest.raises(ValueError, match="a wheel material has no 'toughness'; it may have: yield_strength"):
        bare.require("toughness", "fracture")
    assert WheelMaterial("x", measured_shear_yield=3e8).require("shear_yield", "FI_surf") == 3e8


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"yield_strength": 0.0}, "yield_strength = 0.0 Pa must be finite and > 0 Pa"),
        ({"hardness": math.inf}, "hardness = inf Pa"),
        ({"tensile_strength": 500e6}, "tensile_strength = 500000000.0 Pa must be at least the yield"),
        ({"criterion": "rankine"}, "criterion = 'rankine'; allowed: von_mises, tresca"),
    ],
)
def test_bad_values_are_named(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        replace(ER7, **change)


def test_unknown_grade_lists_the_known() -> None:
    with pytest.raises(ValueError, match="wheel material 'R7' is not known; known: ER7, ER8, ER9"):
        wheel_material("R7")
