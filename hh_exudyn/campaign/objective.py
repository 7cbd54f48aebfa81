"""Wear and rolling contact fatigue as a function of parameters, for optimisation.

    with ProcessWorkers() as workers:
        of = objective("campaign.toml", Path("out"), workers)
        of({"case.wheel_profile": profile, "axle_load": 32.5}).wear

Parameters are those of `campaign vary`. All calls have the random numbers of the file, so that small changes
of a parameter are not drowned in them: the function is deterministic, and as biased as the sample is.
"""

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from damage.life.places import WheelPlaces
from hh_exudyn.campaign.engine.case_damage import code, evaluate_case
from hh_exudyn.campaign.engine.mapping import TooManyFailed
from hh_exudyn.campaign.engine.task import Evaluate
from hh_exudyn.campaign.engine.workers import Workers
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.campaign.life.profiles import ProfileFiles
from hh_exudyn.campaign.life.rates import GroupRates
from hh_exudyn.campaign.variation.changed import changed_text
from hh_exudyn.case.fields import is_path
from hh_exudyn.contact.profile import Profile
from hh_exudyn.log.parts import write_bytes, write_text
from hh_exudyn.text_files import read_bytes

_PROFILE = "case.wheel_profile"
_VALUES = "objective.json"


@dataclass(frozen=True)
class Objective:
    """Rates of the wheels as they are after the distance of the objective; smaller is better.

    Attributes
    ----------
    wear
        Worn area of the cross-section of a wheel, the mean of all [mm^2 per 1000 km].
    rcf
        Miner's sum of rolling contact fatigue at the worst place of any tread [1 per 1000 km]; its inverse is
        the distance to failure if nothing wore off.
    tread, flange
        Depth of wear at the worst place of any tread, and of any root or flange [um per 1000 km].
    """

    wear: float
    rcf: float
    tread: float
    flange: float


def objective(
    file: Path | str,
    folder: Path | str,
    workers: Workers,
    distance: float = 0.0,
    index: str = "global",
    evaluate: Evaluate = evaluate_case,
) -> Callable[[Mapping[str, Any]], Objective]:
    """A function from parameters to wear and fatigue.

    Parameters
    ----------
    file
        Of the campaign.
    folder
        For the campaigns of all parameters; what was computed is not computed again.
    workers
        Where cases run.
    distance
        Rolled before the rates are taken [m]. 0: those of new wheels by one evaluation, running-in included,
        which wears roots far faster than later; a few kilometres run them in.
    index
        Of fatigue: "global" or "local".
    evaluate
        From a case to its sums.

    Returns
    -------
    callable
        From a mapping of values by key (`hh_exudyn.campaign.variation.changed.changed_text`) to an
        `Objective`. A wheel profile is a name, a file, or a `Profile`; files of profiles count by their
        content, other files of the campaign must not change. It raises ValueError for parameters that are not
        allowed, and what `Campaign.run` raises.
    """
    folder = Path(folder)

    def of(parameters: Mapping[str, Any]) -> Objective:
        text = changed_text(file, _with_profiles(parameters, folder))
        given = json.dumps([text, distance, index, code()], sort_keys=True)
        own = folder / hashlib.sha256(given.encode()).hexdigest()[:16]
        if (own / _VALUES).is_file():
            return Objective(**json.loads((own / _VALUES).read_text(encoding="utf-8")))
        own.mkdir(parents=True, exist_ok=True)
        write_text(own / "campaign.toml", text)
        campaign = Campaign.begin(own / "campaign.toml", own / "campaign")
        try:
            if distance > 0.0:
                campaign.run(workers, distance, evaluate=evaluate)
            rates = campaign.evaluated(workers, evaluate=evaluate).rates
        except TooManyFailed:
            workers.renew([], [])  # they were stopped, and other parameters may do better
            raise
        places = {group: WheelPlaces.of(one.step.profile) for group, one in campaign.start().items()}
        found = _objective(rates, places, index)
        write_text(own / _VALUES, json.dumps(asdict(found)) + "\n")
        return found

    return of


def _with_profiles(parameters: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Parameters with wheel profiles as files named by their content."""
    files, found = ProfileFiles((folder / "profiles").resolve()), dict(parameters)
    for key, value in parameters.items():
        if isinstance(value, Profile):
            found[key] = str(files.path(files.put(value)))
        elif key == _PROFILE and isinstance(value, str) and is_path(value):
            content = read_bytes(value)
            name = hashlib.sha256(content).hexdigest()[:16] + Path(value).suffix
            files.directory.mkdir(parents=True, exist_ok=True)
            write_bytes(files.directory / name, content)
            found[key] = str(files.directory / name)
    return found


def _objective(rates: Mapping[str, GroupRates], places: Mapping[str, WheelPlaces], index: str) -> Objective:
    """The numbers of all groups of wheels, which have as many wheels each."""
    worst = {group: places[group].largest(one.depth, one.y) for group, one in rates.items()}
    cracks = [places[group].largest(one.cracks[index], one.y)["tread"] for group, one in rates.items()]
    return Objective(
        wear=1e12 * sum(one.worn_area for one in rates.values()) / len(rates),
        rcf=1e6 * max(cracks),
        tread=1e12 * max(one["tread"] for one in worst.values()),
        flange=1e12 * max(max(one["root"], one["flange"]) for one in worst.values()),
    )
