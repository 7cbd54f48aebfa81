"""When a locomotive's wheels must be turned, how long they last, and what the answer hangs on.

    python examples/15_when_to_turn.py FOLDER

From rates that stay the same: wear as measured, and the distance at which cracks fail a tread. The limits and
their sources stand in damage/data/limits.toml.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from damage.evolution.profile_wear import ProfileWear
from damage.figures.lives import lives_figure
from damage.life.condition import WheelCondition
from damage.life.forecast import first_turnings, life_from_rates, whole_life
from damage.life.life_table import distance_quantiles, write_life
from damage.life.limits import WheelLimits, limit
from damage.life.places import WheelPlaces
from damage.life.rates import LifeRates
from damage.life.turning import TurningRule
from hh_exudyn.contact.profile import wheel_profile

FOLDER, PROFILE, LIMITS = Path(sys.argv[1]), wheel_profile("WP4_like"), WheelLimits.of("iore_locomotive")
WHEELS = WheelCondition.new(
    "locomotive", PROFILE, 0.5 * LIMITS.new_diameter, limit("cracks", "failure_depth")
)
Y = np.array([-60, -50, -35, 20, 30, 36, 42, 48, 52]) * 1e-3
DEPTH = (
    np.array([0, 2.7, 8.9, 8.9, 5.3, 3.6, 6.1, 6.1, 0]) * 1e-9
)  # m/km: Sh +1.34, Sd -0.11 mm in 150,000 km
LATERAL = WHEELS.grid.lateral
BANDS = np.interp(LATERAL, np.array([-52, -45, -25, -18, -15, -5, 0]) * 1e-3, [0, 1, 1, 0.3, 0.6, 0.6, 0])


def rates(km: float) -> LifeRates:
    """Cracks that would fail after so many kilometres if nothing wore."""
    return LifeRates(ProfileWear(Y, DEPTH), {"global": BANDS / km, "local": 0.5 * BANDS / km})


if __name__ == "__main__":
    places, rule, lives = WheelPlaces.of(PROFILE), TurningRule([PROFILE]), []
    for one in life_from_rates(WHEELS, rates(50e3), LIMITS, places, longest=600e6, all_limits=True).crossings:
        print(
            f"{one.reason.measure} reaches {1e3 * one.reason.limit:.1f} mm after {one.distance / 1e3:.0f} km"
        )
    for depth in (5.0, 2.0):
        group, limits = f"cracks of {depth:.0f} mm", replace(LIMITS, largest_crack_depth=1e-3 * depth)
        turned = whole_life(replace(WHEELS, group=group), rates(50e3), limits, rule)
        often, cut = f"every {turned[0].distance / 1e3:.0f} km", f"{1e3 * turned[0].cut:.1f} mm"
        print(f"{group}: turned {often} by {cut}; end after {turned[-1].distance / 1e3:.0f} km")
        lives += turned
    draw = np.random.default_rng(1).lognormal(np.log(50e3), 0.5, 40)  # seasons of friction: assumed
    found = distance_quantiles(first_turnings(WHEELS, map(rates, draw), LIMITS, places))
    print("first turning: " + ", ".join(f"{100 * q:.0f} % by {km / 1e3:.0f} km" for q, km in found.items()))
    write_life(FOLDER, lives)
    lives_figure(lives, LIMITS).savefig(FOLDER / "lives.png", dpi=150)
