"""Groups of wheels that wear alike: by axle of the bogie, by role in a curve, or every wheel by itself.

A vehicle has many wheels, and a campaign follows one profile for each group of them:

=================  ==================================================================================
``"all"``          one group: wheelsets change places and direction over their life
``"axle"``         "leading", "middle", "trailing" in the bogie: as many curves to the left as to the right
``"role"``         "outer" and "inner" in curves, whichever axle
``"axle_role"``    both: what a wheel would wear if it were always the outer one of a leading wheelset
``"wheel"``        every wheel by itself, "1L" to "8R" through all units
=================  ==================================================================================

On straight track, as often worn on one side as on the other, the right wheel counts as the outer one. Where
the vehicle is not turned round at the ends of the line, its last wheelset leads on the way back and its left
wheels run on the right: then a wheel is in the group that it has on the way out.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from hh_exudyn.campaign.collective.strata import Stratum
from hh_exudyn.conventions import LEFT, RIGHT
from vehicles.description import Vehicle

GROUPINGS = ("all", "axle", "role", "axle_role", "wheel")

Place = tuple[int, int]
"""Wheelset, counted from 1 at the leading end through all units of a run, and side."""

_SIDES = {LEFT: "L", RIGHT: "R"}


@dataclass(frozen=True)
class Grouping:
    """How wheels are grouped.

    Attributes
    ----------
    kind
        One of `GROUPINGS`.
    turns_round
        Whether the vehicle is turned at the ends of the line, so that the same end always leads.

    Raises
    ------
    ValueError
        An unknown kind.
    """

    kind: str = "axle_role"
    turns_round: bool = True

    def __post_init__(self) -> None:
        if self.kind not in GROUPINGS:
            raise ValueError(f"groups = {self.kind!r}: allowed {', '.join(GROUPINGS)}")

    def of_run(
        self, vehicle: Vehicle, stratum: Stratum, returning: bool, mirrored: bool
    ) -> Mapping[Place, str]:
        """The group of every wheel of a run.

        Parameters
        ----------
        vehicle
            That runs.
        stratum
            Of the case: its hand as run.
        returning
            Whether the run is one on the way back.
        mirrored
            Whether the run stands for its mirror image.
        """
        axles = bogie_axles(vehicle)
        count = len(axles)
        found = {}
        for wheelset in range(1, count + 1):
            for side in (LEFT, RIGHT):
                back = returning and not self.turns_round
                own = count + 1 - wheelset if back else wheelset
                own_side = -side if mirrored != back else side
                role = "outer" if side == (LEFT if stratum.run_hand == "right" else RIGHT) else "inner"
                axle = axles[own - 1]
                found[wheelset, side] = {
                    "all": "all",
                    "axle": axle,
                    "role": role,
                    "axle_role": f"{axle} {role}",
                    "wheel": f"{own}{_SIDES[own_side]}",
                }[self.kind]
        return found

    def names(self, vehicle: Vehicle) -> tuple[str, ...]:
        """All groups of a vehicle, in the order of its wheels."""
        axles = list(dict.fromkeys(bogie_axles(vehicle)))
        roles = ("outer", "inner")
        return {
            "all": ("all",),
            "axle": tuple(axles),
            "role": roles,
            "axle_role": tuple(f"{axle} {role}" for axle in axles for role in roles),
            "wheel": tuple(
                f"{number}{side}" for number in range(1, len(vehicle.wheelsets) + 1) for side in "LR"
            ),
        }[self.kind]


def bogie_axles(vehicle: Vehicle) -> tuple[str, ...]:
    """Place of every wheelset in its bogie: "leading", "middle" or "trailing"."""
    bogies = [(wheelset.unit, wheelset.bogie) for wheelset in vehicle.wheelsets]
    found = []
    for index, bogie in enumerate(bogies):
        rank, last = bogies[:index].count(bogie), bogies.count(bogie) - 1
        found.append("leading" if rank == 0 else "trailing" if rank == last else "middle")
    return tuple(found)
