"""One wheel on one rail: the Hertz patch of a 30 t axle load, and how the creep force saturates.

    python examples/01_one_contact.py

The wheel has 915 mm diameter and touches a rail head of 300 mm radius with its straight tread. FASTSIM and
FaStrip agree on the force within some per cent; what FaStrip improves is the shear stress.
"""

from hh_exudyn.contact.normal.hertz import hertz_patch
from hh_exudyn.contact.tangential.api import creep_force
from hh_exudyn.conventions import GRAVITY


def main() -> None:
    wheel_load = 30e3 / 2 * GRAVITY
    patch = hertz_patch(wheel_load, curvature_x=1 / (2 * 0.4575), curvature_y=1 / (2 * 0.300))
    print(f"{wheel_load / 1e3:.1f} kN: a = {patch.a * 1e3:.2f} mm, b = {patch.b * 1e3:.2f} mm, "
          f"p_max = {patch.max_pressure / 1e6:.0f} MPa")  # fmt: skip

    friction = 0.4
    print("creepage [per mille]   FASTSIM   FaStrip   (force over friction * load)")
    for creepage in (0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3):
        shares = []
        for theory in ("fastsim", "fastrip"):
            force = creep_force(theory, patch.a, patch.b, wheel_load, creepage, 0.0, 0.0, friction)
            shares.append(-force.x / (friction * wheel_load))  # the force acts against the creepage
        print(f"{creepage * 1e3:20.1f} {shares[0]:9.3f} {shares[1]:9.3f}")


if __name__ == "__main__":
    main()
