"""Wear of the cases when what films of lubricant take off it is varied.

A film divides the dry wear coefficients of a zone of the wheel, and from zone to zone the factor passes with
the contact angle (`damage.wear.films`). So the wear of a case at a place of the profile goes with the mean
factor of the wheels of a group there: exactly where all wheels of the group have the same films; where some
wheelsets have lubricators, as if all wore alike when dry. Friction, which goes with the films, is not varied.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from damage.parameters import parameters
from damage.wear.films import WearFilms
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.campaign.collective.films import wear_films
from hh_exudyn.campaign.collective.weighted import WeightedCase
from hh_exudyn.campaign.life.plan import CampaignPlan
from hh_exudyn.contact.friction import FILMS
from hh_exudyn.contact.profile import Profile
from hh_exudyn.conventions import LEFT

NAMES = {
    **{f"wear.surface.{film}": ("surface", film) for film in FILMS[1:]},
    **{f"wear.films.{end}": ("films", end) for end in ("root_from", "root_to")},
}
"""Numbers that this file varies: table and entry of ``damage/data/wear.toml`` by name."""


class FilmWear:
    """Wear of every case over that with the films as they are.

    Parameters
    ----------
    plan
        Of the campaign.
    cases
        Of the evaluation.
    profiles, y
        Worn profile of every group of wheels, and the bins of its rates [m].
    """

    def __init__(
        self, plan: CampaignPlan, cases: Sequence[WeightedCase], profiles: Mapping[str, Profile],
        y: Mapping[str, FloatArray],
    ) -> None:  # fmt: skip
        self._usual = {name: parameters("wear", table)[key].value for name, (table, key) in NAMES.items()}
        self._angle = {group: np.degrees(_contact_angle(profiles[group], y[group])) for group in y}
        codes: dict[str, dict[str, IntArray]] = {}  # (wheels x sections, 3) by run and group
        flange: dict[str, tuple[float, float]] = {}
        self._of_case: list[tuple[dict[str, IntArray], tuple[float, float]]] = []
        returning = {running.name: running.returning for running in plan.collective.plan.running}
        for weighted in cases:
            stratum = weighted.stratum
            run = f"{stratum.key};{weighted.mirrored}"
            if run not in codes:
                films, vehicle = wear_films(weighted.case, weighted.films), weighted.case.described_vehicle()
                groups = plan.grouping.of_run(vehicle, stratum, returning[stratum.running], weighted.mirrored)
                codes[run] = _codes(films, groups)
                ends = np.degrees([films.films.flange_from, films.films.flange_to])
                flange[run] = float(ends[0]), float(ends[1])
            self._of_case.append((codes[run], flange[run]))
        self._plain = {group: self._wear(group, self._usual) for group in y}

    @property
    def films(self) -> tuple[str, ...]:
        """The films that lie on a wheel in some case."""
        found = {int(code) for codes, _ in self._of_case for rows in codes.values() for code in rows.flat}
        return tuple(FILMS[code] for code in sorted(found - {0}))

    @property
    def passes(self) -> bool:
        """Whether there is a wheel with different films on its zones, so that their passage counts."""
        rows = [row for codes, _ in self._of_case for of_group in codes.values() for row in of_group]
        return any(len(set(row.tolist())) > 1 for row in rows)

    def factors(self, group: str, values: Mapping[str, float]) -> FloatArray:
        """(cases, B) wear of a group over that with the films as they are.

        Parameters
        ----------
        group
            Of wheels.
        values
            By name, of `NAMES`: divisors, and contact angles [deg] at the ends of the passage from tread to
            root; others are ignored.
        """
        own = {name: values.get(name, usual) for name, usual in self._usual.items()}
        if own == self._usual:
            return np.ones_like(self._plain[group])
        return np.asarray(self._wear(group, own) / self._plain[group], dtype=np.float64)

    def _wear(self, group: str, values: Mapping[str, float]) -> FloatArray:
        """(cases, B) wear of a group over that of dry steel."""
        inverse = np.array([1.0, *(1.0 / values[f"wear.surface.{film}"] for film in FILMS[1:])])
        angle = self._angle[group]
        root = _smooth((angle - values["wear.films.root_from"]) / _width(values))
        found = np.ones((len(self._of_case), angle.size))
        for row, (codes, (start, end)) in enumerate(self._of_case):
            if group not in codes:
                continue
            flange = _smooth((angle - start) / (end - start))
            zones = inverse[codes[group]]  # (wheels, 3)
            tread, corner, face = (zones[:, k].mean() for k in range(3))
            found[row] = tread + root * (corner - tread) + flange * (face - corner)
        return found


def _width(values: Mapping[str, float]) -> float:
    return values["wear.films.root_to"] - values["wear.films.root_from"]


def _codes(films: WearFilms, groups: Mapping[tuple[int, int], str]) -> dict[str, IntArray]:
    """Numbers of the films on tread, root and flange, a row for each wheel and section, by group."""
    table = films.films
    found: dict[str, list[IntArray]] = {}
    for (wheelset, side), group in groups.items():
        rows = table.friction[table.surface[wheelset - 1], :, 0 if side == LEFT else 1]
        found.setdefault(group, []).append(rows.astype(np.int64))
    return {group: np.concatenate(rows) for group, rows in found.items()}


def _contact_angle(wheel: Profile, y: FloatArray) -> FloatArray:
    """Contact angle at lateral places, positive towards the flange; beyond its tip a right angle [rad]."""
    angle = np.arctan(-np.gradient(wheel.z, wheel.y))
    tip = wheel.y[int(np.argmin(wheel.z))]
    return np.where(y < tip, np.interp(y, wheel.y, angle), 0.5 * np.pi)


def _smooth(x: FloatArray) -> FloatArray:
    """From 0 at x <= 0 to 1 at x >= 1 as friction passes (`hh_exudyn.contact.friction`)."""
    t = np.clip(x, 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t), dtype=np.float64)
