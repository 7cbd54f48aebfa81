"""The normal theories: one record each, and the kernels that call the strips of the one asked for.

A theory of strips is a file with a kernel `strip`; here a number, a record in `NORMAL` and a line in `strip`
(and in `pressure_by_strip`, where its strips do not wait for the stiffness of the whole patch). Case schema
and checks follow from the records.
"""

from typing import NamedTuple

from hh_exudyn.contact.normal import analyn, kik_piotrowski
from hh_exudyn.contact.normal.hertz import CURVATURE_FLOOR
from hh_exudyn.contact.normal.interpenetration import Minimum
from hh_exudyn.contact.tangential.registry import STRIP_THEORIES
from hh_exudyn.contact.types import Triple
from hh_exudyn.kernel import inlined_kernel

HERTZ = 0
ANALYN = 1
KIK_PIOTROWSKI = 2
COUPLED_STRIPS = 3
EQUIVALENT_ELASTIC = 4


class NormalTheory(NamedTuple):
    """A theory of the normal contact."""

    number: int  # by which kernels know it
    name: str
    meaning: str  # with its source
    makes_strips: bool = True  # whether its patches are made of strips, or ellipses
    only: tuple[str, ...] = ()  # tangential theories that know its strips; empty: all that take strips


NORMAL = (
    NormalTheory(
        COUPLED_STRIPS,
        "coupled_strips",
        "strips along the profile that press on each other (`hh_exudyn.contact.strips`)",
        only=("fastrip",),  # each strip has its own slip
    ),
    NormalTheory(HERTZ, "hertz", "the ellipse of Hertz", makes_strips=False),
    NormalTheory(ANALYN, "analyn", "Hertz strip by strip: Sichani, Enblom and Berg 2014"),
    NormalTheory(KIK_PIOTROWSKI, "kik_piotrowski", "virtual interpenetration: Kik and Piotrowski 1996"),
    NormalTheory(
        EQUIVALENT_ELASTIC,
        "equivalent_elastic",
        "one ellipse of equal area for each region of overlap, as SIMPACK's of that name",
        makes_strips=False,
    ),
)
NORMAL_THEORIES: dict[str, int] = {theory.name: theory.number for theory in NORMAL}


def check_combination(normal: str, theory: str) -> None:
    """Whether a tangential theory can take the patches of a normal one.

    Parameters
    ----------
    normal, theory : str
        Names of a normal and of a tangential theory.

    Raises
    ------
    ValueError
        For strips under a theory that does not take them.
    """
    wanted = tangential_theories(normal)
    if wanted and theory not in wanted:
        names = " or ".join(repr(name) for name in wanted)
        raise ValueError(
            f"theory = {theory!r} does not take the patches of normal = {normal!r}, which need {names}"
        )


def tangential_theories(normal: str) -> tuple[str, ...]:
    """The tangential theories that take the patches of a normal one; empty where every theory does.

    Parameters
    ----------
    normal : str
        Name of a normal theory.
    """
    record = next(known for known in NORMAL if known.name == normal)
    return (record.only or STRIP_THEORIES) if record.makes_strips else ()


@inlined_kernel
def is_elliptic(normal: int) -> bool:
    """Whether a theory makes ellipses, not strips."""
    return normal in (HERTZ, EQUIVALENT_ELASTIC)


@inlined_kernel
def pressure_by_strip(normal: int) -> bool:
    """Whether every strip has a pressure of its own; else it follows from the stiffness of the patch."""
    return normal == ANALYN


@inlined_kernel
def strip(low: Minimum, s: float, gap: float, curvature_y: float) -> Triple:
    """One strip of a patch (kernel).

    Parameters
    ----------
    low : Minimum
        The point of deepest interpenetration, with the theory's number.
    s : float
        Lateral coordinate in the contact plane from there [m].
    gap, curvature_y : float
        Gap of the undeformed profiles [m] and half the sum of the lateral curvatures [1/m] at s.

    Returns
    -------
    inside : float
        Positive in contact, NaN off the profiles [-].
    half_length : float
        [m].
    pressure : float
        In the middle [Pa]; the half length where it awaits the stiffness of the patch.
    """
    if low.normal == ANALYN:
        return analyn.strip(
            gap,
            low.approach,
            low.curvature_x,
            max(curvature_y, CURVATURE_FLOOR),
            low.shear_modulus,
            low.poisson_ratio,
        )
    inside, half_length = kik_piotrowski.strip(gap, s, low.curvature_x, low.curvature_y, low.a, low.b)
    return inside, half_length, half_length
