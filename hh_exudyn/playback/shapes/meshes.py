"""Solids for the shapes, with colours by face, and their shading with sharp creases.

Boxes, cylinders and turned bodies are trimesh's; lofts, plates and coils are made here. Everything is a
closed `trimesh.Trimesh` with one colour per face, in metres.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
import trimesh
from numpy.typing import NDArray

from hh_exudyn.arrays import FloatArray

Colour = tuple[int, int, int]

_Z_TO_Y = trimesh.transformations.rotation_matrix(-0.5 * np.pi, (1.0, 0.0, 0.0))  # trimesh turns about z

CREASE_ANGLE = np.radians(38.0)  # faces that meet at more than this keep a sharp edge


class Shaded(NamedTuple):
    """A mesh for a renderer: single precision, with normals and colours at the vertices."""

    positions: NDArray[np.float32]  # (n, 3) [m]
    triangles: NDArray[np.uint32]  # (m, 3)
    normals: NDArray[np.float32]  # (n, 3)
    colours: NDArray[np.uint8]  # (n, 4) RGBA


def painted(mesh: trimesh.Trimesh, colour: Colour) -> trimesh.Trimesh:
    """The same mesh with all faces in one colour (0..255 each)."""
    mesh.visual.face_colors = np.tile(np.array([*colour, 255], dtype=np.uint8), (len(mesh.faces), 1))
    return mesh


def joined(meshes: Iterable[trimesh.Trimesh]) -> trimesh.Trimesh:
    """One mesh of many; faces keep their colours, parts stay separate closed surfaces."""
    parts = list(meshes)
    first = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    return trimesh.Trimesh(
        vertices=np.concatenate([part.vertices for part in parts]),
        faces=np.concatenate([part.faces + start for part, start in zip(parts, first, strict=True)]),
        face_colors=np.concatenate([part.visual.face_colors for part in parts]),
        process=False,
    )


def loft(rings: FloatArray, colour: Colour) -> trimesh.Trimesh:
    """The solid through consecutive closed rings of points, both ends closed by a fan.

    Parameters
    ----------
    rings
        (n, m, 3) n rings of m corners each [m]; the last corner joins the first.
    colour
        Of all faces.
    """
    count, corners = rings.shape[:2]
    ring, corner = np.meshgrid(np.arange(count - 1), np.arange(corners), indexing="ij")
    here, there = ring * corners, (ring + 1) * corners
    following = (corner + 1) % corners
    quads = np.stack([here + corner, there + corner, there + following, here + following], axis=-1)
    quads = quads.reshape(-1, 4)
    centre = count * corners
    edge = np.arange(corners)
    over = (edge + 1) % corners
    last = (count - 1) * corners
    faces = [
        quads[:, [0, 1, 2]],
        quads[:, [0, 2, 3]],
        np.stack([np.full(corners, centre), edge, over], axis=-1),
        np.stack([np.full(corners, centre + 1), last + over, last + edge], axis=-1),
    ]
    vertices = [rings.reshape(-1, 3), rings[0].mean(axis=0)[None], rings[-1].mean(axis=0)[None]]
    mesh = trimesh.Trimesh(vertices=np.concatenate(vertices), faces=np.concatenate(faces), process=False)
    return painted(_outwards(mesh), colour)


def _outwards(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The mesh with outward normals."""
    if mesh.volume < 0.0:
        mesh.faces = mesh.faces[:, ::-1]
    return mesh


def box(low: Sequence[float], high: Sequence[float], colour: Colour) -> trimesh.Trimesh:
    """The box between two opposite corners [m]."""
    return painted(trimesh.creation.box(bounds=(low, high)), colour)


def plate(upper: FloatArray, lower: FloatArray, y: tuple[float, float], colour: Colour) -> trimesh.Trimesh:
    """A plate or bar in the x-z plane between an upper and a lower edge, from y[0] to y[1].

    Parameters
    ----------
    upper, lower
        (n, 2) points (x, z) along the two edges, point i of one opposite point i of the other [m].
    y
        The two faces [m].
    colour
        Of all faces.
    """
    rings = np.empty((len(upper), 4, 3))
    for corner, (edge, side) in enumerate(((upper, y[0]), (upper, y[1]), (lower, y[1]), (lower, y[0]))):
        rings[:, corner, 0] = edge[:, 0]
        rings[:, corner, 1] = side
        rings[:, corner, 2] = edge[:, 1]
    return loft(rings, colour)


def bar(start: Sequence[float], end: Sequence[float], width: float, colour: Colour) -> trimesh.Trimesh:
    """A square bar of the given width [m] between two points [m]."""
    first, last = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    length = np.linalg.norm(last - first)
    along = (last - first) / length
    helper = np.array([0.0, 0.0, 1.0]) if abs(along[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    across = np.cross(along, helper)
    across /= np.linalg.norm(across)
    placed = np.eye(4)
    placed[:3, :3] = np.column_stack([along, across, np.cross(along, across)])
    placed[:3, 3] = 0.5 * (first + last)
    return painted(trimesh.creation.box((length, width, width), placed), colour)


def turned(stations: FloatArray, sections: int, colour: Colour) -> trimesh.Trimesh:
    """A solid turned about the y axis.

    Parameters
    ----------
    stations
        (n, 2) pairs (y, radius) along the axis [m].
    sections
        Facets around the axis.
    colour
        Of all faces.
    """
    ends = stations[[0, -1]] * (1.0, 0.0)  # on the axis
    return _revolved(np.concatenate([ends[:1], stations, ends[1:]]), sections, colour)


def turned_ring(outline: FloatArray, sections: int, colour: Colour) -> trimesh.Trimesh:
    """The closed outline (n, 2) of pairs (y, radius) [m] turned about the y axis; it must not meet it."""
    return _revolved(np.concatenate([outline, outline[:1]]), sections, colour)


def _revolved(line: FloatArray, sections: int, colour: Colour) -> trimesh.Trimesh:
    """A line (n, 2) of pairs (y, radius) turned about the y axis."""
    mesh = trimesh.creation.revolve(line[:, ::-1], sections=sections, transform=_Z_TO_Y)
    return painted(_outwards(mesh), colour)


def resampled(line: FloatArray, count: int) -> FloatArray:
    """A line of points (n, 2) as `count` points at equal distances along it."""
    step = np.hypot(*np.diff(line, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(step)])
    where = np.linspace(0.0, along[-1], count)
    return np.column_stack([np.interp(where, along, line[:, 0]), np.interp(where, along, line[:, 1])])


def upright_cylinder(
    centre: Sequence[float], radius: float, height: float, sections: int, colour: Colour
) -> trimesh.Trimesh:
    """An upright cylinder.

    Parameters
    ----------
    centre
        X, y, z of its bottom [m].
    radius, height
        [m].
    sections
        Facets around the axis.
    colour
        Of all faces.
    """
    x, y, z = centre
    ends = ((x, y, z), (x, y, z + height))
    return painted(trimesh.creation.cylinder(radius, sections=sections, segment=ends), colour)


def coil(
    centre: Sequence[float], radius: float, wire: float, height: float, colour: Colour
) -> trimesh.Trimesh:
    """An upright coil spring.

    It has 4.5 turns.

    Parameters
    ----------
    centre
        X, y, z of its bottom [m].
    radius, wire
        Mean radius of the coil, and radius of its wire [m].
    height
        [m].
    colour
        Of all faces.
    """
    turns, facets = 4.5, 5
    angle = np.linspace(0.0, 2.0 * np.pi * turns, int(turns * 12) + 1)
    outward = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1)
    rise = np.linspace(wire, height - wire, len(angle))
    path = np.asarray(centre) + radius * outward + rise[:, None] * np.array([0.0, 0.0, 1.0])
    around = 2.0 * np.pi * np.arange(facets) / facets
    rings = (
        path[:, None, :]
        + wire * np.cos(around)[None, :, None] * outward[:, None, :]
        + wire * np.sin(around)[None, :, None] * np.array([0.0, 0.0, 1.0])
    )
    return loft(rings, colour)


def shaded(mesh: trimesh.Trimesh) -> Shaded:
    """The mesh for a renderer: vertices split at creases and at colour borders, normals smooth between."""
    faces = np.asarray(mesh.faces)
    weighted = np.asarray(mesh.triangles_cross, dtype=np.float64)  # twice the area times the normal
    size: FloatArray = np.linalg.norm(weighted, axis=1)
    unit = weighted / np.where(size > 0.0, size, 1.0)[:, None]

    # every pair of corners (left, right) that meet at one vertex
    vertex = faces.ravel()
    order = np.argsort(vertex, kind="stable")
    _, start, count = np.unique(vertex[order], return_index=True, return_counts=True)
    partners = np.repeat(count, count)
    left = np.repeat(np.arange(len(vertex)), partners)
    within = np.arange(len(left)) - np.repeat(np.cumsum(partners) - partners, partners)
    right = np.repeat(np.repeat(start, count), partners) + within
    left, right = order[left] // 3, order[right] // 3
    corner = np.repeat(order, partners)

    smooth = np.einsum("ij,ij->i", unit[left], unit[right]) >= np.cos(CREASE_ANGLE)
    normals: FloatArray = np.stack(
        [
            np.bincount(corner[smooth], weights=weighted[right[smooth], axis], minlength=len(vertex))
            for axis in range(3)
        ],
        axis=-1,
    )
    length: FloatArray = np.linalg.norm(normals, axis=1)
    normals = normals / np.where(length > 0.0, length, 1.0)[:, None]

    colours = np.repeat(np.asarray(mesh.visual.face_colors, dtype=np.uint8), 3, axis=0)
    key = np.column_stack([vertex, np.round(normals * 1e4).astype(np.int64), colours])
    _, index, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    return Shaded(
        np.asarray(mesh.vertices[vertex[index]], dtype=np.float32),
        inverse.reshape(-1, 3).astype(np.uint32),
        normals[index].astype(np.float32),
        colours[index],
    )
