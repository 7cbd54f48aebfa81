"""A wheelset that nothing guides, and cones for it: Klingel's motion."""

from pathlib import Path

import numpy as np

from vehicles.description import Body, Coupler, Vehicle, Wheelset

CONICITY, RADIUS = 0.05, 0.46  # [-], m


def free_wheelset() -> Vehicle:
    """A wheelset pulled at its axle's middle: nothing holds it laterally or in yaw."""
    body = Body("wheelset_1", "wheelset", 2000.0, (1000.0, 120.0, 1000.0), (0.0, 0.0, RADIUS))
    train = Coupler(("wheelset_1",) * 2, ((0.0, 0.0, RADIUS), (0.0, 0.0, RADIUS)), stiffness=2e4, damping=1e4)
    return Vehicle("free_wheelset", (body,), (), (Wheelset("wheelset_1", 1, RADIUS),), train, {})


def conical_wheel(path: Path, slope: float = CONICITY) -> str:
    """Write a cone that bends over 12 mm into a 70 degree flange, two columns in mm; its path as text.

    Parameters
    ----------
    path : of the new file
    slope : of the cone [-]
    """
    y = np.arange(-60.0, 45.0, 0.1)
    bend = np.clip((y - 28.0) / 12.0, 0.0, 1.0)
    slopes = slope + (np.tan(np.radians(70.0)) - slope) * bend**2 * (3.0 - 2.0 * bend)
    z = -np.concatenate([[0.0], np.cumsum((slopes[1:] + slopes[:-1]) / 2.0 * np.diff(y))])
    np.savetxt(path, np.column_stack([y, z - np.interp(0.0, y, z)]), fmt="%.6f")
    return str(path)
