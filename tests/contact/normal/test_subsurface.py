"""Stresses below a line contact: the equations of elasticity, the loads at the border, published maxima."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq, minimize
from shakedown_table import LIMITS

from hh_exudyn.contact.normal.subsurface import (
    SubsurfaceStress,
    line_contact_stress,
    partial_slip_stress,
    stick_half_length,
)

A, P0, MU = 5e-3, 1.2e9, 0.35
LOADS = {"no friction": 0.0, "full slip": 0.35, "full slip back": -0.35, "partial": 0.2, "partial back": -0.1}
loads = pytest.mark.parametrize("ratio", LOADS.values(), ids=list(LOADS))
PLACES = [
    (0.0, 0.3),
    (0.9, 0.05),
    (-1.0, 0.02),
    (0.4, 0.78),
    (-2.0, 0.4),
    (1.3, 1e-3),
    (3.0, 5.0),
    (1.0, 0.1),
]


def stress(x: object, depth: object, ratio: float, friction: float = MU) -> SubsurfaceStress:
    """Lengths over a, stresses over p0."""
    x, depth = np.asarray(x, dtype=float), np.asarray(depth, dtype=float)
    return line_contact_stress(x, depth, 1.0, 1.0, friction, traction_ratio=ratio, poisson_ratio=0.3)


def carter(x: float, ratio: float) -> float:
    """Carter's traction over p0, from the published formula (leading edge and stick zone at +1)."""
    d = math.sqrt(1.0 - abs(ratio) / MU)
    full = math.sqrt(1.0 - x * x)
    inner = 1.0 - ((x - 1.0 + d) / d) ** 2 if d > 0.0 else 0.0
    return math.copysign(MU, ratio) * (full - (d * math.sqrt(inner) if inner > 0.0 else 0.0))


@loads
def test_equilibrium_and_compatibility(ratio: float) -> None:
    """div sigma = 0 and Laplace(sigma_x + sigma_z) = 0, by central differences of fourth order."""
    h = 1e-3
    first = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / (12.0 * h)
    second = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / (12.0 * h * h)
    steps = h * np.arange(-2, 3)
    for x, z in PLACES:
        if z < 0.05:
            continue
        along, down = stress(x + steps, z, ratio), stress(x, z + steps, ratio)
        assert first @ along.sigma_x + first @ down.tau_xz == pytest.approx(0.0, abs=1e-6)
        assert first @ along.tau_xz + first @ down.sigma_z == pytest.approx(0.0, abs=1e-6)
        laplace = second @ (along.sigma_x + along.sigma_z) + second @ (down.sigma_x + down.sigma_z)
        assert laplace == pytest.approx(0.0, abs=2e-4)
        # the differences are not small by themselves
        assert max(abs(first @ along.sigma_x), abs(first @ down.sigma_x)) > 1e-3


@loads
def test_surface_carries_pressure_and_traction_and_nothing_outside(ratio: float) -> None:
    x = np.array([-3.0, -1.0 - 1e-12, -1.0, -0.7, 0.0, 0.3, 0.999, 1.0, 1.0 + 1e-12, 2.0])
    inside = np.abs(x) <= 1.0
    field = stress(x, 0.0, ratio)
    pressure = np.where(inside, np.sqrt(np.maximum(1.0 - x * x, 0.0)), 0.0)
    traction = [carter(place, ratio) if here else 0.0 for place, here in zip(x, inside, strict=True)]
    # a traction of square root form gives a millionth of rounding where the places are 1e-12 from an edge
    np.testing.assert_allclose(field.sigma_z, -pressure, rtol=0.0, atol=2e-8)
    np.testing.assert_allclose(field.tau_xz, np.negative(traction), rtol=0.0, atol=2e-8)
    np.testing.assert_allclose(field.sigma_y, 0.3 * (field.sigma_x + field.sigma_z), rtol=1e-15)
    # and the stresses are continuous down to the surface
    near = stress(x, 1e-14, ratio)
    for name in ("sigma_x", "sigma_z", "tau_xz"):
        np.testing.assert_allclose(getattr(near, name), getattr(field, name), rtol=0.0, atol=1e-6)


def test_a_driving_wheel_is_compressed_in_front_and_pulled_behind() -> None:
    """Equation 3.10, corrected: sigma_x = -p - 2 mu p0 x/a at the surface."""
    x = np.linspace(-1.0, 1.0, 11)
    field = line_contact_stress(x * A, 0.0, A, P0, MU)
    np.testing.assert_allclose(field.sigma_x, -P0 * np.sqrt(1.0 - x**2) - 2.0 * MU * P0 * x, rtol=1e-12)
    assert field.tau_xz[5] == pytest.approx(-MU * P0)


@loads
def test_equals_line_forces_added_up(ratio: float) -> None:
    """Flamant's line forces (Johnson, equations 2.23) integrated over pressure and Carter's traction."""
    edge = 1.0 - 2.0 * math.sqrt(1.0 - abs(ratio) / MU)  # of stick and slip

    for x, z in PLACES:
        if z < 0.02:
            continue
        field = stress(x, z, ratio)

        def added(i: int, x: float = x, z: float = z) -> float:
            """-2/pi times the integral of (p X^i z^(3-i) + q X^(i+1) z^(2-i))/r^4, X = x - s."""

            def load(angle: float) -> float:
                s = math.sin(angle)
                force = math.sqrt(1.0 - s * s) * z + carter(s, ratio) * (x - s)
                r4 = ((x - s) ** 2 + z * z) ** 2
                return -2.0 / math.pi * force * (x - s) ** i * z ** (2 - i) / r4 * math.cos(angle)

            breaks = [math.asin(edge), math.asin(max(min(x, 1.0), -1.0))]
            return quad(load, -0.5 * math.pi, 0.5 * math.pi, points=breaks, limit=200, epsabs=1e-11)[0]

        assert field.sigma_x == pytest.approx(added(2), abs=1e-8)
        assert field.sigma_z == pytest.approx(added(0), abs=1e-8)
        assert field.tau_xz == pytest.approx(added(1), abs=1e-8)


@loads
@pytest.mark.parametrize("depth", [0.0, 0.02, 0.5, 4.0])
def test_every_depth_carries_the_forces(ratio: float, depth: float) -> None:
    """P = pi a p0/2 and Q = ratio P over every plane."""
    reach = math.pi / 2.0
    scale = max(depth, 1.0)

    def over(name: str) -> float:
        def integrand(angle: float) -> float:
            return (
                float(getattr(stress(scale * math.tan(angle), depth, ratio), name))
                * scale
                / math.cos(angle) ** 2
            )

        at = sorted({math.atan(s / scale) for s in (-1.0, 1.0, 1.0 - 2.0 * math.sqrt(1.0 - abs(ratio) / MU))})
        return quad(integrand, -reach, reach, points=at, limit=200, epsabs=1e-9)[0]

    assert over("sigma_z") == pytest.approx(-0.5 * math.pi, abs=1e-7)
    assert over("tau_xz") == pytest.approx(-0.5 * math.pi * ratio, abs=1e-7)


@loads
def test_far_away_only_the_forces_count(ratio: float) -> None:
    """sigma_r = -2 (P cos + Q sin)/(pi r) (Flamant), sigma_theta = tau_r_theta = 0, angle from the depth."""
    normal, tangential = 0.5 * math.pi, 0.5 * math.pi * ratio
    r = 1e6
    for angle in np.radians([-90.0, -60.0, 0.0, 20.0, 75.0, 90.0]):
        sine, cosine = math.sin(angle), max(math.cos(angle), 0.0)
        radial = -2.0 / (math.pi * r) * (normal * cosine + tangential * sine)
        field = stress(r * sine, r * cosine, ratio)
        for value, share in (
            (field.sigma_x, sine**2),
            (field.sigma_z, cosine**2),
            (field.tau_xz, sine * cosine),
        ):
            assert value == pytest.approx(radial * share, abs=5e-6 / r)


@given(st.floats(-8.0, 8.0), st.floats(1e-6, 8.0), st.floats(-0.6, 0.6))
def test_printed_equations(x: float, z: float, traction: float) -> None:
    """Equations 3.5-3.8 as printed, with x and q of the thesis turned round."""
    middle = 1.0 - x * x + z * z
    root = math.hypot(middle, 2.0 * x * z)
    m = math.sqrt(0.5 * (root + middle))
    n = math.copysign(math.sqrt(max(0.5 * (root - middle), 0.0)), -x)
    if m * m + n * n < 1e-6 or min(m, abs(n)) < 1e-4:  # their rounding there exceeds the tolerance
        return
    square = m * m + n * n
    x_p = -(m * (1.0 + (z * z + n * n) / square) - 2.0 * z)
    z_p = -m * (1.0 - (z * z + n * n) / square)
    xz_p = -n * (m * m - z * z) / square
    x_q = n * (2.0 - (z * z - m * m) / square) - 2.0 * -x
    friction = abs(traction)
    field = stress(x, z, traction, friction)
    assert field.sigma_x == pytest.approx(x_p - traction * x_q, abs=1e-9)
    assert field.sigma_z == pytest.approx(z_p - traction * xz_p, abs=1e-9)
    assert -field.tau_xz == pytest.approx(xz_p - traction * x_p, abs=1e-9)


@pytest.mark.parametrize("slip", [0.1, 0.36, 0.8])
def test_johnsons_points_of_partial_slip(slip: float) -> None:
    """Equation 3.13: sigma_x at the leading edge, at the border of stick and slip, and at the trailing edge.

    The thesis's leading edge is x = -a and its traction points to the trailing edge: here Q < 0.
    """
    d = 1.0 - slip
    field = stress([1.0, 1.0 - 2.0 * d, -1.0], 0.0, -MU * (1.0 - d * d))
    pressure = np.sqrt(np.maximum(1.0 - np.array([1.0, 1.0 - 2.0 * d, 1.0]) ** 2, 0.0))
    expected = np.array([2.0 * slip, 2.0 * slip, 2.0 * slip - 4.0 * math.sqrt(slip)])
    np.testing.assert_allclose((field.sigma_x + pressure) / MU, expected, atol=1e-7)
    assert -field.tau_xz[1] / MU == pytest.approx(-2.0 * math.sqrt(slip * (1.0 - slip)))


def largest_shear(friction: float, least_depth: float = 0.0) -> tuple[float, float, float]:
    """Largest principal shear stress over p0, with its place, from a grid and then by optimisation."""
    x, z = np.meshgrid(np.linspace(-1.5, 1.5, 151), np.linspace(least_depth, 1.5, 151))
    shear = stress(x, z, friction, friction).principal_shear
    best = np.unravel_index(np.argmax(shear), shear.shape)
    found = minimize(
        lambda at: -float(stress(at[0], at[1], friction, friction).principal_shear),
        (x[best], z[best]), bounds=((-1.5, 1.5), (least_depth, 1.5)), method="Nelder-Mead",
        options={"xatol": 1e-7, "fatol": 1e-12},
    )  # fmt: skip
    return -found.fun, found.x[0], found.x[1]


def test_maximum_without_friction() -> None:
    """0.300 p0 at a depth of 0.78 a (Johnson, 1985, section 4.2)."""
    shear, x, depth = largest_shear(0.0)
    assert shear == pytest.approx(0.300, abs=5e-4)
    assert depth == pytest.approx(0.78, abs=7e-3)
    assert x == pytest.approx(0.0, abs=1e-4)


@pytest.mark.parametrize("row", LIMITS, ids=[f"mu {row['friction']}" for row in LIMITS])
def test_published_limits(row: dict[str, str]) -> None:
    """Elastic limit and both shakedown limits: the smallest circle around all ((sx - sz)/2, tau_xz).

    Its centre is the origin (elastic), on the axis (perfectly plastic), or free (kinematic hardening).
    """
    friction = float(row["friction"])
    x, z = np.meshgrid(np.linspace(-4.0, 4.0, 801), np.append(0.0, np.geomspace(1e-3, 4.0, 150)))
    field = stress(x, z, friction, friction)
    across, up = 0.5 * (field.sigma_x - field.sigma_z), field.tau_xz

    def smallest(free: int) -> float:
        """Radius of the smallest circle whose centre has so many free coordinates."""
        centre = np.zeros(2)

        def radius(moved: np.ndarray) -> float:
            centre[:free] = moved
            return float(np.hypot(across - centre[0], up - centre[1]).max())

        start = np.full(free, 0.02)
        return minimize(radius, start, method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-8}).fun

    if row["elastic"]:
        assert 1.0 / largest_shear(friction)[0] == pytest.approx(float(row["elastic"]), abs=5e-3)
    if row["perfectly_plastic"]:
        assert 1.0 / smallest(1) == pytest.approx(float(row["perfectly_plastic"]), abs=2e-3)
    assert 1.0 / smallest(2) == pytest.approx(float(row["kinematic"]), abs=1e-2)


def test_maximum_reaches_the_surface_between_037_and_038() -> None:
    """The maximum below the surface falls behind the surface's own mu p0."""
    border = brentq(lambda mu: largest_shear(mu, least_depth=0.02)[0] - mu, 0.3, 0.45, xtol=1e-6)
    assert 0.37 < border < 0.38
    assert largest_shear(0.36)[2] > 0.1
    shear, _, depth = largest_shear(0.39)
    assert (shear, depth) == (pytest.approx(0.39, rel=1e-9), pytest.approx(0.0, abs=1e-9))


def test_partial_slip_is_worse_at_the_surface_than_full_slip_of_the_same_friction() -> None:
    """Figure 3-10: mu = 0.5, Q/P = 0.4."""
    x = np.linspace(-1.0, 1.0, 2001)
    partial = stress(x, 0.0, 0.4, 0.5).principal_shear.max()
    full = stress(x, 0.0, 0.5, 0.5).principal_shear.max()
    assert full == pytest.approx(0.5)
    assert partial > 1.05 * full


def test_limits_of_partial_slip() -> None:
    x, z = np.meshgrid(np.linspace(-2.0, 2.0, 21), np.linspace(0.0, 2.0, 11))
    for close, limit, friction in ((MU * (1.0 - 1e-12), MU, MU), (1e-12, 0.0, 0.0)):
        one, other = stress(x, z, close), stress(x, z, limit, friction)
        for name in ("sigma_x", "sigma_z", "tau_xz"):
            np.testing.assert_allclose(getattr(one, name), getattr(other, name), atol=2e-6)
    assert stick_half_length(A, MU, MU) == 0.0
    assert stick_half_length(A, MU, 0.0) == A
    assert stick_half_length(A, 0.0, 0.0) == A
    assert stick_half_length(A, 0.4, -0.3) == pytest.approx(0.5 * A)


@given(
    st.floats(-3.0, 3.0),
    st.floats(0.0, 3.0),
    st.floats(-0.35, 0.35),
    st.floats(1e-4, 10.0),
    st.floats(1.0, 3e9),
)
def test_scaling(x: float, z: float, ratio: float, size: float, pressure: float) -> None:
    one = stress(x, z, ratio)
    other = line_contact_stress(
        x * size, z * size, size, pressure, MU, traction_ratio=ratio, poisson_ratio=0.3
    )
    for name in ("sigma_x", "sigma_y", "sigma_z", "tau_xz", "principal_shear", "max_shear", "von_mises"):
        # at the edges stresses are continuous, with a square root: rounding of 1e-16 in x gives 1e-8
        assert getattr(other, name) == pytest.approx(pressure * getattr(one, name), abs=1e-6 * pressure)


def test_equivalent_stresses_are_those_of_the_tensor() -> None:
    """Against the eigenvalues of the full tensor."""
    generator = np.random.default_rng(3)
    x, z = generator.uniform(-2.0, 2.0, 50), generator.uniform(0.0, 2.0, 50)
    field = line_contact_stress(x, z, 1.0, 1.0, 0.3, traction_ratio=0.1, poisson_ratio=0.28)
    for i in range(50):
        tensor = np.diag([field.sigma_x[i], field.sigma_y[i], field.sigma_z[i]])
        tensor[0, 2] = tensor[2, 0] = field.tau_xz[i]
        low, middle, high = np.linalg.eigvalsh(tensor)
        in_plane = np.linalg.eigvalsh(tensor[np.ix_([0, 2], [0, 2])])
        assert field.principal_shear[i] == pytest.approx(0.5 * (in_plane[1] - in_plane[0]))
        assert field.max_shear[i] == pytest.approx(0.5 * (high - low))
        mises = math.sqrt(0.5 * ((high - middle) ** 2 + (middle - low) ** 2 + (high - low) ** 2))
        assert field.von_mises[i] == pytest.approx(mises)


def test_kernel_is_what_the_function_loops_over() -> None:
    field = line_contact_stress([[1e-3], [-4e-3]], [0.0, 2e-3, 5e-3], A, P0, MU, traction_ratio=-0.2)
    assert field.sigma_x.shape == (2, 3)
    d = stick_half_length(A, MU, -0.2)
    values = partial_slip_stress(-4e-3, 2e-3, A, P0, -MU * P0, d)
    assert values == pytest.approx((field.sigma_x[1, 1], field.sigma_z[1, 1], field.tau_xz[1, 1]), rel=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"half_length": 0.0}, "half_length = 0.0 m"),
        ({"max_pressure": math.inf}, "max_pressure = inf Pa"),
        ({"friction": -0.1}, "friction = -0.1"),
        ({"traction_ratio": 0.4}, r"traction_ratio = 0.4 \[-\]; it must lie in -0.3..0.3"),
        ({"traction_ratio": math.nan}, "traction_ratio = nan"),
        ({"poisson_ratio": 0.6}, "poisson_ratio = 0.6"),
        ({"depth": [-1e-3]}, "depth = -0.001 m"),
        ({"x": [math.nan]}, "must be finite"),
    ],
)
def test_bad_input_is_named(change: dict[str, object], message: str) -> None:
    good = {"x": [0.0], "depth": [0.0], "half_length": A, "max_pressure": P0, "friction": 0.3}
    with pytest.raises(ValueError, match=message):
        line_contact_stress(**(good | change))  # type: ignore[arg-type]
