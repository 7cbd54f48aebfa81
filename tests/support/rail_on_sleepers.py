"""Reference: two Timoshenko rails on sleepers one by one, by finite elements, for the track's receptance.

Independent of `track.support.sleepers`, which solves an endless track by its waves: here 61 sleepers, rails
in elements of a twentieth of the spacing (shear-flexible beam, Przemieniecki 1968, section 5.6; masses at the
nodes), every sleeper a rigid body with its own motion, every ballast mass too. Sparse matrices by scipy.
"""

import numpy as np
from scipy.sparse import coo_array, csc_array
from scipy.sparse.linalg import splu

from track.support.sleepers import SleeperTrack

SLEEPERS = 61
PER_SPAN = 20
NODES = (SLEEPERS - 1) * PER_SPAN + 1
MIDDLE = NODES // 2  # on a sleeper
PLACES = np.arange(PER_SPAN // 2 + 1) / PER_SPAN  # from a sleeper to the middle between two, in spacings
WEIGHTS = np.array([0.5, *[1.0] * (PER_SPAN // 2 - 1), 0.5]) / (PER_SPAN // 2)  # of a mean over PLACES


class _Assembly:
    """Matrices from springs, dampers and masses."""

    def __init__(self, size: int) -> None:
        self.size = size
        self.entries: dict[str, list[tuple[int, int, float]]] = {"k": [], "c": [], "m": []}

    def add(self, kind: str, dofs: list[int], matrix: np.ndarray) -> None:
        for a, i in enumerate(dofs):
            for b, j in enumerate(dofs):
                self.entries[kind].append((i, j, float(matrix[a, b])))

    def link(self, dofs: list[int], row: list[float], stiffness: float, damping: float) -> None:
        """Spring and damper whose length is `row` times the coordinates."""
        square = np.outer(row, row)
        self.add("k", dofs, stiffness * square)
        self.add("c", dofs, damping * square)

    def matrix(self, kind: str) -> csc_array:
        rows, columns, values = zip(*self.entries[kind], strict=True)
        return csc_array(coo_array((values, (rows, columns)), shape=(self.size, self.size)))


def _rail(assembly: _Assembly, first: int, t: SleeperTrack, inertia: float) -> None:
    length = t.sleeper_spacing / PER_SPAN
    bending = t.young_modulus * inertia
    phi = 12.0 * bending / (t.rail_shear_coefficient * t.shear_modulus * t.rail_area * length**2)
    h = length
    beam = np.array([
        [12.0, 6.0 * h, -12.0, 6.0 * h],
        [6.0 * h, (4.0 + phi) * h**2, -6.0 * h, (2.0 - phi) * h**2],
        [-12.0, -6.0 * h, 12.0, -6.0 * h],
        [6.0 * h, (2.0 - phi) * h**2, -6.0 * h, (4.0 + phi) * h**2],
    ]) * bending / (h**3 * (1.0 + phi))  # fmt: skip
    for node in range(NODES):
        i = first + 2 * node
        if node < NODES - 1:
            assembly.add("k", [i, i + 1, i + 2, i + 3], beam)
        share = length * (0.5 if node in (0, NODES - 1) else 1.0)
        mass = t.rail_mass_per_length * share
        assembly.add("m", [i], np.array([[mass]]))
        assembly.add("m", [i + 1], np.array([[mass * inertia / t.rail_area]]))


def _vertical(t: SleeperTrack) -> _Assembly:
    rails = 4 * NODES
    assembly = _Assembly(rails + 4 * SLEEPERS)  # then z, roll, left and right ballast of every sleeper
    _rail(assembly, 0, t, t.rail_inertia_vertical)
    _rail(assembly, 2 * NODES, t, t.rail_inertia_vertical)
    for j in range(SLEEPERS):
        z, roll = rails + 4 * j, rails + 4 * j + 1
        for side, arm in ((0, 1.0), (1, -1.0)):
            seat = 2 * NODES * side + 2 * PER_SPAN * j
            ballast = z + 2 + side
            b = arm * t.rail_spacing_half
            assembly.link([seat, z, roll], [1.0, -1.0, -b], t.pad_stiffness_vertical, t.pad_damping_vertical)
            b = arm * t.sleeper_length / np.sqrt(12.0)  # where two springs have an even bed's roll stiffness
            assembly.link(
                [z, roll, ballast], [1.0, b, -1.0], t.ballast_stiffness_vertical, t.ballast_damping_vertical
            )
            assembly.link([ballast], [1.0], t.subgrade_stiffness_vertical, t.subgrade_damping_vertical)
            assembly.add("m", [ballast], np.array([[t.ballast_mass]]))
        assembly.add("m", [z], np.array([[t.sleeper_mass]]))
        assembly.add("m", [roll], np.array([[t.sleeper_mass * t.sleeper_length**2 / 12.0]]))
    return assembly


def _lateral(t: SleeperTrack) -> _Assembly:
    rails = 4 * NODES
    assembly = _Assembly(rails + SLEEPERS)
    _rail(assembly, 0, t, t.rail_inertia_lateral)
    _rail(assembly, 2 * NODES, t, t.rail_inertia_lateral)
    for j in range(SLEEPERS):
        y = rails + j
        for side in range(2):
            seat = 2 * NODES * side + 2 * PER_SPAN * j
            assembly.link([seat, y], [1.0, -1.0], t.pad_stiffness_lateral, t.pad_damping_lateral)
            assembly.link([y], [1.0], t.ballast_stiffness_lateral, t.ballast_damping_lateral)
        assembly.add("m", [y], np.array([[t.sleeper_mass]]))
    return assembly


def receptances(track: SleeperTrack, direction: str, frequencies: np.ndarray) -> np.ndarray:
    """(frequencies, loading, place): rails alike or opposite; at `PLACES` after a sleeper [m/N]."""
    assembly = _vertical(track) if direction == "vertical" else _lateral(track)
    k, c, m = (assembly.matrix(kind) for kind in "kcm")
    nodes = MIDDLE + np.arange(PLACES.size)
    result = np.zeros((frequencies.size, 2, PLACES.size), dtype=complex)
    for f, frequency in enumerate(frequencies):
        omega = 2.0 * np.pi * frequency
        solve = splu(csc_array(k + 1j * omega * c - omega**2 * m)).solve
        for loading, right in enumerate((1.0, -1.0)):
            load = np.zeros((assembly.size, PLACES.size), dtype=complex)
            load[2 * nodes, range(PLACES.size)] = 1.0
            load[2 * (NODES + nodes), range(PLACES.size)] = right
            result[f, loading] = np.diag(solve(load)[2 * nodes])
    return result
