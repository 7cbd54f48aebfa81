"""What a wheel profile is worth on the line's rails: its measures, and conicity on three rails at two gauges.

    python examples/04_profiles_and_conicity.py [WHEEL]

WHEEL is a standard name or a measured file of any format (MiniProf, SIMPACK, two columns); without it the
stand-in for the ore wagons' WP4, whose coordinates are not public (all its numbers are assumed).
"""

import math
import sys

import numpy as np

from hh_exudyn.contact.geometry.functions import equivalent_conicity
from hh_exudyn.contact.profile import WHEEL_PROFILES, rail_profile, read_wheel_profile, wheel_profile
from hh_exudyn.contact.profiles.measures import (
    flange_angle,
    flange_height,
    flange_steepness,
    flange_thickness,
)

RADIUS, TAPE_DISTANCE = 0.46, 1.5  # m
AMPLITUDES = np.array([1e-3, 3e-3, 6e-3])  # m


def main() -> None:
    name = sys.argv[1] if len(sys.argv) > 1 else "WP4_like"
    wheel = wheel_profile(name) if name in WHEEL_PROFILES else read_wheel_profile(name)
    print(
        f"{wheel.name}: Sh {1e3 * flange_height(wheel):.2f}, Sd {1e3 * flange_thickness(wheel):.2f}, "
        f"qR {1e3 * flange_steepness(wheel):.2f} mm, flange angle {math.degrees(flange_angle(wheel)):.1f}°"
    )
    print("equivalent conicity at the amplitudes", ", ".join(f"{1e3 * y:g} mm" for y in AMPLITUDES))
    for gauge in (1.435, 1.445):
        for rail in ("60E1", "MB1_like", "MB4_like"):
            head = rail_profile(rail, 1 / 30)
            conicity = equivalent_conicity(
                wheel, head, wheel, head, gauge=gauge, tape_distance=TAPE_DISTANCE,
                radius_left=RADIUS, radius_right=RADIUS, amplitudes=AMPLITUDES,
            )  # fmt: skip
            print(f"gauge {1e3 * gauge:.0f} mm, {rail:8}", " ".join(f"{value:.3f}" for value in conicity))


if __name__ == "__main__":
    main()
