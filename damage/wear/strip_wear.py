"""The one kernel that wears a patch, whatever the law.

It writes the depth that one revolution of the wheel takes from each strip of the patch. A strip that loses
the depth dz per revolution all around the wheel, 2 pi r, loses the volume dz times its width per metre
rolled: so depth per revolution times width, summed over the strips, is the worn volume per metre rolled.
"""

from damage.wear.archard import archard_depths
from damage.wear.values import ARCHARD, LawValues
from hh_exudyn.contact.types import Fields, FloatArray, RollingPatch
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
        (ny, nx) stress and slip, as `hh_exudyn.contact.theories.field_kernel` fills them.
    speed
        Forward speed [m/s], > 0.
    rolling_radius
        Of the wheel at the contact [m], > 0.
    depth
        (ny, REGIMES) result: depth normal to the surface [m]; NaN for an unknown law.
    """
    if law.law == ARCHARD:
        archard_depths(law, patch, fields, speed, depth)
    else:
        depth[:] = float("nan")
