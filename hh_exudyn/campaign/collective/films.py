"""Lubricant of a stratum for the wear coefficients: the natural film of its season, and its treatments.

Wear coefficients go with friction: what makes a rail slippery also separates the surfaces. Archard's
coefficients are divided by 6 under natural lubrication (Jendel, after Hossein-Nia 2018, p. 70) and by 100
under grease (Zhu, ibid.); `damage.wear.films` applies them zone by zone from a table of films.
"""

import numpy as np

from damage.parameters import parameters
from damage.wear.films import WearFilms
from hh_exudyn.campaign.collective.plan import Films
from hh_exudyn.case import Case
from hh_exudyn.contact.friction import FILMS, FrictionTable

DIVISORS = {film: 1.0 if film == FILMS[0] else parameters("wear", "surface")[film].value for film in FILMS}
"""Divisor of the dry wear coefficients under each film [-]."""


def film_table(case: Case, natural: Films, wheelsets: int) -> FrictionTable:
    """Films by place, wheel and zone, as `Case.film_table`, none weaker than the natural one.

    Parameters
    ----------
    case : Case
        With its treatments; its friction is a table.
    natural : Films
        Of the season.
    wheelsets : int
        Of the vehicle.
    """
    own = case.film_table(wheelsets)
    least = np.array([float(FILMS.index(name)) for name in natural.names])
    return own._replace(friction=np.maximum(own.friction, least))


def wear_films(case: Case, natural: Films) -> WearFilms:
    """The films of a run for the wear laws of `damage.wear`, in place of those that the case alone has.

    Parameters
    ----------
    case, natural
        As `film_table`.
    """
    vehicle = case.described_vehicle()
    units = [wheelset.unit for wheelset in vehicle.wheelsets]
    counts = tuple(units.count(unit) for unit in vehicle.units)
    return WearFilms(film_table(case, natural, len(units)), counts)
