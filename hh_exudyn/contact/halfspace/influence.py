"""Surface displacement of two half-spaces under stresses that are constant on the elements of a grid.

Closed forms of Boussinesq and Cerruti, integrated over a rectangle (K.L. Johnson, Contact Mechanics, 1985,
equations 3.25 and 3.75 to 3.77; J.J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, 1990,
appendix C). Wheel and rail are of one material: then pressure makes no tangential and traction no normal
displacement difference (the constant K of the difference of materials is zero; it is left out).

Arrays are (ny, nx): x in rolling direction, second index; y across, first. With u the displacement of the
wheel less that of the rail, pressure p pressing them apart and q the traction on the wheel,

    u_z = (1 - nu)/(pi G) int int p / r
    u_x = 1/(pi G) int int ((1 - nu)/r + nu x^2/r^3) q_x + nu x y/r^3 q_y

and u_y with x and y exchanged.

In steady rolling the material passes an element in dx/V, and the slip over V of element i, averaged between
its centre and that of its neighbour ahead, is w_i + (u_i - u_(i+1))/dx with the rigid slip w (Kalker 1990,
section 4.1, with the step of one element; E.A.H. Vollebregt, CONTACT). These differences have transforms too,
as have those between the edges of an element.

The sums over elements are convolutions. Their transforms are prepared once for a shape of the grid, a ratio
of the sides of its elements and a Poisson's ratio, and shared between all solves; lengths only scale them.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from scipy import fft

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import Material

_PREPARED = 128  # transforms that are kept; each takes a few hundred kilobytes


@dataclass(frozen=True)
class Grid:
    """A grid of nx by ny equal elements, centred on the origin.

    Attributes
    ----------
    nx, ny : int
        Elements along x and across y.
    dx, dy : float
        Sides of an element [m].
    """

    nx: int
    ny: int
    dx: float
    dy: float

    def __post_init__(self) -> None:
        for name in ("nx", "ny"):
            if not (1 <= getattr(self, name) <= 2000 and int(getattr(self, name)) == getattr(self, name)):
                raise ValueError(f"{name} = {getattr(self, name)}; whole numbers from 1 to 2000 are allowed")
        for name in ("dx", "dy"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name} = {getattr(self, name)} m; it must be finite and > 0 m")
        if not 1e-3 <= self.dx / self.dy <= 1e3:
            raise ValueError(f"dx/dy = {self.dx / self.dy} [-]; it must lie in 0.001..1000")

    @property
    def x(self) -> FloatArray:
        """Centres along x [m], (nx,)."""
        return np.asarray((np.arange(self.nx) - 0.5 * (self.nx - 1)) * self.dx, dtype=np.float64)

    @property
    def y(self) -> FloatArray:
        """Centres across [m], (ny,)."""
        return np.asarray((np.arange(self.ny) - 0.5 * (self.ny - 1)) * self.dy, dtype=np.float64)

    @property
    def shape(self) -> tuple[int, int]:
        """(ny, nx)."""
        return self.ny, self.nx

    @property
    def area(self) -> float:
        """Of an element [m^2]."""
        return self.dx * self.dy


@dataclass(frozen=True)
class Transforms:
    """Transforms of the influence of one element of length 1 on all others, per 1/(pi G); complex arrays.

    `normal` is u_z by p; `slip` (3, ...) are u_i - u_(i+1) of x by q_x, of y by q_y, and of both crossed;
    `own` is the influence of an element on its own slip, (x, y).
    """

    padded: tuple[int, int]
    normal: Any
    slip: Any
    own: tuple[float, float]


def _corner_functions(along: FloatArray, across: FloatArray) -> FloatArray:
    """Functions whose mixed derivatives are 1/r, x^2/r^3, y^2/r^3 and x y/r^3; `across` is nowhere 0."""
    second = across * np.arcsinh(along / np.abs(across))
    with np.errstate(divide="ignore", invalid="ignore"):  # the limit of the third at along = 0 is zero
        third = np.where(along == 0.0, 0.0, along * np.arcsinh(across / np.abs(along)))
    return np.stack([second + third, second, third, -np.hypot(along, across)])


def rectangle_integrals(x: Any, y: Any, half_x: float, half_y: float) -> FloatArray:
    """Integrals of 1/r, x^2/r^3, y^2/r^3 and x y/r^3 over a rectangle about the origin, at places x, y.

    Parameters
    ----------
    x, y : array_like
        Places in the plane of the rectangle [m]; not on the lines through its sides along x.
    half_x, half_y : float
        Half its sides [m].

    Returns
    -------
    ndarray, (4, ...)
        Lengths [m].
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
    result: FloatArray = np.zeros((4, *x.shape))
    for sign, shift_x, shift_y in ((1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)):
        result += sign * _corner_functions(x + shift_x * half_x, y + shift_y * half_y)
    return result


def lag_integrals(first: float, count: int, ny: int, ratio: float) -> FloatArray:
    """`rectangle_integrals` of an element 1 by `ratio` at lags (4, 2 ny - 1, count), each corner only once.

    Parameters
    ----------
    first : float
        The first lag along x; the others follow in steps of 1.
    count, ny : int
        Lags along x, and elements across: lags from -(ny - 1) to ny - 1.
    ratio : float
        Side of the element across over that along [-].
    """
    along = first - 0.5 + np.arange(count + 1.0)
    across = ratio * (np.arange(-ny, ny) + 0.5)[:, None]
    corners = _corner_functions(*np.broadcast_arrays(along, across))
    integrals: FloatArray = np.diff(np.diff(corners, axis=-1), axis=-2)
    return integrals


def _influences(first: float, count: int, ny: int, ratio: float, poisson_ratio: float) -> FloatArray:
    """Displacements at lags as of `lag_integrals`, per 1/(pi G): (4, 2 ny - 1, count).

    Of z by p, of x by q_x, of y by q_y, and of both crossed.
    """
    inverse, of_x, of_y, crossed = lag_integrals(first, count, ny, ratio)
    normal = (1.0 - poisson_ratio) * inverse
    return np.stack(
        [normal, normal + poisson_ratio * of_x, normal + poisson_ratio * of_y, poisson_ratio * crossed]
    )


def _transform(values: FloatArray, nx: int, ny: int) -> Any:
    """Transforms of influences (..., 2 ny - 1, 2 nx) at lags from -(ny - 1) and -nx on."""
    padded = _padded(nx, ny)
    placed = np.zeros((*values.shape[:-2], *padded))
    rows, columns = np.arange(-(ny - 1), ny) % padded[0], np.arange(-nx, nx) % padded[1]
    placed[..., rows[:, None], columns] = values
    return fft.rfft2(placed)


def _padded(nx: int, ny: int) -> tuple[int, int]:
    """Rows and columns of the transforms."""
    return fft.next_fast_len(2 * ny, real=True), fft.next_fast_len(2 * nx, real=True)


@lru_cache(maxsize=_PREPARED)
def _transforms(nx: int, ny: int, ratio: float, poisson_ratio: float) -> Transforms:
    """The transforms of a grid of elements 1 by `ratio`."""
    values = _influences(-nx, 2 * nx + 1, ny, ratio, poisson_ratio)
    slips = values[1:, :, :-1] - values[1:, :, 1:]
    transforms = _transform(np.concatenate([values[:1, :, :-1], slips]), nx, ny)
    own = (float(slips[0, ny - 1, nx]), float(slips[1, ny - 1, nx]))
    return Transforms(_padded(nx, ny), transforms[0], transforms[1:], own)


@lru_cache(maxsize=_PREPARED)
def _centred_slip(nx: int, ny: int, ratio: float, poisson_ratio: float) -> Any:
    """As `Transforms.slip`, between the edges of an element."""
    values = _influences(-nx - 0.5, 2 * nx + 1, ny, ratio, poisson_ratio)[1:]
    return _transform(values[:, :, :-1] - values[:, :, 1:], nx, ny)


class Influence:
    """What stresses on a grid do to the surfaces of wheel and rail.

    Parameters
    ----------
    grid : Grid
        The elements.
    material : Material
        Of both bodies.
    """

    def __init__(self, grid: Grid, material: Material) -> None:
        self.grid, self.material = grid, material
        self.transforms = _transforms(grid.nx, grid.ny, grid.dy / grid.dx, material.poisson_ratio)
        self.flexibility = 1.0 / (np.pi * material.shear_modulus)  # [1/Pa]

    def _forward(self, stress: FloatArray) -> Any:
        """Transform of stresses (..., ny, nx) that are zero around the grid."""
        rows, columns = self.transforms.padded
        first = fft.rfft(stress, n=columns, axis=-1)
        return fft.fft(first, n=rows, axis=-2, overwrite_x=True)

    def _backward(self, transform: Any) -> FloatArray:
        """The values on the grid, from their transform (overwritten)."""
        ny, nx = self.grid.shape
        first = fft.ifft(transform, axis=-2, overwrite_x=True)[..., :ny, :]
        values: FloatArray = fft.irfft(first, n=self.transforms.padded[1], axis=-1, overwrite_x=True)
        return values[..., :nx]

    def normal(self, pressure: FloatArray) -> FloatArray:
        """Normal displacement that drives the surfaces apart [m], (ny, nx), by a pressure [Pa]."""
        product = self._forward(pressure)
        product *= self.transforms.normal
        product *= self.flexibility * self.grid.dx
        return self._backward(product)

    def slip(self, traction: FloatArray) -> FloatArray:
        """Elastic part of the slip over V [-], (2, ny, nx), by a traction (2, ny, nx) on the wheel [Pa].

        Between the centre of each element and that of the next one ahead.
        """
        return self._slip(traction, self.transforms.slip)

    def slip_at_centres(self, traction: FloatArray) -> FloatArray:
        """As `slip`, between the edges of each element: of second order, and with q.s summing to nothing.

        No problem can be solved with it: a traction that is the same everywhere makes none.
        """
        grid = self.grid
        centred = _centred_slip(grid.nx, grid.ny, grid.dy / grid.dx, self.material.poisson_ratio)
        return self._slip(traction, centred)

    def _slip(self, traction: FloatArray, transforms: Any) -> FloatArray:
        """Slip by a traction through the transforms of both and of the crossed influence."""
        of_x, of_y, crossed = transforms
        given = self._forward(traction)
        product = np.empty_like(given)
        np.multiply(of_x, given[0], out=product[0])
        product[0] += crossed * given[1]
        np.multiply(of_y, given[1], out=product[1])
        product[1] += crossed * given[0]
        product *= self.flexibility
        return self._backward(product)

    @property
    def own_slip(self) -> tuple[float, float]:
        """Slip along and across that a traction of 1 Pa on one element makes there [1/Pa]."""
        return self.transforms.own[0] * self.flexibility, self.transforms.own[1] * self.flexibility
