"""Motion about the equilibrium: modes, stability, hunting.

=============  ======================================================================================
`modes`        linearisation, modes, root locus, linear critical speed
`inertia`      mass matrix and gyroscopic moments
`hunting`      motion in time after a disturbance, nonlinear critical speed
`stability`    the largest stable time step of the explicit integration
=============  ======================================================================================
"""
