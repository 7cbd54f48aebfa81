"""Sections of tracks that several tests run on, as a case states them."""

from typing import Any

Sections = list[dict[str, Any]]


def straight(length: float, gauge: float = 1435.0) -> Sections:
    """Straight track of a length [m] and a gauge [mm]."""
    return [{"kind": "straight", "length_m": length, "gauge_mm": gauge}]


def into_left_curve(lengths: tuple[float, float, float], radius: float, gauge: float) -> Sections:
    """Straight, transition and left-hand curve of the lengths [m]; radius [m], gauge [mm], cant 65 mm."""
    curve = {"kind": "curve", "radius_m": radius, "hand": "left", "cant_mm": 65.0, "gauge_mm": gauge}
    return [
        *straight(lengths[0], gauge),
        {"kind": "transition", "length_m": lengths[1]},
        curve | {"length_m": lengths[2]},
    ]
