"""The only importer of Exudyn: vehicle and track descriptions become a multibody system and are run.

===============  ===================================================================================
`model`          layout of the coordinates; the constant model, its inputs, and the kernel's work space
`assembly`       descriptions -> model
`exudyn_system`  model -> Exudyn system, open to other Exudyn items
`extension`      a user's own items in it, and the state of all
`vectors`        three-vectors and rotations inside kernels
`couplings`      folder: forces of the suspension elements between two bodies
`brakes`         shoes on the treads: thrust, friction, reaction on the side frames
`system`         `evaluate`: all forces of a vehicle on its track
`equilibrium`    rest on straight track, before the run
`rolling`        state of a vehicle that rolls in one place: the unknowns of the equilibrium
`settling`       its damped motion, where no root search finds the equilibrium
`bending_body`   a body of beam elements, as an extension
`extended_rest`  the start of a run, settled in time where there is an extension
`remaining`      largest residual force of a vehicle out of equilibrium, and its place
`linear`         folder: modes, stability and hunting about the equilibrium
`control`        controllers in the loop: driver and steering of a vehicle with drives
`watch`          derailment, divergence, a step too large: reasons to stop a run
`chatter`        wheels whose contact jumps from place to place, counted in windows
`climb`          wheels that rise from their rail, or run on the flange alone
`interruption`   Ctrl-C and SIGTERM while Exudyn integrates
`viewer`         Exudyn's own renderer on the system of a run
`recording`      rows of the logs
`checkpoint`     state of a run between two segments of its integration, to resume from
`provenance`     what a run was made from and with
`integration`    the time integration of a run: Exudyn's callbacks
`simulate`       `simulate(case, directory)`
`built`          `build(case)`: the system before `Assemble()`, in its user's hands
`once`           `simulate_once`: finished runs of a study are reused
`many`           `simulate_many`: a pool of processes, a folder for each case
`hysteresis`     force over deflection of a bogie's friction elements in slow cycles
`free_wheelset`  a wheelset that nothing guides, on cones
`validation`     vehicles against closed forms and outside numbers, as rows of `hh-exudyn validate`
`gz18_curve`     GZ18 against SIMPACK in a curve, among these rows
===============  ===================================================================================
"""

try:
    import exudyn as _exudyn  # noqa: F401
except ImportError as error:
    raise ImportError(
        f"Exudyn cannot be loaded: {error}. On a machine without a desktop, install the OpenGL library (on "
        "Debian: apt-get install libgl1)"
    ) from error

from hh_exudyn.multibody.built import build

__all__ = ["build"]
