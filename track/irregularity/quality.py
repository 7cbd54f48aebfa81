"""Track quality after UIC 518: standard deviations of level and alignment by section, and their classes.

Level and alignment are filtered to wavelengths of 3 to 25 m (D1) and their standard deviations taken over
sections of 100 m (the thesis; UIC 518 also has 250 m and 500 m by kind of line). Limits QN1 and QN2 by speed
are Table 1-4 of S. Hossein-Nia's thesis, in `data/quality.toml`; his Tables 1-5 and 1-6 are data of the line,
`data/malmbanan.toml`. A section has the worse of the classes of its two signals:

=======  ==================  ==================================================
`QN1`    sigma <= QN1        good track
`QN2`    QN1 < sigma <= QN2  maintenance as regularly planned
`QN3`    QN2 < sigma <= QN3  maintenance soon
`>QN3`   sigma > QN3         left out of the analysis of acceptance tests
=======  ==================  ==================================================

QN3 = 1.3 QN2 is unconfirmed: the thesis does not give it for standard deviations. Neither does it say which
filter its Tables 1-5 and 1-6 rest on; 3 to 25 m is the band of UIC 518.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hh_exudyn.arrays import FloatArray
from hh_exudyn.sourced import load_parameters
from track.irregularity.irregularity import Irregularity
from track.irregularity.wavelength_bands import D1

CLASSES = ("QN1", "QN2", "QN3", ">QN3")
SECTION_LENGTH = 100.0  # m, the thesis's

_SECTION = (25.0, 1000.0)  # m
_KM_H = 1.0 / 3.6  # m/s


def quality_limits(speed: float) -> FloatArray:
    """QN1, QN2 and QN3 [m] of level (row 0) and alignment (row 1) for a speed [m/s], Table 1-4.

    Raises ValueError unless the speed is above 0 and up to 300 km/h.
    """
    data = load_parameters("track", "quality")
    rows = [data.table("limits").table(name) for name in data.table("limits").tables]
    speed_km_h = speed / _KM_H
    if speed > 0.0:
        for row in rows:
            if speed_km_h <= row["speed"] * (1.0 + 1e-12):  # 80 km/h in m/s and back is 80 km/h
                qn1_qn2 = 1e-3 * np.array([row.row("level"), row.row("alignment")])
                return np.hstack([qn1_qn2, data["qn3.factor"] * qn1_qn2[:, 1:]])
    highest = rows[-1]["speed"] * _KM_H
    raise ValueError(f"speed is {speed} m/s, allowed are above 0 to {highest:g} m/s")


@dataclass(frozen=True, eq=False)
class TrackQuality:
    """Quality of consecutive sections of a track.

    Attributes
    ----------
    start : (n,) array
        Arc length where each section begins [m].
    section_length : float
        [m].
    deviations : (n, 2) array
        Standard deviations of level and alignment [m].
    classes : (n,) array of int
        Index into `CLASSES`.
    """

    start: FloatArray
    section_length: float
    deviations: FloatArray
    classes: NDArray[np.int64]

    def distribution(self) -> dict[str, float]:
        """Share of sections in each class, as Table 1-5; they sum to 1."""
        return _shares(self.classes)

    def distribution_by(self, groups: Sequence[str]) -> dict[str, dict[str, float]]:
        """Shares by group of sections, as Table 1-6: a name for every section, such as its curve class.

        Raises ValueError unless there is one name for every section.
        """
        if len(groups) != len(self.classes):
            raise ValueError(f"groups has {len(groups)} names, there are {len(self.classes)} sections")
        names = np.array(groups)
        return {str(name): _shares(self.classes[names == name]) for name in dict.fromkeys(groups)}

    def unmet(self) -> tuple[str, ...]:
        """Classes in shares that UIC 518 does not recommend: QN1 > 50 %, QN2 < 40 %, QN3 < 10 %, no worse."""
        share = self.distribution()
        met = {
            "QN1": share["QN1"] > 0.5,
            "QN2": share["QN2"] < 0.4,
            "QN3": share["QN3"] < 0.1,
            ">QN3": share[">QN3"] == 0.0,
        }
        return tuple(name for name in CLASSES if not met[name])


def _shares(classes: NDArray[np.int64]) -> dict[str, float]:
    """Share of each class."""
    counts = np.bincount(classes, minlength=len(CLASSES))
    return {name: float(count) / len(classes) for name, count in zip(CLASSES, counts, strict=True)}


def quality_class(deviations: FloatArray, speed: float) -> NDArray[np.int64]:
    """Class (index into `CLASSES`) of sections from their deviations (n, 2) of level and alignment [m].

    Raises ValueError for a speed out of range, deviations of another shape, negative or NaN.

    Parameters
    ----------
    deviations : (n, 2) array
        Standard deviations of level and alignment [m], >= 0.
    speed : float
        [m/s], up to 300 km/h.
    """
    if deviations.ndim != 2 or deviations.shape[1] != 2:
        raise ValueError(f"deviations has shape {deviations.shape}, it must be (n, 2)")
    if not np.all(deviations >= 0.0):
        raise ValueError(f"deviations has {np.min(deviations)} m, all must be 0 or more")
    limits = quality_limits(speed)
    exceeded = deviations[:, :, np.newaxis] > limits
    worst: NDArray[np.int64] = exceeded.sum(axis=2).max(axis=1)
    return worst


def track_quality(track: Irregularity, speed: float, section_length: float = SECTION_LENGTH) -> TrackQuality:
    """Quality of a track at a speed, section by section from its start.

    Parameters
    ----------
    track : Irregularity
        At least as long as a section; the remainder after the last whole section is omitted.
    speed : float
        [m/s], up to 300 km/h.
    section_length : float
        [m], 25 to 1000.

    Raises
    ------
    ValueError
        Speed or section length out of range, or a track that is too short or too coarse for the filter.
    """
    if not _SECTION[0] <= section_length <= _SECTION[1]:
        raise ValueError(
            f"section_length is {section_length} m, allowed are {_SECTION[0]:g} to {_SECTION[1]:g} m"
        )
    count = int(track.length / section_length + 1e-9)
    if count == 0:
        raise ValueError(f"the track is {track.length:g} m long, a section is {section_length:g} m")
    filtered = track.filtered(D1)
    edges = np.ceil(section_length * np.arange(count + 1) / track.step - 1e-9).astype(int)
    both = np.column_stack([filtered.signal("level"), filtered.signal("alignment")])
    deviations: FloatArray = np.array([both[edges[i] : edges[i + 1]].std(axis=0) for i in range(count)])
    start = track.start + section_length * np.arange(count, dtype=float)
    return TrackQuality(start, section_length, deviations, quality_class(deviations, speed))
