"""Wear of the wheel: every law through one call.

A law is made by name and then used like any other, on a batch of contact states or in the accumulation:

    law = wear_law("archard", surface="lubricated")
    depths = wear_depths(law, states)          # `damage.wear.batch`

============================  ======================================================================
`damage.wear.laws`            `wear_law`: a law by name, as people write it
`damage.wear.jendel`          the wear coefficient's map over sliding velocity and pressure
`damage.wear.archard`         depth from pressure and sliding distance, cell by cell
`damage.wear.energy`          wear number, and the energy that friction dissipates in the cells
`damage.wear.strip_wear`      the one kernel: depth per strip of a patch, whatever the law
`damage.wear.parameters`      every number with its source
`damage.wear.values`          a law as the kernels take it
============================  ======================================================================
"""
