"""Springs that are loaded on the drawing: how far a preload has compressed them there."""


def require_preload(what: str, preload: float) -> None:
    """Refuse a load on the drawing below zero, of an element that cannot pull.

    Parameters
    ----------
    what : kind and name of the element
    preload : [N]

    Raises
    ------
    ValueError
        It is below zero.
    """
    if not preload >= 0.0:
        raise ValueError(f"{what}: preload {preload} N must be >= 0, as it cannot pull")


def two_stage_compression(
    load: float, first_stiffness: float, second_stiffness: float, second_from: float
) -> float:
    """Compression of `force_laws.two_stage_spring` under a load [m].

    Parameters
    ----------
    load : [N], >= 0; without one there is no compression
    first_stiffness, second_stiffness, second_from : [N/m], [N/m], [m]
    """
    if load <= 0.0:
        return 0.0
    first = first_stiffness * second_from
    return load / first_stiffness if load <= first else second_from + (load - first) / second_stiffness
