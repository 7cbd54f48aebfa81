"""Steels of wheels and rails: strengths and elastic constants.

The numbers of the wheel steels stand with their sources in ``damage/data/materials.toml``
(`material_parameters`); those of the rails, of the same form, belong to `damage.rails.steel`.
"""

import math
from dataclasses import dataclass

from damage.bounds import check_above_zero
from damage.parameters import parameters, table_names
from hh_exudyn.contact.material import STEEL, Material
from hh_exudyn.sourced import Parameter

CRITERIA = {
    "von_mises": (1.0 / math.sqrt(3.0), "yield strength / sqrt 3, after von Mises"),
    "tresca": (0.5, "yield strength / 2, after Tresca"),
}
"""Yield criteria: shear yield strength over tensile yield strength, in numbers and in words.

Table 3-2 of Hossein-Nia (2018) is reproduced by von Mises (ER7: 300 MPa), while equation 3.1 there is
Tresca's (260 MPa).
"""

_GIVE = {  # strength that a model needs: arguments of a material that give it
    "yield_strength": "yield_strength [Pa]",
    "tensile_strength": "tensile_strength [Pa]",
    "hardness": "hardness [Pa]",
    "shear_yield": "yield_strength or measured_shear_yield [Pa]",
}
_PASCAL = {"MPa": 1e6, "HB": 9.80665e6}  # Brinell hardness is in kgf/mm^2


@dataclass(frozen=True)
class WheelMaterial:
    """A steel of wheels or rails.

    Unknown strengths are None; a model that needs one raises ValueError.

    Attributes
    ----------
    name
        Name of the grade.
    yield_strength
        Tensile yield strength [Pa], > 0.
    elastic
        Elastic constants of wheel and rail.
    tensile_strength
        Ultimate tensile strength [Pa], at least the yield strength.
    hardness
        Hardness as a pressure [Pa]: the Brinell number times 9.80665 MPa.
    criterion
        Yield criterion by which the shear yield strength follows from the yield strength, one of `CRITERIA`.
    measured_shear_yield
        Measured shear yield strength (torsion, cyclic tests) [Pa]; it has precedence over the criterion.

    Raises
    ------
    ValueError
        A strength that is not finite and above zero, a tensile strength below the yield strength, an unknown
        criterion.
    """

    name: str
    yield_strength: float | None = None
    elastic: Material = STEEL
    tensile_strength: float | None = None
    hardness: float | None = None
    criterion: str = "von_mises"
    measured_shear_yield: float | None = None

    def __post_init__(self) -> None:
        for quantity in ("yield_strength", "tensile_strength", "hardness", "measured_shear_yield"):
            value = getattr(self, quantity)
            if value is not None:
                check_above_zero(quantity, value, "Pa")
        if self.yield_strength and self.tensile_strength and self.tensile_strength < self.yield_strength:
            raise ValueError(
                f"tensile_strength = {self.tensile_strength} Pa must be at least the yield strength, "
                f"{self.yield_strength} Pa"
            )
        if self.criterion not in CRITERIA:
            raise ValueError(f"criterion = {self.criterion!r}; allowed: {', '.join(CRITERIA)}")

    @property
    def shear_yield(self) -> float:
        """Yield strength in pure shear k [Pa]; its derivation: `shear_yield_derivation`.

        Raises ValueError where neither it nor the yield strength is known.
        """
        return self.require("shear_yield", "every index of rolling contact fatigue")

    @property
    def shear_yield_derivation(self) -> str:
        """Derivation of the shear yield strength, in words."""
        return "measured" if self.measured_shear_yield is not None else CRITERIA[self.criterion][1]

    def require(self, quantity: str, model: str) -> float:
        """A strength that a model requires [Pa].

        Parameters
        ----------
        quantity
            "yield_strength", "tensile_strength", "hardness" or "shear_yield".
        model
            Model that needs it, for the message: "Archard's law".

        Raises
        ------
        ValueError
            The material does not have it (names material, quantity and model), or there is no such quantity.
        """
        if quantity not in _GIVE:
            raise ValueError(f"a wheel material has no {quantity!r}; it may have: {', '.join(_GIVE)}")
        value: float | None
        if quantity == "shear_yield":
            value = self.measured_shear_yield
            if value is None and self.yield_strength is not None:
                value = CRITERIA[self.criterion][0] * self.yield_strength
        else:
            value = getattr(self, quantity)
        if value is None:
            raise ValueError(
                f"material {self.name!r} has no {quantity}, which {model} needs: give it {_GIVE[quantity]}"
            )
        return value


def wheel_materials() -> tuple[str, ...]:
    """Names of all grades."""
    return table_names("materials")


def material_parameters(name: str) -> dict[str, Parameter]:
    """Numbers of a grade with their sources. Raises ValueError for an unknown one (lists the known)."""
    known = wheel_materials()
    if name not in known:
        raise ValueError(f"wheel material {name!r} is not known; known: {', '.join(known)}")
    return parameters("materials", name)


def wheel_material(name: str) -> WheelMaterial:
    """The grade of that name. Raises ValueError for an unknown one (lists the known)."""
    return named_material(name, "materials", "wheel")


def named_material(name: str, file: str, of: str) -> WheelMaterial:
    """A steel of one of the files of steels.

    Parameters
    ----------
    name
        Of the grade.
    file
        In ``damage/data``, without its ending.
    of
        "wheel" or "rail", for messages.

    Raises
    ------
    ValueError
        An unknown grade (lists the known).
    """
    known = table_names(file)
    if name not in known:
        raise ValueError(f"{of} material {name!r} is not known; known: {', '.join(known)}")
    numbers = {quantity: x.value * _PASCAL[x.unit] for quantity, x in parameters(file, name).items()}
    return WheelMaterial(
        name,
        numbers.get("yield_strength"),
        tensile_strength=numbers.get("tensile_strength"),
        hardness=numbers.get("hardness"),
    )


ER7 = wheel_material("ER7")
ER8 = wheel_material("ER8")
ER9 = wheel_material("ER9")
