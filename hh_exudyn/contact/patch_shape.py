"""The patch behind a logged contact state, rebuilt from the profiles: strips, pressure, traction and slip.

A contact log holds the equivalent ellipse of a non-elliptic patch. Its strips follow again from the profiles,
the place of the contact, the approach, and roll and yaw of the wheelset, by the kernels of the run; so they
can be finer than in the run. Those of coupled strips are those of the run (`strips.rebuilt`).
"""

import math
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from scipy.optimize import brentq

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.geometry.search import CONTACT_COLUMNS, MAX_MAXIMA, STIFFNESS, Y_WHEEL
from hh_exudyn.contact.geometry.silhouette import WheelRailPair, silhouette
from hh_exudyn.contact.normal.neighbours import find_patches
from hh_exudyn.contact.normal.non_elliptic import minimum, patch_strips
from hh_exudyn.contact.normal.registry import COUPLED_STRIPS, is_elliptic
from hh_exudyn.contact.profiles.spline import spline_evaluate
from hh_exudyn.contact.strips.rebuilt import LoggedPatch, LoggedPose, logged_pair, rebuilt_rows
from hh_exudyn.contact.strips.table import CAPACITY, ROWS, Row
from hh_exudyn.contact.tangential.api import TractionField
from hh_exudyn.contact.tangential.fastrip import field_on_strips
from hh_exudyn.contact.tangential.strips import HALF_LENGTH, PRESSURE, STRIP_COLUMNS, WIDTH, Y
from hh_exudyn.contact.types import Fields, RollingPatch, WheelRailModel
from hh_exudyn.conventions import LEFT

_STEP = 0.25  # of the search for the height, over the approach
_STEPS = 40
_TOLERANCE = 1e-13  # m, of the height
_ALIKE = 1.5  # of the semi-axes, whatever the number of strips


class State(Protocol):
    """Attributes of a patch that its shape follows from: a `ContactState` has them, or a row of the log."""

    @property
    def side(self) -> int: ...
    @property
    def y_wheel(self) -> float: ...
    @property
    def contact_angle(self) -> float: ...
    @property
    def y_rail(self) -> float: ...
    @property
    def normal_force(self) -> float: ...
    @property
    def a(self) -> float: ...
    @property
    def b(self) -> float: ...
    @property
    def p_max(self) -> float: ...
    @property
    def nu_x(self) -> float: ...
    @property
    def nu_y(self) -> float: ...
    @property
    def phi(self) -> float: ...
    @property
    def friction(self) -> float: ...
    @property
    def angle_of_attack(self) -> float: ...
    @property
    def approach(self) -> float: ...
    @property
    def centre_y(self) -> float: ...
    @property
    def centre_z(self) -> float: ...
    @property
    def roll(self) -> float: ...
    @property
    def s(self) -> float: ...


@dataclass(frozen=True)
class PatchShape:
    """Strips of a patch, from right to left as frame C has them; arrays (n,).

    Attributes
    ----------
    y : FloatArray
        Middle of the strips, lateral from the contact's place (its centre of pressure), frame C [m].
    width, half_length : FloatArray
        [m].
    pressure : FloatArray
        At x = 0, semi-elliptic along the strip; it carries the normal force of the state [Pa].
    a, b : float
        Semi-axes of the equivalent ellipse [m].
    y_wheel : FloatArray
        Place on the wheel profile [m].
    nu_x, nu_y, phi : FloatArray
        Rigid slip in the middle of the strips and spin there [-], [-], [1/m].
    """

    y: FloatArray
    width: FloatArray
    half_length: FloatArray
    pressure: FloatArray
    a: float
    b: float
    y_wheel: FloatArray
    nu_x: FloatArray
    nu_y: FloatArray
    phi: FloatArray

    def normal_force(self) -> float:
        """Integral of the pressure [N]."""
        return float(0.5 * math.pi * np.sum(self.pressure * self.half_length * self.width))

    def strips(self) -> FloatArray:
        """The array that kernels take (`strips`)."""
        return np.column_stack((self.y, self.width, self.half_length, self.pressure))


def patch_shape(model: WheelRailModel, state: State, strips: int = 50) -> PatchShape:
    """The strips of a contact state.

    Parameters
    ----------
    model : WheelRailModel
        Profiles and theory of the run, from `wheel_rail.wheel_rail_model`.
    state : State
        Attributes named as the columns of the contact log.
    strips : int
        3 .. 1000; not read where the model has coupled strips, which are fixed on the wheel.

    Returns
    -------
    PatchShape

    Raises
    ------
    ValueError
        A number out of its range, or profiles between which there is no such contact. The least patches of a
        run, of a few newtons beside a large one, may have none.
    """
    if not 3 <= strips <= 1000:
        raise ValueError(f"strips = {strips}, allowed 3 .. 1000")
    if not (state.normal_force > 0.0 and state.approach > 0.0):
        raise ValueError(
            f"normal_force = {state.normal_force} N, approach = {state.approach} m; both must be > 0"
        )
    if model.normal == COUPLED_STRIPS:
        return _coupled_shape(model, state)
    rows = np.zeros((strips, STRIP_COLUMNS))
    if is_elliptic(model.normal):
        a, b = state.a, state.b
        lateral = -1.0 + (2.0 * np.arange(strips) + 1.0) / strips
        rows[:, Y], rows[:, WIDTH] = b * lateral, 2.0 * b / strips
        rows[:, HALF_LENGTH] = a * np.sqrt(1.0 - lateral**2)
        rows[:, PRESSURE] = state.p_max * np.sqrt(1.0 - lateral**2)
    else:
        a, b = _solve(model, state, rows)
        # not so where other profiles were in the run, or its strips belong to a patch beside it
        for name, found, logged in (("a", a, state.a), ("b", b, state.b)):
            if not logged / _ALIKE <= found <= logged * _ALIKE:
                raise ValueError(
                    f"the patch at y_wheel = {state.y_wheel:.5f} m with approach = {state.approach:.3g} m "
                    f"has {name} = {found:.3g} m between these profiles, but in the state {name} = "
                    f"{logged:.3g} m"
                )
    if rows[0, Y] > rows[-1, Y]:
        rows = rows[::-1]
    shape = PatchShape(
        y=rows[:, Y],
        width=rows[:, WIDTH],
        half_length=rows[:, HALF_LENGTH],
        pressure=rows[:, PRESSURE],
        a=a,
        b=b,
        y_wheel=state.y_wheel - state.side * math.cos(state.contact_angle) * rows[:, Y],
        nu_x=state.nu_x - state.phi * rows[:, Y],
        nu_y=np.full(strips, state.nu_y),
        phi=np.full(strips, state.phi),
    )
    # for the contact damping, and the error of the strips at their edges
    return replace(shape, pressure=state.normal_force / shape.normal_force() * shape.pressure)


def _coupled_shape(model: WheelRailModel, state: State) -> PatchShape:
    """The strips of a row by coupled strips."""
    rows = np.zeros((ROWS, CAPACITY))
    count = _rebuild(model, state, rows)
    rows = rows[:, np.flatnonzero(rows[Row.LOAD, :count] > 0.0)]
    if state.side == LEFT:  # the flange is to the right of its tread
        rows = rows[:, ::-1]
    strips = model.strips_left if state.side == LEFT else model.strips_right
    largest = int(np.argmax(rows[Row.LOAD] / rows[Row.WIDTH]))
    return PatchShape(
        y=state.side * (np.average(rows[Row.ARC], weights=rows[Row.LOAD]) - rows[Row.ARC]),
        width=rows[Row.WIDTH],
        half_length=rows[Row.HALF_LENGTH],
        pressure=rows[Row.PRESSURE],
        a=float(rows[Row.A, largest]),
        b=float(rows[Row.B, largest]),
        y_wheel=strips.y[rows[Row.NUMBER].astype(int)],
        nu_x=rows[Row.NU_X],
        nu_y=rows[Row.NU_Y],
        phi=rows[Row.PHI],
    )


def _rebuild(model: WheelRailModel, state: State, rows: FloatArray, fields: Fields | None = None) -> int:
    """Fill (ROWS, CAPACITY) with the strips of a row, and their fields; the number of strips with overlap.

    ValueError where no strip carries load in the logged pose: other profiles were in the run.
    """
    pose = LoggedPose(
        float(state.side), state.s, state.centre_y, state.centre_z, state.angle_of_attack, state.roll
    )
    patch = LoggedPatch(state.y_wheel, state.normal_force, state.nu_x, state.nu_y, state.phi, state.friction)
    no_fields = Fields(*np.zeros((5, 0, 0)))
    vectors = np.zeros((2, 3))
    count = rebuilt_rows(model, pose, patch, vectors, rows, no_fields if fields is None else fields)
    if count == 0:
        raise ValueError(
            f"no load at y_wheel = {state.y_wheel:.5f} m with the wheelset's centre at centre_y = "
            f"{state.centre_y:.5f} m, centre_z = {state.centre_z:.5f} m from these profiles' rail"
        )
    return int(count)


def traction_on_shape(
    model: WheelRailModel, state: State, shape: PatchShape, cells_x: int = 50
) -> TractionField:
    """Pressure, FaStrip's tractions on the wheel and slip over V in the cells of a patch.

    Parameters
    ----------
    model : WheelRailModel
        For the material.
    state : State
        As for `patch_shape`.
    shape : PatchShape
        Its strips.
    cells_x : int
        Cells along each strip, 3 .. 1000.

    Returns
    -------
    TractionField
        Arrays (strips, cells_x); cell (j, i) has the area 2 half_length_j width_j / cells_x.
    """
    if not 3 <= cells_x <= 1000:
        raise ValueError(f"cells_x = {cells_x}, allowed 3 .. 1000")
    count = shape.y.size
    along = -1.0 + (2.0 * np.arange(cells_x) + 1.0) / cells_x
    patch = RollingPatch(
        shape.a, shape.b, state.normal_force, state.nu_x, state.nu_y, state.phi, state.friction,
        model.shear_modulus, model.poisson_ratio,
    )  # fmt: skip
    fields = Fields(*np.zeros((5, count, cells_x)))
    if model.normal == COUPLED_STRIPS:
        _rebuild(model, state, np.zeros((ROWS, CAPACITY)), fields)
        if state.side == LEFT:  # strips in the order of the profile; y to the left falls along it
            fields = Fields(*(field[::-1] for field in fields))
    else:
        field_on_strips(shape.strips(), count, patch, fields)
    x = shape.half_length[:, None] * along[None, :]
    return TractionField(x, np.repeat(shape.y[:, None], cells_x, axis=1), *fields)


def _solve(model: WheelRailModel, state: State, rows: FloatArray) -> tuple[float, float]:
    """Find the height of the wheelset that gives the logged approach; fill the strips, return a and b."""
    low, middle, slope = _pair(model, state)
    contacts = np.zeros((MAX_MAXIMA, CONTACT_COLUMNS))

    def solve(height: float) -> tuple[float, float, float, float]:
        """Approach, distance from the logged place, a, b of the patch nearest to that place."""
        pair = low._replace(centre_z=height)
        count = find_patches(model.normal, pair, contacts, model.shear_modulus, model.poisson_ratio, rows)
        best = (0.0, math.inf, 0.0, 0.0)
        for k in range(count):
            contact = contacts[k].copy()
            point = minimum(model.normal, pair, contact, model.shear_modulus, model.poisson_ratio)
            strips = np.zeros_like(rows)
            force, _, a, b, _ = patch_strips(pair, contact, point, contact[STIFFNESS], strips)
            distance = abs(contact[Y_WHEEL] - state.y_wheel)
            if force > 0.0 and distance < best[1]:
                best = (point.approach, distance, a, b)
                found[:] = strips
        return best

    found = np.zeros_like(rows)
    shallow = middle  # here the profiles just touch at the logged place, which lies within the patch
    step = _STEP * state.approach * math.sqrt(1.0 + slope * slope)
    for _ in range(_STEPS):
        deep = shallow - step
        if solve(deep)[0] > state.approach >= solve(shallow)[0]:
            break
        shallow = deep
    else:
        raise ValueError(
            f"no contact with approach = {state.approach:.3g} m at y_wheel = {state.y_wheel:.5f} m, "
            f"y_rail = {state.y_rail:.5f} m between these profiles"
        )
    height = brentq(lambda z: solve(z)[0] - state.approach, deep, shallow, xtol=_TOLERANCE, rtol=1e-15)
    _, _, a, b = solve(height)
    rows[:] = found
    return float(a), float(b)


def _pair(model: WheelRailModel, state: State) -> tuple[WheelRailPair, float, float]:
    """Wheel and rail with the logged places above each other, the height of touch and the slope there."""
    pose = LoggedPose(float(state.side), state.s, 0.0, 0.0, state.angle_of_attack, state.roll)
    pair = logged_pair(model, pose)
    z, slope, _ = spline_evaluate(pair.wheel, state.y_wheel)
    z_rail, _, _ = spline_evaluate(pair.rail, state.y_rail)
    _, py, pz, _ = silhouette(pair, state.y_wheel, z, slope)
    if not math.isfinite(py + pz + z_rail):
        raise ValueError(f"y_wheel = {state.y_wheel} m, y_rail = {state.y_rail} m: not on the profiles")
    return pair._replace(centre_y=-(py + state.side * state.y_rail)), z_rail - pz, slope
