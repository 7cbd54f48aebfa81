"""Contact states by their equivalent ellipses: each is solved once, for its wheel and for its rail."""

from damage.log_input.states import ContactStates, patch_of
from damage.patch_strips import ellipse_strips, place_strips
from damage.rails.side import RailSide, add_to_rail
from damage.surface.contact_sums import Placed, Solving, Sums, Work, add_patch, turning_of, wear_factor
from damage.surface.patch_field import patch_field
from hh_exudyn.kernel import kernel


@kernel
def add_states(
    states: ContactStates, placed: Placed, solving: Solving, work: Work, sums: Sums, rail: RailSide
) -> None:
    """Add the states of a wheel, each by its equivalent ellipse, to its sums (kernel, allocates nothing).

    Parameters
    ----------
    states, placed
        (n,) contact states of the wheel; every patch lies on the grids.
    solving
        Theory, steel, wear law and bins.
    work
        Work space.
    sums
        Result, added to.
    rail
        The rail below the wheel, added to where it is wanted.
    """
    for row in range(placed.part.size):
        if states.normal_force[row] <= 0.0:
            continue  # contact without force: no pressure, no wear, no fatigue
        patch, part = patch_of(states, row, solving.elastic), placed.part[row]
        turning = turning_of(states, row, placed.interval[row], placed.fatigue_index[row])
        area = ellipse_strips(patch, work.strips)
        across = -states.side[row] * placed.stretch[row]
        place_strips(patch.b, placed.position[row], across, part, work.strips)
        work.strips.wear_factor[:] = wear_factor(states, placed, row, states.contact_angle[row], solving)
        sums.pressure_by_part[part] = max(sums.pressure_by_part[part], states.p_max[row])
        if turning.rolled > 0.0:
            patch_field(solving.theory, patch, states.force_x[row], states.force_y[row], work.fields)
        add_patch(patch, area, work.strips, work.fields, turning, solving, work, sums)
        if rail.wanted:
            across = -states.side[row] * rail.placed.stretch[row]
            place_strips(patch.b, rail.placed.position[row], across, part, rail.strips)
            add_to_rail(rail, row, patch, area, rail.strips, work.fields, turning, work)
