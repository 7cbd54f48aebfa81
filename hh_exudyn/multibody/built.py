"""The Exudyn system of a case in the hands of its user, who adds items to it and integrates it."""

from dataclasses import dataclass

import exudyn as exu

from hh_exudyn.case import Case
from hh_exudyn.multibody.assembly import assemble, released
from hh_exudyn.multibody.control import vehicle_control
from hh_exudyn.multibody.extended_rest import start_of_run
from hh_exudyn.multibody.extension import Extension
from hh_exudyn.multibody.exudyn_system import ExudynSystem
from hh_exudyn.multibody.integration import Integration
from hh_exudyn.multibody.model import workspace
from vehicles.description import Vehicle


@dataclass(frozen=True, kw_only=True)
class BuiltSystem(ExudynSystem):
    """The system of a case at its start, before `Assemble()`."""

    integration: Integration

    def solve(self) -> None:
        """Assemble the system and integrate it to the end of the track, by `settings`.

        Raises
        ------
        SimulationStopped
            Derailment or divergence.
        """
        exu.config.printToConsole = False
        try:
            self.integration.solve(self)
        finally:
            exu.config.printToConsole = True


def build(case: Case, *, vehicle: Vehicle | None = None, extend: Extension | None = None) -> BuiltSystem:
    """The Exudyn system of a case at rest: with its forces, its controllers and the reasons to stop.

    Add what you like to its ``mbs``, then call `solve`; or assemble and solve it yourself, which ends early
    and without an error where the vehicle derails. What is added after `extend` is not settled. Nothing is
    logged: that is the work of `simulate`, which takes the same function `extend`.

    Parameters
    ----------
    case : vehicle, track, speed, contact and integration
    vehicle : a description in place of the vehicle of the case
    extend : adds items, and the vehicle is settled with them

    Raises
    ------
    ValueError, NoEquilibrium
        As by `simulate`.
    """
    runs = vehicle or case.described_vehicle()
    model = assemble(runs, case)
    work = workspace(model)
    control = vehicle_control(case, runs, model, work)
    integration = Integration(case, runs, released(model, case), work, control, extend, placed=True)
    integration.begin(*start_of_run(case, runs, model, work, extend), case.alignment().length)
    system = integration.whole_system()
    return BuiltSystem(**vars(system), integration=integration)
