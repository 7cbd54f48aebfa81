"""Tangential contact: creep forces, tractions and slip of a rolling patch, by any theory through one call.

==================  =================================================================================
`api`               `creep_force` and `traction_field`: one signature for all theories
`registry`          a record of every theory, and the kernels that call them
`kalker`            creep coefficients of the linear theory
`linear`            Kalker's linear theory
`carter`            line contact, 1926
`strip`             Haines and Ollerton 1963, Kalker 1967: every strip a line contact
`polach`            Polach's closed formulas, 1999
`fastsim`           Kalker's simplified theory, 1982
`fastsim_march`     its march over eight strips at once
`fastrip`           Sichani, Enblom and Berg, 2016: strip theory with FASTSIM directions (kernels)
`fastrip_theory`    its formulas, strip by strip
`strips`            a patch of any shape as strips
`given`             creep coefficients and conicity as a reference model states them
`curves`            creep force over one creepage by several theories
`validation`        errors of all theories against the exact solution
==================  =================================================================================
"""

from hh_exudyn.contact.tangential.api import (
    CreepForce,
    TractionField,
    cell_areas,
    creep_force,
    traction_field,
)
from hh_exudyn.contact.tangential.registry import THEORIES

__all__ = ["THEORIES", "CreepForce", "TractionField", "cell_areas", "creep_force", "traction_field"]
