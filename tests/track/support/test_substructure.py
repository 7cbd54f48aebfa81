"""The track under a wheelset by itself: transfer function, energy, symmetry, passing sleepers."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from track.support.flexibility import track_flexibility
from track.support.substructure import DOFS, TrackFlexibility, track_forces

STEP = 0.4e-3  # s, of the vehicle's integration
NONE = np.zeros((2, 2))


@pytest.fixture(scope="module")
def track() -> TrackFlexibility:
    return track_flexibility("concrete")


def march(
    track: TrackFlexibility, steps: int, rail_force: Callable[[float], np.ndarray], speed: float = 0.0
) -> np.ndarray:
    """(steps + 1, 7) displacements by the classical Runge-Kutta method, from the static rest at time 0."""
    parameters, masses, force = track.parameters(), track.masses(), np.empty(7)
    place = 0.25 * track.sleeper_spacing

    def rate(time: float, state: np.ndarray) -> np.ndarray:
        track_forces(parameters, place + speed * time, state[:7], state[7:], rail_force(time), force)
        return np.concatenate([state[7:], force / masses])

    start = np.linalg.solve(track.matrices()[0], np.append(rail_force(0.0).ravel(), np.zeros(3)))
    state = np.append(start, np.zeros(7))
    found = [start]
    for step in range(steps):
        time = step * STEP
        a = rate(time, state)
        b = rate(time + STEP / 2, state + STEP / 2 * a)
        c = rate(time + STEP / 2, state + STEP / 2 * b)
        d = rate(time + STEP, state + STEP * c)
        state = state + STEP / 6 * (a + 2 * b + 2 * c + d)
        found.append(state[:7])
    return np.array(found)


def amplitude(signal: np.ndarray, frequency: float, periods: int) -> np.ndarray:
    """Complex amplitude of the last whole periods, by least squares with a constant."""
    count = round(periods / frequency / STEP)
    time = (np.arange(len(signal)) * STEP)[-count:]
    wave = 2.0 * np.pi * frequency * time
    basis = np.column_stack([np.cos(wave), np.sin(wave), np.ones(count)])
    cosine, sine, _ = np.linalg.lstsq(basis, signal[-count:], rcond=None)[0]
    return cosine - 1j * sine


@pytest.mark.parametrize("frequency", [5.0, 15.0, 27.8, 35.0])
@pytest.mark.parametrize(("side", "axis"), [(0, 0), (0, 1), (1, 1)])
def test_motion_under_a_harmonic_force_is_the_transfer_function(track, side, axis, frequency) -> None:
    """At a fixed place, by the kernel in time steps, against the matrices: 1e-3 of the largest."""

    def rail_force(time: float) -> np.ndarray:
        forces = np.zeros((2, 2))
        forces[side, axis] = 1e3 * np.cos(2.0 * np.pi * frequency * time)
        return forces

    settled = 0.35  # s: the slowest decay is exp(-30 t)
    signal = march(track, round((settled + 3.0 / frequency) / STEP), rail_force)
    exact = 1e3 * track.receptance(frequency)[:, 2 * side + axis]
    arm = np.array([1.0] * 6 + [track.rail_spacing_half])  # roll as the displacement of a rail seat
    error = arm * np.abs(amplitude(signal, frequency, 3) - exact)
    assert error.max() < 1e-3 * (arm * np.abs(exact)).max()


def test_passing_sleepers_shake_the_track_at_speed_over_spacing(track) -> None:
    """A constant load at 60 km/h: the rail moves at v/d as the modulated spring under its static load tells.

    First order: the spring's change -eps k cos on its static compression is a pair of forces on rail and
    sleeper, answered by the transfer function. Second order is eps, below 5 %.
    """
    speed, load = 60.0 / 3.6, 150e3
    frequency = speed / track.sleeper_spacing
    constant = np.array([[0.0, -load], [0.0, -load]])
    signal = march(track, round(0.6 / STEP), lambda _: constant, speed)[:, 1]
    found = amplitude(signal, frequency, 4)
    # eps k u = eps load: up on the sleeper and down on the rail where the pad is soft, between sleepers
    pair = track.passing_vertical * load * np.array([0.0, 1.0, 0.0, 1.0, 0.0, -2.0, 0.0])
    start = np.exp(2j * np.pi * 0.25)  # the wave's phase at time 0, a quarter of the spacing after a sleeper
    expected = (track.receptance(frequency) @ pair)[1] * start
    assert abs(found - expected) < 0.05 * abs(expected)
    spectrum = np.abs(np.fft.rfft(signal[-round(16 / frequency / STEP) :] - signal.mean()))
    assert np.argmax(spectrum) == 16
    assert 10e-6 < abs(found) < 60e-6  # some hundredths of a millimetre


def test_the_rail_is_highest_over_a_sleeper(track) -> None:
    on, between = track.static_deflection(150e3, 0.0), track.static_deflection(150e3, 0.3)
    assert on < track.static_deflection(150e3) < between
    assert between == pytest.approx(track.static_deflection(150e3, -0.3), rel=1e-12)
    even = track.evenly_supported()
    assert even.static_deflection(150e3, 0.0) == even.static_deflection(150e3, 0.123)
    assert even.static_deflection(150e3) == pytest.approx((on + between) / 2, rel=1e-12)


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
    power = track_forces(track.parameters(), 0.0, rest, rest, np.array([[1.0, 2.0], [3.0, 4.0]]), force)
    assert force.tolist() == [1.0, 2.0, 3.0, 4.0, 0.0, 0.0, 0.0]
    assert power == 0.0


def test_a_free_decay_loses_what_the_dampers_take(track: TrackFlexibility) -> None:
    parameters, masses = track.parameters(), track.masses()
    stiffness, _ = track.matrices(0.1)
    force = np.empty(7)

    def rate(_: float, state: np.ndarray) -> np.ndarray:
        q, v = state[:7].copy(), state[7:14].copy()
        power = track_forces(parameters, 0.1, q, v, NONE, force)
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
        power = track_forces(track.parameters(), 0.1, q, v, NONE, force)
        assert power == pytest.approx(v @ damping @ v, rel=1e-12)
        assert power >= 0.0


def test_bad_input_says_what_is_wrong(track: TrackFlexibility) -> None:
    assert len(DOFS) == len(track.masses())
    with pytest.raises(ValueError, match=r"rail_mass_lateral of TrackFlexibility is 0.0 kg"):
        replace(track, rail_mass_lateral=0.0)
    with pytest.raises(ValueError, match=r"passing_vertical of TrackFlexibility is 1.0, it must be from 0"):
        replace(track, passing_vertical=1.0)
    with pytest.raises(ValueError, match=r"frequency is -1.0 Hz"):
        track.receptance(-1.0)
