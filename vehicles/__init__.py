"""Vehicles as frozen descriptions: bodies, couplings and parameters with their source. No Exudyn here.

===================  =====================================================================================
`models`             the vehicles themselves, one file each, with their records
`traction`           drives, driver, train and steering of a vehicle that drives itself
`description`        bodies, wheelsets, vehicles, in the coordinates of the drawing
`couplings`          descriptions of springs, rods, stops, wedges, plates between two bodies; their forces
                     are in `hh_exudyn.multibody.couplings`
`freight_couplings`  those of European freight wagons: Lenoir suspension, double link
`passenger_bogie`    the axle-box arm, and dampers by a table and in series with a spring
`preloads`           springs that are loaded on the drawing
`joining`            which bodies a coupling may join, and in which order
`soundness`          checks of all numbers of a vehicle: finite, of a possible size, everything above the
                     rails and between the ends
`quantities`         plausible ranges of changed numbers, a type for each quantity
`units`              other units of changed numbers
`force_laws`         two-stage springs, stops, dry friction, wedges: kernels of plain numbers
`dampers`            dampers by a table, alone and in series with a spring: kernels of plain numbers
`outline`            a box for every body, for drawings
`record`             the record of a vehicle in the catalogue
`catalogue`          the vehicles by name, those of other packages among them
`whole`              a whole vehicle as a file, written by hand or exported
`variants`           a vehicle with some numbers changed by a small file
`axle_load`          a loaded wagon at another axle load, as such a variant
`statics`            axle loads of a vehicle at rest
`start`              place of a vehicle on its track at the beginning of a run
`stored`             a vehicle as JSON, the copy in every run's folder
===================  =====================================================================================

The numbers of a vehicle stand with their sources in ``data/<name>.toml`` (`hh_exudyn.sourced`).
"""
