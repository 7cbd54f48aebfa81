"""The sourced numbers behind a case: of its vehicle, track, check rails, irregularities, friction."""

from hh_exudyn.case.case import Case
from hh_exudyn.case.check_rail import CHECK_RAIL_NUMBERS
from hh_exudyn.case.friction import FrictionCase, SurfaceCase
from hh_exudyn.case.track import RIGID
from hh_exudyn.case.vehicle import variant_behind
from hh_exudyn.sourced import Parameter
from track.friction import friction_numbers
from track.irregularity.spectra import spectrum, spectrum_names
from track.support.sleepers import sleeper_track_numbers


def case_numbers(case: Case) -> tuple[Parameter, ...]:
    """Every number of a data file that enters a run, without those of the case file itself.

    Parameters
    ----------
    case : Case
        The case; the numbers of a vehicle that was built in Python have no sources and are left out.
    """
    vehicle = variant_behind(case.vehicle)
    found = [] if vehicle is None else list(vehicle.parameters().parameters)
    if case.track.flexibility != RIGID:
        found += sleeper_track_numbers(case.track.flexibility)
    if case.track.irregularity in spectrum_names():
        found += spectrum(case.track.irregularity).numbers.parameters
    if case.track.check_rail is not None:
        found += CHECK_RAIL_NUMBERS.parameters
    if isinstance(case.friction, FrictionCase):
        found += _friction(case.friction)
    return tuple(found)


def assumed_summary(case: Case) -> str:
    """How many of the numbers behind a case are assumed, in one line."""
    numbers = case_numbers(case)
    assumed = sum(number.kind == "assumed" for number in numbers)
    return f"{assumed} of the {len(numbers)} numbers behind it are assumed: hh-exudyn parameters --assumed"


def _friction(table: FrictionCase) -> list[Parameter]:
    """Numbers of the climates, treatments and the falling characteristic that a table names."""
    surfaces: list[SurfaceCase | None] = []
    for place in (table, *table.sections):
        surfaces += [place, place.left, place.right]
    names = [("falling", table.falling)] if isinstance(table.falling, str) else []
    if table.lubricated_wheelsets:
        names.append(("treatment", table.lubrication))
    for surface in surfaces:
        if surface is not None:
            names += [("climate", surface.climate)] if surface.climate is not None else []
            names += [("treatment", name) for name in surface.treatments or ()]
    return [item for kind, name in dict.fromkeys(names) for item in friction_numbers(kind, name).parameters]
