"""Stresses below the surface under pressures and tractions that are constant on the elements of a grid.

Closed forms from the potentials of Boussinesq and Cerruti (K.L. Johnson, Contact Mechanics, 1985, equations
3.4 to 3.10): with the kernel c = ln(rho + z), rho the distance and z the depth, and o = z c - rho, by

    pressure         2 pi sigma_x = 2 nu c_zz - z c_xxz - (1 - 2 nu) c_xx    2 pi tau_xz = -z c_xzz
                     2 pi tau_xy = -z c_xyz - (1 - 2 nu) c_xy                2 pi sigma_z = c_zz - z c_zzz
    traction along x 2 pi sigma_x = 2 (1 + nu) c_xz + 2 nu o_xxx - z c_xxx   2 pi sigma_z = -z c_xzz
                     2 pi sigma_y = 2 nu c_xz + 2 nu o_xyy - z c_xyy         2 pi tau_yz = -z c_xyz
                     2 pi tau_xy = c_yz + 2 nu o_xxy - z c_xxy               2 pi tau_xz = c_zz - z c_xxz

and what follows with x and y exchanged. Over a rectangle each is a sum over its corners of the function whose
mixed derivative in x and y it is; over the grid it is a convolution.

Frame and signs are those of `normal.subsurface`: depth into the body, tension positive, tractions on the body
at hand. For the wheel that is z of the contact frame and the library's traction, for the rail its opposite.
"""

from dataclasses import dataclass

import numpy as np
from scipy import fft

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.halfspace.influence import Grid
from hh_exudyn.contact.material import STEEL, Material

_CORNERS = ((1, 0.5, 0.5), (-1, -0.5, 0.5), (-1, 0.5, -0.5), (1, -0.5, -0.5))


@dataclass(frozen=True)
class StressField:
    """Stresses in a body, arrays (depths, ny, nx), tension positive [Pa].

    Attributes
    ----------
    depth : ndarray, (depths,)
        [m]
    sigma_x, sigma_y, sigma_z, tau_xy, tau_xz, tau_yz : ndarray
        Below the middles of the grid's elements.
    """

    depth: FloatArray
    sigma_x: FloatArray
    sigma_y: FloatArray
    sigma_z: FloatArray
    tau_xy: FloatArray
    tau_xz: FloatArray
    tau_yz: FloatArray

    @property
    def von_mises(self) -> FloatArray:
        """Equivalent stress of von Mises [Pa]; yield in pure shear k is at sqrt(3) k."""
        normal = (
            (self.sigma_x - self.sigma_y) ** 2
            + (self.sigma_y - self.sigma_z) ** 2
            + (self.sigma_z - self.sigma_x) ** 2
        )
        result: FloatArray = np.sqrt(0.5 * normal + 3.0 * (self.tau_xy**2 + self.tau_xz**2 + self.tau_yz**2))
        return result

    @property
    def max_shear(self) -> FloatArray:
        """Largest shear stress (Tresca) [Pa]: half the difference of the outer principal stresses."""
        tensor = np.empty((*self.sigma_x.shape, 3, 3))
        for i, part in enumerate((self.sigma_x, self.sigma_y, self.sigma_z)):
            tensor[..., i, i] = part
        for i, j, part in ((0, 1, self.tau_xy), (0, 2, self.tau_xz), (1, 2, self.tau_yz)):
            tensor[..., i, j] = tensor[..., j, i] = part
        principal = np.linalg.eigvalsh(tensor)
        result: FloatArray = 0.5 * (principal[..., 2] - principal[..., 0])
        return result


def _of_pressure(x: FloatArray, y: FloatArray, z: float, nu: float) -> FloatArray:
    """Corner functions of 2 pi times sigma_x, sigma_y, sigma_z, tau_xy, tau_xz, tau_yz by a pressure."""
    rho = np.sqrt(x * x + y * y + z * z)
    of_x, of_y = x * x + z * z, y * y + z * z
    chi_zz = -np.arctan2(x * y, z * rho)
    chi_zzz = x * y * (rho * rho + z * z) / (rho * of_x * of_y)
    chi_xx = np.arctan(y / x) - np.arctan(y * z / (x * rho))
    chi_yy = np.arctan(x / y) - np.arctan(x * z / (y * rho))
    chi_xxz, chi_yyz = x * (rho - y) / (rho * of_x), y * (rho - x) / (rho * of_y)
    result: FloatArray = np.stack(
        [
            2.0 * nu * chi_zz - z * chi_xxz - (1.0 - 2.0 * nu) * chi_xx,
            2.0 * nu * chi_zz - z * chi_yyz - (1.0 - 2.0 * nu) * chi_yy,
            chi_zz - z * chi_zzz,
            -z / rho - (1.0 - 2.0 * nu) * np.log(rho + z),
            -z * z * (rho - y) / (rho * of_x),
            -z * z * (rho - x) / (rho * of_y),
        ]
    )
    return result


def _of_traction(x: FloatArray, y: FloatArray, z: float, nu: float) -> FloatArray:
    """As `_of_pressure` by a traction along x."""
    rho = np.sqrt(x * x + y * y + z * z)
    of_x, of_y = x * x + z * z, y * y + z * z
    chi_xz, chi_yz = np.arcsinh(y / np.sqrt(of_x)), np.arcsinh(x / np.sqrt(of_y))
    chi_xzz, chi_xyy = z * (rho - y) / (rho * of_x), y / (rho * (rho + z))
    omega_xyy = -y / (rho + z)
    result: FloatArray = np.stack(
        [
            2.0 * (1.0 + nu) * chi_xz - 2.0 * nu * (omega_xyy + chi_xz) + z * (chi_xyy + chi_xzz),
            2.0 * nu * (chi_xz + omega_xyy) - z * chi_xyy,
            -z * chi_xzz,
            chi_yz - 2.0 * nu * x / (rho + z) - z * x / (rho * (rho + z)),
            -np.arctan2(x * y, z * rho) - z * x * (rho - y) / (rho * of_x),
            -z / rho,
        ]
    )
    return result


def _coefficients(grid: Grid, depth: float, nu: float) -> FloatArray:
    """Stresses (3 loads, 6, lags) at a depth by one loaded element, lags -(n-1)..(n-1) both ways."""
    x = np.arange(-(grid.nx - 1), grid.nx) * grid.dx
    y = np.arange(-(grid.ny - 1), grid.ny)[:, None] * grid.dy
    result = np.zeros((3, 6, y.size, x.size))
    for sign, along, across in _CORNERS:
        at_x, at_y = np.broadcast_arrays(x + along * grid.dx, y + across * grid.dy)
        result[0] += sign * _of_traction(at_x, at_y, depth, nu)
        turned = _of_traction(at_y, at_x, depth, nu)  # x and y exchanged
        result[1] += sign * turned[[1, 0, 2, 3, 5, 4]]
        result[2] += sign * _of_pressure(at_x, at_y, depth, nu)
    return result / (2.0 * np.pi)


def stress_below(
    grid: Grid,
    depth: FloatArray,
    pressure: FloatArray,
    traction: FloatArray | None = None,
    material: Material = STEEL,
) -> StressField:
    """Stresses below the elements of a grid.

    After Boussinesq and Cerruti (Johnson 1985); frame and signs: see the head of this file.

    Parameters
    ----------
    grid : Grid
        Of pressure and traction.
    depth : ndarray, (depths,)
        Depths into the body [m], > 0.
    pressure : ndarray, (ny, nx)
        [Pa]
    traction : ndarray, (2, ny, nx), optional
        On the body at hand, along x and across [Pa].
    material : Material
        Its Poisson's ratio counts.

    Returns
    -------
    StressField

    Raises
    ------
    ValueError
        For a depth that is not positive, or arrays of another shape.
    """
    depths = np.atleast_1d(np.asarray(depth, dtype=np.float64))
    if not (np.all(np.isfinite(depths)) and np.all(depths > 0.0)):
        raise ValueError(f"depth = {depths} m; all must be finite and > 0 m, into the body")
    loads = np.zeros((3, *grid.shape))
    if pressure.shape != grid.shape or (traction is not None and traction.shape != (2, *grid.shape)):
        raise ValueError(f"pressure {pressure.shape}: the grid's shape {grid.shape}, of tractions two")
    loads[2] = pressure
    if traction is not None:
        loads[:2] = traction
    padded = [fft.next_fast_len(3 * n - 2, real=True) for n in grid.shape]
    given = fft.rfft2(loads, s=padded)
    ny, nx = grid.shape
    result = np.empty((6, depths.size, ny, nx))
    for k, z in enumerate(depths):
        coefficients = fft.rfft2(_coefficients(grid, float(z), material.poisson_ratio), s=padded)
        sums = fft.irfft2(np.einsum("lyx,lsyx->syx", given, coefficients), s=padded)
        result[:, k] = sums[:, ny - 1 : 2 * ny - 1, nx - 1 : 2 * nx - 1]
    return StressField(depths, *result)
