"""Contact geometry against numbers from outside, as a table: EN 15302's benchmark, and cones.

The standard's results are files of ``hh_exudyn/data/validation``. Its wheels A, B, H, I and rail A are made
by others and stand in no package: who has the files names their folder. Without them the integration is
compared, from the standard's own radius differences.

The rail file departs from a smooth head by up to 0.07 mm at its gauge corner and by some micrometres on its
crown. So the radius difference of this nearly conformal pair (E1) moves in small jumps where the standard's
is smooth, the gauge point lies 0.02 mm from where the standard has it (1435.16 = 1500 - 2 x 32.42 mm), and
the last displacement before the tables end, on the flange, is off.
"""

import math
from pathlib import Path

import numpy as np

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.comparison import Comparison, outside_rows
from hh_exudyn.contact.functions import equivalent_conicity, rolling_radius_difference
from hh_exudyn.contact.geometry.conicity import conicity_from_radius_difference
from hh_exudyn.contact.profile import Profile, rail_profile, read_rail_profile, read_wheel_profile

CASES = {"E1": "A", "E2": "B", "E3": "H", "E4": "I"}  # wheels of the standard's cases
BENCHMARK = {"gauge": 1.43516, "tape_distance": 1.5, "radius_left": 0.46, "radius_right": 0.46}
_RADIUS_TOLERANCE = 0.05  # mm of radius difference
_FLANGE_TOLERANCE = 1.0  # mm, of the last displacement: contact angle 66 degrees
_INTEGRATION_TOLERANCE = 1e-3  # of conicity: the tables are linear over 0.1 mm, the standard's curve is not
_AT_JUMPS = {("E3", 2.5), ("E3", 2.6), ("E4", 1.8)}  # case, mm: a hundredth of a millimetre decides there
_SOURCE = "EN 15302, {}"
_NEARBY = np.arange(-10, 11) * 0.01  # mm, displacements about a row of the standard: jumps may lie there


def geometry_table(profiles: Path | None = None) -> list[Comparison]:
    """All comparisons; a second, with the standard's profiles some seconds.

    Parameters
    ----------
    profiles : Path or None
        Folder with the standard's profiles as RUIC519A.dat, RUIC519B.dat, RUIC519H.dat, RUIC519I.dat (wheels)
        and SUIC519A.dat (rail), two columns in mm; None leaves out what needs them.

    Raises
    ------
    ValueError, OSError
        A file is missing or is no profile.
    """
    rows = [*_cones(), *(_integration(case) for case in CASES)]
    if profiles is not None:
        for case in CASES:
            wheel, rail = standard_pair(profiles, case)
            rows += [*radius_difference_rows(case, wheel, rail), *conicity_rows(case, wheel, rail)]
    return rows


def standard_pair(folder: Path, case: str) -> tuple[Profile, Profile]:
    """Wheel and rail of a case from the folder of the standard's files.

    Parameters
    ----------
    folder : Path
        As for `geometry_table`.
    case : str
        One of `CASES`.
    """
    wheel = read_wheel_profile(folder / f"RUIC519{CASES[case]}.dat")
    return wheel, read_rail_profile(folder / "SUIC519A.dat")


def benchmark_columns(name: str, case: str) -> FloatArray:
    """(columns, rows) of numbers of one case in a file of the benchmark, without case and wheel."""
    rows = [row for row in outside_rows(name) if row["case"] == case]
    return np.array([[float(word) for word in list(row.values())[2:]] for row in rows]).T


def radius_difference_rows(case: str, wheel: Profile, rail: Profile) -> list[Comparison]:
    """Rolling radius difference against the standard's: worst and median deviation over their tolerance.

    A row of the standard is compared with what displacements within 0.1 mm give.

    Parameters
    ----------
    case : str
        One of `CASES`.
    wheel, rail : Profile
        Of both sides.
    """
    lateral, expected = benchmark_columns("en15302_radius_difference.csv", case)
    around = (lateral[:, None] + _NEARBY).ravel() * 1e-3
    found = rolling_radius_difference(wheel, rail, wheel, rail, lateral=around, **BENCHMARK)
    nearby = 1e3 * found.reshape(len(lateral), -1)
    off = np.maximum(np.maximum(nearby.min(axis=1) - expected, expected - nearby.max(axis=1)), 0.0)
    last = np.abs(lateral) == np.abs(lateral).max()
    middle = float(np.median(np.abs(nearby[:, len(_NEARBY) // 2] - expected)))
    source = _SOURCE.format(case)
    return [
        _share(f"radius difference, worst over {_RADIUS_TOLERANCE:g} mm", source,
               float(off[~last].max()) / _RADIUS_TOLERANCE),
        _share(f"– on the flange, over {_FLANGE_TOLERANCE:g} mm", source,
               float(off[last].max()) / _FLANGE_TOLERANCE),
        _share("– median, over 0.03 mm", source, middle / 0.03),
    ]  # fmt: skip


def conicity_rows(case: str, wheel: Profile, rail: Profile) -> list[Comparison]:
    """Equivalent conicity against the standard's: worst share of its tolerance, wide and narrow.

    Parameters
    ----------
    case : str
        One of `CASES`.
    wheel, rail : Profile
        Of both sides.
    """
    amplitude, expected, upper, lower, wide_upper, wide_lower = benchmark_columns(
        "en15302_conicity.csv", case
    )
    found = equivalent_conicity(wheel, rail, wheel, rail, amplitudes=amplitude * 1e-3, **BENCHMARK)
    source = _SOURCE.format(case)

    def share(high: FloatArray, low: FloatArray) -> FloatArray:
        return np.asarray(np.abs(found - 0.5 * (high + low)) / (0.5 * (high - low)))

    narrow = np.array([(case, round(float(a), 1)) not in _AT_JUMPS for a in amplitude])
    at = int(np.argmin(np.abs(amplitude - 3.0)))
    return [
        Comparison(
            "conicity at 3 mm, within its limits", source, float(found[at]), float(expected[at]),
            float(0.5 * (upper - lower)[at] / expected[at]),
        ),
        _share(f"conicity, worst of {amplitude.size}, over wide limits", source,
               float(share(wide_upper, wide_lower).max())),
        _share(f"– of {narrow.sum()} off the jumps, over limits", source,
               float(share(upper, lower)[narrow].max())),
    ]  # fmt: skip


def _share(quantity: str, source: str, share: float) -> Comparison:
    """A worst deviation over its tolerance, allowed up to 1; NaN does not hold.

    Rounded: a conicity of 0 lies at its limit of 0, where the share is 1 but for the last digit.
    """
    return Comparison(quantity, source, round(share, 9), 0.0, 1.0)


def _integration(case: str) -> Comparison:
    """The integration alone: conicities from the standard's own radius differences."""
    lateral, delta_r = benchmark_columns("en15302_radius_difference.csv", case) * 1e-3
    amplitude, expected = benchmark_columns("en15302_conicity.csv", case)[:2]
    inside = amplitude * 1e-3 <= lateral.max()
    found = conicity_from_radius_difference(
        lateral, delta_r, radius=BENCHMARK["radius_left"], tape_distance=BENCHMARK["tape_distance"],
        amplitudes=amplitude[inside] * 1e-3,
    )  # fmt: skip
    worst = float(np.abs(found - expected[inside]).max())
    return _share(
        f"conicity from the standard's radii, over {_INTEGRATION_TOLERANCE:g}", _SOURCE.format(case),
        worst / _INTEGRATION_TOLERANCE,
    )  # fmt: skip


def cone(slope: float) -> Profile:
    """A conical tread with a flange at 60 degrees that begins at y = 40 mm.

    Parameters
    ----------
    slope : float
        Of the tread [-].
    """
    y = np.linspace(-0.06, 0.06, 601)
    return Profile("cone", "wheel", y, -slope * y - math.tan(math.radians(60.0)) * np.maximum(y - 0.04, 0.0))


def _cones() -> list[Comparison]:
    """Cones on a rail: twice the slope per displacement, and the slope as conicity."""
    slope, at = 0.05, 3e-3
    wheel, rail = cone(slope), rail_profile("60E1", 1.0 / 30.0)
    source = "Klingel 1883, cones"
    difference = rolling_radius_difference(wheel, rail, wheel, rail, lateral=np.array([at]), **BENCHMARK)
    conicity = equivalent_conicity(wheel, rail, wheel, rail, amplitudes=np.array([at]), **BENCHMARK)
    return [
        Comparison("radius difference at 3 mm [m]", source, float(difference[0]), 2.0 * slope * at, 1e-4),
        Comparison("conicity at 3 mm", source, float(conicity[0]), slope, 1e-5),
    ]  # fmt: skip
