"""Every wear law on contact states worked by hand: the published arithmetic stands in the tests.

The states slide as a whole without spin, so that the traction is mu p and the slip the creepage nu
everywhere: E = mu N nu. Load, friction and creepage are chosen for round energies, not for likeness to a
railway.
"""

import math
from typing import Any

import numpy as np
import pytest

from damage.parameters import parameters
from damage.wear.batch import WearDepths, wear_depths
from damage.wear.british_rail import british_rail_volume
from damage.wear.jendel import JendelMap
from damage.wear.law import WearLaw
from damage.wear.laws import wear_law
from damage.wear.rate import rate_in_regime, rate_regime, read_rate
from hh_exudyn.sourced import Parameter

A, B, LOAD, FRICTION, RADIUS = 4e-3, 5e-3, 20e3, 0.1, 0.46
AREA_MM2 = math.pi * 4.0 * 5.0
P0 = 1.5 * LOAD / (math.pi * A * B)  # 477 MPa
HAND = 1e-3  # measured: at most 0.06 % at 80 x 80 cells, the sum of sqrt(1 - x^2) over cells
KRAUSE_POLL: dict[str, Any] = {"coefficients": (2e-13, 9e-13), "power_densities": (2e7,)}
LAWS: list[tuple[str, dict[str, Any]]] = [
    ("archard", {}),
    ("archard", {"slip": "rigid"}),
    ("british_rail", {}),
    ("british_rail", {"continuous": True}),
    ("usfd", {}),
    ("ward", {}),
    ("krause_poll", KRAUSE_POLL),
]


def worn(law: WearLaw, cells: int = 80, theory: str = "fastrip", **given: Any) -> WearDepths:
    state = {"a": A, "b": B, "normal_force": LOAD, "friction": FRICTION, "rolling_radius": RADIUS}
    state |= {"nu_x": 0.02, "nu_y": 0.0, "phi": 0.0, "speed": 15.0}
    return wear_depths(law, state | given, theory, (cells, cells))


def volume(law: WearLaw, **given: Any) -> float:
    """Per metre rolled [m^3/m]."""
    return float(worn(law, **given).volume.sum())


@pytest.mark.parametrize("slip", ["elastic", "rigid"])
def test_archard_by_hand(slip: str) -> None:
    """|s| V = 0.02 x 15 m/s = 0.3 m/s: severe, k = 35e-4; p0 < 0.8 H. The strip in the middle, of length 2 a
    and mean pressure pi/4 p0, loses k/H nu times the integral of p, p0 a pi/2, per revolution."""
    depths = worn(wear_law("archard", slip=slip), cells=81)  # an odd number has a strip in the middle
    assert depths.depth[0, 40] == pytest.approx(35e-4 / 2.65e9 * 0.02 * P0 * A * math.pi / 2, rel=HAND)
    by_regime = depths.volume[0]
    assert by_regime[1] == pytest.approx(35e-4 / 2.65e9 * LOAD * 0.02, rel=HAND)  # 5.28e-10 m^3/m
    assert by_regime.sum() == by_regime[1]
    parabola = 1.0 - (depths.y[0] / B) ** 2
    np.testing.assert_allclose(depths.depth[0], depths.depth[0, 40] * parabola, rtol=1e-12)


@pytest.mark.parametrize(("nu", "regime", "coefficient"), [(0.013, 0, 5.5e-4), (0.05, 2, 5.5e-4)])
def test_archard_in_the_mild_regions(nu: float, regime: int, coefficient: float) -> None:
    """0.195 and 0.75 m/s, either side of the severe region."""
    by_regime = worn(wear_law("archard", slip="rigid"), nu_x=nu).volume[0]
    assert by_regime[regime] == by_regime.sum()
    assert by_regime.sum() == pytest.approx(coefficient / 2.65e9 * LOAD * nu, rel=HAND)


def test_archard_seizes_where_the_pressure_is_beyond_four_fifths_of_the_hardness() -> None:
    """H = 500 MPa: p = p0 sqrt(1 - r^2) > 400 MPa within r^2 < 1 - (400/477)^2, which carries 1 - (400/477)^3
    of the load."""
    law = wear_law("archard", hardness=500e6)
    assert law == wear_law("archard", wear_map=JendelMap(hardness=500e6))
    by_regime = worn(law, cells=400).volume[0]
    share = 1.0 - (400e6 / P0) ** 3
    assert by_regime[3] == pytest.approx(350e-4 / 500e6 * LOAD * share * 0.02, rel=5e-3)  # cells at the rim
    assert by_regime[1] == pytest.approx(35e-4 / 500e6 * LOAD * (1.0 - share) * 0.02, rel=5e-3)


@pytest.mark.parametrize(
    ("options", "divisor"),
    [({"surface": "lubricated"}, 6.0), ({"surface": "lubricated", "divisor": 5.5}, 5.5),
     ({"surface": "greased"}, 100.0), ({"surface": "dry"}, 1.0)],
)  # fmt: skip
def test_surfaces_divide_the_dry_wear(options: dict[str, Any], divisor: float) -> None:
    dry = worn(wear_law("archard"), nu_y=0.01, phi=2.0)
    np.testing.assert_allclose(
        worn(wear_law("archard", **options), nu_y=0.01, phi=2.0).by_regime,
        dry.by_regime / divisor,
        rtol=1e-12,
    )


@pytest.mark.parametrize(
    ("nu", "loss_times_diameter", "regime"),
    [(0.02, 0.25 * 40.0, 0), (0.075, 25.0, 1), (0.125, 1.19 * 250.0 - 154.0, 2)],  # E = 40, 150, 250 N
)
def test_british_rail_by_hand(nu: float, loss_times_diameter: float, regime: int) -> None:
    """D = 920 mm: 40 N take 0.25 x 40/920 = 0.01087 mm^2 per km; all around the wheel, per metre rolled."""
    area = loss_times_diameter / 920.0 * 1e-6 / 1e3  # m^2 per m
    depths = worn(wear_law("british_rail"), nu_x=nu)
    by_regime = depths.volume[0]
    # E of the field is 0.03 % off mu N nu, which the severe line makes 1.19 E/(1.19 E - 154) = 2 times that
    assert by_regime[regime] == pytest.approx(area * math.pi * 0.920, rel=2 * HAND)
    assert by_regime.sum() == by_regime[regime]
    np.testing.assert_allclose(
        depths.depth[0] / depths.depth[0].sum(), depths.energy[0] / depths.energy[0].sum(), rtol=1e-12
    )


def test_british_rail_jumps_as_printed_and_not_if_continuous() -> None:
    """25/D to 84/D at 200 N; (1.19 E - 154) = 25 at E = 179/1.19 = 150.42 N."""
    printed, smooth = (
        read_rate(wear_law("british_rail").values.numbers),
        read_rate(wear_law("british_rail", continuous=True).values.numbers),
    )

    def loss(energy: float, rate: Any) -> float:
        """mm^2 per km times D in mm."""
        return british_rail_volume(energy, RADIUS, rate)[1] / math.pi * 1e12

    below = math.nextafter
    assert loss(below(200.0, 0.0), printed) == pytest.approx(25.0)
    assert loss(200.0, printed) == pytest.approx(84.0)
    assert loss(below(100.0, 0.0), printed) == pytest.approx(25.0)
    assert loss(100.0, printed) == pytest.approx(25.0)
    assert loss(150.42, smooth) == pytest.approx(25.0, abs=1e-2)
    assert loss(150.43, smooth) == pytest.approx(25.0, abs=2e-2)
    assert loss(200.0, smooth) == pytest.approx(84.0)
    energies = np.linspace(0.0, 400.0, 4001)
    steps = np.diff([loss(energy, smooth) for energy in energies])
    assert steps.max() < 1.2 * 0.1
    assert steps.min() >= 0.0


@pytest.mark.parametrize(
    ("nu", "rate", "regime"),
    [
        (0.02, 5.3 * 40.0 / AREA_MM2, 0),  # Tg/A = 0.637 N/mm^2: 3.37 ug/m/mm^2
        (0.5, 55.0, 1),  # 1000 N: 15.9
        (4.0, 61.9 * 8000.0 / AREA_MM2 - 4723.7, 2),  # 8000 N: 127.3
    ],
)
def test_usfd_by_hand(nu: float, rate: float, regime: int) -> None:
    """Rate x area is the mass per metre [ug]; over 7850 kg/m^3 it is the volume."""
    depths = worn(wear_law("usfd"), nu_x=nu, cells=81)
    assert depths.volume[0, regime] == pytest.approx(rate * AREA_MM2 * 1e-9 / 7850.0, rel=2 * HAND)
    assert depths.volume[0].sum() == depths.volume[0, regime]
    # 1 ug/mm^2 is 1.274e-4 mm; the strip in the middle rolls 2 a = 8 mm of contact per revolution
    assert depths.depth[0, 40] == pytest.approx(rate * 1.274e-7 * 8e-3, rel=2 * HAND)


def test_usfd_goes_on_from_what_it_has_reached() -> None:
    """At 77.2 N/mm^2 the last line starts from 55; with the -4778.7 of public code it would from 0."""
    rate = read_rate(wear_law("usfd").values.numbers)

    def micrograms(stress: float) -> float:
        density = stress * 1e6
        return rate_in_regime(rate_regime(density, rate), density, rate) * 7850.0 * 1e3

    assert micrograms(10.399) == pytest.approx(5.3 * 10.399)
    assert micrograms(10.4) == pytest.approx(55.0)
    assert micrograms(77.199) == pytest.approx(55.0)
    assert micrograms(77.2) == pytest.approx(55.0)
    assert micrograms(80.0) == pytest.approx(61.9 * 80.0 - 4723.7, abs=0.05)
    assert micrograms(77.2) - (61.9 * 77.2 - 4778.7) == pytest.approx(55.0, abs=0.05)


def test_ward_by_hand() -> None:
    """E = 1000 N: e = e0 sqrt(1 - r^2) with e0 = 1.5 E/A = 23.9 N/mm^2. Above 10.4, on 1 - q^2 of the area
    with q = 10.4/e0, the rate is 55; on the rest it is 5.3 e, over the whole area 5.3 e0 q^3 2/3."""
    e0 = 1.5 * 1000.0 / AREA_MM2
    q = 10.4 / e0
    by_regime = worn(wear_law("ward"), nu_x=0.5, cells=400).volume[0] * 7850.0 / 1e-9 / AREA_MM2
    assert by_regime[0] == pytest.approx(5.3 * e0 * q**3 * 2.0 / 3.0, rel=5e-3)
    assert by_regime[1] == pytest.approx(55.0 * (1.0 - q * q), rel=5e-3)


def test_ward_is_usfd_where_every_cell_is_mild() -> None:
    """Both are then 5.3 E; but Ward wears by energy, hence the middle more."""
    mild, cells = worn(wear_law("usfd")), worn(wear_law("ward"))
    assert cells.volume.sum() == pytest.approx(mild.volume.sum(), rel=1e-12)
    assert cells.depth[0, 40] > 1.1 * mild.depth[0, 40]


def test_krause_poll_by_hand() -> None:
    """40 N at 15 m/s on 62.8 mm^2: 9.5e6 W/m^2, below 2e7; at 60 m/s 3.8e7, above."""
    law = wear_law("krause_poll", **KRAUSE_POLL)
    slow, fast = worn(law).volume[0], worn(law, speed=60.0).volume[0]
    np.testing.assert_allclose(slow, [2e-13 * 40.0, 0.0, 0.0, 0.0], rtol=HAND)
    np.testing.assert_allclose(fast, [0.0, 9e-13 * 40.0, 0.0, 0.0], rtol=HAND)


@pytest.mark.parametrize(
    ("name", "options", "nu", "load", "slip"),
    [
        ("archard", {"slip": "rigid"}, 0.005, 2.0, 2.0),  # 0.075 and 0.15 m/s: mild
        (
            "archard",
            {"slip": "rigid"},
            0.01,
            2.0,
            2.0 * 35.0 / 5.5,
        ),  # 0.15 and 0.3 m/s: into the severe region
        ("british_rail", {}, 0.02, 2.0, 2.0),  # 40 and 80 N
        (
            "british_rail",
            {},
            0.055,
            (1.19 * 220.0 - 154.0) / 25.0,
            (1.19 * 220.0 - 154.0) / 25.0,
        ),  # 110, 220 N
        ("usfd", {}, 0.02, 2.0, 2.0),
        ("usfd", {}, 0.5, 1.0, 1.0),  # 15.9 and 31.8 N/mm^2: the same 55
        ("ward", {}, 0.02, 2.0, 2.0),
        ("krause_poll", KRAUSE_POLL, 0.02, 2.0, 2.0),  # 0.95e7 and 1.9e7 W/m^2
        ("krause_poll", KRAUSE_POLL, 0.03, 9.0, 9.0),  # 1.4e7 and 2.9e7 W/m^2: 2 x 9/2
    ],
)
def test_twice_the_load_and_twice_the_slip(
    name: str, options: dict[str, Any], nu: float, load: float, slip: float
) -> None:
    law = wear_law(name, **options)
    single = volume(law, nu_x=nu)
    assert volume(law, nu_x=nu, normal_force=2.0 * LOAD) == pytest.approx(load * single, rel=2e-3)
    assert volume(law, nu_x=2.0 * nu) == pytest.approx(slip * single, rel=2e-3)


@pytest.mark.parametrize(("name", "options"), LAWS)
def test_worn_volume_belongs_to_the_metre_not_to_the_wheel(name: str, options: dict[str, Any]) -> None:
    """A smaller wheel turns more often on the way, and each turn takes the same depth."""
    law = wear_law(name, **options)
    assert volume(law, rolling_radius=0.38, phi=0.5) == pytest.approx(volume(law, phi=0.5), rel=1e-12)


@pytest.mark.parametrize(("name", "options"), LAWS)
@pytest.mark.parametrize("theory", ["fastrip", "fastsim"])
def test_mirrored_states_wear_mirrored_strips(name: str, options: dict[str, Any], theory: str) -> None:
    law = wear_law(name, **options)
    state = {"nu_x": 1e-3, "friction": 0.4, "cells": 30, "theory": theory}
    left = worn(law, nu_y=2e-3, phi=0.6, **state).by_regime[0]
    right = worn(law, nu_y=-2e-3, phi=-0.6, **state).by_regime[0]
    np.testing.assert_allclose(right[::-1], left, rtol=1e-9, atol=1e-9 * left.max())


@pytest.mark.parametrize(("name", "options"), LAWS)
def test_nothing_wears_without_creepage_or_load(name: str, options: dict[str, Any]) -> None:
    law = wear_law(name, **options)
    assert not worn(law, nu_x=0.0).by_regime.any()
    assert not worn(law, normal_force=0.0).by_regime.any()
    assert not worn(law, normal_force=0.0, a=0.0, b=0.0).by_regime.any()


@pytest.mark.parametrize(("name", "options"), LAWS)
def test_a_batch_is_its_states_one_by_one(name: str, options: dict[str, Any]) -> None:
    law = wear_law(name, **options)
    creepages = np.array([1e-4, 3e-3, 0.03])
    together = worn(law, nu_x=creepages, phi=0.4, cells=20).by_regime
    alone = [worn(law, nu_x=nu, phi=0.4, cells=20).by_regime[0] for nu in creepages]
    np.testing.assert_array_equal(together, alone)
    assert together.any(axis=(1, 2)).all()


def test_rigid_slip_wears_less_than_elastic_where_part_of_the_patch_sticks() -> None:
    """By the energy identity the elastic volume is k/H E/mu, for one coefficient: |q| = mu p where it slips.
    The rigid slip in the slip zone misses the rail and wheel springing back to their stretch there."""
    partial = {"friction": 0.4, "nu_x": 3e-4, "speed": 15.0}
    elastic = volume(wear_law("archard"), **partial)
    rigid = volume(wear_law("archard", slip="rigid"), **partial)
    # by the energy identity, mu times the elastic volume is k/H E: one coefficient, |q| = mu p where it slips
    energy = worn(wear_law("archard"), **partial).energy.sum()
    assert elastic == pytest.approx(5.5e-4 / 2.65e9 * energy / 0.4, rel=1e-9)
    assert rigid < 0.9 * elastic


def test_the_table_has_a_row_per_state_and_a_column_per_regime() -> None:
    table = worn(wear_law("usfd"), nu_x=np.array([0.02, 0.5])).to_table()
    assert table.column_names == [
        *("wear_number_N", "max_depth_nm_per_revolution", "volume_mm3_per_km"),
        *("volume_mild_mm3_per_km", "volume_severe_mm3_per_km", "volume_catastrophic_mm3_per_km"),
    ]
    np.testing.assert_allclose(table["wear_number_N"].to_numpy(), [40.0, 1000.0], rtol=HAND)
    mass = table["volume_mm3_per_km"].to_numpy() * 7850e-9 * 1e9 / 1e3  # ug per m
    np.testing.assert_allclose(mass, [5.3 * 40.0, 55.0 * AREA_MM2], rtol=HAND)


def test_every_parameter_says_where_it_is_from() -> None:
    for law in ("jendel", "surface", "british_rail", "usfd"):
        for name, parameter in parameters("wear", law).items():
            assert parameter.unit, (law, name)
            assert isinstance(parameter.confirmed, bool), (law, name)
    with pytest.raises(ValueError, match=r"wear has no table 'ward'; it has: jendel, surface"):
        parameters("wear", "ward")
    with pytest.raises(ValueError, match="source starts with 'Jendel'; allowed: published, derived, assumed"):
        Parameter("severe", 1.0, "-", "Jendel", confirmed=False)


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("archerd", {}, r"wear law = 'archerd'; known: archard, british_rail, usfd, ward, krause_poll"),
        ("archard", {"surface": "wet"}, r"surface = 'wet'; known: dry, lubricated, greased"),
        ("archard", {"slip": "plastic"}, r"slip = 'plastic'; known: elastic, rigid"),
        ("archard", {"divisor": 5.5}, r"divisor = 5\.5: a dry surface has none"),
        ("archard", {"surface": "greased", "divisor": -1.0}, r"divisor = -1\.0"),
        ("archard", {"hardness": 0.0}, r"hardness = 0\.0"),
        ("usfd", {"surface": "greased"}, r"'usfd' has no option 'surface'; it has density"),
        ("usfd", {"density": 0.0}, r"density = 0\.0 kg/m\^3 must be finite and > 0"),
        ("krause_poll", {}, r"'krause_poll' needs coefficients and power_densities: there are no published"),
        ("krause_poll", {"coefficients": (1e-13,), "power_densities": (1e7,)}, r"given: 1 and 1"),
        ("krause_poll", {"coefficients": (1e-13, -1.0), "power_densities": (1e7,)}, r"-1\.0 m\^3/J"),
        ("krause_poll", {"coefficients": (1, 2, 3), "power_densities": (2e7, 1e7)}, r"2.*followed by 1"),
    ],
)
def test_bad_laws_are_refused(name: str, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        wear_law(name, **options)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"nu_x": np.array([0.0, np.nan])},
            r"nu_x = nan \[-\] in row 1 must be finite \(1 such rows",
        ),
        ({"speed": 0.0}, r"speed = 0 m/s in row 0 must be finite and > 0 m/s"),
        ({"a": -1e-3}, r"a = -0\.001 m in row 0 must be finite and >= 0 m"),
        ({"theory": "polach"}, r"theory = 'polach'; known: "),
        ({"cells": 0}, r"cells = \(0, 0\)"),
        ({"nu_x": np.zeros((2, 2))}, r"shape \(2, 2\)"),
    ],
)
def test_bad_states_are_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        worn(wear_law("usfd"), **given)


def test_missing_columns_are_named() -> None:
    with pytest.raises(ValueError, match="contact states: nu_y, speed missing"):
        wear_depths(
            wear_law("usfd"),
            dict.fromkeys(("a", "b", "normal_force", "nu_x", "phi", "friction", "rolling_radius"), 1.0),
        )
