"""The normal contact by which damage solves the patches of a log: names, defaults, what goes together."""

import math

from damage.surface.patch_field import DAMAGE_THEORIES, theory_number
from hh_exudyn.contact.normal.registry import COUPLED_STRIPS
from hh_exudyn.contact.types import WheelRailModel

STRIPS, ELLIPSE, HALFSPACE = "strips", "ellipse", "halfspace"
NORMAL_CONTACTS = {
    STRIPS: "coupled strips of the run, rebuilt from its poses",
    ELLIPSE: "equivalent ellipses of the log",
    HALFSPACE: "exact half-space between the profiles of the run",
}
"""Normal contacts of damage: name to meaning."""


def chosen_contact(normal: str | None, theory: str | None, contact: WheelRailModel | None) -> tuple[str, str]:
    """Normal contact and tangential theory, where either or both may be left open.

    Without a choice: the strips of a run that was made with coupled strips, with FaStrip; else ellipses with
    FaStrip. A theory other than FaStrip goes with ellipses, the half-space with the profiles where there are
    any.

    Parameters
    ----------
    normal
        One of `NORMAL_CONTACTS`, or None.
    theory
        One of `damage.surface.patch_field.DAMAGE_THEORIES`, or None.
    contact
        Profiles and theory of the run, or None.

    Raises
    ------
    ValueError
        An unknown name, or a choice that does not go together.
    """
    if theory is not None:
        theory_number(theory)
    if normal is None:
        if contact is not None and theory == HALFSPACE:
            normal = HALFSPACE
        elif contact is not None and contact.normal == COUPLED_STRIPS and theory in (None, "fastrip"):
            normal = STRIPS
        else:
            normal = ELLIPSE
    if normal not in NORMAL_CONTACTS:
        raise ValueError(f"normal = {normal!r}; known: {', '.join(NORMAL_CONTACTS)}")
    chosen = theory or (HALFSPACE if normal == HALFSPACE else "fastrip")
    check_contact(normal, chosen, contact, math.inf)
    return normal, chosen


def check_contact(normal: str, theory: str, contact: WheelRailModel | None, pressure_limit: float) -> None:
    """Raise ValueError where normal contact, theory, profiles and pressure limit do not go together.

    Parameters
    ----------
    normal
        One of `NORMAL_CONTACTS`.
    theory
        One of `damage.surface.patch_field.DAMAGE_THEORIES`.
    contact
        Profiles and theory of the run, or None.
    pressure_limit
        [Pa].
    """
    if normal not in NORMAL_CONTACTS:
        raise ValueError(f"normal = {normal!r}; known: {', '.join(NORMAL_CONTACTS)}")
    theory_number(theory)
    if normal != ELLIPSE and contact is None:
        raise ValueError(
            f"normal = {normal!r} needs the profiles of the run (contact); a log alone has ellipses"
        )
    if normal == STRIPS and contact is not None and contact.normal != COUPLED_STRIPS:
        raise ValueError(
            "normal = 'strips': the run was made without coupled strips; allowed: ellipse, halfspace"
        )
    allowed = {STRIPS: ("fastrip",), ELLIPSE: tuple(DAMAGE_THEORIES), HALFSPACE: (HALFSPACE,)}[normal]
    if theory not in allowed:
        raise ValueError(f"normal = {normal!r} goes with theory {', '.join(allowed)}, not {theory!r}")
    if not pressure_limit > 0.0:
        raise ValueError(f"pressure_limit = {pressure_limit} Pa must be > 0 Pa")
    if pressure_limit < math.inf and normal != HALFSPACE:
        raise ValueError(
            f"pressure_limit = {pressure_limit * 1e-6:g} MPa needs normal = 'halfspace', not {normal!r}"
        )
