"""A coupling that the package does not have: a description, its numbers, its law and one entry of a tuple."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pytest

from hh_exudyn.kernel import inlined_kernel, kernel
from hh_exudyn.multibody.couplings.dispatch import FAMILIES
from hh_exudyn.multibody.couplings.family import Condition, Family, Motion, Reaction, one_law, packed
from vehicles.catalogue import vehicle
from vehicles.couplings import Rod

LEVEL = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Snubber:
    """Vertical damper with a force that grows with the square of the speed."""

    name: str
    body_a: str
    body_b: str
    point: tuple[float, float, float]
    coefficients: tuple[float, float, float]  # of x, y, z [N s^2/m^2]


class SnubberNumbers(NamedTuple):
    coefficients: tuple[float, float, float]
    first: float  # derived


@inlined_kernel
def snubber(p: SnubberNumbers, motion: Motion, condition: Condition) -> Reaction:
    speed = motion.rate[2]
    force = -p.coefficients[2] * abs(speed) * speed
    return Reaction(
        (0.0, 0.0, force),
        (p.first, 0.0, 0.0),
        condition.slider,
        condition.friction_power,
        condition.damper_power - force * speed,
    )


EVERY = (
    *FAMILIES,
    Family("snubber", Snubber, SnubberNumbers, snubber, lambda s: {"first": s.coefficients[0]}),
)
LAW = one_law(EVERY)


@kernel
def answer(kinds: Any, numbers: Any, i: int, motion: Motion, condition: Condition) -> Reaction:
    """Reaction of the coupling of a number."""
    return LAW(kinds[i], numbers[i], motion, condition)


def test_a_coupling_from_outside_beside_those_of_the_package():
    own = Snubber("snubber", "bolster_1", "car_body", (0.0, 0.0, 0.0), (1.0, 2.0, 3e4))
    rod = Rod("rod", "bolster_1", "car_body", (0.0, 0.0, 0.0), (2.0, 0.0, 0.0), 8e6, 0.0)
    kinds, numbers = packed((rod, own), EVERY)
    condition = Condition((1.0, 2.0, 3.0, 4.0, 5.0, 6.0), False, 1.0, 5.0, 7.0)
    motion = Motion((2.01, 0.0, 0.0), (0.0, 0.0, 0.2), (0.0, 0.0, 0.0), LEVEL, LEVEL)
    pulled = answer(kinds, numbers, 0, motion, condition)
    assert pulled.force == pytest.approx((-8e4, 0.0, 0.0))
    damped = answer(kinds, numbers, 1, motion, condition)
    assert damped.force == pytest.approx((0.0, 0.0, -1200.0))
    assert damped.moment == (1.0, 0.0, 0.0)
    assert damped.slider == condition.slider
    assert (damped.friction_power, damped.damper_power) == pytest.approx((5.0, 7.0 + 240.0))


def test_a_coupling_of_no_family_is_an_error():
    own = Snubber("strange", "bolster_1", "car_body", (0.0, 0.0, 0.0), (1.0, 2.0, 3.0))
    with pytest.raises(TypeError, match="coupling strange: no family for a Snubber"):
        packed((own,), FAMILIES)


@pytest.mark.parametrize("name", ["iore_wagon_loaded", "iore_locomotive", "manchester_vehicle_1"])
def test_every_number_of_a_coupling_is_that_of_its_description(name):
    couplings = vehicle(name).couplings
    kinds, numbers = packed(couplings, FAMILIES)
    for kind, row, coupling in zip(kinds, numbers, couplings, strict=True):
        family = FAMILIES[kind]
        derived = family.derived(coupling)
        for field in family.numbers._fields:
            expected = derived[field] if field in derived else getattr(coupling, field)
            assert np.array_equal(row[family.name][field], expected), (coupling.name, field)
