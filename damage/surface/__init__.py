"""Sums over contact states on a grid fixed to the wheel.

=================  ==================================================================================
`wheel_surface`    the sums of one wheel: they add, scale and weigh
`lateral_grid`     the bins of the grid, along the arc of the profile
`accumulate`       the loop over the contact states, chunk by chunk
`contact_sums`     kernel: sums of the contact states of one chunk
`patch_field`      pressure, traction and slip of a state on the cells of its patch
=================  ==================================================================================
"""
