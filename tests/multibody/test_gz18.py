"""GZ18: static loads of its source, and SIMPACK's response in a curve of 300 m, wheel by wheel.

Notes
-----
The source is the open program OpenRailVehicleDynamics and its figures of SIMPACK's curves, read off with the
uncertainty stated in the file. The rails lie along the centre line on the cant ramps, as SIMPACK has them:
with their real slope (the default of a case) the steady curve is the same, and in the transitions the
wheelsets run 0.1 to 0.2 mm further out, the leading axle's longitudinal forces are smaller by 0.3 kN.

With coupled strips and FaStrip, the defaults of a case, the steady curve differs from SIMPACK's by up to 0.06
mm, 0.07 mrad, 0.56 kN (N), 0.70 (Tx) and 0.78 kN (Ty). Taken apart:

    from                 to                          leading wheelsets          trailing wheelsets
    FASTSIM              FaStrip, the same patches   Tx -7 %, Ty +3 to +4 %     Tx +5 to +6 %
    equivalent_elastic   coupled strips              Tx, Ty below 1 %           Tx -1.5 to -1.7 %

The tangential theory makes it, not the patch. Against the exact half-space with the creepages, in kN, of
FASTSIM, FaStrip, exact: wheel 1L, flange root with spin, Tx 10.56, 10.03, 10.53, Ty 18.86, 19.42, 19.13; 1R,
wide patch on the tread, Tx 10.94, 9.78, 9.86; 2L Tx 15.75, 16.59, 16.22. Coupled strips have 14 to 20 % more
peak pressure, as the ellipse of equal area spreads a pressure that the flange root crowds.
"""

import csv
from pathlib import Path

import numpy as np
import pytest
from command_line import call, refused

from hh_exudyn.case import Case
from hh_exudyn.contact.comparison import outside_rows
from hh_exudyn.multibody.assembly import assemble
from hh_exudyn.multibody.equilibrium import equilibrium
from hh_exudyn.multibody.gz18_curve import gz18_rows
from hh_exudyn.multibody.model import BODY_COORDINATES, workspace
from hh_exudyn.multibody.system import evaluate
from vehicles.catalogue import vehicle
from vehicles.description import Vehicle
from vehicles.statics import axle_loads

WHEEL_LOAD = 68_295.99  # N, of the source's own starting state


@pytest.fixture(scope="module")
def gz18() -> Vehicle:
    return vehicle("gz18")


def test_every_wheel_carries_the_load_of_the_source(gz18: Vehicle) -> None:
    assert gz18.mass == 55_695.0
    assert axle_loads(gz18) == pytest.approx([2 * WHEEL_LOAD] * 4, abs=0.01)


def test_it_is_drawn_loaded(gz18: Vehicle, demo: Case) -> None:
    """Preloads carry it at the heights of its drawing, all alike lower by the approach of the wheels."""
    sections = [{"kind": "straight", "length_m": 60.0, "gauge_mm": 1435.0}]
    case = demo.with_changes(
        vehicle="gz18", speed_km_h=60.0, track={"sections": sections, "flexibility": "rigid"}
    )
    model = assemble(gz18, case)
    work = workspace(model)
    state = equilibrium(gz18, model, work)
    evaluate(model, work, state.sliders, state.q, state.v, 0.0, True)
    assert -work.rail_force[:, :, 1] == pytest.approx(np.full((4, 2), WHEEL_LOAD), rel=1e-3)
    heights = state.q[2 : BODY_COORDINATES * len(gz18.bodies) : BODY_COORDINATES]
    lower = np.array([body.position[2] for body in gz18.bodies]) - heights
    assert np.ptp(lower) < 1e-6
    assert 0.0 < lower[0] < 0.5e-3


@pytest.mark.slow
def test_simpacks_curve(shared_reference: Path) -> None:
    """Steady values at 8.2 to 9.0 s and the peaks of the transition."""
    rows = gz18_rows(shared_reference / "gz18" / "lm_wheel.txt")
    assert len(rows) == 10
    assert [row.quantity for row in rows if not row.holds] == [], rows


def test_the_reference_is_that_of_the_shared_folder(shared_reference: Path) -> None:
    with (shared_reference / "gz18" / "simpack_r300_read_off.csv").open(encoding="utf-8") as file:
        source = [list(row.values()) for row in csv.DictReader(file)]
    ours = [list(row.values()) for row in outside_rows("gz18_curve.csv")]
    assert len(ours) == len(source) == 32
    for mine, (wheelset, wheel, quantity, _, steady, _, low, _, high, _, uncertainty) in zip(
        ours, source, strict=True
    ):
        number = str(("FF", "FR", "RF", "RR").index(wheelset) + 1)
        assert mine == [number, wheel, quantity, steady, low, high, uncertainty]


def test_without_the_profile_it_is_not_run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("hh_exudyn.multibody.validation._PARTS", ())
    result = call("validate", "vehicles")
    assert result.exit_code == 0
    assert "not run: GZ18" in result.stdout
    assert "profile LM (TB/T 449) is not at hand (--lm-wheel FILE)" in result.stdout
    assert "there is no such file" in refused("validate", "vehicles", "--lm-wheel", tmp_path / "lm.txt")
    (tmp_path / "lm.txt").write_text("no profile")
    assert "lm.txt" in refused("validate", "vehicles", "--lm-wheel", tmp_path / "lm.txt")
