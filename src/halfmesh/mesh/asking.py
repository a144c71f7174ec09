"""What can be asked of any mesh, in whatever way its connectivity is held.

Nothing is computed here: rules and loops live in `core`, and every method is a few lines of delegation.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from halfmesh.core import counting, tables
from halfmesh.core.search import find_halfedge
from halfmesh.errors import PreconditionError
from halfmesh.mesh.attributes import AttributeTable
from halfmesh.mesh.collections import Collection
from halfmesh.mesh.counts import Counted
from halfmesh.mesh.elements import Edge, Face, Halfedge, Vertex
from halfmesh.mesh.handles import KINDS, made
from halfmesh.mesh.summary import Summary, summarize

__all__ = ["Asked"]

Ints = NDArray[np.int32]


class Asked(Counted):
    """The part of a mesh that answers: its elements as handles, adjacency as arrays, counts, a summary."""

    vertex_data: AttributeTable
    halfedge_data: AttributeTable
    edge_data: AttributeTable
    face_data: AttributeTable
    has_points: bool
    build_seconds: float
    _family: ClassVar[Mapping[str, Any]] = KINDS  # the classes of its handles

    @property
    def topology(self) -> Any:
        """The connectivity as kernels take it."""
        return self._topology

    # -- elements ------------------------------------------------------------------------------------------------

    @property
    def vertices(self) -> Collection[Vertex]:
        """The vertices: iterate, ``len``, ``[index]``, ``in``."""
        return Collection(self, self._family["vertex"])

    @property
    def halfedges(self) -> Collection[Halfedge]:
        """The halfedges: iterate, ``len``, ``[index]``, ``in``."""
        return Collection(self, self._family["halfedge"])

    @property
    def edges(self) -> Collection[Edge]:
        """The edges: iterate, ``len``, ``[index]``, ``in``."""
        return Collection(self, self._family["edge"])

    @property
    def faces(self) -> Collection[Face]:
        """The faces: iterate, ``len``, ``[index]``, ``in``."""
        return Collection(self, self._family["face"])

    # -- asking ----------------------------------------------------------------------------------------------------

    def summary(self) -> Summary:
        """All the counts, topology, degrees, memory and building time; prints as a table. O(n)."""
        return summarize(self)

    # -- finding and walking ---------------------------------------------------------------------------------------

    def find_halfedge(self, u: Vertex | int, v: Vertex | int) -> Halfedge | None:
        """The halfedge from `u` to `v`, or None. Complexity: O(smaller degree).

        Where edges are parallel, one of them.
        """
        find = getattr(find_halfedge, self._family["halfedge"]._form)
        h = find(self._t, self.vertices.resolve(u), self.vertices.resolve(v))
        return None if h < 0 else made(self._family["halfedge"], self._t, h)

    def boundary_loops(self) -> list[Ints]:
        """The halfedges of each boundary loop, along next: a list of int32 arrays. O(n) after a change, then kept."""
        halfedges, offsets = self._kept("loops", counting.boundary_loops)
        return [loop.copy() for loop in np.split(halfedges, offsets[1:-1])] if len(offsets) > 1 else []

    # -- arrays ----------------------------------------------------------------------------------------------------

    def face_vertices(self) -> tuple[Ints, Ints]:
        """The vertices of each face as (indices, offsets): the face list that made the mesh. O(n)."""
        return tables.face_vertices(self._topology)

    def face_neighbors(self) -> tuple[Ints, Ints]:
        """The faces across the edges of each face as (indices, offsets); boundary edges are left out. O(n)."""
        return tables.face_neighbors(self._topology)

    def vertex_neighbors(self) -> tuple[Ints, Ints]:
        """The ring of each vertex as (indices, offsets), counter-clockwise. O(n)."""
        return tables.vertex_neighbors(self._topology)

    def vertex_faces(self) -> tuple[Ints, Ints]:
        """The faces around each vertex as (indices, offsets), counter-clockwise. O(n)."""
        return tables.vertex_faces(self._topology)

    def vertex_degrees(self) -> Ints:
        """Number of edges at each vertex; a loop edge counts twice. O(n)."""
        return tables.vertex_degrees(self._topology)

    def face_degrees(self) -> Ints:
        """Number of corners of each face. O(n)."""
        return tables.face_degrees(self._topology)

    def corner_halfedges(self) -> Ints:
        """The halfedge of each corner, in the order of the face list: where corner data belong. O(n)."""
        return tables.corner_halfedges(self._topology)[0]

    def triangles(self) -> Ints:
        """The vertices of the faces, shape (n, 3), of a triangle mesh; row `i` belongs to ``faces.indices[i]``.

        Raises
        ------
        PreconditionError
            A face is not a triangle.
        """
        if not self.is_triangular:
            degrees = self.face_degrees()
            f = int(np.flatnonzero((degrees != 3) & (self._topology.face_halfedge >= 0))[0])
            raise PreconditionError(f"face {f} has {degrees[f]} corners; face_vertices() gives faces of any degree")
        return tables.triangles(self._topology)

    def edge_vertices(self) -> Ints:
        """The two ends of each edge, shape (n, 2). O(n)."""
        return tables.edge_vertices(self._topology)

    def edge_faces(self) -> Ints:
        """The faces left and right of each edge, shape (n, 2); -1 where there is none. O(n)."""
        return tables.edge_faces(self._topology)

    def __repr__(self) -> str:
        kind = "with boundary" if self.has_boundary else "closed"
        counts = (
            (self.n_vertices, "vertex", "vertices"),
            (self.n_edges, "edge", "edges"),
            (self.n_faces, "face", "faces"),
        )
        return (
            f"<{type(self).__name__}: {', '.join(f'{n} {one if n == 1 else many}' for n, one, many in counts)}, {kind}>"
        )

    def _repr_html_(self) -> str:
        return self.summary()._repr_html_()

    # -- a carrier: kernels take a mesh as its topology --------------------------------------------------------------

    def __views__(self) -> Any:
        return self._t

    def __arrays__(self) -> Any:
        return self._topology.__arrays__()

    def __compiled__(self) -> Any:
        return self._topology.__compiled__()
