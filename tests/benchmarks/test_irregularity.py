"""Time of the irregularity kernel, called from compiled code as the dynamics does.

Asked: below 100 ns. Measured on one core of a shared machine: 16 ns rolling along the track, 26 ns jumping
about 10 km of it; 80 ns at random places, where no row of the table is in the processor's cache.

Run: pytest tests/benchmarks -p benchmark --override-ini addopts="--import-mode=importlib"
"""

from typing import Any

import pytest

from hh_exudyn.kernel import kernel
from track.irregularity.irregularity import random_irregularity
from track.irregularity.table import IrregularityTable, irregularity_at

CALLS = 10_000


@kernel
def many_places(table: IrregularityTable, step: float, calls: int) -> float:
    total = 0.0
    place = 0.0
    for _ in range(calls):
        place += step
        if place > 9000.0:
            place -= 9000.0
        state = irregularity_at(table, place)
        total += state.level + state.alignment + state.gauge + state.cross_level
        total += state.level_slope + state.alignment_slope + state.gauge_slope + state.cross_level_slope
    return total


@pytest.mark.parametrize("step", [0.01, 3571.3], ids=["rolling", "jumping"])
def test_irregularity_at(benchmark: Any, step: float) -> None:
    table = random_irregularity("erri_low", 10_000.0, seed=1).table()
    many_places(table, step, 2)
    benchmark.extra_info["calls"] = CALLS
    benchmark(many_places, table, step, CALLS)
