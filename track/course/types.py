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


def _column(node: Node, meaning: str) -> property:
    """A column of an `AlignmentTable` by name."""

    def values(table: "AlignmentTable") -> NDArray[np.float64]:
        return table.nodes[:, node]

    return property(values, doc=meaning)


class _Nodes(NamedTuple):
    """The fields of an `AlignmentTable` for the kernels."""

    start: float  # arc length of the first node [m], minus the lead-in
    end: float  # of the last node [m]
    step: float  # [m]
    cell: NDArray[np.int64]  # (m,) node at or before start + j * step
    nodes: NDArray[np.float64]  # (n, len(Node))


class AlignmentTable(_Nodes):
    """The centre line at nodes no farther apart than `step`; every section boundary is a node.

    One array for all columns: a row is contiguous, and few arrays make calls from Python fast. `cell` gives
    the node before s without a search. The properties are for Python only.
    """

    s = _column(Node.S, "Arc lengths of the nodes [m].")
    x = _column(Node.X, "Global x of the nodes [m].")
    y = _column(Node.Y, "Global y of the nodes [m].")
    z = _column(Node.Z, "Global z of the nodes [m].")
    heading = _column(Node.HEADING, "Headings at the nodes [rad].")
    curvature = _column(Node.CURVATURE, "Curvatures at the nodes, positive in left-hand curves [1/m].")
    cant = _column(Node.CANT, "Height of the right rail over the left at the nodes [m].")
    gauge = _column(Node.GAUGE, "Gauges at the nodes [m].")
    gradient = _column(Node.GRADIENT, "Gradients at the nodes, positive uphill [-].")
