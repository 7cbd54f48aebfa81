"""Films of lubricant between wheel and rail: wear over that of dry steel, by place, wheel and zone.

A run says where lubricant lies (`hh_exudyn.case.friction`): its treatments reach zones of the wheel, sections
of the track, and wheelsets. Archard's coefficients are divided there as those of a lubricated or a greased
surface (`damage.wear.archard`; Hossein-Nia 2018, p. 70: 6 after Jendel, 100 after Zhu). From root to flange
and from section to section the factor passes as friction does; from tread to root over a wider range, y = 10
to 35 mm of a new wheel: an edge of the film would be worn into the profile. Other laws have no such numbers:
theirs stay dry.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from damage.parameters import parameters
from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.contact.friction import FILMS, FrictionTable, constant_friction

ZONES = ("tread", "root", "flange")
NO_FILM = constant_friction(np.ones((1, 2)))
"""Factors of a run without lubricant: 1 everywhere."""


@dataclass(frozen=True, eq=False)
class WearFilms:
    """The films of a run.

    Attributes
    ----------
    films
        Number of the film in `hh_exudyn.contact.friction.FILMS` in place of each friction coefficient.
    wheelsets
        Of each vehicle of the run, in its order: the table counts the wheelsets through.
    """

    films: FrictionTable
    wheelsets: tuple[int, ...]

    @property
    def dry(self) -> bool:
        """Whether there is no lubricant at all."""
        return not np.any(self.films.friction)

    def without(self) -> "WearFilms":
        """The same wheelsets without any lubricant."""
        return replace(self, films=self.films._replace(friction=np.zeros_like(self.films.friction)))

    @property
    def factors(self) -> FrictionTable:
        """Wear over that of dry steel, for the kernels."""
        divisors = parameters("wear", "surface")
        factor = np.array([1.0 if film == "dry" else 1.0 / divisors[film].value for film in FILMS])
        passage = parameters("wear", "films")
        return self.films._replace(
            friction=factor[self.films.friction.astype(np.int64)],
            corner_from=math.radians(passage["root_from"].value),
            corner_to=math.radians(passage["root_to"].value),
        )

    def rows(self, vehicle: FloatArray, wheelset: FloatArray) -> IntArray:
        """Wheelsets of the table, (n,), from those of contact states.

        Parameters
        ----------
        vehicle, wheelset
            (n,) numbers in the log, from 1.

        Raises
        ------
        ValueError
            The run has no such vehicle or wheelset.
        """
        unit, number = vehicle.astype(np.int64), wheelset.astype(np.int64)
        count = np.array(self.wheelsets, dtype=np.int64)
        known = (unit >= 1) & (unit <= count.size)
        known &= (number >= 1) & (number <= count[np.where(known, unit - 1, 0)])
        if not known.all():
            bad = int(np.argmin(known))
            raise ValueError(
                f"contact log: vehicle {unit[bad]}, wheelset {number[bad]}: the run has vehicles of "
                f"{', '.join(map(str, self.wheelsets))} wheelsets"
            )
        found: IntArray = (np.cumsum(count) - count)[unit - 1] + number - 1
        return found

    def named(self, vehicle: int, wheelset: int, side: int) -> str:
        """The films of a wheel in words: ``dry``, or ``tread dry, root lubricated, flange greased``.

        Parameters
        ----------
        vehicle, wheelset, side
            As in the log.
        """
        row = int(self.rows(np.array([float(vehicle)]), np.array([float(wheelset)]))[0])
        codes = self.films.friction[self.films.surface[row], :, 0 if side > 0 else 1]  # (sections, zones)
        if not codes.any():
            return FILMS[0]
        zones = (
            f"{zone} {' to '.join(FILMS[code] for code in sorted(set(codes[:, k].astype(int))))}"
            for k, zone in enumerate(ZONES)
        )
        return ", ".join(zones)
