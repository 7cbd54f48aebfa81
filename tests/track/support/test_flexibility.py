"""The lumped track against a Timoshenko rail on discrete sleepers, and the parameter sets."""

import math
from dataclasses import replace

import numpy as np
import pytest
from rail_on_sleepers import PLACES, WEIGHTS, receptances

from hh_exudyn.sourced import load_parameters, read_parameters
from track.support import sleepers as sleepers_file
from track.support.flexibility import LARGEST_RATE, LEAST_RAIL_MASS, VALID_TO, track_flexibility
from track.support.sleepers import SleeperTrack, sleeper_track, sleeper_track_names
from track.support.substructure import TrackFlexibility

SETS = ("concrete", "concrete_frozen", "concrete_soft", "concrete_stiff", "wooden", "wooden_frozen")
FREQUENCIES = np.array([0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0])
LOADINGS = ("alike", "opposite")
DOF = {"lateral": 0, "vertical": 1}


@pytest.fixture(scope="module")
def reference() -> dict[tuple[str, str], np.ndarray]:
    return {
        (name, direction): receptances(sleeper_track(name), direction, FREQUENCIES)
        for name in SETS
        for direction in DOF
    }


def lumped(track: TrackFlexibility, direction: str, frequency: float, s: float) -> np.ndarray:
    """Receptance of a rail, both loaded alike and opposite."""
    matrix, dof = track.receptance(frequency, s), DOF[direction]
    return np.array([matrix[dof, dof] + sign * matrix[dof, dof + 2] for sign in (1.0, -1.0)])


@pytest.mark.parametrize("direction", DOF)
@pytest.mark.parametrize("name", SETS)
def test_the_endless_track_agrees_with_finite_elements(name, direction, reference) -> None:
    """Two ways to the same rail on sleepers: waves of an endless one, elements of a long one."""
    track = sleeper_track(name)
    places = PLACES * track.sleeper_spacing
    found = [
        [[track.receptance(direction, loading, frequency, s) for s in places] for loading in LOADINGS]
        for frequency in FREQUENCIES
    ]
    np.testing.assert_allclose(found, reference[name, direction], rtol=1e-3)


@pytest.mark.parametrize("direction", DOF)
@pytest.mark.parametrize("name", SETS)
def test_receptance_within_20_percent_up_to_35_hz(name, direction, reference) -> None:
    """From a sleeper to between two, rails alike and opposite; complex, so amplitude and phase together."""
    track = track_flexibility(name)
    for f, frequency in enumerate(FREQUENCIES):
        for place, share in enumerate(PLACES):
            found = lumped(track, direction, frequency, share * track.sleeper_spacing)
            error = np.abs(found / reference[name, direction][f, :, place] - 1.0)
            assert error.max() < 0.20


@pytest.mark.parametrize("direction", DOF)
@pytest.mark.parametrize("name", SETS)
def test_statics_are_those_of_the_rail_on_sleepers(name, direction, reference) -> None:
    """Mean along the track, alike and opposite (gauge spreading, roll); and the first harmonic alike."""
    track, static = track_flexibility(name), reference[name, direction][0].real
    found = np.array([lumped(track, direction, 0.0, x * track.sleeper_spacing).real for x in PLACES]).T
    assert found @ WEIGHTS == pytest.approx(static @ WEIGHTS, rel=1e-3)

    def harmonic(compliance: np.ndarray, number: int) -> float:
        return float(2.0 * WEIGHTS @ (compliance * np.cos(2.0 * np.pi * number * PLACES)))

    first = harmonic(static[0], 1)
    assert harmonic(found[0], 1) == pytest.approx(first, rel=0.01)
    assert -0.10 < first / (static[0] @ WEIGHTS) < -0.005  # stiffest on a sleeper
    assert 0.0 < harmonic(static[0], 2) / first < 0.25  # what the smooth model leaves out


def test_concrete_in_summer_is_much_closer_vertically(reference) -> None:
    track = track_flexibility("concrete")
    for f, frequency in enumerate(FREQUENCIES):
        found = lumped(track, "vertical", frequency, 0.0)
        assert np.abs(found / reference["concrete", "vertical"][f, :, 0] - 1.0).max() < 0.03


def test_closely_spaced_supports_are_zimmermanns_foundation() -> None:
    """K = 2 sqrt(2) (EI)^(1/4) k'^(3/4) (Zimmermann 1888) for a slender rail on an even bed."""
    even = replace(
        sleeper_track("concrete"),
        sleeper_spacing=0.006,
        rail_shear_coefficient=1e3,
        pad_stiffness_vertical=65e4,
        ballast_stiffness_vertical=137.75e4,
        subgrade_stiffness_vertical=77.5e4,
    )
    per_metre = even.support("vertical", "alike", 0.0).real / even.sleeper_spacing
    bending = even.young_modulus * even.rail_inertia_vertical
    zimmermann = 2.0 * math.sqrt(2.0) * bending**0.25 * per_metre**0.75
    assert 1.0 / even.receptance("vertical", "alike", 0.0, 0.0).real == pytest.approx(zimmermann, rel=1e-3)


def test_static_deflection_under_150_kn() -> None:
    """1.5 to 3 mm where unfrozen, so 50 to 100 MN/m under a wheel, as Swedish lines are said to have.

    Frozen track is stiffer (Hossein-Nia 2018, figure 1-10), 1.5 to 3 times (sources/vehicles.md, a guide).
    """
    deflection = {name: track_flexibility(name).static_deflection(150e3) for name in SETS}
    assert 1.5e-3 < deflection["concrete"] < 3.0e-3
    assert 1.5e-3 < deflection["wooden"] < 3.0e-3
    assert deflection["concrete_stiff"] < deflection["concrete"] < deflection["concrete_soft"] < 3.0e-3
    for name in ("concrete", "wooden"):
        assert 1.5 < deflection[name] / deflection[f"{name}_frozen"] < 3.0


@pytest.mark.parametrize("name", SETS)
def test_the_explicit_step_stays_stable(name) -> None:
    """With a contact spring of 1.7 GN/m (150 kN) on every rail, normal and tangential, at 0.4 ms.

    The wheel is held, which is stiffer than any wheel. |lambda| h < 2.7 is the region of RK4.
    """
    track = track_flexibility(name)
    stiffness, damping = track.matrices(0.0)  # on a sleeper: the stiffest
    contact = np.diag([1.7e9] * 4 + [0.0] * 3)
    inverse = 1.0 / track.masses()[:, None]
    state = np.block([[np.zeros((7, 7)), np.eye(7)], [-inverse * (stiffness + contact), -inverse * damping]])
    assert np.abs(np.linalg.eigvals(state)).max() * 0.4e-3 < 2.7
    assert min(track.rail_mass_lateral, track.rail_mass_vertical) > 0.999 * LEAST_RAIL_MASS
    assert track.pad_damping_vertical < 1.001 * LARGEST_RATE * track.rail_mass_vertical


@pytest.mark.parametrize("name", SETS)
def test_own_modes_are_damped_and_above_the_valid_range(name) -> None:
    frequencies, ratios = track_flexibility(name).modes()
    assert frequencies.min() > VALID_TO
    assert ratios.min() > 0.05


def test_frozen_track_is_what_its_factors_say() -> None:
    summer, frozen = sleeper_track("concrete"), sleeper_track("concrete_frozen")
    assert frozen.subgrade_stiffness_vertical == pytest.approx(5.0 * summer.subgrade_stiffness_vertical)
    assert frozen.sleeper_mass == summer.sleeper_mass


def test_bad_input_says_what_is_wrong(monkeypatch) -> None:
    known = "concrete, concrete_frozen, concrete_soft, concrete_stiff, wooden, wooden_frozen"
    with pytest.raises(ValueError, match=rf"'slab' is not known, there are: {known}$"):
        track_flexibility("slab")
    track = sleeper_track("concrete")
    with pytest.raises(ValueError, match=r"pad_damping_vertical of SleeperTrack is nan N s/m"):
        replace(track, pad_damping_vertical=math.nan)
    with pytest.raises(ValueError, match=r"frequency is -1.0 Hz"):
        track.receptance("vertical", "alike", -1.0, 0.0)
    with pytest.raises(ValueError, match=r"after_sleeper is 0.7 m, it must be from 0 to 0.6 m"):
        track.receptance("vertical", "alike", 1.0, 0.7)
    value = {"value": 1.0, "unit": "m", "source": "assumed: test"}
    for table, message in (
        ({"slab_length": value}, "slab_length of track 'bad' is not known"),
        ({"factor": {"sleeper_length": value}}, "factor.sleeper_length of track 'bad' is not known"),
        ({"sleeper_length": value | {"unit": "mm"}}, "sleeper_length of track 'bad' is in 'mm', .* 'm'"),
        ({"sleeper_length": value}, r"track 'bad' has no ballast_damping_lateral \[N s/m\]"),
    ):
        bad = read_parameters({"bad": table}, "flexibility", "flexibility.toml")
        monkeypatch.setattr(sleepers_file, "_sets", lambda bad=bad: bad)
        with pytest.raises(ValueError, match=message):
            sleeper_track("bad")


def test_every_set_describes_itself() -> None:
    for name in sleeper_track_names():
        assert load_parameters("track", "flexibility").texts[f"{name}.description"]
    assert isinstance(sleeper_track("wooden"), SleeperTrack)
