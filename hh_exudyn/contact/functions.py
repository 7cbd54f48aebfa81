"""The front of `hh_exudyn.contact.geometry`: contact geometry functions and EN 15302's conicity."""

from hh_exudyn.contact.geometry.conicity import conicity_from_radius_difference
from hh_exudyn.contact.geometry.contact_geometry import (
    SMOOTHING,
    TAPE_DISTANCE,
    ContactFunctions,
    WheelsetFunctions,
    contact_functions,
    wheelset_functions,
)
from hh_exudyn.contact.geometry.functions import (
    CONICITY_STEP,
    contiguous,
    equivalent_conicity,
    rolling_radius_difference,
)

__all__ = [
    "CONICITY_STEP",
    "SMOOTHING",
    "TAPE_DISTANCE",
    "ContactFunctions",
    "WheelsetFunctions",
    "conicity_from_radius_difference",
    "contact_functions",
    "contiguous",
    "equivalent_conicity",
    "rolling_radius_difference",
    "wheelset_functions",
]
