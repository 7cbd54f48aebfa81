"""`hh-exudyn creep-curve`."""

import csv
from pathlib import Path

import pytest
from command_line import call, refused

from hh_exudyn.contact.tangential.api import creep_force
from hh_exudyn.contact.tangential.registry import PATCH_THEORIES

PATCH = ("creep-curve", "--a-mm", "5", "--b-mm", "1", "--load-kn", "30", "--cells", "10", "--points", "4")


def test_curves_as_table_and_figure(tmp_path: Path) -> None:
    table, figure = tmp_path / "curves.csv", tmp_path / "curves.png"
    result = call(
        *PATCH, "--over", "longitudinal", "--over", "spin", "--nu-y", "1e-3", "--theory", "fastrip",
        "--theory", "linear", "--table", table, "--out", figure,
    )  # fmt: skip
    assert result.exit_code == 0, result.stderr
    assert figure.read_bytes().startswith(b"\x89PNG")
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert len(rows) == 2 * 3 * 4
    assert [*dict.fromkeys(row["theory"] for row in rows)] == ["linear", "fastrip", "halfspace"]
    for row in rows:
        value = float(row["creepage"])
        nu_x, phi = (value, 0.0) if row["over"] == "longitudinal" else (0.0, value)
        force = creep_force(row["theory"], 5e-3, 1e-3, 3e4, nu_x, 1e-3, phi, 0.3, cells=(10, 10))
        assert float(row["F_x_over_mu_N"]) == pytest.approx(force.x / 9e3, abs=1e-9)
        assert float(row["F_y_over_mu_N"]) == pytest.approx(force.y / 9e3, abs=1e-9)
        moment = force.moment / (9e3 * (5e-3 * 1e-3) ** 0.5)
        assert float(row["M_z_over_mu_N_c"]) == pytest.approx(moment, abs=1e-9)


def test_the_linear_theory_reaches_the_limit_at_the_unit() -> None:
    result = call(*PATCH, "--reach", "1", "--over", "lateral", "--theory", "linear")
    assert result.exit_code == 0, result.stderr
    (line,) = (line for line in result.stdout.splitlines() if line.split()[:1] == ["linear"])
    # F_linear = mu N there, and the half-space has some 0.7 of it (Fig. 2-5)
    assert 25.0 < float(line.split()[1]) < 35.0
    assert "lateral: 4 creepages to" in result.stdout


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--over", "vertical"), "--over vertical: unknown, allowed: longitudinal, lateral, spin"),
        (("--theory", "contact"), f"--theory contact: unknown, allowed: {', '.join(PATCH_THEORIES)}"),
        (("--points", "1"), "--points 1: allowed 2 to 1000"),
        (("--reach", "0"), "--reach 0: allowed 0.01 to 100"),
        (("--table", "curves.txt"), "--table curves.txt: allowed is .csv"),
    ],
)
def test_bad_input_is_one_line(words: tuple[str, str], message: str) -> None:
    assert message in refused(*PATCH, *words)
