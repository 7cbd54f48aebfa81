"""Sums over contact states on a grid fixed to the wheel, or to the rail (`damage.rails`).

=================  ==================================================================================
`wheel_surface`    the sums of one wheel: they add, scale and weigh
`stored`           surfaces in files: npz with checksum and version
`tables`           surfaces as tables and as arrays with labelled axes; differences of two
`lateral_grid`     the bins of the grid, along the arc of the profile
`normal_contact`   strips of the run, ellipses or half-space: names, defaults, what goes together
`accumulate`       the loop over the contact states, chunk by chunk
`block_sums`       the states of one block, solved for their wheel and for its rail
`contact_sums`     kernel: sums of a solved patch
`ellipse_sums`     kernel: the states of one block by their ellipses
`patch_field`      pressure, traction and slip of a state on the cells of its ellipse
`rebuilt_sums`     kernel: the states of one block by the strips of the run
`halfspace_patch`  states solved again by the half-space
=================  ==================================================================================
"""
