"""Strata and cases with their weights."""

from dataclasses import dataclass

from hh_exudyn.campaign.collective.case_of_stratum import Setting
from hh_exudyn.campaign.collective.plan import Films
from hh_exudyn.campaign.collective.strata import Stratum
from hh_exudyn.campaign.collective.track import EvaluatedPart
from hh_exudyn.case import Case


@dataclass(frozen=True)
class WeightedStratum:
    """A stratum with its share of the distance [-]; `setting` is what its case has beside the labels.

    `mirrored`: on this share left and right are exchanged against the case.
    """

    stratum: Stratum
    weight: float
    mirrored: bool
    setting: Setting


@dataclass(frozen=True)
class WeightedCase:
    """A case with its share of the distance.

    Attributes
    ----------
    case
        Shared with other weighted cases where a run counts for several members: run it once.
    weight
        Share of the collective's distance; all sum to 1.
    stratum
        Labels and values.
    mirrored
        Whether left and right of the run's results are exchanged before they are added: the stretch of line
        is the mirror image of the case. Right for vehicles and wheels without difference of left and right.
    films
        Natural films of the season on the wheel's zones, for `collective.films.wear_films`.
    parts
        Stretches of the track that are evaluated; their shares of the weight sum to 1.
    """

    case: Case
    weight: float
    stratum: Stratum
    mirrored: bool
    films: Films
    parts: tuple[EvaluatedPart, ...]

    @property
    def seed(self) -> int:
        """Seed of the case's irregularity, which depends on the stratum and its replicate alone."""
        return self.stratum.seed
