"""``campaign vary``: what is refused before anything runs, what is printed of variants that ran."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from command_line import call, refused
from made_up_wear import made_up_sums
from small_campaign import small_campaign_file

from hh_exudyn.campaign.engine.workers import GivenWorkers
from hh_exudyn.campaign.variation import run_variants, variants

REFUSED = {
    ("--vary", "gauge"): "--vary gauge: allowed KEY=VALUE",
    ("--vary", "gauge=1440,,1442"): "a value is empty",
    ("--vary", "gauge=1440", "--vary", "gauge=1441"): "gauge is given twice",
    ("--vary", "gauge.devation_mm=3"): "unknown key gauge.devation_mm; did you mean deviation_mm?",
    ("--vary", "wege.friction=0.3"): "did you mean wedge.friction",
    ("--vary", "material=wood"): "allowed ER7, ER8, ER9",
    ("--vary", "axle_load=heavy"): "axle_load = 'heavy' t: allowed 1 to 60 t",
    ("--vary", "material=ER9", "--budget", "soon"): "allowed a time above zero",
    ("--vary", "material=ER9", "--distance-km", "0"): "--distance-km 0 km: allowed 0.001 to",
}


@pytest.mark.parametrize("words", REFUSED, ids=" ".join)
def test_what_is_refused_leaves_nothing(words: tuple[str, ...], tmp_path: Path) -> None:
    path = small_campaign_file(tmp_path)
    assert REFUSED[words] in refused("campaign", "vary", path, *words, "--out", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_variants_that_are_there_are_compared_and_not_run(tmp_path: Path) -> None:
    path, folder = small_campaign_file(tmp_path, groups="all"), tmp_path / "out"
    with ThreadPoolExecutor(1) as threads:
        texts = variants(path, {"material": ["ER7", "ER9"], "case.wheel_profile": ["S1002"]})
        run_variants(texts, folder, GivenWorkers(threads, 1), 1e6, evaluate=made_up_sums)
    result = call(
        "campaign", "vary", path, "--vary", "material=ER7,ER9", "--vary", "case.wheel_profile=S1002",
        "--out", folder, "--distance-km", "1000", "--workers", "1",
    )  # fmt: skip
    assert result.exit_code == 0, result.stderr
    assert "2 of 2 campaigns have run their distance" in result.stdout
    assert "Wheels after 1000.0 km" in result.stdout
    for name in texts:
        assert name in result.stdout
    rows = (folder / "comparison.csv").read_text().splitlines()
    assert len(rows) == 3
    assert rows[0].startswith('"campaign","group","distance_km"')
