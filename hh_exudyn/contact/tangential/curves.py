"""Creep force over one creepage, by several theories: curves as in Fig. 2-4 to 2-7 of Hossein-Nia (2018)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.tangential.api import creep_force
from hh_exudyn.contact.tangential.kalker import kalker_coefficients

EXACT = "halfspace"  # what the other theories are compared with
CREEPAGES = ("longitudinal", "lateral", "spin")


@dataclass(frozen=True)
class CurvePatch:
    """An elliptic patch whose creepage is varied.

    Attributes
    ----------
    a, b, normal_force, friction : float
        As of `api.PatchLoad`.
    nu_x, nu_y, phi : float
        The creepages that are kept while another varies [-], [-], [1/m].
    material : Material
        Of wheel and rail.
    """

    a: float
    b: float
    normal_force: float
    friction: float
    nu_x: float = 0.0
    nu_y: float = 0.0
    phi: float = 0.0
    material: Material = STEEL

    @property
    def limit(self) -> float:
        """Friction times normal force [N]."""
        return self.friction * self.normal_force

    def unit(self, creepage: str) -> float:
        """The creepage at which Kalker's linear theory reaches the limit: [-], for spin [1/m]."""
        c11, c22, c23, _ = kalker_coefficients(self.a / self.b, self.material.poisson_ratio)
        stiffness = self.material.shear_modulus * self.a * self.b
        per_creepage = {"longitudinal": c11, "lateral": c22, "spin": c23 * math.sqrt(self.a * self.b)}
        return self.limit / (stiffness * float(per_creepage[creepage]))


@dataclass(frozen=True)
class CreepCurve:
    """Forces over one creepage.

    Attributes
    ----------
    creepage : str
        Which one varies, of `CREEPAGES`.
    values : ndarray, (n,)
        The creepage [-], spin [1/m].
    forces : dict
        By theory, (n, 3): F_x, F_y on the wheel over friction * normal force, M_z over that times sqrt(a b).
    """

    creepage: str
    values: FloatArray
    forces: dict[str, FloatArray]

    def error(self, theory: str) -> float:
        """Largest distance of a theory's force vector from the half-space's, over friction * normal force."""
        off = self.forces[theory][:, :2] - self.forces[EXACT][:, :2]
        return float(np.hypot(off[:, 0], off[:, 1]).max())


def creep_curve(
    patch: CurvePatch,
    creepage: str,
    theories: Sequence[str],
    *,
    reach: float = 3.0,
    points: int = 25,
    cells: int = 30,
) -> CreepCurve:
    """Forces of an elliptic patch over one of its creepages, from none on.

    Parameters
    ----------
    patch : CurvePatch
        Size, load, friction, and the creepages that stay.
    creepage : str
        The one that varies, of `CREEPAGES`.
    theories : sequence of str
        Of `registry.PATCH_THEORIES`.
    reach : float
        Largest creepage over `CurvePatch.unit`, > 0 [-].
    points : int
        Creepages, from zero on, >= 2.
    cells : int
        Of the theories, along x and across y.

    Returns
    -------
    CreepCurve

    Raises
    ------
    ValueError
        For an unknown creepage or theory, or a number out of range.
    """
    if creepage not in CREEPAGES:
        raise ValueError(f"creepage = {creepage!r}; allowed: {', '.join(CREEPAGES)}")
    if not (math.isfinite(reach) and reach > 0.0):
        raise ValueError(f"reach = {reach} [-]; it must be finite and > 0")
    if not 2 <= points <= 1000:
        raise ValueError(f"points = {points}; 2 to 1000 are allowed")
    values = np.linspace(0.0, reach * patch.unit(creepage), points)
    kept = {"longitudinal": patch.nu_x, "lateral": patch.nu_y, "spin": patch.phi}
    size = math.sqrt(patch.a * patch.b)
    forces = {}
    for theory in theories:
        rows = []
        for value in values:
            given = kept | {creepage: float(value)}
            found = creep_force(
                theory, patch.a, patch.b, patch.normal_force, given["longitudinal"], given["lateral"],
                given["spin"], patch.friction, patch.material, (cells, cells),
            )  # fmt: skip
            rows.append((found.x, found.y, found.moment / size))
        forces[theory] = np.array(rows) / patch.limit
    return CreepCurve(creepage, values, forces)
