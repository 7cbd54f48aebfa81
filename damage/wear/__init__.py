"""Wear of the wheel: every law through one call.

A law is made by name and then used like any other, on a batch of contact states or in the accumulation:

    law = wear_law("archard", surface="lubricated")
    depths = wear_depths(law, states)          # `damage.wear.batch`

============================  ======================================================================
`damage.wear.laws`            `wear_law`: a law by name
`damage.wear.batch`           `wear_depths`: many contact states by any law
`damage.wear.energy`          wear number, and the energy that friction dissipates in the cells
`damage.wear.archard`         Archard: depth from pressure and sliding distance, cell by cell
`damage.wear.jendel`          its wear coefficient over sliding velocity and pressure
`damage.wear.british_rail`    British Rail: worn area from the wear number
`damage.wear.usfd`            Sheffield: wear number over contact area; Ward's cells
`damage.wear.krause_poll`     Krause and Poll: volume from work and power density
`damage.wear.wear_ratio`      depth over energy per lateral position, to spare full steps
`damage.wear.law`             what a law is
`damage.wear.rate`            piecewise linear rates of the energy laws
`damage.wear.strip_wear`      the one kernel: depth per strip of a patch, whatever the law
`damage.wear.values`          a law as the kernels take it
============================  ======================================================================

Every number of a law lies with its source in ``damage/data/wear.toml``.
"""
