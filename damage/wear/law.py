"""What a wear law is, whichever it is."""

from dataclasses import dataclass

from damage.wear.values import LawValues


@dataclass(frozen=True)
class WearLaw:
    """A wear law with its numbers; `damage.wear.laws.wear_law` makes it.

    Attributes
    ----------
    name
        One of `values.LAWS`.
    regimes
        What the law calls its regimes, one a column of the strips' depth; further columns stay 0.
    values
        The law for the kernels.
    """

    name: str
    regimes: tuple[str, ...]
    values: LawValues


def require_known(what: str, given: str, known: tuple[str, ...]) -> None:
    """Raise ValueError if a name is not among the known ones."""
    if given not in known:
        raise ValueError(f"{what} = {given!r}; known: {', '.join(known)}")
