"""A wagon at another axle load: mass, payload, what stays, what is refused."""

import pytest

from vehicles.axle_load import carries_payload, with_axle_load
from vehicles.variants import find_variant


@pytest.mark.parametrize("name", ["iore_wagon_loaded", "iore_wagon_pair_loaded"])
@pytest.mark.parametrize("axle_load", [20e3, 30e3, 32.5e3])
def test_mass_on_a_wheelset(name: str, axle_load: float) -> None:
    found = with_axle_load(find_variant(name), axle_load)
    wagon = found.vehicle()
    assert wagon.mass / len(wagon.wheelsets) == pytest.approx(axle_load)
    assert found.name == name


def test_nothing_but_the_load_changes() -> None:
    before = find_variant("iore_wagon_loaded")
    found = with_axle_load(before, 32.5e3)
    changed = {one.name for one in found.differences()}
    assert changed == {
        "wagon.payload", "wagon.largest_payload", "car_body.ore_depth", "car_body.ore_height",
    }  # fmt: skip
    same = with_axle_load(before, 30e3).parameters()
    assert all(same[p.name] == pytest.approx(p.value) for p in before.parameters().parameters)


def test_ore_keeps_its_floor_and_its_density() -> None:
    before, after = (one.parameters() for one in (
        find_variant("iore_wagon_loaded"), with_axle_load(find_variant("iore_wagon_loaded"), 25e3),
    ))  # fmt: skip

    def floor(p) -> float:
        return p["car_body.ore_height"] - 0.5 * p["car_body.ore_depth"]

    assert floor(after) == pytest.approx(floor(before))
    density = [p["wagon.payload"] / p["car_body.ore_depth"] for p in (before, after)]
    assert density[0] == pytest.approx(density[1])


def test_what_has_no_payload() -> None:
    assert not carries_payload(find_variant("iore_wagon_empty"))
    with pytest.raises(ValueError, match=r"iore_locomotive carries no wagon\.payload"):
        with_axle_load(find_variant("iore_locomotive"), 30e3)
    with pytest.raises(ValueError, match=r"axle load 5 t of iore_wagon_loaded: allowed above 5\.4 t, empty"):
        with_axle_load(find_variant("iore_wagon_loaded"), 5e3)
