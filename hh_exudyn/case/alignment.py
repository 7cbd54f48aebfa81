"""The alignment in a case file: sections and grades, or a table, or surveyed points. See `case`."""

from dataclasses import replace
from typing import Annotated, Any, Literal, Self, TypeVar

from pydantic import Field, model_validator

from hh_exudyn.case.fields import CaseTable, number
from hh_exudyn.case.rails import RailName, sided
from hh_exudyn.conventions import NOMINAL_GAUGE
from track.course.alignment import Alignment, Curve, Grade, Ramp, Straight, Transition
from track.course.centre_line import fit_centre_line
from track.course.survey import read_centre_line_csv
from track.rails import RailPair, Rails

NOMINAL_GAUGES_MM = (900.0, 1700.0)  # from 900 mm (Christchurch, Leipzig) to 1676 mm (India)
WIDENING_MM = 35.0  # over the nominal gauge; beyond it a wheel may drop between the rails
_RADII = (100.0, 100_000.0)  # m


def _gauge(default: float | None = NOMINAL_GAUGE * 1000) -> Any:
    """Field of a gauge [mm]; the allowed ones follow from wheel profile and nominal gauge, see `Case`.

    Without it a section has the nominal gauge of the track (`with_nominal_gauge`).
    """
    largest = NOMINAL_GAUGES_MM[1] + WIDENING_MM
    extra: dict[str, Any] = {"unit": "mm", "allowed": f"up to {largest:g}"}
    return Field(default, le=largest, json_schema_extra=extra)


class StraightCase(CaseTable):
    """A straight. Its rails are those of the track unless it names its own."""

    kind: Literal["straight"] = "straight"
    length_m: float = number("m", 1, 100_000)
    gauge_mm: float = _gauge()
    rail: RailName | None = None
    rail_left: RailName | None = None
    rail_right: RailName | None = None

    def rails(self, track: Rails) -> Rails:
        """Its rails, on a track with those."""
        return sided(track, self.rail, self.rail_left, self.rail_right)

    def section(self) -> Straight:
        """The section in SI."""
        return Straight(length=self.length_m, gauge=self.gauge_mm / 1000)

    def mirrored(self) -> Self:
        """The same with the rails exchanged: a straight has no hand."""
        return self.model_copy(update={"rail_left": self.rail_right, "rail_right": self.rail_left})


class TransitionCase(CaseTable):
    """A transition between its neighbours, in curvature, cant and gauge.

    Between two curves of one radius it is a cant ramp. `gauge_mm` is the gauge at its middle; without it the
    gauge follows one ramp too. `gravity_height_m` is for the Viennese bend.
    """

    kind: Literal["transition"] = "transition"
    length_m: float = number("m", 1, 10_000)
    shape: Literal["clothoid", "helmert", "bloss", "cosine", "sine", "viennese", "cubic"] = "clothoid"
    gauge_mm: float | None = _gauge(None)
    gravity_height_m: float = number("m", 0, 3, 1.8)

    def section(self) -> Transition:
        """The section in SI."""
        gauge = None if self.gauge_mm is None else self.gauge_mm / 1000
        return Transition(self.length_m, gauge, self.shape, self.gravity_height_m)

    def rails(self, track: Rails) -> None:
        """None: the rails change at its middle from those of one neighbour to those of the other."""

    def mirrored(self) -> Self:
        """The same: its direction follows from its neighbours."""
        return self


class CurveCase(CaseTable):
    """A curve of constant radius; the cant raises its outer rail.

    Its high (outer) and low rail are those of the track unless it names its own.
    """

    kind: Literal["curve"] = "curve"
    length_m: float = number("m", 1, 100_000)
    radius_m: float = number("m", *_RADII)
    hand: Literal["left", "right"]
    cant_mm: float = number("mm", 0, 180, 0.0)
    gauge_mm: float = _gauge()
    rail_high: RailName | None = None
    rail_low: RailName | None = None

    def rails(self, track: Rails) -> Rails:
        """Its rails, on a track with those."""
        high, low = (track.right, track.left) if self.hand == "left" else (track.left, track.right)
        return RailPair(self.rail_high or high, self.rail_low or low).rails(self.hand, track.inclination)

    def section(self) -> Curve:
        """The section in SI."""
        return Curve(
            length=self.length_m,
            radius=self.radius_m,
            hand=self.hand,
            cant=self.cant_mm / 1000,
            gauge=self.gauge_mm / 1000,
        )

    def mirrored(self) -> Self:
        """The curve of the other hand."""
        return self.model_copy(update={"hand": "right" if self.hand == "left" else "left"})


class RampCase(CaseTable):
    """Curvature, cant and gauge, each linear between given values at beginning and end.

    Radii are positive to the left, negative to the right, 0 in a straight. The cant raises the outer rail;
    where both radii are 0, because a ramp of the cant begins ahead of its transition or ends behind it,
    `hand` is that of the curve.
    """

    kind: Literal["ramp"] = "ramp"
    length_m: float = number("m", 1, 100_000)
    radius_m: tuple[float, float] = Field(strict=False, json_schema_extra={"allowed": "two radii in m"})
    cant_mm: tuple[float, float] = Field(
        default=(0.0, 0.0), strict=False, json_schema_extra={"allowed": "two numbers, 0 to 180 mm"}
    )
    gauge_mm: tuple[float, float] = Field(
        default=(NOMINAL_GAUGE * 1000,) * 2, strict=False, json_schema_extra={"allowed": "two numbers, mm"}
    )
    hand: Literal["left", "right"] | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        for radius in self.radius_m:
            if radius != 0.0 and not _RADII[0] <= abs(radius) <= _RADII[1]:
                raise ValueError(
                    f"radius_m has {radius:g} m: allowed 0 in a straight, or {_RADII[0]:g} to {_RADII[1]:g} "
                    "m, negative to the right"
                )
        for cant in self.cant_mm:
            if not 0.0 <= cant <= 180.0:
                raise ValueError(f"cant_mm has {cant:g} mm: allowed 0 to 180 mm, the outer rail is higher")
        turn = sum(self.radius_m)
        if self.hand is None and not any(self.radius_m) and any(self.cant_mm):
            raise ValueError(
                'cant_mm on a straight: hand is missing, allowed "left" or "right", of the curve'
            )
        if self.hand is not None and turn * (1.0 if self.hand == "left" else -1.0) < 0.0:
            raise ValueError(f'hand = "{self.hand}": the radii are those of the other hand')
        self.section()
        return self

    def section(self) -> Ramp:
        """The section in SI."""
        (r0, r1), (c0, c1), (g0, g1) = self.radius_m, self.cant_mm, self.gauge_mm
        outer = r0 or r1 or (-1.0 if self.hand == "right" else 1.0)
        return Ramp(
            length=self.length_m,
            curvature=(_curvature(r0), _curvature(r1)),
            cant=(_signed(c0 / 1000, r0 or outer), _signed(c1 / 1000, r1 or outer)),
            gauge=(g0 / 1000, g1 / 1000),
        )

    def rails(self, track: Rails) -> None:
        """None, as for a transition."""

    def mirrored(self) -> Self:
        """The ramp with left and right exchanged."""
        r0, r1 = self.radius_m
        other = {"left": "right", "right": "left"}
        return self.model_copy(
            update={"radius_m": (-r0, -r1), "hand": other[self.hand] if self.hand else None}
        )


def _curvature(radius: float) -> float:
    """Curvature [1/m]; 0 for the radius 0, which stands for straight track."""
    return 1.0 / radius if radius else 0.0


def _signed(cant: float, radius: float) -> float:
    """Height of the right rail over the left one [m]."""
    return -cant if radius < 0.0 else cant


class GradeCase(CaseTable):
    """A stretch of the vertical profile; with `end_per_mille` a vertical curve to that gradient."""

    length_m: float = number("m", 1, 100_000)
    gradient_per_mille: float = number("per mille", -50, 50)
    end_per_mille: float | None = number("per mille", -50, 50, None)

    @model_validator(mode="after")
    def _check(self) -> Self:
        self.grade()
        return self

    def grade(self) -> Grade:
        """The grade in SI."""
        end = None if self.end_per_mille is None else self.end_per_mille / 1000
        return Grade(length=self.length_m, gradient=self.gradient_per_mille / 1000, end=end)


class CentreLineCase(CaseTable):
    """Surveyed points (`track.course.survey.read_centre_line_csv`) and their smoothing to an alignment.

    Keys and defaults as in `track.course.centre_line.fit_centre_line`; the cant is that of zero cant
    deficiency at `balance_speed_km_h`. A run must begin on straight track, and surveyed points are never
    exactly straight: so `approach_m` of track precede the first point, half of it straight, half a transition
    to curvature and cant of the line there, on its first gradient; 0 for none.
    """

    file: str = Field(min_length=1, json_schema_extra={"allowed": "a file (.csv)"})
    wavelength_m: float = number("m", 20, 1000, 80.0)
    largest_deviation_m: float = number("m", 1e-3, 10, 0.1)
    balance_speed_km_h: float = number("km/h", 0, 360, 0.0)
    largest_cant_mm: float = number("mm", 0, 180, 150.0)
    gauge_mm: float = _gauge()
    approach_m: float = number("m", 0, 1000, 60.0)

    def fitted(self) -> Alignment:
        """The alignment along the points; raises ValueError as `fit_centre_line` does."""
        found = fit_centre_line(
            read_centre_line_csv(self.file),
            wavelength=self.wavelength_m,
            largest_deviation=self.largest_deviation_m,
            balance_speed=self.balance_speed_km_h / 3.6,
            largest_cant=self.largest_cant_mm / 1000,
            gauge=self.gauge_mm / 1000,
        ).alignment
        if self.approach_m == 0.0:
            return found
        half = 0.5 * self.approach_m
        ahead = Straight(half, self.gauge_mm / 1000), Transition(half)
        grades = tuple(Grade(self.approach_m, grade.gradient) for grade in found.grades[:1])
        return replace(found, sections=ahead + found.sections, grades=grades + found.grades)


_Gauged = TypeVar("_Gauged", bound=CaseTable)
SectionCase = Annotated[StraightCase | TransitionCase | CurveCase | RampCase, Field(discriminator="kind")]


def with_nominal_gauge(table: _Gauged, nominal_mm: float) -> _Gauged:
    """A section or centre line with the nominal gauge where it states none.

    Parameters
    ----------
    table : CaseTable
        With the key `gauge_mm`.
    nominal_mm : float
        Nominal gauge of the track [mm].
    """
    if "gauge_mm" in table.model_fields_set or isinstance(table, TransitionCase):
        return table
    gauge = (nominal_mm,) * 2 if isinstance(table, RampCase) else nominal_mm
    return table.model_copy(update={"gauge_mm": gauge})


def gauges_mm(section: StraightCase | TransitionCase | CurveCase | RampCase) -> tuple[float, ...]:
    """The gauges that a section states; none for a transition without `gauge_mm`."""
    gauge = section.gauge_mm
    if isinstance(gauge, tuple):
        return gauge
    return () if gauge is None else (gauge,)
