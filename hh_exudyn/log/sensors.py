"""The log of Exudyn's sensors, by sensor."""

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.log.store import Run


def sensor_values(run: Run, name: str) -> tuple[FloatArray, FloatArray]:
    """Times (n,) [s] and values (n, components) of a sensor that an extension has named, in its own unit.

    Parameters
    ----------
    run : Run
        With an extension.
    name : str
        Of the sensor.

    Raises
    ------
    ValueError
        The run has no such sensor.
    """
    log = run.read("sensors")
    names = np.array(log["sensor"].to_pylist(), dtype=object)
    wanted = names == name
    if not wanted.any():
        raise ValueError(f"sensor {name!r} is not in {run.directory}; it has {', '.join(sorted(set(names)))}")
    components = int(log["component"].to_numpy()[wanted].max()) + 1
    times = log["time"].to_numpy()[wanted][::components]
    return times, log["value"].to_numpy()[wanted].reshape(-1, components)
