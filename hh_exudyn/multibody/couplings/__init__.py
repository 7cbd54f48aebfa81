"""Suspension elements of a vehicle: forces and moments between two bodies (kernels).

====================  ================================================================================
`dispatch`            all couplings of a vehicle in one kernel
`general`             pads, axle boxes, bushings, rods, bump stops
`three_piece_bogie`   spring nests, wedges, centre plates, side bearers
====================  ================================================================================
"""
