"""Carter's theory: traction and braking of a line contact.

F.W. Carter, On the action of a locomotive driving wheel, Proceedings of the Royal Society A 112 (1926)
151-157; equations 2.16-2.21 of Hossein-Nia (KTH, 2018), with the leading edge at x = +a as everywhere here.

Carter's contact is two cylinders with parallel axes: it has a length 2 a and a pressure p0, nothing else. An
ellipse is taken as ONE such line: the one in its middle, with the ellipse's semi-axis a and greatest pressure
p0, and a width (4 b/3) that makes it carry the normal force. So F_x over friction * load is Carter's closed
curve (2.21), the usual meaning of "Carter". Every strip of the stress field has that
line's traction, scaled to the strip's length and pressure: it adds up to the force, and |q| <= mu p.
(Giving each strip a Carter solution of its own is strip theory, Haines and Ollerton 1963: `strip`.)

LONGITUDINAL CREEPAGE ONLY: lateral creepage and spin are ignored, F_y and M_z are zero. Under spin or
lateral creepage the force is therefore too large, and its direction wrong.

As a line it misses the third dimension: the slope at zero creepage is 2 pi/3/(1 - nu) G a b instead of
C11 G a b, 15 % too small for a/b towards 0, 31 % at a/b = 1, 64 % at a/b = 5.
"""

import math

from hh_exudyn.contact.normal.hertz import peak_pressure
from hh_exudyn.contact.types import Fields, RollingPatch
from hh_exudyn.kernel import kernel


@kernel
def slip_share(patch: RollingPatch) -> tuple[float, float]:
    """Share of the length that slips, 1 - d/a of equation 2.19 [-], and 2 (1 - nu) mu p0/G [-].

    The share is R |nu_x|/(mu a) of equation 2.21; it exceeds 1 for creepages beyond the onset of full slip.

    Parameters
    ----------
    patch : RollingPatch
        Size, load, creepages and material.
    """
    compliance = 2.0 * (1.0 - patch.poisson_ratio) * patch.friction
    saturation = compliance * peak_pressure(patch) / patch.shear_modulus
    return abs(patch.nu_x) / saturation, saturation


@kernel
def force(patch: RollingPatch) -> tuple[float, float, float]:
    """Creep force on the wheel, (F_x, 0, 0).

    Parameters
    ----------
    patch : RollingPatch
        Size, load, nu_x and material; nu_y and phi have no effect.
    """
    share, _ = slip_share(patch)
    share = min(share, 1.0)
    size = patch.friction * patch.normal_force * (2.0 - share) * share  # (2.21)
    return -math.copysign(size, patch.nu_x), 0.0, 0.0


@kernel
def field(patch: RollingPatch, fields: Fields) -> None:
    """Pressure, tractions and slip over the cells.

    Slip is the creepage less the surface's strain, in closed form; the strain does no net work along a line,
    so friction dissipates F_x nu_x.

    Arguments as in `fastrip.field`.
    """
    pressure, q_x, q_y, slip_x, slip_y = fields
    cells_y, cells_x = pressure.shape
    share, saturation = slip_share(patch)
    middle = peak_pressure(patch)
    sign = math.copysign(1.0, patch.nu_x)
    slips_whole = share >= 1.0
    for i in range(cells_x):
        xi = -1.0 + (2 * i + 1) / cells_x
        ellipse = math.sqrt(1.0 - xi * xi)
        traction, slip = ellipse, 0.0  # (2.16)
        if slips_whole:
            slip = saturation * (share - xi)
        else:
            gap = (xi - share) ** 2 - (1.0 - share) ** 2
            if xi <= 2.0 * share - 1.0:
                slip = saturation * math.sqrt(max(gap, 0.0))
            else:
                traction = ellipse - math.sqrt(max(-gap, 0.0))  # (2.17, 2.18)
        for j in range(cells_y):
            lateral = -1.0 + (2 * j + 1) / cells_y
            strip_pressure = middle * math.sqrt(1.0 - lateral * lateral)
            pressure[j, i] = strip_pressure * ellipse
            q_x[j, i], q_y[j, i] = -sign * patch.friction * strip_pressure * traction, 0.0
            slip_x[j, i], slip_y[j, i] = sign * slip, 0.0
