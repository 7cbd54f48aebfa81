"""What ``hh-exudyn damage`` says about a run: its early end, its lubricant, rows that are left out."""

import math
from importlib import resources
from pathlib import Path

import pyarrow.csv
import pyarrow.parquet
import pytest
from command_line import call
from rolling_run import rolling_run

from hh_exudyn.log.store import write_status

DEMO = (resources.files("hh_exudyn") / "data" / "demo.toml").read_text(encoding="utf-8")
GREASED = DEMO.replace("friction = 0.40", "") + (
    '\n[friction]\nclimate = "dry"\nlubricated_wheelsets = [1]\n'
)
QUICK = ("--theory", "fastsim")


@pytest.fixture(autouse=True)
def without_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """They take seconds, and are looked at elsewhere."""
    monkeypatch.setattr("hh_exudyn.cli.damage._figures", lambda *_: {})


def one_wheelset() -> str:
    """A case whose whole vehicle is the run's one wheelset, on a straight."""
    return (
        'name = "one"\nvehicle = "suspended_wheelset"\nspeed_km_h = 54.0\nfriction = 0.4\n\n'
        '[[track.sections]]\nkind = "straight"\nlength_m = 30.0\n'
    )


def damage(run: Path, *words: str) -> tuple[str, list[dict[str, object]]]:
    """What is printed, and the rows of the table."""
    out = run.parent / f"out-{len(list(run.parent.iterdir()))}"
    result = call("damage", run, "--out", out, *QUICK, *words)
    assert result.exit_code == 0, result.output
    return result.stdout, pyarrow.csv.read_csv(out / "damage.csv").to_pylist()


def test_a_run_that_ended_early_is_named_in_every_table(tmp_path: Path) -> None:
    run = rolling_run(tmp_path / "run", DEMO)
    write_status(run, {"finished": False, "reason": "interrupted"})
    printed, rows = damage(run, "--unfinished", "--distance-km", "100")
    assert printed.count("(unfinished run: interrupted)") == 2
    assert {row["run"] for row in rows} == {"interrupted"}
    write_status(run, {"finished": True, "reason": "finished"})
    printed, rows = damage(run)
    assert "unfinished" not in printed
    assert {row["run"] for row in rows} == {"finished"}


def test_grease_is_in_the_table_and_in_the_wear(tmp_path: Path) -> None:
    """On the flange, Zhu's 100 of the thesis's page 70; named surfaces hold everywhere."""
    at_flange = {"contact_angle": 1.1, "y_wheel": 0.036}
    dry = rolling_run(tmp_path / "dry", DEMO, **at_flange)
    greased = rolling_run(tmp_path / "greased", GREASED, **at_flange)
    printed, before = damage(dry)
    assert "wear coefficients of archard: dry\n" in printed
    printed, after = damage(greased)
    assert "wear coefficients of archard: tread dry, root lubricated, flange greased\n" in printed
    for one, other in zip(before, after, strict=True):
        assert other["wear_surface"] == "tread dry, root lubricated, flange greased"
        assert one["wear_surface"] == "dry"
        assert one["worn_area_mm2_per_km"] / other["worn_area_mm2_per_km"] == pytest.approx(100.0)
    printed, named = damage(greased, "--surface", "lubricated")
    assert "wear coefficients of archard: lubricated\n" in printed
    assert before[0]["worn_area_mm2_per_km"] / named[0]["worn_area_mm2_per_km"] == pytest.approx(6.0)
    printed, _ = damage(greased, "--surface", "dry")
    assert "wear coefficients of archard: dry; doubtful: the case has lubricated zones" in printed
    printed, _ = damage(greased, "--model", "usfd")
    assert "wear coefficients of usfd: dry; doubtful: the case has lubricated zones" in printed


def test_dry_coefficients_at_the_friction_of_a_lubricated_contact_are_doubtful(tmp_path: Path) -> None:
    run = rolling_run(tmp_path / "run", DEMO, friction=0.12)
    printed, _ = damage(run)
    assert "wear coefficients of archard: dry; doubtful: friction is down to 0.12" in printed


def test_er7_and_er9_wear_by_their_hardness(tmp_path: Path) -> None:
    """235 and 255 HB."""
    run = rolling_run(tmp_path / "run", DEMO)
    soft, hard = (damage(run, "--material", steel)[1] for steel in ("ER7", "ER9"))
    for one, other in zip(soft, hard, strict=True):
        assert one["worn_area_mm2_per_km"] / other["worn_area_mm2_per_km"] == pytest.approx(255 / 235)


def test_a_gap_is_left_out_and_said(tmp_path: Path) -> None:
    run = rolling_run(tmp_path / "run", DEMO)
    whole = damage(run)[1]
    part = next((run / "contact").glob("part-*.parquet"))
    table = pyarrow.parquet.read_table(part)
    pyarrow.parquet.write_table(pyarrow.concat_tables([table.slice(0, 400), table.slice(600)]), part)
    printed, rows = damage(run, "--skip-bad-rows")
    assert "no rows between time = 0.796 and 1.2 s, where they are 0.004 s apart" in printed
    for one, other in zip(whole, rows, strict=True):  # per kilometre, so that the gap must not count
        assert other["worn_area_mm2_per_km"] == pytest.approx(one["worn_area_mm2_per_km"])


def test_rails_by_element_and_per_gross_tonne(tmp_path: Path) -> None:
    """The steady patch wears both rails alike; their names follow the curve; the wheels stay as they are."""
    run = rolling_run(tmp_path / "run", one_wheelset(), y_rail=2e-3)
    alone = damage(run)[1]
    printed, rows = damage(run, "--rails", "--rail-material", "R350HT")
    assert rows == alone
    out = max(tmp_path.glob("out-*"), key=lambda path: path.stat().st_mtime_ns)
    found = pyarrow.csv.read_csv(out / "rails.csv").to_pylist()
    assert [(row["element"], row["rail"]) for row in found] == [("straight", "left"), ("straight", "right")]
    assert found[0]["worn_area_mm2_per_MGT"] == pytest.approx(found[1]["worn_area_mm2_per_MGT"])
    # one passing of one wheel on the rail is one revolution of it, by the ratio of hardness (ER7: 235 HB)
    turns_per_km = 1e3 / (2.0 * math.pi * 0.4575)
    area = alone[0]["worn_area_mm2_per_km"] / turns_per_km * 235 / 370
    passings = 1e6 / found[0]["vehicle_mass_t"]
    assert found[0]["worn_area_mm2_per_MGT"] == pytest.approx(area * passings, rel=1e-6)
    assert "Damage of the rails in 100 MGT by element of the track" in printed
    assert "rails: R350HT; a million gross tonnes (MGT) are" in printed
    assert (out / "rail_wear.png").is_file()
    refused = call("damage", run, "--rails", "--rail-material", "R400")
    assert refused.exit_code == 2
    assert "rail material 'R400' is not known" in refused.stderr
