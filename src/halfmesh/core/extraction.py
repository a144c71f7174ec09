"""Taking a part out as a mesh of its own: faces with what they stand on, or what some vertices span."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.compaction import Maps, numbered
from halfmesh.core.navigation import ccw_of, face_of, halfedge_of_vertex, is_exterior, origin_of
from halfmesh.core.topology import DELETED, N_EXTERIOR, Topology, empty_columns

__all__ = ["extract", "spanned_by_faces", "spanned_by_vertices"]

Mask = NDArray[np.bool_]
Ints = NDArray[np.int32]


def spanned_by_faces(t: Topology, faces: Mask) -> tuple[Mask, Mask, Mask]:
    """The vertices, edges and faces of a part: these faces, with their edges and vertices. O(n)."""
    sides = t.face >= 0
    sides[sides] = faces[t.face[sides]]
    vertices = np.zeros(len(t.vertex_halfedge), dtype=bool)
    vertices[t.origin[sides]] = True
    return vertices, sides[::2] | sides[1::2], faces


def spanned_by_vertices(t: Topology, vertices: Mask) -> tuple[Mask, Mask, Mask]:
    """The vertices, edges and faces of a part: what is left when all other vertices are removed. O(n)."""
    alive = t.next != DELETED
    ends = alive.copy()
    ends[alive] = vertices[t.origin[alive]]
    edges = ends[::2] & ends[1::2]
    faces = t.face_halfedge != DELETED
    cut = alive & (t.face >= 0) & ~edges.repeat(2)
    faces[t.face[cut]] = False
    return vertices, edges, faces


def extract(t: Topology, vertices: Mask, edges: Mask, faces: Mask) -> tuple[Topology, Maps]:
    """Make a mesh of what is marked, in its order. Edges need their vertices and faces their edges.

    Around each vertex, what is kept keeps its cyclic order: gaps are where faces or edges were left out.

    Returns
    -------
    topology : Topology
    maps : Maps
        The new index of each old one, -1 for what was left out.

    Notes
    -----
    O(n): as a whole, and as a ring is walked from each edge that is kept to the next one.
    """
    maps = numbered(vertices, edges, faces)
    made = empty_columns(int(vertices.sum()), int(edges.sum()), int(faces.sum()))
    made.vertex_halfedge[:] = -1
    columns = (made.next, made.prev, made.origin, made.face, made.vertex_halfedge, made.face_halfedge)
    kept = np.flatnonzero(maps.halfedges >= 0)
    _link_kept.at(len(kept))(t, kept, maps.vertices, maps.halfedges, maps.faces, *columns[:5])
    old = t.face_halfedge[faces]
    made.face_halfedge[: len(old)] = maps.halfedges[old]
    made.counts[N_EXTERIOR] = np.count_nonzero(made.face[: len(kept)] < 0)
    return Topology(made), maps


@kernel
def _link_kept(
    t: Any, kept: Any, vertices: Any, halfedges: Any, faces: Any,
    next: Any, prev: Any, origin: Any, face: Any, vertex_halfedge: Any,
) -> None:  # fmt: skip
    for x in range(len(kept)):
        h = kept[x]
        y = ccw_of(t, h)
        while halfedges[y] < 0:
            y = ccw_of(t, y)
        before = halfedges[y] ^ 1
        prev[x] = before
        next[before] = x
        v = vertices[origin_of(t, h)]
        origin[x] = v
        face[x] = -1 if is_exterior(t, h) else faces[face_of(t, h)]
        if vertex_halfedge[v] < 0 or face[x] < 0:
            vertex_halfedge[v] = x
    for x in range(len(kept)):  # the one that the vertex had, if it will do
        h = kept[x]
        v = vertices[origin_of(t, h)]
        if halfedge_of_vertex(t, origin_of(t, h)) == h and (face[x] < 0 or face[vertex_halfedge[v]] >= 0):
            vertex_halfedge[v] = x
