"""Shakedown diagram of a point contact in full slip: Hertz pressure over utilised friction.

The axes are the utilised friction Q/P and p0/k. The limit has two branches (Johnson, Contact Mechanics,
1985; Hossein-Nia, 2018, figure 3-13 left):

* at the surface p0/k = 1/mu, where the traction mu p0 itself reaches k;
* below it by the orthogonal shear stress. No residual stress of rolling along x has a component
  tau_xz (equilibrium with the free surface), so by Melan's theorem p0/k = 1/max|tau_xz/p0|.

The second branch is tabulated for a circular patch, from the point force solutions of Boussinesq and
Cerruti, where tau_xz does not depend on Poisson's ratio:

    tau_xz/p0 = 3/(2 pi) int p/p0 (X z^2 + mu X^2 z)/R^5 dA,     X = x - x'

`tests/damage/shakedown/test_shakedown.py` integrates it again. At mu = 0 it gives the published 4.7; it
meets the surface branch at mu = 0.30. It is a necessary limit: no allowance is made for the other stress
components.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

_FRICTION = np.array([0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35])
_LARGEST_SHEAR = np.array(  # largest |tau_xz|/p0 below a circular patch in full slip
    [0.213891, 0.227922, 0.242215, 0.256750, 0.271510, 0.286486, 0.301672, 0.317072]
)


def point_contact_limit(friction: ArrayLike) -> NDArray[np.float64]:
    """Shakedown limit p0/k [-] of a point contact in full slip.

    Parameters
    ----------
    friction
        Utilised friction Q/P [-], >= 0.

    Raises
    ------
    ValueError
        Friction below zero or NaN.
    """
    value = np.asarray(friction, dtype=np.float64)
    if not np.all(value >= 0.0):
        raise ValueError(f"friction must be >= 0 [-]; {np.count_nonzero(~(value >= 0.0))} values are not")
    limit: NDArray[np.float64] = 1.0 / np.maximum(np.interp(value, _FRICTION, _LARGEST_SHEAR), value)
    return limit
