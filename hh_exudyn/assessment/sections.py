"""Elements of a track: straights, transitions, curves; its test sections, by the lengths of UIC 518."""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from hh_exudyn.assessment.limits import data
from track.course.alignment import Alignment, Curve, Straight, Transition
from track.course.sections import Ramp, Section

STRAIGHT, TRANSITION = "straight", "transition"
LENGTHS = (10.0, 1000.0)  # m, of a section that the caller chooses

# Surveyed lines consist of ramps: below these bounds they are straight, or one curve. Assumed.
_STRAIGHT_RADIUS = 5000.0  # m
_SAME_CURVATURE = 0.1  # relative


@dataclass(frozen=True)
class AssessedSection:
    """A test section: a stretch of track with its own values.

    Attributes
    ----------
    kind : str
        "straight", "transition", or the name of a class of radii.
    start, end : float
        Arc length [m].
    curvature : float
        [1/m], positive to the left; 0 on a straight and for a transition.
    cant : float
        Of a curve [m], positive where its outer rail is higher.
    """

    kind: str
    start: float
    end: float
    curvature: float = 0.0
    cant: float = 0.0

    @property
    def length(self) -> float:
        """Length of the section [m]."""
        return self.end - self.start

    @property
    def radius(self) -> float:
        """Radius [m], infinite without curvature."""
        return 1.0 / abs(self.curvature) if self.curvature else math.inf

    @property
    def hand(self) -> str:
        """Hand of the curve: "left", "right", or empty."""
        return "" if not self.curvature else "left" if self.curvature > 0.0 else "right"

    @property
    def curved(self) -> bool:
        """Whether quasi-static forces are judged here."""
        return self.curvature != 0.0

    @property
    def title(self) -> str:
        """ "straight", "transition", "curve R 450 m left"."""
        return f"curve R {self.radius:.0f} m {self.hand}" if self.curved else self.kind


@dataclass(frozen=True)
class Unassessed:
    """A stretch of track in no test section, or covered by the run in part only.

    Attributes
    ----------
    stretch : AssessedSection
        Its kind and place, as the run covers it.
    reason : str
        Why it has no section, with lengths.
    """

    stretch: AssessedSection
    reason: str

    def __str__(self) -> str:
        part = self.stretch
        what = f"curve R {part.radius:.0f} m" if part.curved else part.kind
        return f"{what} from {part.start:.1f} to {part.end:.1f} m, {self.reason}"


class CutTrack(NamedTuple):
    """Test sections of a track, and what lies in none."""

    sections: tuple[AssessedSection, ...]
    left_out: tuple[Unassessed, ...]


def cut_sections(alignment: Alignment, covered: tuple[float, float], length: float | None = None) -> CutTrack:
    """The test sections of an alignment that a run covers, and the stretches without any.

    A straight or curve holds as many whole sections as fit; the remainder is at its start, where the vehicle
    still settles, and is not named. A transition is one section. A stretch shorter than one section has none.

    Parameters
    ----------
    alignment : Alignment
        Of the run.
    covered : (float, float)
        Arc lengths between which every wheelset has run [m].
    length : float or None
        Of the sections of straights and curves [m], 10 to 1000; None, the default, for those of UIC 518.

    Raises
    ------
    ValueError
        A length out of range; no stretch is long enough.
    """
    if length is not None and not LENGTHS[0] <= length <= LENGTHS[1]:
        raise ValueError(f"section length is {length:g} m, allowed are {LENGTHS[0]:g} to {LENGTHS[1]:g} m")
    found: list[AssessedSection] = []
    short: list[Unassessed] = []
    for stretch in track_elements(alignment):
        whole = covered[0] <= stretch.start and stretch.end <= covered[1]
        part = replace(stretch, start=max(stretch.start, covered[0]), end=min(stretch.end, covered[1]))
        if part.kind == TRANSITION:
            if whole and part.length >= LENGTHS[0]:
                found.append(part)
            elif not whole:
                short.append(Unassessed(stretch, f"covered for {max(part.length, 0.0):.1f} m"))
            else:
                short.append(Unassessed(part, f"{part.length:.1f} of {LENGTHS[0]:g} m"))
            continue
        wanted = length or _wanted(part)
        count = max(math.floor(part.length / wanted + 1e-9), 0)
        if count == 0:
            lies = part if part.length > 0.0 else stretch
            short.append(Unassessed(lies, f"{max(part.length, 0.0):.1f} of {wanted:g} m"))
        starts = (part.end - wanted * (count - i) for i in range(count))
        found += [replace(part, start=start, end=start + wanted) for start in starts]
    if not any(section.kind != TRANSITION for section in found):
        reached = [
            part for part in short if part.stretch.kind != TRANSITION and part.stretch.end > covered[0]
        ]
        near = "; ".join(str(part) for part in reached if part.stretch.start < covered[1])
        raise ValueError(
            f"no straight or curve is long enough for a test section: {near or 'there is none'}; a longer "
            "run or a shorter section length is needed"
        )
    return CutTrack(tuple(found), tuple(short))


def _wanted(part: AssessedSection) -> float:
    """Length of the sections of a straight or curve [m]."""
    if part.kind == STRAIGHT:
        return float(data()["sections"]["straight_m"])
    rows = data()["sections"]["curves"].values()
    return next(float(row["length_m"]) for row in rows if row["name"] == part.kind)


def track_elements(alignment: Alignment) -> list[AssessedSection]:
    """The elements of a track from its start: consecutive sections of the same kind and curvature are one."""
    found: list[AssessedSection] = []
    start = 0.0
    for section in alignment.sections:
        new = _stretch(section, start)
        start = new.end
        if found and _same(found[-1], new):
            old = found[-1]
            whole = new.end - old.start
            curvature = (old.curvature * old.length + new.curvature * new.length) / whole
            cant = (old.cant * old.length + new.cant * new.length) / whole
            found[-1] = replace(old, end=new.end, curvature=curvature, cant=cant)
        else:
            found.append(new)
    return found


def _stretch(section: Section, start: float) -> AssessedSection:
    """A section of the alignment by the kinds of the assessment."""
    end = start + section.length
    if isinstance(section, Straight):
        return AssessedSection(STRAIGHT, start, end)
    if isinstance(section, Curve):
        curvature, cant, _ = section.state
        return AssessedSection(_curve_class(curvature), start, end, curvature, abs(cant))
    if isinstance(section, Ramp):
        first, last = section.curvature
        largest = max(abs(first), abs(last))
        if largest * _STRAIGHT_RADIUS <= 1.0:
            return AssessedSection(STRAIGHT, start, end)
        if abs(first - last) <= _SAME_CURVATURE * largest:
            mean = 0.5 * (first + last)
            cant = 0.5 * abs(sum(section.cant))  # the outer rail is the higher one
            return AssessedSection(_curve_class(mean), start, end, mean, cant)
    else:
        assert isinstance(section, Transition)
    return AssessedSection(TRANSITION, start, end)


def _curve_class(curvature: float) -> str:
    """Name of the class of radii."""
    rows = data()["sections"]["curves"].values()
    return next(str(row["name"]) for row in rows if row["from_m"] * abs(curvature) <= 1.0)


def _same(old: AssessedSection, new: AssessedSection) -> bool:
    """Whether two neighbours are one stretch."""
    largest = max(abs(old.curvature), abs(new.curvature))
    return old.kind == new.kind and abs(old.curvature - new.curvature) <= _SAME_CURVATURE * largest
