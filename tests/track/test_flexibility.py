"""The track under a wheelset against the beam on elastic foundation, energy and symmetry."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import solve_banded

from track.flexibility import SleeperTrack, TrackFlexibility, sleeper_track, track_flexibility, track_forces

RAIL_MASS_PER_LENGTH = 60.64  # kg/m, Zhai 2004
BALLAST_MASS = 531.4  # kg per rail seat, Zhai 2004
VALID_TO = 35.0  # Hz, Hossein-Nia 2018, section 1.2.1


@pytest.fixture(scope="module")
def track() -> TrackFlexibility:
    return track_flexibility("concrete")


@pytest.fixture(scope="module")
def sleepers() -> SleeperTrack:
    return sleeper_track("concrete")


def both_rails(track: TrackFlexibility, dof: int, frequency: float) -> complex:
    """Receptance of one rail when both carry the same force: dof 0 lateral, 1 vertical."""
    matrix = track.receptance(frequency)
    return complex(matrix[dof, dof] + matrix[dof, dof + 2])


def test_the_vertical_stiffness_is_that_of_a_beam_on_sleepers(
    track: TrackFlexibility, sleepers: SleeperTrack
) -> None:
    """Finite differences of EI w'''' + k' w = 0 on 20 m with a unit force in the middle."""
    support = 1.0 / (
        1.0 / sleepers.pad_stiffness_vertical
        + 1.0 / sleepers.ballast_stiffness_vertical
        + 1.0 / sleepers.subgrade_stiffness_vertical
    )
    h, n = 0.01, 2001
    bending = sleepers.young_modulus * sleepers.rail_inertia_vertical / h**4
    bands = np.zeros((5, n))
    bands[0, 2:] = bands[4, :-2] = bending
    bands[1, 1:] = bands[3, :-1] = -4.0 * bending
    bands[2] = 6.0 * bending + support / sleepers.sleeper_spacing
    load = np.zeros(n)
    load[n // 2] = 1.0 / h
    deflection = solve_banded((2, 2), bands, load)[n // 2]
    assert both_rails(track, 1, 0.0).real == pytest.approx(deflection, rel=1e-3)


def test_stiffness_under_a_wheel_is_in_the_swedish_range(track: TrackFlexibility) -> None:
    assert 50e6 < 1.0 / both_rails(track, 1, 0.0).real < 100e6
    assert 25e6 < 1.0 / both_rails(track, 0, 0.0).real < 50e6
    assert 1.5e-3 < track.static_deflection(150e3) < 3.0e-3


def test_the_assumed_rail_mass_is_harmless_vertically(
    track: TrackFlexibility, sleepers: SleeperTrack
) -> None:
    """Against the beam's own effective mass 3 m' / (2 beta), up to 35 Hz."""
    stiffness = 1.0 / both_rails(track, 1, 0.0).real
    per_metre = (stiffness / (2.0 * math.sqrt(2.0))) ** (4 / 3) / (
        sleepers.young_modulus * sleepers.rail_inertia_vertical
    ) ** (1 / 3)
    true_mass = RAIL_MASS_PER_LENGTH * 0.75 * stiffness / per_metre
    assert 60.0 < true_mass < 100.0
    light = replace(track, rail_mass_vertical=true_mass)
    for frequency in np.linspace(0.0, VALID_TO, 36):
        ratio = both_rails(track, 1, frequency) / both_rails(light, 1, frequency)
        assert abs(ratio - 1.0) < 0.10


def test_the_vertical_receptance_is_that_of_the_three_layer_track(
    track: TrackFlexibility, sleepers: SleeperTrack
) -> None:
    """Against the infinite beam on Zhai's three layers with the ballast masses, in the frequency domain."""
    for frequency in np.linspace(0.0, VALID_TO, 36):
        omega = 2.0 * math.pi * frequency
        pad = sleepers.pad_stiffness_vertical + 1j * omega * sleepers.pad_damping_vertical
        ballast = sleepers.ballast_stiffness_vertical + 1j * omega * sleepers.ballast_damping_vertical
        ground = sleepers.subgrade_stiffness_vertical + 1j * omega * sleepers.subgrade_damping_vertical
        below = ground - omega**2 * BALLAST_MASS
        below = ballast * below / (ballast + below) - omega**2 * 0.5 * sleepers.sleeper_mass
        support = pad * below / (pad + below)
        per_metre = support / sleepers.sleeper_spacing - omega**2 * RAIL_MASS_PER_LENGTH
        bending = sleepers.young_modulus * sleepers.rail_inertia_vertical
        stiffness = 2.0 * math.sqrt(2.0) * bending**0.25 * per_metre**0.75
        assert abs(both_rails(track, 1, frequency) * stiffness - 1.0) < 0.10


def test_the_lateral_receptance_is_that_of_the_beam_up_to_20_hz(
    track: TrackFlexibility, sleepers: SleeperTrack
) -> None:
    """Against the infinite beam; the surplus of rail mass costs the range from 20 to 35 Hz laterally."""
    for frequency in np.linspace(0.0, 20.0, 21):
        omega = 2.0 * math.pi * frequency
        pad = sleepers.pad_stiffness_lateral + 1j * omega * sleepers.pad_damping_lateral
        below = sleepers.ballast_stiffness_lateral + 1j * omega * sleepers.ballast_damping_lateral
        below -= omega**2 * 0.5 * sleepers.sleeper_mass
        per_metre = pad * below / (pad + below) / sleepers.sleeper_spacing - omega**2 * RAIL_MASS_PER_LENGTH
        bending = sleepers.young_modulus * sleepers.rail_inertia_lateral
        stiffness = 2.0 * math.sqrt(2.0) * bending**0.25 * per_metre**0.75
        assert abs(both_rails(track, 0, frequency) * stiffness - 1.0) < 0.10


def test_modes_are_damped_and_dampers_fit_the_time_step(track: TrackFlexibility) -> None:
    frequencies, ratios = track.modes()
    assert len(frequencies) == 7
    assert frequencies.min() > VALID_TO
    assert np.all(ratios > 0.09)
    assert np.all(ratios < 0.7)
    assert track.pad_damping_vertical / track.rail_mass_vertical < 1500.0
    assert track.pad_damping_lateral / track.rail_mass_lateral < 1500.0


def test_matrices_are_symmetric_and_positive(track: TrackFlexibility) -> None:
    for matrix in track.matrices():
        assert np.array_equal(matrix, matrix.T) or np.allclose(matrix, matrix.T, rtol=1e-14)
        assert np.linalg.eigvalsh(matrix).min() > 0.0


def test_symmetric_and_antisymmetric_loads(track: TrackFlexibility) -> None:
    static = track.receptance(0.0).real
    down = static @ [0.0, -1e5, 0.0, -1e5, 0.0, 0.0, 0.0]
    assert down[1] == pytest.approx(down[3], rel=1e-12)
    assert down[1] < down[5] < 0.0  # rail deeper than the sleeper
    assert np.abs(down[[0, 2, 4, 6]]).max() < 1e-18
    assert -down[1] == pytest.approx(track.static_deflection(1e5), rel=1e-12)
    twist = static @ [0.0, 1e5, 0.0, -1e5, 0.0, 0.0, 0.0]  # lifts the left
    assert twist[1] == pytest.approx(-twist[3], rel=1e-12)
    assert twist[6] > 0.0
    assert twist[5] == pytest.approx(0.0, abs=1e-18)
    roll = (
        2e5
        * track.rail_spacing_half
        / (2.0 * track.ballast_stiffness_vertical * track.ballast_spacing_half**2)
    )
    assert twist[6] == pytest.approx(roll, rel=1e-12)
    spread = static @ [1e4, 0.0, -1e4, 0.0, 0.0, 0.0, 0.0]  # the gauge widens, the sleeper stays
    assert spread[0] == pytest.approx(1e4 / track.pad_stiffness_lateral, rel=1e-12)
    assert spread[4] == pytest.approx(0.0, abs=1e-18)


def test_contact_forces_enter_at_their_rail(track: TrackFlexibility) -> None:
    force = np.empty(7)
    rest = np.zeros(7)
    power = track_forces(track.parameters(), rest, rest, np.array([[1.0, 2.0], [3.0, 4.0]]), force)
    assert force.tolist() == [1.0, 2.0, 3.0, 4.0, 0.0, 0.0, 0.0]
    assert power == 0.0


def test_a_free_decay_loses_what_the_dampers_take(track: TrackFlexibility) -> None:
    parameters, masses, none = track.parameters(), track.masses(), np.zeros((2, 2))
    stiffness, _ = track.matrices()
    force = np.empty(7)

    def rate(_: float, state: np.ndarray) -> np.ndarray:
        q, v = state[:7].copy(), state[7:14].copy()
        power = track_forces(parameters, q, v, none, force)
        return np.concatenate([v, force / masses, [power]])

    start = np.array([1e-3, -2e-3, -5e-4, 1e-3, 3e-4, -1e-3, 1e-3, 0.1, 0.2, -0.1, 0.3, 0.0, -0.2, 0.1, 0.0])

    def energy(state: np.ndarray) -> float:
        q, v = state[:7], state[7:14]
        return float(0.5 * v @ (masses * v) + 0.5 * q @ stiffness @ q)

    end = solve_ivp(rate, (0.0, 0.02), start, rtol=1e-10, atol=1e-13).y[:, -1]
    lost = energy(start) - energy(end)
    assert lost > 0.5 * energy(start)
    assert end[14] == pytest.approx(lost, rel=1e-6)


def test_damper_power_is_that_of_the_damping_matrix(track: TrackFlexibility) -> None:
    _, damping = track.matrices()
    random = np.random.default_rng(3)
    force = np.empty(7)
    for _ in range(20):
        q, v = random.normal(size=7), random.normal(size=7)
        power = track_forces(track.parameters(), q, v, np.zeros((2, 2)), force)
        assert power == pytest.approx(v @ damping @ v, rel=1e-12)
        assert power >= 0.0


def test_bad_input_says_what_is_wrong(track: TrackFlexibility, sleepers: SleeperTrack) -> None:
    with pytest.raises(ValueError, match=r"'wooden' is not known, there are: concrete"):
        track_flexibility("wooden")
    with pytest.raises(ValueError, match=r"rail_mass_lateral of TrackFlexibility is 0.0 kg"):
        replace(track, rail_mass_lateral=0.0)
    with pytest.raises(ValueError, match=r"pad_damping_vertical of SleeperTrack is nan N s/m"):
        replace(sleepers, pad_damping_vertical=math.nan)
    with pytest.raises(ValueError, match=r"frequency is -1.0 Hz"):
        track.receptance(-1.0)
