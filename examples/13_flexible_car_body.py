"""A car body that bends: Exudyn's beam elements in place of a rigid body of the catalogue's coach.

    python examples/13_flexible_car_body.py [FOLDER]

Where does the first bending frequency of the body appear in the spectrum of its motion over a rough track? A
free beam of that stiffness has it at 9 Hz.
"""

import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from hh_exudyn.case import Case, IntegrationCase, StraightCase, TrackCase
from hh_exudyn.log.sensors import sensor_values
from hh_exudyn.multibody.bending_body import BendingBody
from hh_exudyn.multibody.simulate import simulate
from vehicles.catalogue import vehicle

LENGTH, BOGIES, FREQUENCY = 24.0, 9.5, 9.0  # m, m, Hz
TRACK = TrackCase(rail="60E1", irregularity="erri_high", sections=(StraightCase(length_m=230),))
STEPS = IntegrationCase(step_ms=0.1, output_interval_ms=4.0)  # the beam's own vibrations are fast


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp(prefix="bending-coach-"))
    coach = vehicle("manchester_vehicle_1")
    beam = BendingBody(coach.body("car_body"), LENGTH, (-BOGIES, BOGIES), FREQUENCY)
    case = Case(name="bending", speed_km_h=100, friction=0.35, track=TRACK, integration=STEPS)
    run = simulate(case, folder / "run", vehicle=beam.in_two(coach), extend=beam)
    time, middle = sensor_values(run, beam.middle)
    _, end = sensor_values(run, beam.end)
    bending = middle[:, 2] - end[:, 2]
    padded = 8 * bending.size  # for a smooth spectrum
    power = np.abs(np.fft.rfft((bending - bending.mean()) * np.hanning(bending.size), padded)) ** 2
    frequency = np.fft.rfftfreq(padded, time[1] - time[0])
    band = (frequency > 0.6 * FREQUENCY) & (frequency < 1.6 * FREQUENCY)
    peak = frequency[band][power[band].argmax()]
    print(f"bending of the car body: {peak:.2f} Hz; free beam {FREQUENCY:.2f} Hz; {run.directory}")
    plt.semilogy(frequency, power)
    plt.gca().set(xlim=(0, 3 * FREQUENCY), xlabel="frequency [Hz]", ylabel="power of the bending [-]")
    plt.savefig(folder / "bending.png", dpi=150)


if __name__ == "__main__":
    main()
