"""Errors of every tangential theory against the exact solution, as a table.

The exact forces (185 ellipses) and stress fields (5) are in ``hh_exudyn/data/validation``; its README has
their source, units and signs. Measures, all relative:

* force: length of the difference of the force vectors (F_x, F_y), over friction * normal force;
* stress: integral of the difference of |q| over the patch, over the integral of the exact |q|; slip the same
  with |s| (this includes the elastic part);
* peak: difference of the greatest |q| over the exact one's.
"""

import csv
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.resources import as_file, files

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.material import Material
from hh_exudyn.contact.tangential.api import PatchLoad, cell_areas, creep_force, traction_field
from hh_exudyn.contact.tangential.registry import PATCH_FIELD_THEORIES, PATCH_THEORIES

CELLS = (50, 50)  # cells along and strips across, of the theories
_DATA = files("hh_exudyn") / "data" / "validation"


@dataclass(frozen=True)
class RollingCase(PatchLoad):
    """One ellipse in steady rolling, by its name in the tables, and the material of wheel and rail."""

    name: str
    material: Material


@dataclass(frozen=True)
class ExactForce:
    """Exact creep force on the wheel, over friction * normal force (moment: times sqrt(a b) more).

    `others` holds the forces of the reference program's own simplified theories, (F_x, F_y) by column name.
    """

    case: RollingCase
    x: float
    y: float
    moment: float
    others: dict[str, tuple[float, float]]


@dataclass(frozen=True)
class ExactField:
    """Exact traction on the wheel [Pa] and slip over V [-], arrays (y, x), at cell centres x, y [m]."""

    case: RollingCase
    x: FloatArray
    y: FloatArray
    q_x: FloatArray
    q_y: FloatArray
    slip_x: FloatArray
    slip_y: FloatArray


@dataclass(frozen=True)
class FieldErrors:
    """Errors of one theory against one exact field [-]; see the module's docstring."""

    stress: float
    slip: float
    peak: float


@dataclass(frozen=True)
class TheoryErrors:
    """One row of the table.

    Errors are fractions; None where the theory has no field or no field is of its kind.

    Attributes
    ----------
    theory : str
    cases : str
        The exact cases of the row, in words.
    forces, fields : int
        Numbers of the forces and fields compared.
    force_mean, force_95, force_max : float
        Force error over friction * normal force: mean, 95th percentile, greatest.
    stress_mean, stress_worst, slip_mean, slip_worst, peak_mean, peak_worst : float or None
        Errors of |q|, of |s| and of the greatest |q|: mean and worst field (peak: of the absolute errors).
    """

    theory: str
    cases: str
    forces: int
    force_mean: float
    force_95: float
    force_max: float
    fields: int
    stress_mean: float | None = None
    stress_worst: float | None = None
    slip_mean: float | None = None
    slip_worst: float | None = None
    peak_mean: float | None = None
    peak_worst: float | None = None


def exact_forces() -> list[ExactForce]:
    """The 185 exact creep forces."""
    with (_DATA / "creep_forces.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    found = []
    for row in rows:
        v = {name: float(value) for name, value in row.items() if name != "id"}
        case = RollingCase(
            v["a"] * 1e-3, v["b"] * 1e-3, v["N"], v["cksi"], v["ceta"], v["cphi"] * 1e3, v["mu"],
            name=row["id"], material=Material(v["G"] * 1e6, v["nu"]),
        )  # fmt: skip
        names = [key.removesuffix("_fx") for key in v if key.startswith("fastsim") and key.endswith("_fx")]
        others = {name: (v[f"{name}_fx"], v[f"{name}_fy"]) for name in names}
        found.append(ExactForce(case, v["contact_ext_fx"], v["contact_ext_fy"], v["contact_ext_mz"], others))
    return found


def exact_fields() -> list[ExactField]:
    """The 5 exact stress and slip fields."""
    found = []
    with as_file(_DATA / "stress_fields.npz") as path, np.load(path) as data:
        for name in sorted({key.split("/")[0] for key in data.files}):
            a, b, normal_force, nu_x, nu_y, phi, friction, *elastic = map(float, data[f"{name}/case"])
            case = RollingCase(a, b, normal_force, nu_x, nu_y, phi, friction, name, Material(*elastic))
            arrays = [
                np.asarray(data[f"{name}/{key}"], dtype=np.float64)
                for key in ("x", "y", "q_x", "q_y", "slip_x", "slip_y")
            ]
            found.append(ExactField(case, *arrays))
    return found


def force_error(theory: str, exact: ExactForce, cells: tuple[int, int] = CELLS) -> float:
    """Distance of a theory's force vector from the exact one, over friction * normal force [-].

    Parameters
    ----------
    theory : str
        One of `THEORIES`.
    exact : ExactForce
        The exact case.
    cells : tuple of int
        Cells along x and strips across y.
    """
    case = exact.case
    found = creep_force(theory, *case.arguments, case.material, cells)
    limit = case.friction * case.normal_force
    return math.hypot(found.x / limit - exact.x, found.y / limit - exact.y)


def field_errors(theory: str, exact: ExactField, cells: tuple[int, int] = CELLS) -> FieldErrors:
    """Errors of a theory's stress and slip, on the theory's own cells (the exact field is interpolated).

    Parameters
    ----------
    theory : str
        A theory with a field.
    exact : ExactField
        The exact field.
    cells : tuple of int
        As in `force_error`.
    """
    case = exact.case
    field = traction_field(theory, *case.arguments, case.material, cells)
    areas = cell_areas(case.a, case.b, cells[1], cells[0])

    def at_cells(values: FloatArray) -> FloatArray:
        table = RegularGridInterpolator((exact.y, exact.x), values, bounds_error=False, fill_value=0.0)
        return np.asarray(table((field.y, field.x)), dtype=np.float64)

    traction = np.hypot(at_cells(exact.q_x), at_cells(exact.q_y))
    slip = np.hypot(at_cells(exact.slip_x), at_cells(exact.slip_y))
    found_traction, found_slip = np.hypot(field.q_x, field.q_y), np.hypot(field.slip_x, field.slip_y)
    peak = float(np.hypot(exact.q_x, exact.q_y).max())
    return FieldErrors(
        stress=float(np.sum(np.abs(found_traction - traction) * areas) / np.sum(traction * areas)),
        slip=float(np.sum(np.abs(found_slip - slip) * areas) / np.sum(slip * areas)),
        peak=float(found_traction.max()) / peak - 1.0,
    )


def _any(case: RollingCase) -> bool:
    return True


def _longitudinal(case: RollingCase) -> bool:
    return case.nu_y == 0.0 and case.phi == 0.0


def _no_spin(case: RollingCase) -> bool:
    return case.phi == 0.0


def _slender(case: RollingCase) -> bool:
    return case.phi == 0.0 and case.a < 0.25 * case.b


def _small(case: RollingCase) -> bool:
    linear = creep_force("linear", *case.arguments, case.material)
    return math.hypot(linear.x, linear.y) <= 0.1 * case.friction * case.normal_force


_Wanted = tuple[str, Callable[[RollingCase], bool]]
_ALL: _Wanted = ("all", _any)
_COMPARED: dict[str, tuple[_Wanted, ...]] = {  # cases of theories that are not compared over all cases only
    "carter": (("longitudinal only", _longitudinal),),  # it has no other creepage
    "linear": (("force <= 0.1 mu N", _small),),  # it has no friction limit
    "strip": (_ALL, ("a/b = 0.2, no spin", _slender)),  # the range of validity of strip theory
    "polach": (_ALL, ("no spin", _no_spin)),
}
_ROWS = [(theory, *wanted) for theory in PATCH_THEORIES for wanted in _COMPARED.get(theory, (_ALL,))]


def contact_table(cells: tuple[int, int] = CELLS) -> list[TheoryErrors]:
    """Errors of every theory over the exact cases of its range, and over all cases where it covers them.

    Parameters
    ----------
    cells : tuple of int
        Cells along x and strips across y.

    Returns
    -------
    list of TheoryErrors
    """
    forces, fields = exact_forces(), exact_fields()
    table = []
    for theory, label, wanted in _ROWS:
        errors = [force_error(theory, exact, cells) for exact in forces if wanted(exact.case)]
        row = TheoryErrors(
            theory, label, len(errors), float(np.mean(errors)), float(np.percentile(errors, 95.0)),
            float(np.max(errors)), 0,
        )  # fmt: skip
        if theory in PATCH_FIELD_THEORIES:
            of_fields = [field_errors(theory, exact, cells) for exact in fields if wanted(exact.case)]
            if of_fields:
                row = _with_fields(row, of_fields)
        table.append(row)
    return table


def _with_fields(row: TheoryErrors, errors: list[FieldErrors]) -> TheoryErrors:
    """The row with the errors of its fields."""
    stress = [error.stress for error in errors]
    slip = [error.slip for error in errors]
    peak = [abs(error.peak) for error in errors]
    return replace(
        row, fields=len(errors),
        stress_mean=float(np.mean(stress)), stress_worst=max(stress),
        slip_mean=float(np.mean(slip)), slip_worst=max(slip),
        peak_mean=float(np.mean(peak)), peak_worst=max(peak),
    )  # fmt: skip


COLUMNS = (
    "theory", "cases", "forces", "force mean %", "95 %", "max %", "fields",
    "L1 |q| %", "worst", "L1 |s| %", "worst", "peak %", "worst",
)  # fmt: skip


def to_table(rows: list[TheoryErrors]) -> list[tuple[str, ...]]:
    """The rows as texts under `COLUMNS`: percent (forces: of friction * normal force), "-" for none."""

    def percent(value: float | None) -> str:
        return "-" if value is None else f"{100.0 * value:.1f}"

    return [
        (
            row.theory, row.cases, str(row.forces),
            percent(row.force_mean), percent(row.force_95), percent(row.force_max),
            str(row.fields) if row.fields else "-",
            percent(row.stress_mean), percent(row.stress_worst),
            percent(row.slip_mean), percent(row.slip_worst),
            percent(row.peak_mean), percent(row.peak_worst),
        )
        for row in rows
    ]  # fmt: skip
