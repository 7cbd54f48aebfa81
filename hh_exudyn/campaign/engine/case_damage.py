"""`evaluate_case`: a case is simulated into a temporary folder, its damage summed, and the logs thrown away.

Every wheelset counts while it runs on a part of the track itself, and its sums are scaled to the length of
that part: so the sums of a part are those of a vehicle that has passed it whole, also where it is shorter
than the vehicle.
"""

import hashlib
import json
import math
import shutil
import tempfile
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow

from damage.material import wheel_material
from damage.rails.model import RailModel, RailStretch
from damage.rails.steel import rail_material
from damage.report import DamageReport, assess
from damage.surface.wheel_surface import WheelSurface
from damage.wear.films import WearFilms
from damage.wear.laws import wear_law
from hh_exudyn.campaign.engine.sums import DamageSums, PartSums
from hh_exudyn.campaign.engine.task import Task
from hh_exudyn.case import Case
from hh_exudyn.case.sealed import sealed
from hh_exudyn.case.wheels import wheel_names
from hh_exudyn.contact.profile import Profile
from hh_exudyn.contact.types import WheelRailModel
from hh_exudyn.contact.wheels import alike
from hh_exudyn.conventions import LEFT, RIGHT
from hh_exudyn.kernel import source_hash
from hh_exudyn.multibody.provenance import software
from hh_exudyn.multibody.simulate import simulate
from vehicles.description import Vehicle

EXTREMES = {  # name with unit: column of the contact log, of which it is the largest absolute value
    "Q_N": "Q",
    "Y_N": "Y",
    "p_max_Pa": "p_max",
    "angle_of_attack_rad": "angle_of_attack",
}
_LEAST_COVERED = 0.5  # of a part of the track, by every wheelset
_STEP_SECONDS = 75e-6  # wall time of a step of a wheelset, and of the damage of its states, about; calibrated
_ROOT = Path(__file__).resolve().parents[3]
_OWN = ("hh_exudyn/campaign/engine/case_damage.py", "hh_exudyn/campaign/engine/sums.py")
_DATA = "damage/data"


@dataclass(frozen=True)
class Part:
    """A part of a case's track that is summed by itself.

    Attributes
    ----------
    name
        Of its sums: "transition", "curve".
    start, end
        Arc length of the track [m], 0 <= start < end.
    """

    name: str
    start: float
    end: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.start < self.end:
            raise ValueError(
                f"part {self.name}: start = {self.start:g} m must be >= 0 and below end = {self.end:g} m"
            )


@dataclass(frozen=True)
class DamageSettings:
    """How damage is computed, by names; see `damage.report.assess`.

    Attributes
    ----------
    law
        Wear law (`damage.wear.laws.wear_law`).
    material
        Wheel steel (`damage.material.wheel_material`).
    normal, theory
        Normal contact and tangential theory; None takes those that go with the case.
    cells
        Cells of a patch along and across [-].
    rails
        Whether the rails are summed beside the wheels, for cases with parts: 0.2 % of a case's time, and a
        result larger by half.
    rail_material
        Rail steel (`damage.rails.steel.rail_material`).
    """

    law: str = "archard"
    material: str = "ER7"
    normal: str | None = None
    theory: str | None = None
    cells: tuple[int, int] = (50, 50)
    rails: bool = True
    rail_material: str = "R260"


@dataclass(frozen=True)
class CaseWork:
    """A case and what is wanted of it.

    Attributes
    ----------
    case
        To be simulated.
    parts
        Of its track; none for the whole run as one part "run".
    settings
        Of the damage.
    films
        Lubricant for the wear coefficients; None takes that of the case's own treatments.
    scratch
        Folder for the run while it lasts; None for the system's.
    keep_logs
        Where the run folder is kept; None throws it away. On a cluster it is a folder of the worker.
    """

    case: Case
    parts: tuple[Part, ...] = ()
    settings: DamageSettings = field(default_factory=DamageSettings)
    films: WearFilms | None = None
    scratch: Path | None = None
    keep_logs: Path | None = None

    @property
    def key(self) -> str:
        """Hash (hexadecimal, 32 digits) of all that the sums depend on.

        That is the case without its name, the content of its vehicle, profiles and files, the parts, the
        settings, and the code.
        """
        wanted = {
            "case": sealed(self.case.with_changes(name="case")).digest,
            "parts": [asdict(part) for part in self.parts],
            "settings": asdict(self.settings),
            "films": None if self.films is None else _films_hash(self.films),
            "code": code(),
        }
        return hashlib.sha256(json.dumps(wanted, sort_keys=True).encode()).hexdigest()[:32]

    @property
    def size(self) -> float:
        """A guess of its wall time [s]: steps times wheelsets."""
        case = self.case
        steps = case.alignment().length / case.speed / (1e-3 * case.integration.step_ms)
        return _STEP_SECONDS * steps * len(case.described_vehicle().wheelsets)


def case_task(work: CaseWork, name: str, weight: float) -> Task:
    """The task of a case.

    Parameters
    ----------
    work
        The case and what is wanted of it.
    name, weight
        For messages; share in the whole.
    """
    return Task(name, work, work.key, weight, work.size)


@cache
def code() -> dict[str, Any]:
    """Hashes and versions of everything that sums of a case are computed with."""
    own = hashlib.sha256()
    for path in [*(_ROOT / name for name in _OWN), *sorted((_ROOT / _DATA).rglob("*"))]:
        if path.is_file():
            own.update(path.relative_to(_ROOT).as_posix().encode() + path.read_bytes())
    return {**software(), "damage": source_hash("damage"), "evaluation": own.hexdigest()[:16]}


def evaluate_case(work: CaseWork) -> PartSums:
    """Sums of a case by part of its track.

    Raises
    ------
    ValueError
        A part that a wheelset does not run on for at least half its length, or a fault of `assess`.
    NoEquilibrium, SimulationStopped, OSError
        As `simulate` does.
    """
    for folder in filter(None, (work.scratch, work.keep_logs)):
        folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(
        prefix="case-", dir=work.scratch, ignore_cleanup_errors=True
    ) as folder_name:
        run = simulate(work.case, Path(folder_name) / "run")
        sums = part_sums(run.contact(), work)
        if work.keep_logs is not None:
            shutil.rmtree(work.keep_logs / work.key, ignore_errors=True)
            shutil.move(run.directory, work.keep_logs / work.key)
    return sums


def part_sums(log: pyarrow.Table, work: CaseWork) -> PartSums:
    """Sums of a contact log by part of the track; ValueError as `evaluate_case`.

    Parameters
    ----------
    log
        Of the run of the case.
    work
        The case and what is wanted of it.
    """
    vehicle = work.case.described_vehicle()
    wheels = list(_wheels(work.case, vehicle))
    options = _options(work, vehicle)
    if not work.parts:
        reports = [_assessed(log, group, options) for group in _by_profile(wheels)]
        return {"run": _sums(log, [report.surface for report in reports])}
    found = {}
    for part in work.parts:
        rails = _rails(work, part) if work.settings.rails else None
        sums = _on_part(log, part, wheels, options | {"rails": rails})
        found[part.name] = replace(sums, rails=tuple(rail.passed_once(vehicle.mass) for rail in sums.rails))
    return found


def _rails(work: CaseWork, part: Part) -> RailModel:
    """The rails of a part, of the profiles in its middle; which rows lie on it is chosen before."""
    rails = work.case.track.rails_along().at(0.5 * (part.start + part.end)).rails
    whole = RailStretch.of(-math.inf, math.inf, rails.left_profile(), rails.right_profile())
    return RailModel((whole,), rail_material(work.settings.rail_material))


@dataclass(frozen=True)
class _Wheel:
    """A wheel of the run: its name in the log, and the profile with which it ran."""

    place: tuple[int, int, int]  # vehicle, wheelset, side
    profile_name: str
    profile: Profile
    contact: WheelRailModel | None


def _wheels(case: Case, vehicle: Vehicle) -> Iterator[_Wheel]:
    """All wheels of a vehicle."""
    count = len(vehicle.wheelsets)
    names, profiles = wheel_names(case.wheel_profiles, case.wheel_profile, count), case.wheels(count)
    contact = case.contact_model(vehicle) if case.contact.theory != "given" else None
    of_unit: dict[int, int] = {}
    for i, wheelset in enumerate(vehicle.wheelsets):
        number = of_unit[wheelset.unit] = of_unit.get(wheelset.unit, 0) + 1
        for s, side in enumerate((LEFT, RIGHT)):
            own = contact if contact is None or case.wheel_profiles is None else alike(contact, i, s)
            yield _Wheel((wheelset.unit, number, side), names[i][s], profiles[i][s], own)


def _by_profile(wheels: list[_Wheel]) -> list[list[_Wheel]]:
    """The wheels of each profile, in the order of their first ones."""
    groups: dict[str, list[_Wheel]] = {}
    for wheel in wheels:
        groups.setdefault(wheel.profile_name, []).append(wheel)
    return list(groups.values())


def _options(work: CaseWork, vehicle: Vehicle) -> dict[str, Any]:
    """Arguments of `assess` that are the same for all wheels."""
    settings = work.settings
    films = work.films
    if films is None:
        units = [wheelset.unit for wheelset in vehicle.wheelsets]
        counts = tuple(units.count(unit) for unit in vehicle.units)
        films = WearFilms(work.case.film_table(len(units)), counts)
    return {
        "material": wheel_material(settings.material),
        "law": wear_law(settings.law),
        "normal": settings.normal,
        "theory": settings.theory,
        "cells": settings.cells,
        "films": films,
        "threads": 1,  # the cases run side by side
    }


def _assessed(log: pyarrow.Table, wheels: list[_Wheel], options: dict[str, Any]) -> DamageReport:
    """The damage by wheels of one profile."""
    first, places = wheels[0], [wheel.place for wheel in wheels]
    return assess(log, profile=first.profile, contact=first.contact, wheels=places, **options)


def _on_part(log: pyarrow.Table, part: Part, wheels: list[_Wheel], options: dict[str, Any]) -> DamageSums:
    """The sums on a part of the track, of each wheelset while it runs there, scaled to its length."""
    place = {name: log[name].to_numpy() for name in ("time", "s", "vehicle", "wheelset")}
    there = (place["s"] >= part.start) & (place["s"] <= part.end)
    total = DamageSums(())
    by_wheelset: dict[tuple[int, int], list[_Wheel]] = {}
    for wheel in wheels:
        by_wheelset.setdefault(wheel.place[:2], []).append(wheel)
    for (unit, number), own in by_wheelset.items():
        mine = there & (place["vehicle"] == unit) & (place["wheelset"] == number)
        arc = place["s"][mine]
        covered = float(np.ptp(arc)) if arc.size else 0.0
        if covered < _LEAST_COVERED * (part.end - part.start):
            raise ValueError(
                f"part {part.name}, {part.start:g} to {part.end:g} m: wheelset {number} of vehicle {unit} "
                f"runs {covered:.1f} m of it, at least {_LEAST_COVERED:.0%} are needed"
            )
        times = place["time"][mine]
        during = (place["time"] >= times.min()) & (place["time"] <= times.max())
        piece = log.filter(pyarrow.array(during))  # with the other wheelsets: their times are the log's clock
        length = part.end - part.start
        reports = [_assessed(piece, group, options) for group in _by_profile(own)]
        of_mine = log.filter(pyarrow.array(mine))
        total = total + _sums(of_mine, [report.surface.scaled(length) for report in reports])
        for report in reports:
            total = total + DamageSums((), {}, tuple(rail for pair in report.rails for rail in pair))
    return replace(total, surfaces=tuple(_passed_once(surface, part) for surface in total.surfaces))


def _passed_once(surface: WheelSurface, part: Part) -> WheelSurface:
    """The sum of surfaces of wheelsets, each with its own time and distance, as of one vehicle."""
    length = part.end - part.start
    return replace(surface, time=surface.time * length / surface.distance, distance=length)


def _sums(log: pyarrow.Table, surfaces: list[WheelSurface]) -> DamageSums:
    """Surfaces, with the extremes of a log."""
    largest = {
        name: float(np.max(np.abs(log[column].to_numpy()), initial=0.0)) for name, column in EXTREMES.items()
    }
    return sum([DamageSums((surface,), {}) for surface in surfaces], DamageSums((), largest))


def _films_hash(films: WearFilms) -> str:
    digest = hashlib.sha256(repr(films.wheelsets).encode())
    for values in films.films:
        digest.update(np.ascontiguousarray(values).tobytes())
    return digest.hexdigest()
