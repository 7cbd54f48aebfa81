"""Wear by sliding: Archard's law with the wear coefficient from Jendel's map.

J.F. Archard, Contact and rubbing of flat surfaces, J. Applied Physics 24 (1953): worn volume per sliding
distance = k N / H. Per strip of the patch, as a depth on the wheel per revolution (Hossein-Nia 2018, 3.27):

    dz(y) = sum over x of (k/H) p |s| dx

with the local pressure p and the local slip over speed s. Elastic slip is the field's own: rigid slip less
the rate of the surfaces' elastic displacement (R. Enblom, Deterioration mechanisms in the wheel-rail
interface, KTH 2006); rigid slip is that of the creepages, nu_x - phi y and nu_y + phi x, in the cells that
slip (Jendel). Where most of the patch sticks the two differ by a factor: elastic slip carries all of the
dissipated energy, |s| p = e / mu, of which the rigid slip in the slip zone holds a fifth to a half at
creepages of 0.03 to 0.2 %. The pressure is that of the tangential theory: FASTSIM's parabola is 4/3 of
Hertz's in the middle and reaches seizure sooner.
"""

import math
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from damage.parameters import parameters
from damage.wear.jendel import JENDEL_REGIMES, JendelMap, MapValues, wear_coefficient, wear_regime
from damage.wear.law import REGIMES, SolvedPatch, WearLaw, require_known
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.friction import FILMS
from hh_exudyn.kernel import kernel

DRY = JendelMap()
SURFACES = FILMS
SLIPS = ("elastic", "rigid")


def archard(
    surface: str = "dry",
    slip: str = "elastic",
    wear_map: JendelMap = DRY,
    divisor: float | None = None,
    hardness: float | None = None,
) -> WearLaw:
    """Archard's law with Jendel's map.

    A cell that slips wears by k p s / H: the coefficient k follows from its pressure and sliding velocity.

    Parameters
    ----------
    surface
        "dry"; "lubricated" divides the coefficients by 6 (natural lubrication, Jendel), "greased" by 100
        (Zhu).
    slip
        "elastic", the field's own (Enblom), or "rigid", that of the creepages in the slip zone (Jendel).
    wear_map
        The dry coefficients and the hardness.
    divisor
        Divisor instead of that of the surface [-], > 0; 5.5 is also in use for "lubricated".
    hardness
        Of the softer steel [Pa], > 0; None takes the map's, or where that has none the wheel steel's. The
        pressure of seizure is proportional to it.

    Raises
    ------
    ValueError
        Unknown surface or slip, or a divisor or hardness that is not above zero.
    """
    require_known("surface", surface, SURFACES)
    require_known("slip", slip, SLIPS)
    if divisor is None:
        divisor = 1.0 if surface == "dry" else parameters("wear", "surface")[surface].value
    elif surface == "dry":
        raise ValueError(f"divisor = {divisor}: a dry surface has none; name the surface it is for")
    if hardness is not None:
        wear_map = replace(wear_map, hardness=hardness)
    numbers = (float(slip == "rigid"), *wear_map.divided(divisor).values)
    return WearLaw(
        "archard",
        JENDEL_REGIMES,
        archard_depths,
        numbers,
        surface,
        with_films=surface == "dry",
        for_hardness=None
        if wear_map.hardness is not None
        else partial(archard, surface, slip, wear_map, None if surface == "dry" else divisor),
    )


class ArchardValues(NamedTuple):
    """Archard's law, for its kernel."""

    rigid: bool  # sliding distances from the rigid slip in the slip zone, not from the field's own slip
    map: MapValues


@kernel
def read_archard(numbers: FloatArray) -> ArchardValues:
    """The law from its numbers (`WearLaw.numbers`; kernel).

    Parameters
    ----------
    numbers
        (n,) numbers of the law.
    """
    wear_map = MapValues(
        numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7], numbers[8]
    )
    return ArchardValues(numbers[0] != 0.0, wear_map)


def archard_on_rail(law: WearLaw, softer: float, ratio: float) -> tuple[float, ...]:
    """Numbers of Archard's law on a rail: seizure of the softer body, coefficients times a ratio.

    Parameters
    ----------
    law
        Archard's, with the rail's hardness.
    softer
        Hardness of the softer of wheel and rail [Pa].
    ratio
        Coefficients of the rail over those of the map [-].
    """
    rigid, wear_map = read_archard(np.array(law.numbers))
    seizure = wear_map.seizure_pressure * softer / wear_map.hardness
    coefficients = (ratio * coefficient for coefficient in wear_map[:4])
    return (float(rigid), *coefficients, wear_map.severe_from, wear_map.severe_to, seizure, wear_map.hardness)


@kernel
def archard_depths(numbers: FloatArray, solved: SolvedPatch, depth: FloatArray) -> None:
    """Wear depth on the wheel per revolution, by strip and region of the map; arguments: `LawKernel`."""
    strips, speed = solved.strips, solved.speed
    pressure, slip_x, slip_y = solved.fields.pressure, solved.fields.slip_x, solved.fields.slip_y
    cells_y, cells_x = pressure.shape
    law, step = read_archard(numbers), 2.0 / cells_x
    wear_map, rigid = law.map, law.rigid
    for j in range(cells_y):
        for regime in range(REGIMES):
            depth[j, regime] = 0.0
        half_length, rigid_x = strips.half_length[j], strips.nu_x[j]
        for i in range(cells_x):
            s_x, s_y = slip_x[j, i], slip_y[j, i]
            square = s_x * s_x + s_y * s_y
            if square > 0.0:
                if rigid:
                    rigid_y = strips.nu_y[j] + strips.phi[j] * half_length * ((i + 0.5) * step - 1.0)
                    square = rigid_x * rigid_x + rigid_y * rigid_y
                slip = math.sqrt(square)
                regime = wear_regime(pressure[j, i], slip * speed, wear_map)
                depth[j, regime] += pressure[j, i] * slip
        for regime in range(REGIMES):
            factor = wear_coefficient(regime, wear_map) / wear_map.hardness
            depth[j, regime] *= factor * half_length * step  # (3.27)
