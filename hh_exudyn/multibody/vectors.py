"""Three-vectors and rotations as plain numbers, inlined into the kernels."""

import math

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import kernel

Triple = tuple[float, float, float]


@kernel
def cross(a: Triple, b: Triple) -> Triple:
    """Vector product.

    Parameters
    ----------
    a, b : vectors
    """
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@kernel
def dot(a: Triple, b: Triple) -> float:
    """Scalar product.

    Parameters
    ----------
    a, b : vectors
    """
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def rotate(rotation: FloatArray, a: Triple) -> Triple:
    """Rotation matrix (3, 3) times vector.

    Parameters
    ----------
    rotation : (3, 3)
    a : vector
    """
    return (
        rotation[0, 0] * a[0] + rotation[0, 1] * a[1] + rotation[0, 2] * a[2],
        rotation[1, 0] * a[0] + rotation[1, 1] * a[1] + rotation[1, 2] * a[2],
        rotation[2, 0] * a[0] + rotation[2, 1] * a[1] + rotation[2, 2] * a[2],
    )


@kernel
def rotate_back(rotation: FloatArray, a: Triple) -> Triple:
    """Transpose of a rotation matrix times vector, both as for `rotate`."""
    return (
        rotation[0, 0] * a[0] + rotation[1, 0] * a[1] + rotation[2, 0] * a[2],
        rotation[0, 1] * a[0] + rotation[1, 1] * a[1] + rotation[2, 1] * a[2],
        rotation[0, 2] * a[0] + rotation[1, 2] * a[1] + rotation[2, 2] * a[2],
    )


@kernel
def times(factor: float, a: Triple) -> Triple:
    """A vector by a factor.

    Parameters
    ----------
    factor : number
    a : vector
    """
    return factor * a[0], factor * a[1], factor * a[2]


@kernel
def triple(row: FloatArray) -> Triple:
    """The first three numbers of a row as a tuple.

    Parameters
    ----------
    row : (3,) or longer
    """
    return row[0], row[1], row[2]


@kernel
def add_to(row: FloatArray, a: Triple, factor: float) -> None:
    """row += factor a.

    Parameters
    ----------
    row : (3,) or longer, changed
    a : vector
    factor : of the vector
    """
    row[0] += factor * a[0]
    row[1] += factor * a[1]
    row[2] += factor * a[2]


@kernel
def rotation_matrix(x: float, y: float, z: float, rotation: FloatArray) -> None:
    """Fill `rotation` (3, 3) with the exponential of the rotation vector (Rodrigues).

    Parameters
    ----------
    x, y, z : rotation vector [rad]
    rotation : (3, 3), filled
    """
    angle2 = x * x + y * y + z * z
    if angle2 < 1e-12:
        sine = 1.0 - angle2 / 6.0
        versine = 0.5 - angle2 / 24.0
    else:
        angle = math.sqrt(angle2)
        sine = math.sin(angle) / angle
        versine = (1.0 - math.cos(angle)) / angle2
    cosine = 1.0 - versine * angle2
    rotation[0, 0] = cosine + versine * x * x
    rotation[1, 1] = cosine + versine * y * y
    rotation[2, 2] = cosine + versine * z * z
    rotation[0, 1] = versine * x * y - sine * z
    rotation[1, 0] = versine * x * y + sine * z
    rotation[0, 2] = versine * x * z + sine * y
    rotation[2, 0] = versine * x * z - sine * y
    rotation[1, 2] = versine * y * z - sine * x
    rotation[2, 1] = versine * y * z + sine * x
