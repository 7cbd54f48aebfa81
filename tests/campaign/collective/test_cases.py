"""Cases of strata: every kind is a valid `Case` with the track, friction and films of its stratum."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from collectives import product_text

from damage.parameters import parameters
from hh_exudyn.campaign.collective import (
    Collective,
    Stratum,
    WeightedCase,
    WeightedStratum,
    plan_of_text,
    template_text,
)
from hh_exudyn.campaign.collective.films import wear_films
from hh_exudyn.case import CaseError
from hh_exudyn.case.irregular import require_possible_track
from track.course.alignment import track_frame
from track.irregularity.wavelength_bands import D1
from vehicles.start import start_front

WAGON, LOCOMOTIVE, PAIR = "iore_wagon_pair", "iore_locomotive", "iore_locomotive_pair"


@pytest.fixture(scope="module")
def collectives() -> dict[str, Collective]:
    return {name: Collective(plan_of_text(product_text(vehicle=name))) for name in (WAGON, LOCOMOTIVE, PAIR)}


def first(collective: Collective, wanted: Callable[[Stratum], bool]) -> WeightedStratum:
    return next(item for item in collective.strata if wanted(item.stratum))


KINDS: dict[str, tuple[str, Callable[[Stratum], bool]]] = {
    "tight": (WAGON, lambda s: s.curve_class == "<350" and s.running == "loaded" and s.quality == "QN3"),
    "narrow": (WAGON, lambda s: s.curve_class == "straight" and s.gauge_mm < 1434.0),
    "worst": (WAGON, lambda s: s.quality == ">QN3"),
    "empty": (WAGON, lambda s: s.curve_class == "450:600" and s.running == "empty"),
    "braking": (WAGON, lambda s: s.haul == "braking" and s.curve_class == "600:800"),
    "frozen": (WAGON, lambda s: s.season == "cold and dry"),
    "greased": (WAGON, lambda s: s.season == "lubricated flange"),
    "up": (LOCOMOTIVE, lambda s: s.haul == "up" and s.curve_class == "<350"),
    "down": (LOCOMOTIVE, lambda s: s.haul == "down" and s.curve_class == "straight"),
    "both units": (PAIR, lambda s: s.haul == "level" and s.curve_class == "600:800"),
    "empty train": (LOCOMOTIVE, lambda s: s.running == "empty"),
}


@pytest.mark.parametrize("name", KINDS)
def test_a_case_of_every_kind_is_possible(name: str, collectives: dict[str, Collective]) -> None:
    """The case is valid, its irregular track within the limits of gauge, cant and direction."""
    vehicle, wanted = KINDS[name]
    collective = collectives[vehicle]
    item = first(collective, wanted)
    (found,) = collective.cases([item])
    case, stratum = found.case, found.stratum
    alignment = case.alignment()
    irregular = case.track.irregular(start_front(case.described_vehicle()), alignment.length)
    require_possible_track(case, alignment, irregular)
    assert case.speed_km_h == stratum.speed_km_h
    assert case.track.irregularity_seed == found.seed == stratum.seed
    assert case.friction.tread == stratum.friction_tread
    assert math.fsum(part.share for part in found.parts) == pytest.approx(1.0)
    for part in found.parts:
        ends = [track_frame(alignment.table, place)[5] for place in (part.start, part.end)]
        _, _, _, _, _, curvature, gauge = track_frame(alignment.table, 0.5 * (part.start + part.end))
        sign = {"left": 1.0, "right": -1.0, "straight": 0.0}[stratum.run_hand]
        if part.name == "body":
            assert curvature == pytest.approx(sign / stratum.radius_m)
            assert gauge == pytest.approx(1e-3 * stratum.gauge_mm)
        else:
            assert curvature == pytest.approx(0.5 * sign / stratum.radius_m, rel=1e-3)
            assert sorted(map(abs, ends)) == pytest.approx(
                [0.0, 1.0 / stratum.radius_m], abs=0.1 / stratum.radius_m
            )
    # irregularity has faded in before the first part, and the rear leaves the last one before the end
    heads = [point[0] for point in case.described_vehicle().coupler.points]
    assert found.parts[0].start >= start_front(case.described_vehicle()) + 50.0
    assert alignment.length - found.parts[-1].end >= max(50.0, max(heads) - min(heads))


def test_forces_along_the_track_are_those_of_the_haul(collectives: dict[str, Collective]) -> None:
    def case(name: str) -> WeightedCase:
        vehicle, wanted = KINDS[name]
        return collectives[vehicle].cases([first(collectives[vehicle], wanted)])[0]

    braking, up, down, light = (
        case("braking").case,
        case("up").case,
        case("down").case,
        case("empty train").case,
    )
    assert braking.brake is not None and braking.brake.shoe_force_kN in (10.0, 4.0)
    assert (up.track.grades[0].gradient_per_mille, down.track.grades[0].gradient_per_mille) == (6.0, -6.0)
    assert up.traction is not None and (up.traction.trailing_wagons, up.traction.wagon_mass_t) == (68, 120.0)
    assert light.traction is not None and light.traction.wagon_mass_t == 21.6
    assert case("frozen").case.track.flexibility == "concrete_frozen"


def test_measured_irregularity_has_the_stated_deviation(collectives: dict[str, Collective]) -> None:
    """Over many strata the body's deviations scatter about the label, without bias."""
    collective = collectives[WAGON]
    items = [item for item in collective.strata if item.stratum.curve_class == "straight"][:24:2]
    ratio = []
    for found in collective.cases(items):
        irregular = found.case.track.irregular(0.0, 225.0).filtered(D1)
        ratio.append(1e3 * np.std(irregular.signal("level")) / found.stratum.level_deviation_mm)
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.05)


def test_films_go_with_the_season(collectives: dict[str, Collective]) -> None:
    collective = collectives[WAGON]
    named, factors = {}, {}
    for season in ("humid", "dry", "lubricated flange"):
        item = first(collective, lambda s, season=season: s.season == season)
        (found,) = collective.cases([item])
        films = wear_films(found.case, found.films)
        assert films.wheelsets == (4, 4)
        named[season] = films.named(2, 4, -1)
        factors[season] = films.factors.friction[0, 0, 0]
    assert named == {
        "humid": "tread lubricated, root lubricated, flange lubricated",
        "dry": "dry",
        "lubricated flange": "tread dry, root lubricated, flange greased",
    }
    natural, grease = (parameters("wear", "surface")[name].value for name in ("lubricated", "greased"))
    assert factors["humid"] == pytest.approx(1.0 / natural)
    assert factors["lubricated flange"] == pytest.approx([1.0, 1.0 / natural, 1.0 / grease])


def test_mirrored_strata_are_the_mirror_image_of_what_lies(collectives: dict[str, Collective]) -> None:
    """A right-hand curve run as it lies is the mirror image of the left-hand run with `mirrored`."""
    text = product_text("full", quantiles=1)
    pair = [
        Collective(plan_of_text(text.replace('hands = "merged"', f'hands = "{hands}"')))
        for hands in ("mirrored", "both")
    ]
    tracks = []
    for collective in pair:
        item = first(collective, lambda s: s.curve_class == "<350" and s.hand == "right")
        (found,) = collective.cases([item])
        track = found.case.mirrored().track if found.mirrored else found.case.track
        tracks.append((found.weight, track.sections, track.rails_along().sections))
    assert tracks[0][0] == pytest.approx(tracks[1][0])
    assert tracks[0][1:] == tracks[1][1:]


def test_a_case_that_is_not_allowed_names_its_stratum(collectives: dict[str, Collective]) -> None:
    text = product_text(quantiles=9).replace("deviation_mm = 4.0", "deviation_mm = 15.0")
    text = text.replace("truncation = 2.0", "truncation = 3.0")
    text = text.replace("ranges = { deviation_mm = [2.0, 6.0], truncation = [1.5, 3.0] }\n", "")
    collective = Collective(plan_of_text(text))
    item = first(collective, lambda s: s.curve_class == "straight" and s.gauge_mm < 1413.0)
    with pytest.raises(CaseError, match=r"case of stratum loaded straight .* leaves no flange clearance"):
        collective.cases([item])


def test_what_is_left_out_is_said(collectives: dict[str, Collective]) -> None:
    assert any("loaded: forces of the train" in text for text in collectives[WAGON].left_out())
    assert not any("braking" in text for text in collectives[LOCOMOTIVE].left_out())


def test_assumed_numbers_have_ranges_and_sources(collectives: dict[str, Collective]) -> None:
    assumed = {number.name: number for number in collectives[WAGON].assumed()}
    assert assumed["gauge.deviation_mm"].range == (2.0, 6.0)
    assert assumed["season[0].share_percent"].unit == "%"
    assert "gauge.mean_mm[2]" in assumed  # of the line's file
    assert all(number.source.startswith("assumed: ") for number in assumed.values())


@pytest.mark.slow
def test_a_case_runs_over_all_its_parts(tmp_path: Path) -> None:
    from hh_exudyn.log.store import open_run
    from hh_exudyn.multibody.simulate import simulate

    text = template_text("malmbanan", "iore_wagon_loaded").replace("body_m = 60.0", "body_m = 30.0")
    collective = Collective(plan_of_text(text))
    (found,) = collective.cases([first(collective, lambda s: s.curve_class == "<350")])
    simulate(found.case, tmp_path / "run")
    log = open_run(tmp_path / "run").contact()
    s = log["s"].to_numpy()
    for part in found.parts:
        inside = (s > part.start) & (s < part.end)
        assert set(log["wheelset"].to_numpy()[inside]) == {1, 2, 3, 4}
        assert s[inside].max() - s[inside].min() > 0.95 * (part.end - part.start)
