"""Contact states re-solved for damage on 50 x 50 cells: their fields alone; everything, on one and all cores.

A million states take this machine's time per state a million times; what is timed here is a piece of that.
Run: pytest tests/benchmarks -p benchmark --override-ini addopts="--import-mode=importlib"
"""

from typing import Any

import numpy as np
import pyarrow
import pytest

from damage.material import ER7
from damage.model import DamageModel
from damage.rcf.burstow import Burstow
from damage.surface.accumulate import accumulate, usable_processors
from hh_exudyn.contact.tangential.registry import FASTRIP, field_kernel
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel
from hh_exudyn.log.channels import CONTACT

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


MODEL = DamageModel(burstow=Burstow.of(ER7))
STATES = 20_000  # of which a million take fifty times the time: every chunk is treated alike


@kernel
def _solve(patches: np.ndarray, shear_modulus: float, poisson_ratio: float, fields: Fields) -> None:
    """Stress and slip fields alone."""
    for row in range(patches.shape[0]):
        a, b, normal_force, nu_x, nu_y, phi, friction = patches[row]
        patch = RollingPatch(a, b, normal_force, nu_x, nu_y, phi, friction, shear_modulus, poisson_ratio)
        field_kernel(FASTRIP, patch, fields)


def test_fields_alone(benchmark: Any) -> None:
    """What every state costs before anything is made of it: the measure for `test_states`."""
    log = contact_log(STATES)
    names = ("a", "b", "normal_force", "nu_x", "nu_y", "phi", "friction")
    patches = np.ascontiguousarray(np.column_stack([log[name].to_numpy() for name in names]))
    fields = Fields(*np.zeros((5, MODEL.cells[1], MODEL.cells[0])))
    elastic = (ER7.elastic.shear_modulus, ER7.elastic.poisson_ratio)
    _solve(patches[:10], *elastic, fields)
    benchmark.pedantic(_solve, (patches, *elastic, fields), rounds=5)
    if benchmark.stats is not None:
        benchmark.extra_info["states per second and core"] = STATES / benchmark.stats["median"]


@pytest.mark.parametrize("threads", sorted({1, usable_processors()}))
def test_states(benchmark: Any, threads: int) -> None:
    """Stress, slip, wear, fatigue, RCF numbers, sums; the rate per core is in the extra information."""
    log = contact_log(STATES)
    accumulate(contact_log(100), MODEL)
    surface = benchmark.pedantic(accumulate, (log, MODEL), {"threads": threads}, rounds=5)
    assert surface.rows == STATES
    if benchmark.stats is not None:
        benchmark.extra_info["states per second and core"] = STATES / benchmark.stats["median"] / threads
