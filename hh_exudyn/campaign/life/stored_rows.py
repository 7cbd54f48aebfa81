"""The rates of every single case of a campaign's last evaluation, as they lie on disk: nothing is run.

The folder of results is not opened: another process may go on with the campaign meanwhile, and results of
older code are read as they are.
"""

from pathlib import Path

from hh_exudyn.campaign.engine.results import ResultFolder
from hh_exudyn.campaign.life.campaign import RESULTS, Campaign
from hh_exudyn.campaign.life.evaluation import GroupRatesByCase, recorded_rates


def rows_of_last_evaluation(campaign: Campaign) -> GroupRatesByCase:
    """Weighted cases with their rates by group of wheels; failed cases are left out.

    Parameters
    ----------
    campaign
        With a step at least.

    Raises
    ------
    ValueError
        No step has been made yet, or there is no record of its last evaluation.
    FileNotFoundError, BrokenFile
        A result is gone, or is not what was written.
    """
    made = [end.evaluation for end in campaign.files.ends() if end.evaluation]
    if not made:
        raise ValueError(f"{campaign.directory}: no step has been made yet; run the campaign first")
    folder = ResultFolder(Path(campaign.directory) / RESULTS, "", {})  # read, never entered
    return recorded_rates(campaign.plan, campaign.directory, folder, made[-1])
