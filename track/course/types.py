"""The alignment for the kernels: the table of nodes and its columns."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Node(IntEnum):
    """Columns of the nodes of an alignment table, SI units.

    With u = s - S, curvature, cant, gauge and gradient between a node and the next are cubics in u: the
    column of the name is the value at the node, `_1` to `_3` are the coefficients of u, u^2 and u^3.
    """

    S = 0  # arc length in plan [m]
    X = 1  # global position [m]
    Y = 2
    Z = 3
    HEADING = 4  # about Z from +X, not wrapped [rad]
    FORWARD_X = 5  # cos and sin of the heading [-]
    FORWARD_Y = 6
    CURVATURE = 7  # in plan, positive in left-hand curves [1/m]
    CURVATURE_1 = 8
    CURVATURE_2 = 9
    CURVATURE_3 = 10
    CANT = 11  # positive where the RIGHT rail is the higher one [m]
    CANT_1 = 12
    CANT_2 = 13
    CANT_3 = 14
    GAUGE = 15  # [m]
    GAUGE_1 = 16
    GAUGE_2 = 17
    GAUGE_3 = 18
    GRADIENT = 19  # dz/ds, positive uphill [-]
    GRADIENT_1 = 20
    GRADIENT_2 = 21
    GRADIENT_3 = 22


class AlignmentTable(NamedTuple):
    """The centre line at nodes no farther apart than `step`; every section boundary is a node.

    One array for all columns: a row is contiguous, and few arrays make calls from Python fast. `cell` gives
    the node before s without a search. The properties are for Python only.
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
    def z(self) -> NDArray[np.float64]:
        """Global z of the nodes [m]."""
        return self.nodes[:, Node.Z]

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

    @property
    def gradient(self) -> NDArray[np.float64]:
        """Gradients at the nodes, positive uphill [-]."""
        return self.nodes[:, Node.GRADIENT]
