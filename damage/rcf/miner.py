"""Miner's sum of surface fatigue: damage of a place per revolution, after Kabo.

E. Kabo's relation FI = 1.78 N_f^(-1/4) (Hossein-Nia 2018, equation 3.18) gives N_f revolutions to failure;
by Miner's rule a revolution takes 1/N_f = (FI/1.78)^4 = FI^4 / 10.04 of the life (3.19), failure at 1.

Kabo's tests were judged by the index of the whole patch, FI_surf: `WheelSurface.global_crack_damage`. Ekberg
puts the largest local index of each strip in its place (3.20): `WheelSurface.crack_damage`. In full slip the
two agree in the patch's middle; beside it, and in partial slip, they differ.
"""

from hh_exudyn.kernel import kernel

KABO_FACTOR = 1.78


@kernel
def kabo_damage(fatigue_index: float) -> float:
    """Damage per revolution at a fatigue index FI [-], failure at 1; 0 up to an index of 0 (kernel).

    Parameters
    ----------
    fatigue_index
        FI of the revolution [-].
    """
    if not fatigue_index > 0.0:
        return 0.0
    square = (fatigue_index / KABO_FACTOR) ** 2
    return square * square
