"""Campaigns of made-up wear: their file, and a run in this process."""

import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from made_up_wear import made_up_sums

from hh_exudyn.campaign.collective import template_text
from hh_exudyn.campaign.engine.workers import GivenWorkers
from hh_exudyn.campaign.life.campaign import Campaign

STEP = """
[wheels]
groups = "{groups}"

[limits]
of = "iore_wagon"
targets = ["WP4_like"]

[step]
profile_um = 20.0
pressure_percent = 50.0
longest_km = {longest}
source = "assumed: for a test"
"""


CLASSES = ("<350", "350:400", "400:450", "450:600", "600:800", "800:1000")


def campaign_file(folder: Path, groups: str = "role", longest: float = 4e3) -> Path:
    """A campaign of single wagons with four cases an evaluation."""
    text = template_text("malmbanan", "iore_wagon")
    text = re.sub(r"merged_classes = .*", f"merged_classes = [{list(CLASSES)}]".replace("'", '"'), text)
    text = re.sub(r"\nruns = \d+", "\nruns = 8", text)
    text = re.sub(r"\nhalvings = .*", "", text)
    path = folder / "campaign.toml"
    path.write_text(text + STEP.format(groups=groups, longest=longest), encoding="utf-8")
    return path


def run(campaign: Campaign, kilometres: float, evaluate=made_up_sums) -> bool:
    """Go on to a distance."""
    with ThreadPoolExecutor(1) as threads:
        return campaign.run(GivenWorkers(threads, 1), 1e3 * kilometres, evaluate=evaluate)
