"""A contact log made by hand, for the damage tests."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pyarrow
import pytest

from hh_exudyn.contact.normal.hertz import hertz_patch
from hh_exudyn.contact.tangential.api import creep_force
from hh_exudyn.log.channels import LOGS


@pytest.fixture(scope="session")
def make_log() -> Callable[..., pyarrow.Table]:
    """Builder of a contact log: `make_log(a=..., nu_x=...)`, scalars or (n,) arrays; the rest has defaults.

    Without `force_x`, `force_y`, `moment_z` the creep forces are FaStrip's; without `p_max` it is Hertz's.
    """

    def build(**given: Any) -> pyarrow.Table:
        values: dict[str, Any] = {column.name: 0.0 for column in LOGS["contact"]}
        values |= {"vehicle": 1, "bogie": 1, "wheelset": 1, "side": 1, "patch": 0}
        values |= {"a": 6e-3, "b": 5e-3, "normal_force": 100e3, "friction": 0.4, "speed": 15.0}
        values |= {"rolling_radius": 0.46, "nu_x": 1e-3}
        values |= given
        values.setdefault("Q", values["normal_force"])
        count = max(np.size(value) for value in values.values())
        table = {name: np.broadcast_to(np.asarray(value), count) for name, value in values.items()}
        if "p_max" not in given:
            table["p_max"] = 1.5 * table["normal_force"] / (np.pi * table["a"] * table["b"])
        if "force_x" not in given:
            names = ("a", "b", "normal_force", "nu_x", "nu_y", "phi", "friction")
            forces = [
                creep_force("fastrip", *(float(table[name][row]) for name in names)) for row in range(count)
            ]
            table["force_x"] = np.array([force.x for force in forces])
            table["force_y"] = np.array([force.y for force in forces])
            table["moment_z"] = np.array([force.moment for force in forces])
        kinds = {"float64": np.float64, "int32": np.int32}
        return pyarrow.table(
            {column.name: table[column.name].astype(kinds[column.kind]) for column in LOGS["contact"]}
        )

    return build


@pytest.fixture(scope="session")
def random_log(make_log: Callable[..., pyarrow.Table]) -> pyarrow.Table:
    """Two wheelsets in a curve for 40 output times, tread and flange, one and two patches, seeded."""
    generator = np.random.default_rng(3)
    rows: dict[str, list[float]] = {}
    for step in range(40):
        for wheelset in (1, 2):
            for side in (1, -1):
                for patch in range(1 + int(side == 1 and wheelset == 1 and step % 3 != 0)):
                    flange = patch == 1
                    force = generator.uniform(20e3, 60e3) if flange else generator.uniform(90e3, 160e3)
                    curvature = generator.uniform(10.0, 60.0) if flange else generator.uniform(1.0, 4.0)
                    hertz = hertz_patch(force, 1.1, curvature)
                    row = {
                        "time": 0.01 * step,
                        "wheelset": wheelset,
                        "side": side,
                        "patch": patch,
                        "y_wheel": generator.uniform(0.036, 0.039)
                        if flange
                        else generator.normal(0.0, 0.008),
                        "contact_angle": 1.1 if flange else generator.uniform(0.0, 0.1),
                        "rolling_radius": 0.46,
                        "normal_force": force,
                        "a": hertz.a,
                        "b": hertz.b,
                        "nu_x": generator.normal(0.0, 2e-3),
                        "nu_y": generator.normal(0.0, 4e-3),
                        "phi": generator.normal(2.0 if flange else 0.2, 0.1),
                        "friction": 0.4,
                        "speed": 15.0 + 0.02 * step,
                    }
                    for name, value in row.items():
                        rows.setdefault(name, []).append(value)
    return make_log(**{name: np.array(values) for name, values in rows.items()})
