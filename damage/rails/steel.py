"""Rail steels, and the wear law of a rail beside that of the wheels on it.

Numbers and sources stand in ``damage/data/rail_materials.toml``, and in the table ``rail`` of ``wear.toml``.
"""

from dataclasses import replace

from damage.material import WheelMaterial, named_material
from damage.parameters import parameters, table_names
from damage.wear.archard import archard_on_rail
from damage.wear.law import WearLaw

FILE = "rail_materials"


def rail_materials() -> tuple[str, ...]:
    """Names of all rail steels."""
    return table_names(FILE)


def rail_material(name: str) -> WheelMaterial:
    """The rail steel of that name. Raises ValueError for an unknown one (lists the known)."""
    return named_material(name, FILE, "rail")


R260 = rail_material("R260")
R350HT = rail_material("R350HT")


def rail_law(law: WearLaw, wheel: WheelMaterial, rail: WheelMaterial) -> WearLaw:
    """The wear law of a rail, from that of the wheels.

    Archard's takes the rail's hardness, and its coefficients ``coefficient_ratio`` of ``wear.toml``; seizure
    begins where the softer of both seizes. A law whose hardness the caller named, and one without, is the
    same for both bodies: the energy laws were fitted on wheels.

    Parameters
    ----------
    law
        Of the wheels, before it has taken the hardness of their steel.
    wheel, rail
        Steels; a hardness that is not known leaves the law as it is.
    """
    if law.for_hardness is None or rail.hardness is None:
        return law
    softer = rail.hardness if wheel.hardness is None else min(wheel.hardness, rail.hardness)
    ratio = parameters("wear", "rail")["coefficient_ratio"].value
    return replace(law.on(rail.hardness), numbers=archard_on_rail(law.on(rail.hardness), softer, ratio))
