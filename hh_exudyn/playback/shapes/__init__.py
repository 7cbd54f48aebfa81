"""The vehicle and the track as meshes.

====================  ================================================================================
`vehicle`             every body of a vehicle
`wheelset`            axle and wheels, turned from their profile
`three_piece_bogie`   bolster and side frames
`hopper`              body of the ore wagon and its load
`boxy`                bodies of any other vehicle
`dimensions`          dimensions of the ore wagon
`track`               rails, sleepers and ballast along an alignment
`check_rail`          check rails beside them
`meshes`              boxes, bars, turned bodies, coils, colours
====================  ================================================================================
"""
