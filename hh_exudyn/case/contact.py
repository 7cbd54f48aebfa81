"""The tables ``[contact]`` and ``[integration]`` of a case file. See `hh_exudyn.case.case`."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from hh_exudyn.case.fields import CaseTable, number
from hh_exudyn.contact.normal.registry import NORMAL_THEORIES, check_combination
from hh_exudyn.contact.tangential.registry import RUN_THEORIES

_Cells = Annotated[int, Field(ge=5, le=100)]


class ContactCase(CaseTable):
    """Normal and tangential theory, grid, and the damping d of the normal force N (1 + d * approach rate).

    The default of d is assumed: at 150 kN it is a damper of 45 kN s/m, 5 % of critical for the 150 kg of a
    rail on a contact spring of 1.7 GN/m. With 32 cells along each of 16 strips the lateral wheel forces of
    the demo are within 0.6 % of those with 50 x 50 cells and half the step; strips in eights fill the vector
    registers. With the theory "given" profiles, coefficients and conicity are those that the vehicle states.
    """

    normal: Literal[*NORMAL_THEORIES] = "hertz"  # type: ignore[valid-type]
    theory: Literal[*RUN_THEORIES] = "fastrip"  # type: ignore[valid-type]
    cells: tuple[_Cells, _Cells] = Field(
        default=(32, 16), strict=False, json_schema_extra={"allowed": "two whole numbers from 5 to 100"}
    )
    damping_s_per_m: float = number("s/m", 0, 3, 0.3)

    @model_validator(mode="after")
    def _check_combination(self) -> Self:
        check_combination(self.normal, self.theory)
        return self


class IntegrationCase(CaseTable):
    """Step of the time integration and distance in time of the logged states."""

    step_ms: float = number("ms", 0.05, 0.5, 0.4)
    output_interval_ms: float = number("ms", 0.05, 1000, 4.0)

    @model_validator(mode="after")
    def _whole_steps(self) -> Self:
        steps = self.output_interval_ms / self.step_ms
        if round(steps) < 1 or abs(steps - round(steps)) > 1e-6 * steps:
            raise ValueError(
                f"output_interval_ms = {self.output_interval_ms:g} ms: allowed whole multiples of "
                f"step_ms = {self.step_ms:g} ms"
            )
        return self
