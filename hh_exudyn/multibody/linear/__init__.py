"""Motion about the equilibrium: modes, stability, hunting.

=================  =================================================================================
`modes`            linearisation, modes, root locus, linear critical speed
`inertia`          mass matrix and gyroscopic moments
`hunting`          motion in time after a disturbance: amplitude, growth, frequency
`nonlinear_speed`  nonlinear critical speed: down from a limit cycle until hunting decays
`stability`        largest stable time step of the explicit integration
=================  =================================================================================
"""
