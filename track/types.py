"""What enters the alignment kernels: the table of nodes and its columns."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Node(IntEnum):
    """Columns of the nodes of an alignment table, SI units."""

    S = 0  # arc length [m]
    X = 1  # global position [m]
    Y = 2
    HEADING = 3  # about Z from +X, not wrapped [rad]
    FORWARD_X = 4  # cos and sin of the heading [-]
    FORWARD_Y = 5
    CURVATURE = 6  # positive in left-hand curves [1/m]
    CANT = 7  # positive where the RIGHT rail is the higher one [m]
    GAUGE = 8  # [m]


class AlignmentTable(NamedTuple):
    """The centre line at nodes no farther apart than `step`; every section boundary is a node.

    Between two nodes curvature, cant and gauge are linear. One array holds all nodes: a row is read at once,
    and few arrays cross the Python border fast. `cell` finds the node in front of s without a search. The
    columns by name are for Python only.
    """

    start: float  # arc length of the first node [m], minus the lead-in
    end: float  # of the last node [m]
    step: float  # [m]
    cell: NDArray[np.int64]  # (m,) node at or before start + j * step
    nodes: NDArray[np.float64]  # (n, len(Node))

    @property
    def s(self) -> NDArray[np.float64]:
        """Arc lengths of the nodes [m]."""
        return self.nodes[:, Node.S]

    @property
    def x(self) -> NDArray[np.float64]:
        """Global x of the nodes [m]."""
        return self.nodes[:, Node.X]

    @property
    def y(self) -> NDArray[np.float64]:
        """Global y of the nodes [m]."""
        return self.nodes[:, Node.Y]

    @property
    def heading(self) -> NDArray[np.float64]:
        """Headings at the nodes [rad]."""
        return self.nodes[:, Node.HEADING]

    @property
    def curvature(self) -> NDArray[np.float64]:
        """Curvatures at the nodes, positive in left-hand curves [1/m]."""
        return self.nodes[:, Node.CURVATURE]

    @property
    def cant(self) -> NDArray[np.float64]:
        """Height of the right rail over the left at the nodes [m]."""
        return self.nodes[:, Node.CANT]

    @property
    def gauge(self) -> NDArray[np.float64]:
        """Gauges at the nodes [m]."""
        return self.nodes[:, Node.GAUGE]
