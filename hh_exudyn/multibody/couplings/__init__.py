"""Suspension elements of a vehicle: forces and moments between two bodies (kernels).

====================  ==================================================================================
`family`              parts of a family of couplings: numbers, motion, condition, reaction, law
`dispatch`            the table `FAMILIES`, and all couplings of a vehicle in one kernel
`general`             pads, axle boxes, bushings, rods, bump stops
`three_piece_bogie`   spring nests, wedges, centre plates, side bearers
`passenger_bogie`     axle-box arms, dampers by a table, dampers in series with a spring
`freight`             Lenoir suspension (Y25), UIC double link
====================  ==================================================================================

A new coupling is a description in `vehicles.couplings`, a file here with its numbers and its law, and one
line in `FAMILIES`.
"""
