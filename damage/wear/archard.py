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
Hertz's in the middle and meets seizure sooner.
"""

import math
from dataclasses import replace

from damage.parameters import parameters
from damage.wear.jendel import JENDEL_REGIMES, JendelMap, wear_coefficient, wear_regime
from damage.wear.law import WearLaw, require_known
from damage.wear.values import ARCHARD, NO_RATE, REGIMES, LawValues
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel

DRY = JendelMap()
SURFACES = ("dry", "lubricated", "greased")
SLIPS = ("elastic", "rigid")


def archard(
    surface: str = "dry",
    slip: str = "elastic",
    wear_map: JendelMap = DRY,
    divisor: float | None = None,
    hardness: float | None = None,
) -> WearLaw:
    """Archard's law with Jendel's map.

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
        Instead of the surface's [-], > 0; 5.5 is also in use for "lubricated".
    hardness
        Of the softer steel, instead of the map's [Pa], > 0. The pressure of seizure goes with it.

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
    values = LawValues(ARCHARD, slip == "rigid", wear_map.divided(divisor).values, NO_RATE)
    return WearLaw("archard", JENDEL_REGIMES, values)


@kernel
def archard_depths(
    law: LawValues, patch: RollingPatch, fields: Fields, speed: float, depth: FloatArray
) -> None:
    """Wear depth on the wheel per revolution, by strip and region of the map.

    Parameters
    ----------
    law
        Archard's law: its map, and which slip.
    patch
        The patch that the fields belong to.
    fields
        (ny, nx) stress and slip.
    speed
        Forward speed [m/s].
    depth
        (ny, REGIMES) result [m].
    """
    pressure, slip_x, slip_y = fields.pressure, fields.slip_x, fields.slip_y
    cells_y, cells_x = pressure.shape
    wear_map, rigid, step = law.map, law.rigid, 2.0 / cells_x
    for j in range(cells_y):
        for regime in range(REGIMES):
            depth[j, regime] = 0.0
        lateral = -1.0 + (2 * j + 1) / cells_y
        half_length = patch.a * math.sqrt(1.0 - lateral * lateral)
        rigid_x = patch.nu_x - patch.phi * patch.b * lateral
        for i in range(cells_x):
            s_x, s_y = slip_x[j, i], slip_y[j, i]
            square = s_x * s_x + s_y * s_y
            if square > 0.0:
                if rigid:
                    rigid_y = patch.nu_y + patch.phi * half_length * ((i + 0.5) * step - 1.0)
                    square = rigid_x * rigid_x + rigid_y * rigid_y
                slip = math.sqrt(square)
                regime = wear_regime(pressure[j, i], slip * speed, wear_map)
                depth[j, regime] += pressure[j, i] * slip
        for regime in range(REGIMES):
            factor = wear_coefficient(regime, wear_map) / wear_map.hardness
            depth[j, regime] *= factor * half_length * step  # (3.27)
