"""The vehicles themselves.

=====================  ===============================================================================
`wagon`                LKAB's iron-ore wagon, one unit or the pair with drawbar
`three_piece_bogie`    its bogie: bolster, side frames, wheelsets and what couples them
`locomotive`           LKAB's IORE locomotive: six driven wheelsets with nose-suspended motors
`suspended_wheelset`   reference: the smallest model that hunts, with its closed form
`cooperrider`          reference: Cooperrider's bogie
`manchester`           reference: vehicle 1 of the Manchester benchmarks
=====================  ===============================================================================
"""
