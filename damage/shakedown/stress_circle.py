"""Johnson's construction: a circle around the stress trajectories of a rolling line contact.

The stresses of a point below a rolling contact follow the trajectory of its depth. In the plane of
((sigma_x - sigma_z)/(2 p0), tau_xz/p0) yield in the plane of rolling (Tresca) is the circle of radius k/p0
(equation 3.12 of Hossein-Nia, KTH 2018; K.L. Johnson, Wear 190, 1995). The response to a load remains elastic
if the trajectories of ALL depths fit into one such circle, whose centre is minus the residual stress:

=============  ====================================================================================
``elastic``    no residual stress, the centre is the origin: the load of first yield
``perfect``    residual sigma_x of an elastic-perfectly plastic body: the centre moves horizontally
``kinematic``  kinematic hardening, residual and back stress together: the centre is free (Ponter)
=============  ====================================================================================

The yield criterion is Tresca's between the principal stresses in the plane of rolling (equation 3.9), as in
Johnson's diagrams and Table 3-1. With sigma_y, the third principal stress in plane strain, first yield comes
earlier (`SubsurfaceStress.max_shear`): at mu = 0.2, 0.3, 0.35 and 0.4 the elastic limit would be 3.08, 2.63,
2.45 and 2.29 instead of 3.13, 2.90, 2.75 and 2.50 (Poisson's ratio 0.28); at 0, 0.1 and 0.5 it is the same.

The centre is the same at all depths, as in Table 3-1. For ``perfect`` a residual stress that varies with
depth is admissible too; its limit, 1/max|tau_xz/p0|, is the same but between mu = 0.35 and 0.376, where it
is up to 0.8 per cent higher.

Method: the circle around the stresses at a grid of places; near the largest excess places are refined and
added, until the circle grows no more.
"""

import functools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from damage.shakedown.circle import FIXED, FREE, ON_AXIS, smallest_circle
from hh_exudyn.contact.normal.subsurface import line_contact_stress, stick_half_length

HARDENING = {"elastic": FIXED, "perfect": ON_AXIS, "kinematic": FREE}

_GROWTH = 1e-6  # relative growth of the radius below which the places are fine enough
_ROUNDS = 20
_HALVINGS = 9  # of the distance between places around a maximum
_NEAR = 0.97  # of the radius: maxima farther inside do not determine the circle on a finer grid either
_MOST = 40  # maxima refined at once; on the surface in full slip all places are maxima


@dataclass(frozen=True)
class StressCircle:
    """The smallest circle around the stress trajectories of all depths, lengths over a, stresses over p0.

    Attributes
    ----------
    friction
        Friction coefficient mu [-].
    traction_ratio
        Tangential over normal force Q/P [-]; mu in full slip.
    hardening
        One of `HARDENING`.
    centre
        (sigma_x - sigma_z)/2 and tau_xz in the middle of the circle [-].
    radius
        k/p0 [-].
    x, depth
        One to three places with their stresses on the circle, where plastic flow begins beyond the limit. In
        rolling direction from the middle of the patch, and below the surface [-].
    """

    friction: float
    traction_ratio: float
    hardening: str
    centre: tuple[float, float]
    radius: float
    x: tuple[float, ...]
    depth: tuple[float, ...]

    @property
    def limit(self) -> float:
        """The limit p0/k [-]."""
        return 1.0 / self.radius


def trajectory(
    x: NDArray[np.float64], depth: NDArray[np.float64] | float, friction: float, traction_ratio: float
) -> NDArray[np.float64]:
    """Stresses at places below a line contact, in the plane of the circles.

    Parameters
    ----------
    x, depth
        Places over a, broadcast to (n,); the leading edge is x = +1 [-].
    friction, traction_ratio
        mu and Q/P [-], positive where Q acts on the body in rolling direction.

    Returns
    -------
    (n, 2): (sigma_x - sigma_z)/(2 p0), tau_xz/p0
    """
    field = line_contact_stress(x, depth, 1.0, 1.0, friction, traction_ratio=traction_ratio)
    return np.column_stack([0.5 * (field.sigma_x - field.sigma_z), field.tau_xz])


@functools.lru_cache(maxsize=4096)
def stress_circle(
    friction: float, traction_ratio: float | None = None, hardening: str = "elastic"
) -> StressCircle:
    """The circle for one load, to some 1e-6 of its radius.

    Parameters
    ----------
    friction
        Friction coefficient mu [-], >= 0.
    traction_ratio
        Q/P [-], -mu..mu, partial slip after Carter, positive where Q acts on the body in rolling direction (a
        driving wheel); None is full slip, Q/P = mu.
    hardening
        "elastic", "perfect" or "kinematic".

    Raises
    ------
    ValueError
        An unknown hardening, or a load out of range.
    """
    if hardening not in HARDENING:
        raise ValueError(f"hardening = {hardening!r}; allowed: {', '.join(HARDENING)}")
    ratio = friction if traction_ratio is None else traction_ratio
    across, down = _grid(stick_half_length(1.0, friction, ratio))
    shape = (down.size, across.size)
    x, depth = (places.ravel() for places in np.meshgrid(across, down))
    points = trajectory(x, depth, friction, ratio)
    count = points.shape[0]
    circle = smallest_circle(points, HARDENING[hardening])
    for _ in range(_ROUNDS):
        distance = np.hypot(*(points[:count] - circle.centre).T).reshape(shape)
        finer = _refined(across, down, distance, circle.centre, circle.radius, friction, ratio)
        x, depth = np.append(x, finer[0]), np.append(depth, finer[1])
        points = np.concatenate([points, trajectory(*finer, friction, ratio)])
        before = circle.radius
        circle = smallest_circle(points, HARDENING[hardening], circle.support)
        if circle.radius <= before * (1.0 + _GROWTH):
            break
    support = list(circle.support)
    return StressCircle(
        friction,
        ratio,
        hardening,
        (float(circle.centre[0]), float(circle.centre[1])),
        circle.radius,
        tuple(x[support].tolist()),
        tuple(depth[support].tolist()),
    )


def _grid(stick: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places along and below the surface over a, closer at the edges of the patch and of the stick zone."""
    edge = 1.0 - 2.0 * stick
    rounded = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 41))
    beside = 1.0 + np.geomspace(1e-3, 2.0, 12)
    inside = [-1.0 + (edge + 1.0) * rounded, edge + (1.0 - edge) * rounded]
    across = np.unique(np.concatenate([-beside, *inside, beside]))
    down = np.concatenate([[0.0], np.geomspace(1e-3, 0.1, 13)[:-1], np.linspace(0.1, 1.5, 29), [2.0, 3.0]])
    return across, down


def _refined(
    across: NDArray[np.float64],
    down: NDArray[np.float64],
    distance: NDArray[np.float64],
    centre: NDArray[np.float64],
    radius: float,
    friction: float,
    ratio: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places of the maxima of the distance from the centre, from those of a grid."""
    padded = np.pad(distance, 1, constant_values=-np.inf)
    rows, columns = distance.shape
    around = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    maxima = (distance >= np.max(around, axis=0)) & (distance > _NEAR * radius)
    row, column = np.nonzero(maxima)
    if row.size > _MOST:
        highest = np.argsort(distance[row, column])[-_MOST:]
        row, column = row[highest], column[highest]
    x, depth = across[column], down[row]
    step_x = np.maximum(np.gradient(across)[column], 0.5 * np.gradient(across).min())
    step_z = np.gradient(down)[row]
    move_x, move_z = (moves.ravel() for moves in np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]))
    pick = np.arange(x.size)
    for _ in range(_HALVINGS):
        step_x, step_z = 0.5 * step_x, 0.5 * step_z
        try_x = x[:, None] + step_x[:, None] * move_x
        try_z = np.maximum(depth[:, None] + step_z[:, None] * move_z, 0.0)
        away = trajectory(try_x.ravel(), try_z.ravel(), friction, ratio) - centre
        best = np.hypot(away[:, 0], away[:, 1]).reshape(try_x.shape).argmax(axis=1)
        x, depth = try_x[pick, best], try_z[pick, best]
    return x, depth
