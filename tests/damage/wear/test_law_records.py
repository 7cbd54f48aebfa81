"""The wear laws by their records: what the records say is so, and a law of another package is found."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib import invalidate_caches
from inspect import signature
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import numpy as np
import pyarrow
import pytest
from typer.testing import CliRunner

from damage.patch_strips import ellipse_strips, strips_space
from damage.report import assess
from damage.wear.batch import wear_depths
from damage.wear.law import REGIMES, SolvedPatch, WearLaw
from damage.wear.laws import LAW_RECORDS, LawRecord, law_names, law_parameters, names_for_help, wear_law
from hh_exudyn.cli.app import app
from hh_exudyn.contact.types import Fields, RollingPatch

OPTIONS: dict[str, dict[str, Any]] = {"krause_poll": {"coefficients": (2e-13,), "power_densities": ()}}
OTHER_PACKAGE = '''
import math

import numpy as np

from damage.wear.energy import energies_of_strips
from damage.wear.law import WearLaw
from damage.wear.laws import LawRecord
from hh_exudyn.kernel import kernel


@kernel
def square_depths(numbers, solved, depth):
    """Worn volume = coefficient times energy squared, evenly over the strips, in the second regime."""
    energy = energies_of_strips(solved, depth)
    depth[:] = 0.0
    depth[:, 1] = numbers[0] * energy * energy / (2.0 * solved.patch.b)


def square(coefficient=1e-15):
    if not coefficient > 0.0:
        raise ValueError(f"coefficient = {coefficient} m^3/J^2 must be > 0")
    return WearLaw("square", ("none", "all"), square_depths, (coefficient,))


RECORD = LawRecord("square", "tiny_wear:square", "coefficient times the wear number squared")
'''


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str], None]]:
    """Install a package with the entry points given, as pip does: its module and its metadata on the path."""

    def install(entry_points: str) -> None:
        (tmp_path / "tiny_wear.py").write_text(OTHER_PACKAGE)
        metadata = tmp_path / "tiny_wear-1.0.dist-info"
        metadata.mkdir()
        (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: tiny-wear\nVersion: 1.0\n")
        (metadata / "entry_points.txt").write_text(f"[hh_exudyn.wear_laws]\n{entry_points}\n")
        monkeypatch.syspath_prepend(str(tmp_path))
        invalidate_caches()

    yield install
    sys.modules.pop("tiny_wear", None)


def test_the_law_of_another_package(
    install: Callable[[str], None], make_log: Callable[..., pyarrow.Table]
) -> None:
    """E = 40 N on full slip: the volume is c E^2 per metre rolled, in `wear_depths` and in `assess`."""
    install("square = tiny_wear:RECORD")
    assert law_names() == (*(record.name for record in LAW_RECORDS), "square")
    assert "square" in names_for_help()
    law = wear_law("square", coefficient=2e-15)
    log = make_log(nu_x=0.02, time=np.array([0.0, 1.0]))
    depths = wear_depths(law, log, cells=(20, 20))
    energy = depths.energy.sum(axis=1)
    np.testing.assert_allclose(energy, 0.4 * 100e3 * 0.02, rtol=0.01)  # mu N nu
    np.testing.assert_allclose(depths.volume[:, 1], 2e-15 * energy**2, rtol=1e-12)
    report = assess(log, law=law, cells=(20, 20))
    volume = report.surface.worn_volume[0] / report.surface.distance
    np.testing.assert_allclose(volume, [0.0, 2e-15 * energy[0] ** 2, 0.0, 0.0], rtol=1e-12)
    assert report.to_table()["wear_all_share"].to_pylist() == [1.0]
    with pytest.raises(ValueError, match=r"'square' has no option 'surface'; it has coefficient"):
        wear_law("square", surface="dry")


@pytest.mark.parametrize(
    ("entry_points", "name", "message"),
    [
        ("archard = tiny_wear:RECORD", "archard", "'archard' is defined more than once: damage, tiny_wear"),
        ("cube = tiny_wear:RECORD", "cube", r"cube = tiny_wear:RECORD .* must be a LawRecord with the name"),
        ("square = tiny_wear:square", "square", "must be a LawRecord with the name 'square', not <function"),
        ("square = no_such_module:RECORD", "square", "cannot be imported: No module named 'no_such_module'"),
    ],
)
def test_bad_entry_points(install: Callable[[str], None], entry_points: str, name: str, message: str) -> None:
    install(entry_points)
    with pytest.raises(ValueError, match=message):
        wear_law(name)


def test_the_command_line_offers_every_law_that_its_name_makes() -> None:
    shown = CliRunner().invoke(app, ["damage", "--help"], env={"COLUMNS": "200"}).output
    for record in LAW_RECORDS:
        assert (record.name in shown) != record.needs_options, record.name


@pytest.mark.parametrize("record", LAW_RECORDS, ids=lambda record: record.name)
def test_records_are_true(record: LawRecord) -> None:
    options = signature(resolve_name(record.maker)).parameters.values()
    assert any(option.default is option.empty for option in options) == record.needs_options
    law = wear_law(record.name, **OPTIONS.get(record.name, {}))
    assert law.name == record.name
    tables = law_parameters(record.name)
    assert tuple(tables) == record.tables
    assert bool(tables) != record.needs_options  # the numbers are in the file, or the user's
    for name, parameter in [pair for table in tables.values() for pair in table.items()]:
        assert parameter.unit, name
        assert isinstance(parameter.confirmed, bool), name


@pytest.mark.parametrize("record", LAW_RECORDS, ids=lambda record: record.name)
def test_only_laws_that_need_the_field_see_where_in_a_strip_the_energy_is_lost(record: LawRecord) -> None:
    """The same energies of the strips, spread over all cells or twice as dense in every second one."""
    law = wear_law(record.name, **OPTIONS.get(record.name, {}))
    even, uneven = np.ones(8), np.array([2.0, 0.0] * 4)
    spread, gathered = (_depth(law, along) for along in (even, uneven))
    assert spread.any()
    assert np.allclose(spread, gathered, rtol=1e-12, atol=0.0) != record.needs_field


def _depth(law: WearLaw, along: np.ndarray) -> np.ndarray:
    """Depth of a patch of 6 strips whose slip varies along the strips as given; 40 N/mm^2 at the most."""
    patch = RollingPatch(6e-3, 5e-3, 80e3, 0.01, 0.0, 0.0, 0.4, 82e9, 0.28)
    fields, depth = Fields(*np.zeros((5, 6, 8))), np.zeros((6, REGIMES))
    fields.pressure[:] = 800e6
    fields.q_x[:] = -320e6
    fields.slip_x[:] = 0.03 * along
    strips = strips_space(6)
    area = ellipse_strips(patch, strips)
    law.depths(np.array(law.numbers), SolvedPatch(patch, strips, area, fields, 15.0, 0.46), depth)
    return depth


def test_names_and_help_import_no_law() -> None:
    """They are there at once: the command line asks for them before it knows the command."""
    code = "import sys, damage.wear.laws as laws; laws.names_for_help(); sys.exit('numba' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
