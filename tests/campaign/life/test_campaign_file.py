"""The tables of a campaign's file beside the load collective, and what is refused."""

import errno
from pathlib import Path

import pytest
from typer.testing import CliRunner

from hh_exudyn.campaign.collective import template_text
from hh_exudyn.campaign.engine.mapping import TooManyFailed
from hh_exudyn.campaign.engine.workers import EngineStopped
from hh_exudyn.campaign.life.campaign import Campaign
from hh_exudyn.campaign.life.plan import CampaignPlan, campaign_of_text, read_campaign
from hh_exudyn.cli.app import app

EXAMPLES = Path(__file__).parents[3] / "examples" / "campaigns"
LIMITS = '\n[limits]\nof = "iore_wagon"\ntargets = ["WP4_like"]\n'


def plan_with(tables: str) -> CampaignPlan:
    return campaign_of_text(template_text() + tables, "campaign.toml", Path())


def test_without_tables_the_defaults_hold() -> None:
    plan = plan_with("")
    assert plan.grouping.kind == "axle_role"
    assert plan.workshop is None
    assert plan.replicates == 1
    assert len({item.stratum.replicate for item in plan.of_steps.strata}) == 1
    assert sum(item.weight for item in plan.of_steps.strata) == pytest.approx(1.0)


def test_tables_are_read() -> None:
    text = '\n[wheels]\ngroups = "axle"\nturns_round = false\n[damage]\nlaw = "usfd"\nmaterial = "ER9"\n'
    step = '[step]\nprofile_um = 5.0\nlongest_km = 1000.0\nunmoved_um = 0.0\nsource = "assumed: a test"\n'
    plan = plan_with(text + LIMITS + step)
    assert (plan.grouping.kind, plan.grouping.turns_round) == ("axle", False)
    assert (plan.damage.law, plan.damage.material) == ("usfd", "ER9")
    assert plan.workshop is not None
    assert plan.workshop.limits.least_diameter == pytest.approx(0.857)
    assert (plan.step.profile, plan.step.max_distance, plan.unmoved) == pytest.approx((5e-6, 1e6, 0.0))
    assert any(number.name == "step.profile_um" for number in plan.numbers)


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ('\n[wheels]\ngroups = "bogie"\n', "wheels.groups = 'bogie': allowed all, axle, role"),
        ('\n[wheels]\ngroup = "axle"\n', "wheels.group"),
        ('\n[damage]\nlaw = "archart"\n', "damage.law = 'archart': allowed"),
        ('\n[limits]\nof = "iore_wagon"\n', "limits.targets is missing: allowed a list of wheel profiles"),
        ('\n[step]\nprofile_um = -1.0\nsource = "assumed: x"\n', r"step.profile_um = -1 um: allowed 0.1 to"),
        ("\n[step]\nprofile_um = 5.0\n", "source"),
        ("\n[stepp]\n", "stepp"),
    ],
)
def test_faults_name_file_key_and_what_is_allowed(tables: str, message: str) -> None:
    with pytest.raises(ValueError, match=message) as fault:
        plan_with(tables)
    assert str(fault.value).startswith("campaign.toml: ")
    assert "\n" not in str(fault.value)


def test_a_folder_of_another_campaign_is_left_alone(tmp_path: Path) -> None:
    file = tmp_path / "a.toml"
    file.write_text(template_text() + LIMITS, encoding="utf-8")
    Campaign.begin(file, tmp_path / "out")
    file.write_text(template_text(), encoding="utf-8")
    with pytest.raises(FileExistsError, match="holds the campaign of another file"):
        Campaign.begin(file, tmp_path / "out")
    with pytest.raises(FileExistsError, match="holds something else"):
        Campaign.begin(file, tmp_path)
    with pytest.raises(ValueError, match="is no folder of a campaign"):
        Campaign(tmp_path)


def test_commands_new_and_status(tmp_path: Path) -> None:
    runner, file = CliRunner(), tmp_path / "new.toml"
    assert runner.invoke(app, ["campaign", "new", str(file)]).exit_code == 0
    plan_of_new = campaign_of_text(file.read_text(encoding="utf-8"), str(file), tmp_path)
    assert plan_of_new.workshop is not None
    again = runner.invoke(app, ["campaign", "new", str(file)])
    assert again.exit_code == 2
    Campaign.begin(file, tmp_path / "out")
    shown = runner.invoke(app, ["campaign", "status", str(tmp_path / "out")])
    assert shown.exit_code == 0
    assert "0 km of 150000 km" in shown.stdout
    wrong = runner.invoke(
        app, ["campaign", "run", str(file), "-o", str(tmp_path / "o2"), "--budget", "2 weeks"]
    )
    assert wrong.exit_code == 2
    assert "as 90s, 30min or 2h" in wrong.stderr


@pytest.mark.parametrize(
    ("name", "distance", "hauls"),
    [("wagon", 150e6, {"rolling", "braking"}), ("locomotive", 50e6, {"up", "level", "down"})],
)
def test_the_campaigns_of_the_examples_are_plans(name: str, distance: float, hauls: set[str]) -> None:
    plan = read_campaign(EXAMPLES / f"{name}.toml")
    collective = plan.collective
    assert collective.plan.distance == distance
    assert {haul.name for running in collective.plan.running for haul in running.hauls} == hauls
    assert collective.evaluation.startswith("one evaluation: 20 runs")
    assert plan.workshop is not None
    assert plan.of_steps.runs == 20
    assert len(collective.cases(collective.replicate()[:2])) == 2


@pytest.mark.parametrize(
    ("end", "code", "message"),
    [
        (OSError(errno.ENOSPC, "No space left on device"), 1, "is kept, and the same command goes on"),
        (FileExistsError("out: made by other code"), 2, "made by other code"),
        (TooManyFailed("3 cases failed"), 3, "3 cases failed"),
        (EngineStopped("the scheduler has gone"), 3, "the scheduler has gone"),
        (KeyboardInterrupt(), 130, "interrupted; "),
        (SystemExit(143), 143, "terminated; "),
    ],
)
@pytest.mark.parametrize("command", ["run", "error"])
def test_what_ends_a_campaign_early_is_one_line_with_its_exit_code(
    command: str, end: BaseException, code: int, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def ending(*arguments: object, **options: object) -> None:
        raise end

    file, out = tmp_path / "a.toml", tmp_path / "out"
    file.write_text(template_text(), encoding="utf-8")
    Campaign.begin(file, out)
    monkeypatch.setattr(Campaign, {"run": "run", "error": "size"}[command], ending)
    given = {"run": ["run", str(file), "-o", str(out)], "error": ["error", str(out), "--runs", "9"]}[command]
    found = CliRunner().invoke(app, ["campaign", *given, "--workers", "1"])
    assert found.exit_code == code
    assert message in found.stderr
    assert "Traceback" not in found.stderr
