"""The one kernel that wears a patch, whatever the law.

It writes the depth that one revolution of the wheel takes from each strip of the patch. A strip that loses
the depth dz per revolution all around the wheel, 2 pi r, loses the volume dz times its width per metre
rolled: so depth per revolution times width, summed over the strips, is the worn volume per metre rolled.
"""

import math

from damage.wear.archard import archard_depths
from damage.wear.british_rail import british_rail_volume
from damage.wear.energy import strip_energies
from damage.wear.krause_poll import krause_poll_volume
from damage.wear.usfd import usfd_depths, ward_depths
from damage.wear.values import ARCHARD, BRITISH_RAIL, KRAUSE_POLL, USFD, WARD, LawValues
from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel


@kernel
def strip_wear(
    law: LawValues,
    patch: RollingPatch,
    fields: Fields,
    speed: float,
    rolling_radius: float,
    depth: FloatArray,
) -> None:
    """Wear depth on the wheel per revolution, by strip of the patch and regime of the law.

    Parameters
    ----------
    law
        `damage.wear.laws.WearLaw.values`.
    patch
        The patch that the fields belong to.
    fields
        (ny, nx) stress and slip, as `hh_exudyn.contact.tangential.registry.field_kernel` fills them.
    speed
        Forward speed [m/s], > 0.
    rolling_radius
        Of the wheel at the contact [m], > 0.
    depth
        (ny, REGIMES) result: depth normal to the surface [m]; NaN for an unknown law.
    """
    if law.law == ARCHARD:
        archard_depths(law, patch, fields, speed, depth)
        return
    depth[:] = 0.0
    if law.law == WARD:
        ward_depths(patch, fields, law.rate, depth)
        return
    energy = strip_energies(patch, fields, depth[:, 0])
    if not energy > 0.0:
        depth[:] = 0.0  # nothing slips
    elif law.law == USFD:
        depth[:] = 0.0
        usfd_depths(patch, energy, law.rate, depth)
    elif law.law == BRITISH_RAIL:
        regime, volume = british_rail_volume(energy, rolling_radius, law.rate)
        _by_energy(regime, volume / energy, patch, depth)
    elif law.law == KRAUSE_POLL:
        regime, volume = krause_poll_volume(energy, patch, speed, law.rate)
        _by_energy(regime, volume / energy, patch, depth)
    else:
        depth[:] = math.nan


@kernel
def _by_energy(regime: int, volume_per_energy: float, patch: RollingPatch, depth: FloatArray) -> None:
    """Turn the strips' energies in the first column [N] into depths in the regime's column [m]."""
    cells_y = depth.shape[0]
    for j in range(cells_y):
        energy = depth[j, 0]
        depth[j, 0] = 0.0
        depth[j, regime] = energy * volume_per_energy * cells_y / (2.0 * patch.b)
