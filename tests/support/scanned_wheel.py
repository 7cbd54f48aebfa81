"""Profiles as a measuring device scans them, and a worn wheel of our own making: known shapes under noise."""

from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from hh_exudyn.arrays import FloatArray
from hh_exudyn.contact.profile import Profile, wheel_profile
from hh_exudyn.contact.profiles.cleaning import arc_length

SPACING = 0.25e-3  # m, of MiniProf points
NOISE = 5e-6  # m, rms of a good scan
HOLLOW, WIDTH = 1.5e-3, 30e-3  # m, depth of wear at the running circle; from there to where 1/e of it is left


def scanned(profile: Profile, sigma: float, seed: int) -> tuple[FloatArray, FloatArray]:
    """A profile scanned along its arc length, with white noise of rms `sigma` in both directions [m]."""
    s = arc_length(profile.y, profile.z)
    at = np.arange(0.0, s[-1], SPACING)
    noise = np.random.default_rng(seed).normal(0.0, sigma, (2, at.size))
    return CubicSpline(s, profile.y)(at) + noise[0], CubicSpline(s, profile.z)(at) + noise[1]


def hollow_wheel() -> Profile:
    """S1002 whose tread is worn in a bell, by 1.5 mm at the running circle; its flange tip is nearly new.

    The bell's radius of curvature there is a rail crown's, 300 mm: as closely as a wheel wears into its rail.
    """
    wheel = wheel_profile("S1002")
    return Profile(
        "hollow S1002", "wheel", wheel.y, wheel.z + HOLLOW * (np.exp(-((wheel.y / WIDTH) ** 2)) - 1.0)
    )


def scan_of_hollow_wheel(path: Path) -> Path:
    """A MiniProf file of `hollow_wheel` with the noise of a scan; its path."""
    y, z = scanned(hollow_wheel(), NOISE, seed=3)
    table = "".join(f"{1e3 * a:.4f} {1e3 * b:.4f}\n" for a, b in zip(y, z, strict=True))
    path.write_text(f"ProgramName=TEST\nColumnDef=X,Y\nXYPoints={y.size}\n\n{table}")
    return path
