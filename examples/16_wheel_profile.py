"""A wheel profile with less wear and less fatigue: two numbers changed by Optuna, each trial one evaluation.

    pip install 'hh-exudyn[studies]'
    hh-exudyn campaign new campaign.toml --vehicle iore_wagon
    python examples/16_wheel_profile.py campaign.toml FOLDER 20

All trials have the same random numbers. FOLDER keeps them: the same command with more trials goes on.
"""

import sys
from collections.abc import Callable, Mapping

import numpy as np

from hh_exudyn.campaign.engine.workers import ProcessWorkers
from hh_exudyn.campaign.objective import Objective, objective
from hh_exudyn.contact.profile import Profile, wheel_profile

try:
    import optuna
except ImportError:
    optuna = None

BASE, RUNNING_IN = wheel_profile("WP4_like"), 5e3  # m, as rates of new wheels are those of running-in


def changed(cone: float, root_mm: float) -> Profile:
    """The base with a tread steeper by `cone`, and so much more metal in the root, 30 mm from the circle."""
    y = BASE.y  # the flange goes with the end of the tread
    tread = np.where(y < 0.0, y, 20e-3 * np.tanh(y / 20e-3))
    root = 1e-3 * root_mm * (np.exp(-(((y - 30e-3) / 8e-3) ** 2)) - np.exp(-((30 / 8) ** 2)))
    return Profile("changed", "wheel", y, BASE.z - cone * tread - root)


def search(of: Callable[[Mapping[str, Profile]], Objective], trials: int) -> "optuna.Study":
    """Wear and fatigue at the same time, the base first."""

    def both(trial: "optuna.Trial") -> tuple[float, float]:
        profile = changed(trial.suggest_float("cone", -0.01, 0.01), trial.suggest_float("root_mm", -0.3, 0.3))
        found = of({"case.wheel_profile": profile})
        return found.wear, found.rcf

    optuna.logging.set_verbosity(optuna.logging.WARNING)
    study = optuna.create_study(directions=["minimize"] * 2, sampler=optuna.samplers.TPESampler(seed=1))
    study.enqueue_trial({"cone": 0.0, "root_mm": 0.0})
    study.optimize(both, n_trials=trials)
    return study


if __name__ == "__main__":
    if optuna is None:
        print("this example needs Optuna, which is not installed: pip install 'hh-exudyn[studies]'")
    else:
        file, folder, count = sys.argv[1:]
        with ProcessWorkers() as pool:
            study = search(objective(file, folder, pool, RUNNING_IN), int(count))
        for trial in (study.trials[0], *study.best_trials):
            numbers = ", ".join(f"{name} {value:+.4f}" for name, value in trial.params.items())
            print(f"{numbers}: {trial.values[0]:.2f} mm^2, Miner {trial.values[1]:.2g} per 1000 km")
