"""All couplings of a vehicle in one kernel: relative motion, force law, forces and torques on both bodies.

A coupling's displacement is that of its point on body B relative to body A, in the axes of A; force and
moment act on B there, and their opposites on A at the same place, so that no coupling makes energy. The laws
themselves: `general_couplings` and `bogie_couplings`.
"""

from hh_exudyn.arrays import FloatArray
from hh_exudyn.kernel import inlined_kernel, kernel
from hh_exudyn.multibody.couplings.general import axle_box, bump_stop, bushing, pad, rod
from hh_exudyn.multibody.couplings.three_piece_bogie import nest, plate, side_bearer, wedge
from hh_exudyn.multibody.model import Couplings, Kind, Workspace
from hh_exudyn.multibody.vectors import Triple, add_to, cross, rotate, rotate_back, triple

_PAD = int(Kind.AXLE_BOX_PAD)
_NEST = int(Kind.SPRING_NEST)
_WEDGE = int(Kind.WEDGE)
_PLATE = int(Kind.CENTRE_PLATE)
_SIDE_BEARER = int(Kind.SIDE_BEARER)
_BUSHING = int(Kind.BUSHING)
_ROD = int(Kind.ROD)
_AXLE_BOX = int(Kind.AXLE_BOX)


@inlined_kernel
def coupling_forces(couplings: Couplings, sliders: FloatArray, settle: bool, work: Workspace) -> None:
    """Add the forces of all couplings to `work.force` and `work.torque`; fill `work.new_sliders`.

    With `settle`, for the static equilibrium, the wedges' friction in the vertical direction is off, and all
    other friction elements stick, whatever their load: where one is unloaded on the way to the equilibrium,
    its slider must not leave the middle.
    """
    for i in range(couplings.kind.size):
        a = couplings.body_a[i]
        b = couplings.body_b[i]
        rotation_a = work.rotation[a]
        arm_b = rotate(work.rotation[b], triple(couplings.point_b[i]))
        arm_a = (
            work.position[b, 0] + arm_b[0] - work.position[a, 0],
            work.position[b, 1] + arm_b[1] - work.position[a, 1],
            work.position[b, 2] + arm_b[2] - work.position[a, 2],
        )
        local = rotate_back(rotation_a, arm_a)
        displacement = (
            local[0] - couplings.point_a[i, 0],
            local[1] - couplings.point_a[i, 1],
            local[2] - couplings.point_a[i, 2],
        )
        swing_a = cross(triple(work.angular_velocity[a]), arm_a)
        swing_b = cross(triple(work.angular_velocity[b]), arm_b)
        rate = rotate_back(
            rotation_a,
            (
                work.velocity[b, 0] + swing_b[0] - work.velocity[a, 0] - swing_a[0],
                work.velocity[b, 1] + swing_b[1] - work.velocity[a, 1] - swing_a[1],
                work.velocity[b, 2] + swing_b[2] - work.velocity[a, 2] - swing_a[2],
            ),
        )
        parameters = couplings.parameters[i]
        kind = couplings.kind[i]
        moment = (0.0, 0.0, 0.0)
        if kind == _PAD:
            force, moment = pad(parameters, displacement, rate, rotation_a, work.rotation[b], work)
        elif kind == _AXLE_BOX:
            force, moment = axle_box(
                parameters,
                displacement,
                rate,
                rotation_a,
                work.rotation[b],
                sliders[i],
                settle,
                work.new_sliders[i],
                work,
            )
        elif kind == _SIDE_BEARER:
            force = side_bearer(parameters, displacement, rate, sliders[i], settle, work.new_sliders[i], work)
        elif kind in (_NEST, _WEDGE, _PLATE, _BUSHING):
            angle = _relative_rotation(rotation_a, work.rotation[b])
            turn = rotate_back(
                rotation_a,
                (
                    work.angular_velocity[b, 0] - work.angular_velocity[a, 0],
                    work.angular_velocity[b, 1] - work.angular_velocity[a, 1],
                    work.angular_velocity[b, 2] - work.angular_velocity[a, 2],
                ),
            )
            if kind == _NEST:
                force, moment = nest(parameters, displacement, rate, angle, turn, work)
            elif kind == _WEDGE:
                force, moment = wedge(
                    parameters,
                    displacement,
                    rate,
                    angle,
                    turn,
                    sliders[i],
                    settle,
                    work.new_sliders[i],
                    work,
                )
            elif kind == _PLATE:
                force, moment = plate(
                    parameters,
                    displacement,
                    rate,
                    angle,
                    turn,
                    sliders[i],
                    settle,
                    work.new_sliders[i],
                    work,
                )
            else:
                force, moment = bushing(parameters, displacement, rate, angle, turn, work)
        elif kind == _ROD:
            force = rod(parameters, displacement, rate, work)
        else:
            force = bump_stop(parameters, displacement)
        force = rotate(rotation_a, force)
        moment = rotate(rotation_a, moment)
        add_to(work.force[b], force, 1.0)
        add_to(work.force[a], force, -1.0)
        add_to(work.torque[b], cross(arm_b, force), 1.0)
        add_to(work.torque[a], cross(arm_a, force), -1.0)
        add_to(work.torque[b], moment, 1.0)
        add_to(work.torque[a], moment, -1.0)


@kernel
def _relative_rotation(rotation_a: FloatArray, rotation_b: FloatArray) -> Triple:
    """Small rotation of B relative to A in the axes of A, from the skew part of RA^T RB [rad]."""
    x = 0.0
    y = 0.0
    z = 0.0
    for k in range(3):
        x += rotation_a[k, 2] * rotation_b[k, 1] - rotation_a[k, 1] * rotation_b[k, 2]
        y += rotation_a[k, 0] * rotation_b[k, 2] - rotation_a[k, 2] * rotation_b[k, 0]
        z += rotation_a[k, 1] * rotation_b[k, 0] - rotation_a[k, 0] * rotation_b[k, 1]
    return 0.5 * x, 0.5 * y, 0.5 * z
