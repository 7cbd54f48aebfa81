"""The half-space solutions against numbers from outside, as a table.

Outside are closed forms (Hertz; Johnson's stresses below the surface) and what CONTACT computed: the files of
``hh_exudyn/data/validation``, whose headers and README say how. A row compares one number, or the worst or
mean deviation of many.
"""

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.comparison import Comparison, outside_rows
from hh_exudyn.contact.geometry.silhouette import WheelRailPair
from hh_exudyn.contact.halfspace.influence import Grid, Influence
from hh_exudyn.contact.halfspace.normal import normal_contact, quadratic_overlap
from hh_exudyn.contact.halfspace.pose import wheel_above_rail
from hh_exudyn.contact.halfspace.rolling import rigid_slip, rolling_contact
from hh_exudyn.contact.halfspace.subsurface import stress_below
from hh_exudyn.contact.halfspace.wheel_rail import conformal_contact
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.profile import rail_profile, wheel_profile
from hh_exudyn.contact.tangential.validation import exact_fields, exact_forces, field_errors, force_error
from hh_exudyn.conventions import RIGHT

_CELLS = 40  # along and across, of the creep forces
_GRIDS = (40, 52, 64, 76, 88)  # of the creep coefficients
_FLANGE = 11.6  # mm of y_out, from which pressures are held to 9 %
_NO_SLIP = 1e6  # bound over the elastic stresses, so that nothing slips
_CONTACT = "CONTACT rev 2707"


def _hertz() -> list[Comparison]:
    """A sphere of 0.5 m on a plane under 100 kN: approach at a given load and load at a given approach."""
    radius, load = 0.5, 100e3
    modulus = STEEL.young_modulus / (2.0 * (1.0 - STEEL.poisson_ratio**2))
    a = (0.75 * load * radius / modulus) ** (1.0 / 3.0)
    peak, approach = 1.5 * load / (math.pi * a * a), a * a / radius
    influence = Influence(Grid(45, 45, 2.2 * a / 45, 2.2 * a / 45), STEEL)
    overlap = quadratic_overlap(influence.grid, 0.5 / radius, 0.5 / radius)
    given_load = normal_contact(influence, overlap, load=load)
    given_approach = normal_contact(influence, overlap, approach=approach)
    source = "Hertz 1882, closed form"
    return [
        Comparison("sphere, p_max [MPa]", source, given_load.pressure.max() * 1e-6, peak * 1e-6, 5e-3),
        Comparison("sphere, approach [um]", source, given_load.approach * 1e6, approach * 1e6, 1e-3),
        Comparison("sphere, load [kN]", source, given_approach.load * 1e-3, load * 1e-3, 2e-3),
    ]


def deepest_shear(pressure: FloatArray, grid: Grid, depth: FloatArray, nu: float) -> tuple[float, float]:
    """Largest shear stress below a frictionless pressure, and the depth where it is.

    Parameters
    ----------
    pressure : ndarray, (ny, nx)
        [Pa]
    grid : Grid
        Its grid.
    depth : ndarray
        Depths that are looked at [m].
    nu : float
        Poisson's ratio [-].
    """
    stress = stress_below(grid, depth, pressure, material=Material(STEEL.shear_modulus, nu))
    row = grid.ny // 2  # across a long patch only its middle is a line contact
    largest = stress.max_shear[:, row].max(axis=1)
    k = int(largest.argmax())
    return float(largest[k]), float(depth[k])


def _subsurface() -> list[Comparison]:
    """Johnson's values below Hertz pressures, over p0 and a."""
    source = "Johnson 1985, {}"
    depth = np.arange(0.36, 0.9, 0.01)
    point = Grid(45, 45, 2.2 / 45, 2.2 / 45)
    pressure = np.sqrt(np.maximum(1.0 - point.x**2 - point.y[:, None] ** 2, 0.0))
    of_point = deepest_shear(pressure, point, depth, 0.3)
    line = Grid(40, 101, 2.0 / 40, 2.0)
    of_line = deepest_shear(np.sqrt(1.0 - np.tile(line.x, (line.ny, 1)) ** 2), line, depth, 0.3)
    return [
        Comparison("circle, max shear over p0", source.format("fig. 4.3"), of_point[0], 0.31, 0.01),
        Comparison("circle, its depth over a", source.format("fig. 4.3"), of_point[1], 0.48, 0.05),
        Comparison("line, max shear over p0", source.format("eq. 4.47"), of_line[0], 0.30, 0.01),
        Comparison("line, its depth over a", source.format("eq. 4.47"), of_line[1], 0.78, 0.05),
    ]


def creep_coefficients(
    ratio: float, material: Material, cells: Sequence[int]
) -> tuple[float, float, float, float]:
    """C11, C22, C23, C33 of an ellipse from the half-space without slip, for elements of no size.

    Tractions are singular at the edge, so coefficients are those of ellipses of the elements' area; what is
    left of the edge's steps is averaged by a straight line through several sizes of elements.

    Parameters
    ----------
    ratio : float
        a/b [-].
    material : Material
        Of both bodies.
    cells : sequence of int
        Elements along each axis, of two grids at least.
    """
    a, b = math.sqrt(ratio), 1.0 / math.sqrt(ratio)
    found = []
    for n in cells:
        influence = Influence(Grid(n, n, 2.0 * a / n, 2.0 * b / n), material)
        grid = influence.grid
        inside = (grid.x / a) ** 2 + (grid.y[:, None] / b) ** 2 < 1.0
        bound = np.where(inside, _NO_SLIP * material.shear_modulus, 0.0)
        values = []
        for creepage in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
            # a residual of 1e-4 of the stresses, not of the bound
            slip = rigid_slip(influence, *creepage)
            solved = rolling_contact(influence, bound, slip, tolerance=1e-4 / _NO_SLIP)
            values.append((*solved.force, solved.moment))
        size = math.sqrt(float(inside.sum()) * grid.area / math.pi)  # c of the elements, not quite 1
        scale = np.array([[size**2, size**2, size**3]] * 2 + [[size**3, size**3, size**4]])
        x, y, spin = -np.array(values) / (material.shear_modulus * scale)
        found.append([x[0], y[1], 0.5 * (spin[1] - y[2]), spin[2]])
    best = np.polyfit(1.0 / np.array(cells), np.array(found), 1)[1]
    return float(best[0]), float(best[1]), float(best[2]), float(best[3])


def _coefficients() -> list[Comparison]:
    """Worst deviation of each coefficient over the ellipses of the file."""
    names = ("C11", "C22", "C23", "C33")
    worst = np.zeros(len(names))
    for row in outside_rows("creep_coefficients.csv"):
        material = Material(STEEL.shear_modulus, float(row["nu"]))
        found = creep_coefficients(float(row["a_over_b"]), material, _GRIDS)
        wanted = np.array([float(row[name]) for name in names])
        worst = np.maximum(worst, np.abs(np.array(found) / wanted - 1.0))
    source = f"{_CONTACT}, no slip"
    return [
        Comparison(f"{name}, worst of a/b 0.2 to 5", source, float(value), 0.0, allowed)
        for name, value, allowed in zip(names, worst, (1e-2, 1e-2, 1e-2, 2e-2), strict=True)
    ]


def _rolling() -> list[Comparison]:
    """Creep forces of 185 ellipses, and the five stress fields on their own elements."""
    errors = [force_error("halfspace", exact, (_CELLS, _CELLS)) for exact in exact_forces()]
    source = f"{_CONTACT}, 185 ellipses"
    rows = [
        Comparison("creep force, mean error / mu N", source, float(np.mean(errors)), 0.0, 3e-3),
        Comparison("creep force, max error / mu N", source, float(np.max(errors)), 0.0, 1e-2),
    ]
    for exact in exact_fields():
        found = field_errors("halfspace", exact, (80, 80))
        name = exact.case.name.replace("_", " ")
        rows.append(Comparison(f"|q| of {name}, L1 error", f"{_CONTACT}, field", found.stress, 0.0, 1e-2))
    return rows


def conformal_poses() -> Iterator[tuple[WheelRailPair, dict[str, float], bool]]:
    """Poses of ``conformal.csv`` from tread to flange, S1002 on 60E1 1:30.

    Yields
    ------
    tuple
        The pair, the numbers of the row by column, and whether the load was given, not the height.
    """
    wheel, rail = wheel_profile("S1002"), rail_profile("60E1", 1.0 / 30.0)
    for row in outside_rows("conformal.csv"):
        v = {name: float(value) for name, value in row.items() if name != "given"}
        pair = wheel_above_rail(
            wheel, rail, RIGHT, lateral=-v["y_out"] * 1e-3, height=0.4575 - v["z_ws"] * 1e-3, radius=0.4575,
            yaw=-v["yaw"] * 1e-3, gauge=1.445,
        )  # fmt: skip
        yield pair, v, row["given"] == "load"


def _conformal() -> list[Comparison]:
    """Worst deviations over the poses from tread to flange."""
    force: list[float] = []
    root: list[float] = []
    flange: list[float] = []
    for pair, v, load_given in conformal_poses():
        found = conformal_contact(pair, load=v["Fz"] if load_given else None)
        if found is None:
            raise ArithmeticError(f"no contact at y_out = {v['y_out']} mm, z_ws = {v['z_ws']} mm")
        force += [abs(found.vertical / v["Fz"] - 1.0), abs(found.outwards / v["Fy"] - 1.0)]
        pressure = abs(found.max_pressure * 1e-6 / v["p_max"] - 1.0)
        (root if v["y_out"] < _FLANGE else flange).append(pressure)
    source = f"{_CONTACT}, conformal"
    return [
        Comparison(f"S1002 on 60E1, forces, {len(force)}", source, max(force), 0.0, 1e-2),
        Comparison(f"tread and root, p_max, {len(root)}", source, max(root), 0.0, 2e-2),
        Comparison(f"root to flange, p_max, {len(flange)}", source, max(flange), 0.0, 9e-2),
    ]


_PARTS: tuple[Callable[[], list[Comparison]], ...] = (
    _hertz, _subsurface, _coefficients, _rolling, _conformal,
)  # fmt: skip


def halfspace_table() -> list[Comparison]:
    """All comparisons; some seconds."""
    return [row for part in _PARTS for row in part()]
