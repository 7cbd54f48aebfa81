"""Contact states re-solved for damage on 50 x 50 cells, with one thread and with all processors.

A million states take this machine's time per state a million times; what is timed here is a piece of that.
Run: pytest tests/benchmarks -p benchmark --override-ini addopts="--import-mode=importlib"
"""

from typing import Any

import numpy as np
import pyarrow
import pytest

from damage.accumulate import accumulate, usable_processors
from damage.material import ER7
from damage.rcf import FLANGE_ANGLE
from damage.report import DEFAULT_GRID, DRY
from hh_exudyn.log.schema import CONTACT

WHEELS = 8


def contact_log(states: int, seed: int = 1) -> pyarrow.Table:
    """A contact log of four wheelsets with random patches and creepages, as of an ore wagon in curves."""
    generator = np.random.default_rng(seed)
    number = np.arange(states)
    values: dict[str, Any] = {column.name: np.zeros(states) for column in CONTACT}
    values["time"] = number // WHEELS * 4e-3
    values["vehicle"] = np.ones(states)
    values["wheelset"] = number % WHEELS // 2 + 1
    values["bogie"] = number % WHEELS // 4 + 1
    values["side"] = 1 - 2 * (number % 2)
    values["y_wheel"] = generator.uniform(-0.02, 0.035, states)
    values["contact_angle"] = generator.uniform(0.02, 0.6, states)
    values["rolling_radius"] = np.full(states, 0.46)
    values["a"] = generator.uniform(4e-3, 8e-3, states)
    values["b"] = generator.uniform(3e-3, 8e-3, states)
    values["normal_force"] = generator.uniform(80e3, 160e3, states)
    values["p_max"] = 1.5 * values["normal_force"] / (np.pi * values["a"] * values["b"])
    values["nu_x"] = generator.normal(0.0, 1e-3, states)
    values["nu_y"] = generator.normal(0.0, 2e-3, states)
    values["phi"] = generator.normal(0.3, 0.2, states)
    values["friction"] = np.full(states, 0.4)
    values["speed"] = np.full(states, 16.7)
    kinds = {"float64": np.float64, "int32": np.int32}
    return pyarrow.table({column.name: values[column.name].astype(kinds[column.kind]) for column in CONTACT})


@pytest.mark.parametrize("threads", sorted({1, usable_processors()}))
def test_states(benchmark: Any, threads: int) -> None:
    """A hundred thousand states; their rate per core is in the extra information of the benchmark."""
    states = 100_000
    log = contact_log(states)
    options = (ER7, "fastrip", (50, 50), DRY, FLANGE_ANGLE, DEFAULT_GRID)
    accumulate(contact_log(100), *options)
    surface = benchmark.pedantic(accumulate, (log, *options), {"threads": threads}, rounds=3)
    assert surface.rows == states
    if benchmark.stats is not None:
        benchmark.extra_info["states per second and core"] = states / benchmark.stats["median"] / threads
