"""Wall time of evaluations: calibrated on what has run, for time left, timeouts and other numbers of cores.

The size of a task is a guess of its wall time from its steps and wheelsets; the model multiplies it with the
median of the ratios of measured times to sizes. The median does not mind the first cases of every worker,
which compile, nor one that waited for a slow disk.
"""

import heapq
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from statistics import median

from damage.bounds import check_above_zero


@dataclass(frozen=True)
class Prediction:
    """A campaign on a number of cores.

    Attributes
    ----------
    cores
        Number of workers.
    wall
        Expected time [s].
    speedup
        Over one worker [-].
    bound
        What keeps it from being faster: "cores", "longest case" or "main process".
    """

    cores: int
    wall: float
    speedup: float
    bound: str

    @property
    def efficiency(self) -> float:
        """Speed-up over cores [-]."""
        return self.speedup / self.cores

    def words(self) -> str:
        """In a line."""
        return (
            f"{self.cores} cores: {self.wall / 3600.0:.2f} h, {self.speedup:.1f} times one core "
            f"({self.efficiency:.0%}), bound by the {self.bound}"
        )


@dataclass
class CostModel:
    """Expected wall times.

    Attributes
    ----------
    factor
        Of the expected time, after which an evaluation counts as hung [-].
    least_timeout
        No evaluation counts as hung earlier [s]: the first ones compile kernels for some minutes.
    ratios
        Measured wall times over sizes [-].
    """

    factor: float = 10.0
    least_timeout: float = 1200.0
    ratios: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        check_above_zero("factor", self.factor, "-", "the cost model")
        check_above_zero("least_timeout", self.least_timeout, "s", "the cost model")

    def learn(self, size: float, wall: float) -> None:
        """Take in an evaluation of that size that took that long [s]."""
        if size > 0.0 and wall > 0.0:
            self.ratios.append(wall / size)

    @property
    def ratio(self) -> float:
        """Wall time over size [-]; 1 before anything has run."""
        return median(self.ratios) if self.ratios else 1.0

    def wall(self, size: float) -> float:
        """Expected wall time of an evaluation of that size [s]."""
        return self.ratio * size

    def timeout(self, size: float) -> float:
        """Wall time after which an evaluation of that size counts as hung [s]."""
        return max(self.least_timeout, self.factor * self.wall(size))

    def left(self, sizes: Iterable[float], running: Iterable[tuple[float, float]], cores: int) -> float:
        """Expected time until all is done [s].

        Parameters
        ----------
        sizes
            Of what has not begun.
        running
            Size of what runs, and how long it has [s].
        cores
            Number of workers.
        """
        rest = [max(self.wall(size) - elapsed, 0.0) for size, elapsed in running]
        return longest_share([*sorted(rest, reverse=True), *self._longest_first(sizes)], cores)

    def predicted(self, sizes: Iterable[float], cores: int, serial: float = 0.0) -> float:
        """Wall time of a campaign on a number of cores [s]: the busiest core's, or the main process's.

        Parameters
        ----------
        sizes
            Of all evaluations.
        cores
            Number of workers, each as fast as those that the model has learned from.
        serial
            Time of the main process per result [s]: it is one, and bounds the speed of all.
        """
        walls = self._longest_first(sizes)
        return max(longest_share(walls, cores), serial * len(walls))

    def scaling(
        self, sizes: Sequence[float], cores: Iterable[int], evaluations: int = 1, serial: float = 0.0
    ) -> tuple[Prediction, ...]:
        """A loop of evaluations, each of which waits for the one before, on several numbers of cores.

        Parameters
        ----------
        sizes
            Of the cases of one evaluation.
        cores
            Numbers of workers, each as fast as those that the model has learned from.
        evaluations
            Number of evaluations, one after the other.
        serial
            As `predicted`.
        """
        alone = self.predicted(sizes, 1, serial)
        longest, main = max(map(self.wall, sizes), default=0.0), serial * len(sizes)
        found = []
        for count in cores:
            wall = self.predicted(sizes, count, serial)
            bound = "main process" if wall <= main else "longest case" if wall <= longest else "cores"
            speedup = alone / wall if wall > 0.0 else 1.0
            found.append(Prediction(count, evaluations * wall, speedup, bound))
        return tuple(found)

    def _longest_first(self, sizes: Iterable[float]) -> list[float]:
        return sorted(map(self.wall, sizes), reverse=True)


def longest_share(walls: Sequence[float], cores: int) -> float:
    """Work of the busiest core where each takes the next piece when it is free [s].

    Longest first it is at most 4/3 of the best possible (R. L. Graham, Bounds on multiprocessing timing
    anomalies, SIAM J. Appl. Math. 17 (1969) 416-429).

    Parameters
    ----------
    walls
        Of the pieces, in the order in which they are taken [s].
    cores
        Number of cores, >= 1.
    """
    if cores < 1:
        raise ValueError(f"cores = {cores}, allowed from 1")
    busy = [0.0] * min(cores, max(len(walls), 1))
    for wall in walls:
        heapq.heappush(busy, heapq.heappop(busy) + wall)
    return max(busy)
