"""One evaluation of all forces of the loaded wagon: the call that a run makes 10 000 times a second."""

from importlib.resources import files

import numpy as np
import pytest

from hh_exudyn.case import Case
from hh_exudyn.kernel import Bundle
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.model import workspace
from hh_exudyn.multibody.system import evaluate_bundle
from vehicles.catalogue import vehicle


@pytest.mark.parametrize("cells", [(16, 16), (32, 16), (50, 50)])
def test_evaluate(benchmark, cells):
    case = Case.from_toml(files("hh_exudyn").joinpath("data/demo.toml").read_text(encoding="utf-8"))
    case = case.with_changes(contact={"cells": cells})
    wagon = vehicle(case.vehicle)
    model = assemble(wagon, case)
    work = workspace(model)
    state = equilibrium(wagon, model, work)
    bundle = Bundle(model, work)
    arguments = (bundle, np.copy(state.sliders), state.q, state.v, 0.0, False)
    assert benchmark(evaluate_bundle, *arguments) == 0
