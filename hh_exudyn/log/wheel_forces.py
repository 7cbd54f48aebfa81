"""Q and Y of every wheel of a run over time, from its contact log; filtered, and as spectra.

Forces of measuring wheelsets and track-side stations are filtered: Hossein-Nia (2018, section 1.2.1) filters
measured and calculated forces at 20 Hz. The filter is that of `hh_exudyn.signals`: no shift in time,
-3 dB at the cut-off.
"""

from dataclasses import dataclass, replace

import numpy as np
from scipy.signal import welch

from hh_exudyn.arrays import FloatArray
from hh_exudyn.log.store import Run
from hh_exudyn.signals import low_pass

_POSSIBLE = {  # columns: least and largest value, unit; beyond them it is no wheel on a rail
    "time": (0.0, 1e7, " s"),
    "s": (-1e6, 1e8, " m"),
    "vehicle": (1, 1000, ""),
    "wheelset": (1, 64, ""),
    "side": (-1, 1, ""),
    "patch": (0, 64, ""),
    "Q": (-1e7, 1e7, " N"),
    "Y": (-1e7, 1e7, " N"),
}
_WHOLE = ("vehicle", "wheelset", "side", "patch")
_COLUMNS = tuple(_POSSIBLE)


@dataclass(frozen=True, eq=False)
class WheelForces:
    """Forces of the wheels of one vehicle on the rails, at equal intervals of time.

    Attributes
    ----------
    time : (n,) array
        [s].
    s : (n, wheelsets) array
        Arc length of each wheelset along the track [m].
    Q, Y : (n, wheelsets, 2) arrays
        Vertical force, and lateral force outwards, of the left and the right wheel [N]; zero off the rail.
    """

    time: FloatArray
    s: FloatArray
    Q: FloatArray
    Y: FloatArray

    @property
    def interval(self) -> float:
        """Time from one value to the next [s]."""
        return float(self.time[-1] - self.time[0]) / (self.time.size - 1)

    def between(self, first: float, last: float) -> "WheelForces":
        """The times at which all wheelsets lie between two arc lengths [m].

        Raises ValueError where they do so less than twice.

        Parameters
        ----------
        first, last
            Arc lengths [m].
        """
        inside = ((self.s >= first) & (self.s <= last)).all(axis=1)
        if inside.sum() < 2:
            raise ValueError(
                f"all wheelsets never lie between s = {first:g} and {last:g} m: the run has them from "
                f"{self.s.min():.1f} to {self.s.max():.1f} m"
            )
        return replace(self, time=self.time[inside], s=self.s[inside], Q=self.Q[inside], Y=self.Y[inside])

    def filtered(self, cutoff: float) -> "WheelForces":
        """The forces below a cut-off frequency [Hz], where the amplitude is reduced to 1 / sqrt(2).

        Raises ValueError unless the frequency is above 0 and below half the sampling rate.
        """
        Q, Y = (low_pass(force, self.interval, cutoff) for force in (self.Q, self.Y))
        return replace(self, Q=Q, Y=Y)

    def spectrum(self, force: str, segment: float = 4.0) -> tuple[FloatArray, FloatArray]:
        """Power spectral density of a force, by the method of Welch (1967): Hann windows that half overlap.

        Parameters
        ----------
        force : str
            "Q" or "Y".
        segment : float
            Length of a window [s]; the lines of the spectrum are its inverse apart.

        Returns
        -------
        frequency : (m,) array
            [Hz].
        density : (m, wheelsets, 2) array
            One-sided [N^2/Hz]; its integral is the variance.

        Raises
        ------
        ValueError
            Another force; a segment longer than the run, or of fewer than 8 values.
        """
        if force not in ("Q", "Y"):
            raise ValueError(f'force is {force!r}, allowed are "Q" and "Y"')
        count = round(segment / self.interval)
        if not 8 <= count <= self.time.size:
            raise ValueError(
                f"segment is {segment} s, allowed are {8 * self.interval:g} to "
                f"{self.time.size * self.interval:g} s"
            )
        frequency, density = welch(
            getattr(self, force), fs=1.0 / self.interval, nperseg=count, detrend="constant", axis=0
        )
        return frequency, density


def wheel_forces(run: Run, vehicle: int = 1) -> WheelForces:
    """Q and Y of all wheels of a vehicle over a whole run.

    Parameters
    ----------
    run
        On disk.
    vehicle
        Its number in the run, from 1.

    Raises
    ------
    FileNotFoundError, ValueError
        The run has no contact log; fewer than two output times; no such vehicle; values that are not finite
        or of no wheel, or a wheel with two rows at one time.
    """
    table = run.read("contact", _COLUMNS)
    rows = {name: np.asarray(table[name], dtype=np.float64) for name in _COLUMNS}
    _require_possible(run, rows)
    mine = (rows["vehicle"] == vehicle) & (rows["patch"] == 0)
    if not mine.any():
        known = sorted({int(number) for number in rows["vehicle"]})
        raise ValueError(f"{run.directory}: vehicle {vehicle} is not in the contact log; it has {known}")
    time = np.unique(rows["time"])
    if time.size < 2:
        raise ValueError(f"{run.directory}: the contact log has one output time, at least 2 are needed")
    at = np.searchsorted(time, rows["time"][mine])
    wheelset = rows["wheelset"][mine].astype(int) - 1
    side = (rows["side"][mine] < 0).astype(int)
    shape = (time.size, int(wheelset.max()) + 1, 2)
    wheels = np.column_stack([at, wheelset, side])
    if len(np.unique(wheels, axis=0)) < len(wheels):
        _, count = np.unique(wheels, axis=0, return_counts=True)
        raise ValueError(
            f"{run.directory}: contact log: {int(count.sum() - count.size)} rows are there twice: a wheel "
            "has one row at an output time"
        )
    forces = {}
    for name in ("Q", "Y"):
        forces[name] = np.zeros(shape)
        forces[name][at, wheelset, side] = rows[name][mine]
    s = np.empty(shape[:2])
    for number in range(shape[1]):  # a wheelset with both wheels in the air has no row: in between
        own = wheelset == number
        s[:, number] = np.interp(time, rows["time"][mine][own], rows["s"][mine][own])
    return WheelForces(time, s, forces["Q"], forces["Y"])


def _require_possible(run: Run, rows: dict[str, FloatArray]) -> None:
    """Raise ValueError for the first value that no wheel can have."""
    for name, values in rows.items():
        low, high, unit = _POSSIBLE[name]
        wrong = ~((values >= low) & (values <= high))  # NaN too
        if name in _WHOLE:
            wrong |= values != np.rint(values)
        if wrong.any():
            first = int(np.argmax(wrong))
            raise ValueError(
                f"{run.directory}: contact log: {name} = {values[first]:g}{unit} at time = "
                f"{rows['time'][first]:g} s: allowed {low:g} to {high:g}{unit} ({int(wrong.sum())} such rows)"
            )
