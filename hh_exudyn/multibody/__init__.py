"""The only importer of Exudyn: vehicle and track descriptions become a multibody system and are run.

===================  ==================================================================================
`model`              layout of the coordinates, everything constant, and the kernel's work space
`vectors`            three-vectors and rotations inside kernels
`couplings`          all suspension elements of a vehicle in one kernel
`general_couplings`  force laws of pads, axle boxes, bushings, rods, bump stops
`bogie_couplings`    force laws of spring nests, wedges, centre plates, side bearers
`hysteresis`         force over deflection of a bogie's friction elements in slow cycles
`system`             `evaluate`: all forces of a vehicle on its track
`assembly`           descriptions -> model -> Exudyn system
`equilibrium`        rest on straight track, before the run
`rolling`            the state of a vehicle that rolls in one place: drawn, moved, kept
`settling`           its damped motion, where no root search finds the equilibrium
`remaining`          which force keeps a vehicle out of equilibrium, and where
`inertia`            mass matrix and gyroscopic moments
`linear`             modes, their way over speed, linear critical speed
`hunting`            motion in time after a disturbance: amplitude, growth, frequency
`nonlinear_speed`    nonlinear critical speed: down from a limit cycle until hunting dies out
`stability`          the largest time step that the explicit integration bears
`control`            controllers in the loop: driver and steering of a vehicle with drives
`brakes`             shoes on the treads: thrust, friction, reaction on the side frames
`watch`              reasons to stop a run
`interruption`       Ctrl-C while Exudyn integrates
`recording`          rows of the logs
`simulate`           `simulate(case, directory)`
`once`               `simulate_once`, for studies that are begun again: finished runs are found
===================  ==================================================================================
"""

try:
    import exudyn as _exudyn  # noqa: F401
except ImportError as error:
    raise ImportError(
        f"Exudyn cannot be loaded: {error}. On a machine without a desktop, install the OpenGL library (on "
        "Debian: apt-get install libgl1)"
    ) from error
