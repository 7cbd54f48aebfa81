"""The parts of a family of couplings: record of its numbers, relative motion, condition, force law.

A family is one entry of `dispatch.FAMILIES`. Its numbers are a NamedTuple of float and `Vector` fields (an
array of another length: ``Annotated[FloatArray, length]``), filled from the description's attributes of the
same names. A kernel finds them by name in a record (``p.stiffness[0]``) at the cost of an array element.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, get_type_hints

import numpy as np

from hh_exudyn.arrays import FloatArray, IntArray
from hh_exudyn.kernel import inlined_kernel
from hh_exudyn.multibody.vectors import Triple, cross, dot, triple
from vehicles.couplings import Vector

Matrix = tuple[Triple, Triple, Triple]
Sliders = tuple[float, float, float, float, float, float]
RecordArray = np.ndarray[Any, np.dtype[np.void]]


class Motion(NamedTuple):
    """Motion of body B relative to body A at a coupling."""

    displacement: Triple  # in the axes of A, zero on the drawing [m]
    rate: Triple  # velocity in the axes of A [m/s]
    turn: Triple  # angular velocity in global axes [rad/s]
    rotation_a: Matrix  # of body A, to global axes
    rotation_b: Matrix  # of body B; of a wheelset without its spin, see `spin_free`


class Condition(NamedTuple):
    """State and inputs of one coupling, and the ledger of the couplings before it."""

    slider: Sliders  # of the last accepted step [m] or [rad]; a law may keep other states there
    settle: bool  # for the equilibrium: friction sticks under any load, wedges have none vertically
    stiffness: float  # factor on the longitudinal stiffness, set by a controller
    friction_power: float  # of all couplings before this one [W]
    damper_power: float  # [W]
    time: float = 0.0  # of the evaluation [s]


class Reaction(NamedTuple):
    """Force, moment, sliders and dissipated powers of one coupling for a motion."""

    force: Triple  # on body B, in the axes of A [N]
    moment: Triple  # on body B [N m]
    slider: Sliders  # to be committed when the step is accepted
    friction_power: float  # dissipated by all couplings up to this one [W]
    damper_power: float  # [W]


# Laws take and return plain numbers: arrays in a tuple have reference counts, which made all couplings
# three times slower. The powers pass through the laws, so that the ledger is one sum in the couplings' order.
Law = Callable[[Any, Motion, Condition], Reaction]


class Family(NamedTuple):
    """One family of couplings: its description, its numbers and its force law."""

    name: str  # of its field in the record of a coupling
    description: type  # in `vehicles.couplings`
    numbers: type  # NamedTuple of the numbers of the law
    law: Law  # inlined kernel
    derived: Callable[[Any], dict[str, Any]] = lambda coupling: {}  # numbers other than attributes, by name


def packed(couplings: Sequence[Any], families: Sequence[Family]) -> tuple[IntArray, RecordArray]:
    """Family and numbers of couplings.

    Parameters
    ----------
    couplings : descriptions, each of the description type of one of the families
    families : in the order of their numbers

    Returns
    -------
    (n,) number of each coupling's family, and (n,) record of its numbers, in the field of that family's name.

    Raises
    ------
    TypeError
        A coupling belongs to none of the families.
    """
    types = [family.description for family in families]
    kinds = np.zeros(len(couplings), dtype=np.int64)
    numbers = np.zeros(len(couplings), dtype=_record_of_any(families))
    for i, coupling in enumerate(couplings):
        if type(coupling) not in types:
            raise TypeError(f"coupling {coupling.name}: no family for a {type(coupling).__name__}")
        kinds[i] = types.index(type(coupling))
        family = families[kinds[i]]
        numbers[family.name][i] = _numbers(coupling, family)
    return kinds, numbers.view(np.recarray)


def _record_of_any(families: Sequence[Family]) -> np.dtype[np.void]:
    """Record type with one field per family, all at the same offset: a coupling has the numbers of one."""
    records = [_record(family.numbers) for family in families]
    return np.dtype(
        {
            "names": [family.name for family in families],
            "formats": [np.dtype((np.record, record)) for record in records],
            "offsets": [0] * len(records),
            "itemsize": max(record.itemsize for record in records),
        }
    )


def _record(numbers: type) -> np.dtype[np.void]:
    """Record type of a NamedTuple of numbers: one 64-bit float per float, several per `Vector` or array."""
    fields: list[tuple[str, type, tuple[int, ...]]] = []
    for name, hint in get_type_hints(numbers, include_extras=True).items():
        if hint is float:
            fields.append((name, np.float64, ()))
        elif hint == Vector:
            fields.append((name, np.float64, (3,)))
        else:
            fields.append((name, np.float64, hint.__metadata__))
    return np.dtype(fields)


def _numbers(coupling: Any, family: Family) -> tuple[Any, ...]:
    """Numbers of one coupling in the order of its family's fields."""
    derived = family.derived(coupling)
    names = family.numbers._fields  # type: ignore[attr-defined]
    return tuple(derived[name] if name in derived else getattr(coupling, name) for name in names)


def one_law(families: Sequence[Family]) -> Callable[[int, Any, Motion, Condition], Reaction]:
    """The laws of all families as one inlined kernel of family number, record, motion and condition.

    Parameters
    ----------
    families : in the order of their numbers
    """
    return _law_from(tuple(families), 0)


def _law_from(families: tuple[Family, ...], number: int) -> Callable[[int, Any, Motion, Condition], Reaction]:
    """One kernel of the laws of the families from `number` on."""
    name, law = families[number].name, families[number].law
    if number == len(families) - 1:

        @inlined_kernel
        def last(kind: int, numbers: Any, motion: Motion, condition: Condition) -> Reaction:
            return law(numbers[name], motion, condition)

        return last
    others = _law_from(families, number + 1)

    @inlined_kernel
    def this_or_other(kind: int, numbers: Any, motion: Motion, condition: Condition) -> Reaction:
        if kind == number:
            return law(numbers[name], motion, condition)
        return others(kind, numbers, motion, condition)

    return this_or_other


@inlined_kernel
def matrix(rotation: FloatArray) -> Matrix:
    """A rotation matrix (3, 3) as plain numbers, row by row.

    Parameters
    ----------
    rotation : (3, 3)
    """
    return triple(rotation[0]), triple(rotation[1]), triple(rotation[2])


@inlined_kernel
def spin_free(rotation_b: FloatArray, rotation_a: FloatArray) -> Matrix:
    """The axes of an axle box that stands on a wheelset: y along its axle, x level with body A.

    Parameters
    ----------
    rotation_b : (3, 3) of the wheelset, to global axes
    rotation_a : (3, 3) of the body that holds the axle box from pitching
    """
    axle = (rotation_b[0, 1], rotation_b[1, 1], rotation_b[2, 1])
    ahead = cross(axle, (rotation_a[0, 2], rotation_a[1, 2], rotation_a[2, 2]))
    size = math.sqrt(dot(ahead, ahead))
    ahead = (ahead[0] / size, ahead[1] / size, ahead[2] / size)
    up = cross(ahead, axle)
    return (ahead[0], axle[0], up[0]), (ahead[1], axle[1], up[1]), (ahead[2], axle[2], up[2])


@inlined_kernel
def turned_back(rotation_a: Matrix, rotation_b: Matrix) -> Matrix:
    """Axes that are turned from those of A by the opposite of the rotation from A to B: A B^T A.

    Parameters
    ----------
    rotation_a, rotation_b : to global axes
    """
    a0, a1, a2 = rotation_a
    b0, b1, b2 = rotation_b
    between = (  # A B^T
        (dot(a0, b0), dot(a0, b1), dot(a0, b2)),
        (dot(a1, b0), dot(a1, b1), dot(a1, b2)),
        (dot(a2, b0), dot(a2, b1), dot(a2, b2)),
    )
    x, y, z = (a0[0], a1[0], a2[0]), (a0[1], a1[1], a2[1]), (a0[2], a1[2], a2[2])
    return (
        (dot(between[0], x), dot(between[0], y), dot(between[0], z)),
        (dot(between[1], x), dot(between[1], y), dot(between[1], z)),
        (dot(between[2], x), dot(between[2], y), dot(between[2], z)),
    )


@inlined_kernel
def without(vector: Triple, axle: Triple) -> Triple:
    """A vector less its part along an axle, that bearings do not pass on.

    Parameters
    ----------
    vector, axle : in the same axes; the axle of length 1
    """
    along = dot(vector, axle)
    return vector[0] - along * axle[0], vector[1] - along * axle[1], vector[2] - along * axle[2]


@inlined_kernel
def angle_of(motion: Motion) -> Triple:
    """Small rotation of B relative to A in the axes of A, from the skew part of RA^T RB [rad].

    Parameters
    ----------
    motion : rotations and angular velocity are read
    """
    a, b = motion.rotation_a, motion.rotation_b
    x = a[0][2] * b[0][1] - a[0][1] * b[0][2]
    x += a[1][2] * b[1][1] - a[1][1] * b[1][2]
    x += a[2][2] * b[2][1] - a[2][1] * b[2][2]
    y = a[0][0] * b[0][2] - a[0][2] * b[0][0]
    y += a[1][0] * b[1][2] - a[1][2] * b[1][0]
    y += a[2][0] * b[2][2] - a[2][2] * b[2][0]
    z = a[0][1] * b[0][0] - a[0][0] * b[0][1]
    z += a[1][1] * b[1][0] - a[1][0] * b[1][1]
    z += a[2][1] * b[2][0] - a[2][0] * b[2][1]
    return 0.5 * x, 0.5 * y, 0.5 * z


@inlined_kernel
def turn_of(motion: Motion) -> Triple:
    """Angular velocity of B relative to A in the axes of A [rad/s].

    Parameters
    ----------
    motion : rotations and angular velocity are read
    """
    return _in_axes(motion.rotation_a, motion.turn)


@inlined_kernel
def axle_of(motion: Motion) -> Triple:
    """Direction of the axle of body B, a spinning wheelset, in the axes of A.

    Parameters
    ----------
    motion : rotations and angular velocity are read
    """
    b = motion.rotation_b
    return _in_axes(motion.rotation_a, (b[0][1], b[1][1], b[2][1]))


@inlined_kernel
def _in_axes(rotation: Matrix, vector: Triple) -> Triple:
    """Transpose of a rotation matrix times a vector."""
    first, second, third = rotation
    x, y, z = vector
    return (
        first[0] * x + second[0] * y + third[0] * z,
        first[1] * x + second[1] * y + third[1] * z,
        first[2] * x + second[2] * y + third[2] * z,
    )
