"""Handles: a vertex, halfedge, edge or face that you can hold.

A handle is a name, not the element: as cheap as a pair of words, equal to every other handle of the same element.
Each step delegates to one rule of `core.navigation`, interpreted over memoryviews: calling compiled code for a single
step would cost ten times the step itself.

A step on a deleted element raises :class:`StaleElementError`, at no cost in the good case: all columns of a deleted
element hold a negative mark, and what reads a mark refuses.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from halfmesh._jit import declared
from halfmesh.core import circulation, navigation
from halfmesh.mesh.handles import Element, made, step
from halfmesh.mesh.positions import as_point

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["Edge", "Element", "Face", "Halfedge", "Vertex", "made"]


class Vertex(Element):
    """A vertex: a point where edges meet."""

    __slots__ = ()
    kind, plural = "vertex", "vertices"
    column = "vertex_halfedge"

    @step(navigation.halfedge_of_vertex, "halfedge")
    def halfedge(self) -> Halfedge | None:
        """A halfedge that leaves the vertex, an exterior one if there is any; None if it is isolated."""
        declared()

    @property
    def point(self) -> NDArray[np.float64]:
        """Its position, shape (3,): a view, writing into it moves the vertex.

        Assigned may be what :meth:`Mesh.add_vertex` takes: three finite numbers, or two with z = 0.
        """
        self._check()
        row: NDArray[np.float64] = self._t.vertex_data.row("points", self.index)
        return row

    @point.setter
    def point(self, point: Any) -> None:
        self.point[:] = as_point(point)

    @property
    def degree(self) -> int:
        """Number of edges; a loop edge counts twice. Complexity: O(degree)."""
        return self._count(circulation.outgoing)

    @property
    def is_boundary(self) -> bool:
        """Whether it touches a gap. An isolated vertex does not. Complexity: O(1)."""
        return self._is(navigation.is_boundary_vertex)

    @property
    def is_isolated(self) -> bool:
        """Whether no edge touches it."""
        return self._is(navigation.is_isolated)

    def outgoing(self) -> Iterator[Halfedge]:
        """The halfedges that leave it, counter-clockwise; at a boundary vertex the exterior one comes last."""
        return self._walk(circulation.outgoing, Halfedge)

    def incoming(self) -> Iterator[Halfedge]:
        """The halfedges that arrive at it, counter-clockwise."""
        return self._walk(circulation.incoming, Halfedge)

    def neighbors(self) -> Iterator[Vertex]:
        """The other ends of its edges, counter-clockwise; one that is joined twice comes twice."""
        return self._walk(circulation.neighbors, Vertex)

    def edges(self) -> Iterator[Edge]:
        """Its edges, counter-clockwise."""
        return self._walk(circulation.edges_around, Edge)

    def faces(self) -> Iterator[Face]:
        """The faces around it, counter-clockwise; gaps are left out."""
        return self._walk(circulation.faces_around, Face)


class Halfedge(Element):
    """One of the two directed sides of an edge."""

    __slots__ = ()
    kind, plural = "halfedge", "halfedges"
    column = "next"

    @step(navigation.twin_of, "halfedge", reads=False)
    def twin(self) -> Halfedge:
        """The other halfedge of the same edge."""
        declared()

    @step(navigation.next_of, "halfedge")
    def next(self) -> Halfedge:
        """The one after it around its face or boundary loop."""
        declared()

    @step(navigation.prev_of, "halfedge")
    def prev(self) -> Halfedge:
        """The one before it around its face or boundary loop."""
        declared()

    @step(navigation.ccw_of, "halfedge")
    def ccw(self) -> Halfedge:
        """The next one counter-clockwise around its origin: twin(prev)."""
        declared()

    @step(navigation.cw_of, "halfedge")
    def cw(self) -> Halfedge:
        """The next one clockwise around its origin: next(twin)."""
        declared()

    @step(navigation.origin_of, "vertex")
    def origin(self) -> Vertex:
        """The vertex that it leaves."""
        declared()

    @step(navigation.target_of, "vertex")
    def target(self) -> Vertex:
        """The vertex that it arrives at."""
        declared()

    @step(navigation.face_of, "face")
    def face(self) -> Face | None:
        """The face on its left; None if it is exterior."""
        declared()

    @step(navigation.edge_of, "edge", reads=False)
    def edge(self) -> Edge:
        """The edge that it is a side of."""
        declared()

    @property
    def is_exterior(self) -> bool:
        """Whether there is no face on its left."""
        return self._is(navigation.is_exterior)

    @property
    def is_boundary(self) -> bool:
        """Whether it or its twin is exterior."""
        return self.edge.is_boundary

    @property
    def length(self) -> float:
        """Distance between its ends."""
        return self.edge.length


class Edge(Element):
    """An edge: two halfedges that run against each other."""

    __slots__ = ()
    kind, plural = "edge", "edges"
    column = "next"

    def _slot(self) -> int:
        return 2 * self.index

    @step(navigation.halfedge_of_edge, "halfedge", reads=False)
    def halfedge(self) -> Halfedge:
        """Its first halfedge, ``2 * index``."""
        declared()

    @property
    def vertices(self) -> tuple[Vertex, Vertex]:
        """Its two ends: origin and target of its halfedge."""
        h = self.halfedge
        return h.origin, h.target

    @property
    def faces(self) -> tuple[Face | None, Face | None]:
        """The faces left and right of its halfedge; None where there is none."""
        h = self.halfedge
        return h.face, h.twin.face

    @property
    def is_boundary(self) -> bool:
        """Whether a face is missing on one side, or on both."""
        return self._is(navigation.is_boundary_edge)

    @property
    def length(self) -> float:
        """Distance between its ends."""
        a, b = self.vertices
        points = self._t.vertex_data.peek("points")
        return math.dist(points[a.index], points[b.index])


class Face(Element):
    """A face: a polygon of any number of sides, counter-clockwise."""

    __slots__ = ()
    kind, plural = "face", "faces"
    column = "face_halfedge"

    @step(navigation.halfedge_of_face, "halfedge")
    def halfedge(self) -> Halfedge:
        """One of its halfedges: that of the first listed corner, in a mesh made from a face list."""
        declared()

    @property
    def degree(self) -> int:
        """Number of corners. Complexity: O(degree)."""
        return self._count(circulation.face_halfedges)

    def vertices(self) -> Iterator[Vertex]:
        """Its corners, counter-clockwise, as they were listed."""
        return self._walk(circulation.face_vertices, Vertex)

    def halfedges(self) -> Iterator[Halfedge]:
        """Its halfedges, counter-clockwise."""
        return self._walk(circulation.face_halfedges, Halfedge)

    def edges(self) -> Iterator[Edge]:
        """Its edges, counter-clockwise."""
        return self._walk(circulation.face_edges, Edge)

    def neighbors(self) -> Iterator[Face]:
        """The faces across its edges, counter-clockwise; boundary edges are left out."""
        return self._walk(circulation.face_neighbors, Face)
