"""Parameter files: every number with its unit and its source, `assumed` where it is a guess.

A file is TOML; each entry reads ``name = { value = 1341.0, unit = "kg", source = "published: ..." }`` in a
table named after the part. The source starts with one of `KINDS`, so that a user can list the guesses.
"""

import tomllib
from dataclasses import dataclass
from importlib.resources import files

KINDS = ("published", "derived", "assumed")


@dataclass(frozen=True)
class Parameter:
    """One number of a parameter file."""

    name: str  # "part.quantity"
    value: float
    unit: str
    source: str

    @property
    def kind(self) -> str:
        """How the number is known: one of `KINDS`."""
        return self.source.split(":", 1)[0]


class ParameterSet:
    """The numbers of one file by name, ``parameters["wedge.friction"]`` in the unit of the file."""

    def __init__(self, name: str, parameters: tuple[Parameter, ...]) -> None:
        self.name = name
        self.parameters = parameters
        self._values = {parameter.name: parameter.value for parameter in parameters}

    def __getitem__(self, name: str) -> float:
        try:
            return self._values[name]
        except KeyError:
            raise KeyError(f"{self.name} has no parameter {name!r}; it has {sorted(self._values)}") from None

    def of_kind(self, kind: str) -> tuple[Parameter, ...]:
        """The parameters that are "published", "derived" or "assumed"."""
        return tuple(parameter for parameter in self.parameters if parameter.kind == kind)


def load_parameters(name: str) -> ParameterSet:
    """Read ``vehicles/data/<name>.toml``.

    Raises
    ------
    ValueError
        If an entry lacks value, unit or source, or its source does not start with one of `KINDS`.
    """
    text = files("vehicles").joinpath(f"data/{name}.toml").read_text(encoding="utf-8")
    parameters = []
    for part, entries in tomllib.loads(text).items():
        for quantity, entry in entries.items():
            full = f"{part}.{quantity}"
            missing = {"value", "unit", "source"} - set(entry)
            if missing:
                raise ValueError(f"{name}.toml: {full} lacks {', '.join(sorted(missing))}")
            parameter = Parameter(full, float(entry["value"]), entry["unit"], entry["source"])
            if parameter.kind not in KINDS:
                raise ValueError(
                    f"{name}.toml: source of {full} starts with {parameter.kind!r}; "
                    f"allowed: {', '.join(KINDS)}"
                )
            parameters.append(parameter)
    return ParameterSet(name, tuple(parameters))
