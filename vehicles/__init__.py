"""Vehicles as frozen descriptions: bodies, couplings and parameters with their source. No Exudyn here.

====================  ================================================================================
`description`         bodies, wheelsets, vehicles: the drawing
`couplings`           what lies between two bodies: springs, rods, stops, wedges, plates
`soundness`           what no part of a vehicle may have
`parameters`          parameter files, in which every number has its unit and its source
`three_piece_bogie`   bolster, side frames, wheelsets and what couples them
`wagon`               the LKAB iron-ore wagon, one unit or the pair with drawbar
`suspended_wheelset`  reference: the smallest model that hunts, with its closed form
`cooperrider`         reference: Cooperrider's bogie
`manchester`          reference: vehicle 1 of the Manchester benchmarks
`locomotive`          LKAB's IORE locomotive: six driven wheelsets with nose-suspended motors
`traction`            what drives can give; control of speed, slip and over-slip
`train`               resistance, grades, curves and inertia of what hangs on the rear coupler
`driver`              the driver: these laws together, from sample to sample
`steering`            active steering of wheelsets by their axle boxes
`control`             what a controller may measure and move
`catalogue`           the vehicles by name
`variants`            a vehicle with some numbers changed, said in a small file
`statics`             axle loads of a vehicle at rest
`stored`              a vehicle as JSON, which every run keeps of its own
`start`               where a vehicle stands on its track when a run begins
`force_laws`          two-stage springs, stops, dry friction, wedges: kernels of plain numbers
====================  ================================================================================
"""
