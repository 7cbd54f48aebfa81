"""The body of the ore wagon: an open hopper with sloping ends on a centre sill, and the heap of ore in it.

Built in the drawing frame (x forward from the wagon's middle, y left, z up from the rail tops).
"""

import numpy as np
import trimesh

from hh_exudyn.arrays import FloatArray
from hh_exudyn.playback.shapes.dimensions import WagonDimensions
from hh_exudyn.playback.shapes.meshes import Colour, bar, box, joined, loft, plate

SHEET: Colour = (116, 122, 130)
LINING: Colour = (128, 108, 98)
RIB: Colour = (92, 98, 106)
RIM: Colour = (140, 147, 156)
SILL: Colour = (70, 73, 78)
COUPLER: Colour = (104, 88, 76)
BAND: Colour = (205, 208, 204)
ORE: Colour = (122, 70, 56)

SHEET_THICKNESS = 0.05  # of the drawing, thicker than the steel for visible edges [m]
VERTICAL_END = 0.55  # height of the upright part of the end sheets under the rim [m]
SIDE_BOTTOM = 1.42  # height of the lower end of the upright side sheets and the top of the doors [m]
BOTTOM = 0.62  # lower edge of the discharge doors between the bogies [m]
SLOPE_FOOT = 0.49  # half length of the hopper at SIDE_BOTTOM, over that at the rim
RIBS = 9  # along each side
RIB_DEPTH = 0.09  # the basket width is over the ribs [m]


def hopper(size: WagonDimensions) -> trimesh.Trimesh:
    """The empty car body with underframe and couplers."""
    return joined([*_shell(size), *_ribs(size), *_underframe(size), *_ends(size)])


def ore_heap(size: WagonDimensions, seed: int = 1) -> trimesh.Trimesh:
    """The load: a closed heap with two crowns, lumpy by a fixed seed."""
    half_length = 0.5 * size.basket_length - SHEET_THICKNESS
    half_width = _half_width(size) - SHEET_THICKNESS
    top = size.height - 0.20
    floor = max(top - size.ore_depth, size.height - VERTICAL_END - 0.05)
    x = np.linspace(-half_length, half_length, 61)
    y = np.linspace(-half_width, half_width, 25)
    lumps = np.random.default_rng(seed).normal(0.0, 0.022, (len(x), len(y)))
    crown = 0.50 * np.exp(-(((np.abs(x) - 0.45 * half_length) / (0.42 * half_length)) ** 2))
    profile = np.maximum(0.0, 1.0 - (np.abs(y) / half_width) ** 1.6)
    height = top + crown[:, None] * profile[None, :] + lumps
    height[[0, -1], :] = top
    height[:, [0, -1]] = top
    rings = np.empty((len(x), len(y) + 2, 3))
    rings[:, :, 0] = x[:, None]
    rings[:, :-2, 1] = y
    rings[:, -2:, 1] = (half_width, -half_width)
    rings[:, :-2, 2] = height
    rings[:, -2:, 2] = floor
    mesh = loft(rings, ORE)
    shade = np.random.default_rng(seed + 1).uniform(0.72, 1.18, len(mesh.faces))
    colours = np.clip(np.array(ORE) * shade[:, None], 0, 255).astype(np.uint8)
    mesh.visual.face_colors = np.column_stack([colours, np.full(len(colours), 255, dtype=np.uint8)])
    return mesh


def _levels(size: WagonDimensions) -> FloatArray:
    """Rows (z, half length, half width) of the hopper's outside, from the doors up to the rim [m]."""
    half_length, half_width = 0.5 * size.basket_length, _half_width(size)
    return np.array(
        [
            [BOTTOM, 0.40 * half_length, 0.42 * half_width],
            [SIDE_BOTTOM, SLOPE_FOOT * half_length, half_width],
            [size.height - VERTICAL_END, half_length, half_width],
            [size.height, half_length, half_width],
        ]
    )


def _half_width(size: WagonDimensions) -> float:
    """Half the width over the side sheets [m]."""
    return 0.5 * size.basket_width - RIB_DEPTH


def _slope_height(size: WagonDimensions, x: float) -> float:
    """Height of the sloping end sheet at x, outside [m]."""
    levels = _levels(size)
    return float(np.interp(abs(x), levels[1:3, 1], levels[1:3, 0]))


def _shell(size: WagonDimensions) -> list[trimesh.Trimesh]:
    """The sheets: outside up, over the rim, inside down to the floor."""
    outside = _levels(size)
    inside = outside[::-1] - np.array([0.0, SHEET_THICKNESS, SHEET_THICKNESS])
    inside[-1, 0] += SHEET_THICKNESS
    rings = np.empty((len(outside) + len(inside), 4, 3))
    for ring, (z, length, width) in zip(rings, np.concatenate([outside, inside]), strict=True):
        ring[:] = [(length, width, z), (-length, width, z), (-length, -width, z), (length, -width, z)]
    shell = loft(rings, SHEET)
    inward = np.einsum("ij,ij->i", shell.face_normals[:, :2], shell.triangles_center[:, :2]) < -1e-6
    colours = np.array(shell.visual.face_colors)
    colours[inward, :3] = LINING
    shell.visual.face_colors = colours
    half_length, half_width, z = 0.5 * size.basket_length, _half_width(size), size.height
    rim = [
        box(
            (-half_length - 0.05, side * half_width - 0.06, z - 0.13),
            (half_length + 0.05, side * half_width + 0.05, z),
            RIM,
        )
        for side in (1, -1)
    ]
    rim += [
        box((end * half_length - 0.06, -half_width, z - 0.13), (end * half_length + 0.05, half_width, z), RIM)
        for end in (1, -1)
    ]
    return [shell, *rim]


def _ribs(size: WagonDimensions) -> list[trimesh.Trimesh]:
    """Upright ribs on the sides, a belt, the edge beams along the slopes and a painted band."""
    half_length, half_width = 0.5 * size.basket_length, _half_width(size)
    half = 0.045
    parts = []
    for side in (1, -1):
        y0, y1 = side * (half_width - 0.01), side * (half_width + RIB_DEPTH)
        face = (min(y0, y1), max(y0, y1))
        for x in np.linspace(-0.93 * half_length, 0.93 * half_length, RIBS):
            foot = _slope_height(size, x) + 0.02
            parts.append(box((x - half, face[0], foot), (x + half, face[1], size.height - 0.12), RIB))
        foot = SLOPE_FOOT * half_length
        parts.append(box((-foot, face[0], SIDE_BOTTOM - 0.06), (foot, face[1], SIDE_BOTTOM + 0.06), RIB))
        for end in (1, -1):
            slope = np.array([[end * foot, SIDE_BOTTOM], [end * half_length, size.height - VERTICAL_END]])
            thick = np.array([0.0, 0.07])
            parts.append(plate(slope + thick, slope - thick, face, RIB))
            upright = (end * (half_length - 0.05), end * (half_length + 0.04))
            parts.append(
                box(
                    (min(upright), face[0], size.height - VERTICAL_END - 0.05),
                    (max(upright), face[1], size.height - 0.1),
                    RIB,
                )
            )
        band = (side * (half_width + 0.001), side * (half_width + 0.012))
        for start, width in ((-0.62, 0.9), (0.24, 0.9)):
            parts.append(
                box(
                    (start * half_length, min(band), size.height - 0.62),
                    (start * half_length + width, max(band), size.height - 0.34),
                    BAND,
                )
            )
    return parts


def _underframe(size: WagonDimensions) -> list[trimesh.Trimesh]:
    """Centre sill, cross bearers over the bogies, side sills at the ends, discharge gear."""
    half = 0.5 * size.centre_plate_distance
    end = 0.5 * size.basket_length
    plate_top = size.centre_plate_height
    sill = box((-end - 0.06, -0.19, plate_top + 0.03), (end + 0.06, 0.19, plate_top + 0.40), SILL)
    parts = [sill]
    for x in (half, -half):
        root, tip = plate_top + 0.02, plate_top + 0.24
        stations = ((-1.48, tip), (-0.45, root), (0.45, root), (1.48, tip))
        rings = np.array(
            [
                [
                    (x - 0.2, y, z),
                    (x + 0.2, y, z),
                    (x + 0.2, y, plate_top + 0.42),
                    (x - 0.2, y, plate_top + 0.42),
                ]
                for y, z in stations
            ]
        )
        parts.append(loft(rings, SILL))
        r = size.centre_plate_radius
        parts.append(box((x - r, -r, plate_top), (x + r, r, plate_top + 0.04), COUPLER))
        for side in (1, -1):  # side bearer, upper part
            at = side * size.side_bearer_half_spacing
            parts.append(
                box((x - 0.12, at - 0.08, plate_top - 0.03), (x + 0.12, at + 0.08, plate_top + 0.1), SILL)
            )
    inner = half - 0.5 * size.wheelbase - 0.75
    for x in np.linspace(-inner, inner, 4):  # door beams across
        parts.append(box((x - 0.05, -1.1, BOTTOM - 0.08), (x + 0.05, 1.1, BOTTOM + 0.06), RIB))
    for side in (1, -1):
        y = (side * 0.70, side * 0.78)
        parts.append(box((-inner, min(y), BOTTOM - 0.1), (inner, max(y), BOTTOM + 0.04), RIB))
    return parts


def _ends(size: WagonDimensions) -> list[trimesh.Trimesh]:
    """End platforms, posts and braces under the slopes, ladder, coupler stubs."""
    end = 0.5 * size.basket_length
    floor = size.centre_plate_height + 0.40
    parts = []
    for way in (1, -1):
        x = sorted((way * (SLOPE_FOOT * end + 0.05), way * (end + 0.06)))
        parts.append(box((x[0], -1.52, floor), (x[1], 1.52, floor + 0.05), SILL))
        for side in (1, -1):
            y = sorted((side * 1.52, side * 1.40))
            parts.append(box((x[0], y[0], floor - 0.16), (x[1], y[1], floor + 0.06), SILL))
            corner = (way * (end - 0.02), side * 1.46, floor)
            parts.append(
                bar(corner, (way * (end - 0.02), side * 1.46, size.height - VERTICAL_END), 0.11, RIB)
            )
            middle = 0.5 * (SLOPE_FOOT + 1.0) * end
            parts.append(
                bar(
                    (way * middle, side * 1.46, floor),
                    (way * middle, side * 1.46, _slope_height(size, middle)),
                    0.09,
                    RIB,
                )
            )
            parts.append(
                bar(
                    (way * middle, side * 1.46, floor),
                    (way * (end - 0.05), side * 1.46, size.height - VERTICAL_END - 0.1),
                    0.07,
                    RIB,
                )
            )
            for across in (0.45, 0.95):
                parts.append(
                    bar(
                        (way * (end - 0.10), side * across, size.height - VERTICAL_END),
                        (way * (end - 0.10), side * across, floor),
                        0.06,
                        RIB,
                    )
                )
        x = sorted((way * (end - 0.02), way * (end + 0.10)))
        parts.append(box((x[0], -1.52, floor - 0.28), (x[1], 1.52, floor + 0.05), SILL))
        parts += _ladder(way * (end + 0.09), way * 1.05, floor, size.height - 0.1)
        parts += _coupler(size, way, end)
    return parts


def _ladder(x: float, y: float, foot: float, top: float) -> list[trimesh.Trimesh]:
    """A ladder on an end sheet."""
    rails = [bar((x, y + offset, foot), (x, y + offset, top), 0.035, BAND) for offset in (-0.2, 0.2)]
    steps = np.arange(foot + 0.25, top, 0.3)
    return rails + [bar((x, y - 0.2, z), (x, y + 0.2, z), 0.028, BAND) for z in steps]


def _coupler(size: WagonDimensions, way: int, end: float) -> list[trimesh.Trimesh]:
    """Coupler stub: striker, shank and head, ending at half the length over the couplers."""
    z, tip = size.coupler_height, 0.5 * size.length
    x = sorted((way * (end + 0.05), way * (end + 0.16)))
    shank = sorted((way * (end + 0.1), way * (tip - 0.28)))
    head = np.array(
        [
            [
                (way * station, side * width, z + height)
                for side, height in ((1, -0.15), (1, 0.15), (-1, 0.15), (-1, -0.15))
            ]
            for station, width in ((tip - 0.30, 0.10), (tip - 0.16, 0.21), (tip, 0.17))
        ]
    )
    return [
        box((x[0], -0.24, z - 0.22), (x[1], 0.24, z + 0.2), SILL),
        box((shank[0], -0.085, z - 0.085), (shank[1], 0.085, z + 0.085), COUPLER),
        loft(head, COUPLER),
    ]
