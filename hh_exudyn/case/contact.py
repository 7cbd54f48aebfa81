"""The tables ``[contact]`` and ``[integration]`` of a case file. See `hh_exudyn.case.case`."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from hh_exudyn.case.fields import CaseTable, number
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.contact.normal.registry import NORMAL_THEORIES, check_combination, tangential_theories
from hh_exudyn.contact.tangential.registry import RUN_THEORIES

_Cells = Annotated[int, Field(ge=5, le=100)]


class ContactCase(CaseTable):
    """Normal and tangential theory, grid, and the damping d of the normal force N (1 + d * approach rate).

    The default of d is assumed, from the range of steel: d = 1.5 c with the coefficient of restitution 1 -
    c v at low speeds v of impact (Hunt and Crossley, J. Applied Mechanics 1975), c = 0.08 to 0.32 s/m (quoted
    from memory), so d = 0.12 to 0.48 s/m. It is a damper of 24 kN s/m at 80 kN; SIMPACK's usual one is about
    140, d = 1.75 s/m, more damping than that of steel. In the demo 0.3 s/m take 0.1 % of the energy lost
    in the contacts and 1.75 take 0.6 %; on ERRI-low down to 0.5 m the vertical forces above 100 Hz are 4 to
    45 N (rms) with either, on rigid track 10 % less with 1.75. It mattered only where the ellipses of a
    wheel jumped between root and flange, which strips do not. Contact modes near 580 Hz are damped to 17 and
    39 % of critical. These figures are older than the frames of the rails (`track.course.rail_frame`) and
    coupled strips, and not measured again since.

    Without a normal theory it is coupled strips, or Hertz's ellipse for a tangential theory that does not
    take them: FaStrip alone knows strips with a slip of their own. Coupled strips lie where they lie on the
    wheel: they take the cells along from `cells`, not the cells across. 20 cells along keep the creep forces
    of demo and locomotive within 0.4 % of mu N (0.14 % rms) of those with 100 cells, 32 within 0.16 %;
    FaStrip itself is 1 % from the exact solution. With the theory "given" profiles, coefficients and conicity
    are those of the vehicle.
    """

    normal: Literal[*NORMAL_THEORIES] = "coupled_strips"  # type: ignore[valid-type]
    theory: Literal[*RUN_THEORIES] = "fastrip"  # type: ignore[valid-type]
    cells: tuple[_Cells, _Cells] = Field(
        default=(20, 16), strict=False, json_schema_extra={"allowed": "two whole numbers from 5 to 100"}
    )
    damping_s_per_m: float = number("s/m", 0, 3, 0.3)
    young_modulus_GPa: float = number("GPa", 1, 1000, STEEL.young_modulus / 1e9)
    poisson_ratio: float = number("-", 0, 0.5, STEEL.poisson_ratio)
    profile_smoothing_mm: float = number("mm", 0.1, 5, 0.5)

    @model_validator(mode="before")
    @classmethod
    def _ellipse_for_its_theories(cls, given: Any) -> Any:
        """Without a normal theory, theories that do not take coupled strips have Hertz's ellipse."""
        if isinstance(given, dict) and "normal" not in given:
            theory = given.get("theory", "fastrip")
            if theory in RUN_THEORIES and theory not in tangential_theories("coupled_strips"):
                return {**given, "normal": "hertz"}
        return given

    @model_validator(mode="after")
    def _check_combination(self) -> Self:
        check_combination(self.normal, self.theory)
        return self

    @property
    def material(self) -> Material:
        """Elastic constants of wheel and rail."""
        shear_modulus = self.young_modulus_GPa * 1e9 / (2.0 * (1.0 + self.poisson_ratio))
        return Material(shear_modulus, self.poisson_ratio)


class IntegrationCase(CaseTable):
    """Step of the time integration, output interval of the logs, and the couplings in a log of their own.

    `logged_couplings` has names of the vehicle's couplings, with ``*`` for any letters: ``["wedge_*"]``.
    """

    step_ms: float = number("ms", 0.05, 1, 0.4)
    output_interval_ms: float = number("ms", 0.05, 1000, 4.0)
    logged_couplings: tuple[str, ...] = Field(
        default=(), strict=False, json_schema_extra={"allowed": "a list of names of couplings"}
    )

    @model_validator(mode="after")
    def _whole_steps(self) -> Self:
        steps = self.output_interval_ms / self.step_ms
        if round(steps) < 1 or abs(steps - round(steps)) > 1e-6 * steps:
            raise ValueError(
                f"output_interval_ms = {self.output_interval_ms:g} ms: allowed whole multiples of "
                f"step_ms = {self.step_ms:g} ms"
            )
        return self
