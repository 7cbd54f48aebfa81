"""Wear of the wheel: every law through one call.

A law is made by name and then used like any other, on a batch of contact states or in the sums over a log:

    law = wear_law("archard", surface="lubricated")
    depths = wear_depths(law, states)          # `damage.wear.batch`

===============  ==================================================================================
`laws`           a record per law, those of other packages included; `wear_law` makes one by name
`law`            `WearLaw`: a kernel and its numbers
`batch`          `wear_depths`: many contact states by any law
`energy`         wear number, and the energy that friction dissipates in the cells
`archard`        Archard: depth from pressure and sliding distance, cell by cell
`jendel`         its wear coefficient over sliding velocity and pressure
`british_rail`   British Rail: worn area from the wear number
`usfd`           Sheffield: wear number over contact area; Ward's cells
`krause_poll`    Krause and Poll: volume from work and power density
`films`          lubricant of a run: wear over that of dry steel, by place, wheel and zone
`rate`           piecewise linear rates of the energy laws
`wear_ratio`     depth over energy per lateral position, to spare full steps
===============  ==================================================================================

Every number of a law lies with its source in ``damage/data/wear.toml``.
"""
