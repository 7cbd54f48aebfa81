"""The tables ``[train]`` and ``[brake]`` of a case file: train forces and braking of a hauled wagon.

::

    [train]
    draft_kN = 300

    [brake]
    shoe_force_kN = 15

The train has constant speed, and pulls the braked wagon at its couplers.
"""

import re

from pydantic import Field, field_validator

from hh_exudyn.case.fields import CaseTable, number
from vehicles.description import Vehicle

_WHEEL = re.compile(r"[1-9]\d*[LR]")


class TrainCase(CaseTable):
    """Force of the train through the vehicle, from its front coupler to its rear one.

    Positive in draft, negative in buff. At either coupler it is tangential to the track, as between equal
    wagons in a full curve. The extension of the vehicle loads the springs that represent the train, which
    reduces the drawbar's force by about 1 %.
    """

    draft_kN: float = number("kN", -2000, 2000)

    def require_through(self, vehicle: Vehicle) -> None:
        """Raises ValueError for a vehicle without couplers at both ends, or one that pulls its train."""
        if vehicle.drives or len(vehicle.coupler.points) != 2:
            raise ValueError(f"train given: no force passes through vehicle {vehicle.name}")


class BrakeCase(CaseTable):
    """Tread brake: the force of each shoe on its wheel, from a time on.

    `friction` is by default that of the vehicle's shoes. `wheels` are the braked wheels, "1L" leading and
    left, counted through all units; by default all. With `start_s` and `build_up_s` 0
    the run begins with the brakes applied, in equilibrium.
    """

    shoe_force_kN: float = number("kN", 0, 100)
    friction: float | None = number("-", 0.02, 0.6, None)
    wheels: tuple[str, ...] | None = Field(
        None, strict=False, json_schema_extra={"allowed": 'wheels like "1L", "1R", "2L"'}
    )
    start_s: float = number("s", 0, 3600, 0.0)
    build_up_s: float = number("s", 0, 60, 0.0)

    @field_validator("wheels")
    @classmethod
    def _named(cls, value: tuple[str, ...] | None) -> tuple[str, ...] | None:
        for wheel in value or ():
            if not _WHEEL.fullmatch(wheel):
                raise ValueError(f'{wheel!r}: allowed are wheels like "1L", "1R", "2L"')
        return value

    def thrusts(self, vehicle: Vehicle) -> list[float]:
        """Force of every shoe of a vehicle on its wheel [N].

        Raises
        ------
        ValueError
            The vehicle has no shoes, or none on a named wheel.
        """
        numbers = {wheelset.body: number for number, wheelset in enumerate(vehicle.wheelsets, start=1)}
        names = [f"{numbers[shoe.wheelset]}{'L' if shoe.point[1] > 0.0 else 'R'}" for shoe in vehicle.shoes]
        if not names:
            raise ValueError(f"brake given: vehicle {vehicle.name} has no brake shoes")
        wanted = set(names if self.wheels is None else self.wheels)
        if unknown := wanted - set(names):
            raise ValueError(
                f"brake.wheels: vehicle {vehicle.name} has no shoe on {', '.join(sorted(unknown))}; "
                f"it has them on {', '.join(names)}"
            )
        return [1e3 * self.shoe_force_kN if name in wanted else 0.0 for name in names]
