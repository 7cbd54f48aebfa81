"""Importance of inputs by SALib: which of them a result depends on, over the unit cube of their quantiles.

``"morris"``  mu*, the mean size of the elementary effects (M. D. Morris, Technometrics 33 (1991); mu* of F.
              Campolongo et al., Environ. Modell. Softw. 22 (2007)): the change of the result over the whole
              of an input. Trajectories x (inputs + 1) points: cheap.
``"sobol"``   S_T, the share of the variance that an input has a part in (A. Saltelli et al., Comput. Phys.
              Commun. 181 (2010)), by a quasi-random sample of a power of two x (inputs + 2) points.
"""

from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from hh_exudyn.arrays import FloatArray

METHODS = ("morris", "sobol")
_LEVELS = 4  # of Morris' grid: steps of 2/3 between 0, 1/3, 2/3, 1
_PER_TRAJECTORY = 10  # samples of a study for each of Morris' trajectories
_LEAST = 4  # trajectories, or points of Sobol's sample


class Importance(NamedTuple):
    """Importance of k inputs.

    Attributes
    ----------
    value
        (k,) mu* in the unit of the result, or S_T [-].
    half_width
        (k,) of its interval of 95 %, by bootstrap.
    """

    value: FloatArray
    half_width: FloatArray


def points_of(method: str, inputs: int, samples: int, seed: int) -> FloatArray:
    """(n, inputs) points of the unit cube at which the result is needed.

    Parameters
    ----------
    method
        One of `METHODS`.
    inputs
        How many, 1 or more.
    samples
        Of the study: Morris takes a tenth as trajectories, Sobol the next power of two.
    seed
        Of the random numbers.

    Raises
    ------
    ValueError
        Another method, or SALib is not installed.
    """
    sample, _ = _modules(method)
    if method == "morris":
        count = max(_LEAST, round(samples / _PER_TRAJECTORY))
        found = sample.sample(_problem(inputs), count, num_levels=_LEVELS, seed=seed)
    else:
        count = 2 ** int(np.ceil(np.log2(max(_LEAST, samples))))
        found = sample.sample(_problem(inputs), count, calc_second_order=False, seed=seed)
    return np.asarray(found, dtype=np.float64)


def importance_of(method: str, points: FloatArray, results: FloatArray, seed: int) -> Importance:
    """Importance of the inputs for one result.

    Parameters
    ----------
    method, seed
        As `points_of`.
    points
        (n, k) of it.
    results
        (n,) at them; Morris leaves out trajectories with a result that is not finite.

    Raises
    ------
    ValueError
        As `points_of`, or results that are not finite: with Morris in all trajectories but one.
    """
    inputs, known = points.shape[1], np.isfinite(results)
    if method == "morris":
        known = np.repeat(known.reshape(-1, inputs + 1).all(axis=1), inputs + 1)
    if not known.all() and (method != "morris" or known.sum() <= inputs + 1):
        raise ValueError(
            f"{int((~np.isfinite(results)).sum())} of {results.size} lives are not known, as wear leaves no "
            f"valid profile: the importance by {method} needs them"
        )
    points, results = points[known], results[known]
    if np.ptp(results) == 0.0:
        return Importance(np.zeros(inputs), np.zeros(inputs))
    _, analyze = _modules(method)
    if method == "morris":
        found = analyze.analyze(_problem(inputs), points, results, num_levels=_LEVELS, seed=seed)
        value, half_width = found["mu_star"], found["mu_star_conf"]
    else:
        found = analyze.analyze(_problem(inputs), results, calc_second_order=False, seed=seed)
        value, half_width = found["ST"], found["ST_conf"]
    return Importance(np.asarray(value, dtype=np.float64), np.asarray(half_width, dtype=np.float64))


def _problem(inputs: int) -> dict[str, Any]:
    names = [f"x{i}" for i in range(inputs)]
    return {"num_vars": inputs, "names": names, "bounds": [[0.0, 1.0]] * inputs}


def _modules(method: str) -> tuple[ModuleType, ModuleType]:
    """SALib's modules of a method, for the sample and for its analysis."""
    if method not in METHODS:
        raise ValueError(f"method = {method!r}: allowed {', '.join(METHODS)}")
    try:
        from SALib.analyze import morris as analyze_morris
        from SALib.analyze import sobol as analyze_sobol
        from SALib.sample import morris as sample_morris
        from SALib.sample import sobol as sample_sobol
    except ImportError:
        raise ValueError(
            "SALib is not installed: the importance of assumptions needs the extra studies, "
            "pip install 'hh-exudyn[studies]'"
        ) from None
    return (sample_morris, analyze_morris) if method == "morris" else (sample_sobol, analyze_sobol)
