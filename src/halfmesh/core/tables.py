"""Adjacency in bulk: one flat array of indices and one of offsets, counter-clockwise.

Row `i` belongs to slot `i`; rows of deleted elements are empty. Each table is filled in two passes over its elements
(how many, then which), so nothing has to grow.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import Kernel, kernel
from halfmesh.core.circulation import face_halfedges, outgoing
from halfmesh.core.navigation import (
    edge_slots,
    face_of,
    face_slots,
    halfedge_of_edge,
    halfedge_of_face,
    next_of,
    opposite_face_of,
    origin_of,
    target_of,
    vertex_slots,
)
from halfmesh.core.topology import DELETED, EDGE_SLOTS, FACE_SLOTS, N_DEAD_EDGES, N_EXTERIOR, Topology

__all__ = [
    "corner_halfedges",
    "edge_faces",
    "edge_vertices",
    "face_degrees",
    "face_neighbors",
    "face_vertices",
    "is_wire",
    "triangles",
    "vertex_degrees",
    "vertex_faces",
    "vertex_neighbors",
]

Ints = NDArray[np.int32]
Table = tuple[Ints, Ints]


def vertex_degrees(t: Topology) -> Ints:
    """Edges at each vertex; a loop edge counts twice."""
    return np.bincount(t.origin[t.next >= 0], minlength=len(t.vertex_halfedge)).astype(np.int32)


def face_degrees(t: Topology) -> Ints:
    """Corners of each face."""
    return np.bincount(t.face[(t.next >= 0) & (t.face >= 0)], minlength=len(t.face_halfedge)).astype(np.int32)


def corner_halfedges(t: Topology) -> Table:
    """The halfedges of each face, from its first corner: (halfedges, offsets)."""
    return _around_faces(t, False)


def face_vertices(t: Topology) -> Table:
    """The vertices of each face, as they were listed."""
    return _around_faces(t, True)


def vertex_neighbors(t: Topology) -> Table:
    """The ring of each vertex, counter-clockwise."""
    ring, offsets = _filled(t, vertex_degrees(t), _fill_rings)
    return target_of(t, ring), offsets


def vertex_faces(t: Topology) -> Table:
    """The faces around each vertex, counter-clockwise; gaps are left out."""
    ring, offsets = _filled(t, vertex_degrees(t), _fill_rings)
    return _without_gaps(face_of(t, ring), offsets)


def face_neighbors(t: Topology) -> Table:
    """The faces across the edges of each face; boundary edges are left out."""
    halfedges, offsets = corner_halfedges(t)
    return _without_gaps(opposite_face_of(t, halfedges), offsets)


def edge_vertices(t: Topology) -> Ints:
    """The two ends of each edge, shape (n, 2); -1 for deleted edges."""
    return _of_edges(t, _fill_ends)


def edge_faces(t: Topology) -> Ints:
    """The faces left and right of each edge, shape (n, 2); -1 where there is none."""
    return _of_edges(t, _fill_sides)


def is_wire(t: Topology) -> NDArray[np.bool_]:
    """Whether there is no face on either side of each edge; True for deleted edges."""
    table = np.empty(edge_slots(t), dtype=np.bool_)
    _fill_wire.at(len(table))(t, table)
    return table


def triangles(t: Topology) -> Ints:
    """The corners of the living faces, shape (n, 3), of a mesh that has only triangles."""
    first = t.face_halfedge[t.face_halfedge != DELETED]
    second = t.next[first]
    return np.stack([t.origin[first], t.origin[second], t.origin[t.next[second]]], axis=1)


def _of_edges(t: Topology, fill: Kernel[Any, Any]) -> Ints:
    table = np.empty((edge_slots(t), 2), dtype=np.int32)
    fill.at(len(table))(t, table)
    return table


@kernel
def _fill_ends(t: Any, table: Any) -> None:
    for e in range(len(table)):
        h = halfedge_of_edge(t, e)
        is_alive = next_of(t, h) >= 0
        table[e, 0] = origin_of(t, h) if is_alive else -1
        table[e, 1] = target_of(t, h) if is_alive else -1


@kernel
def _fill_sides(t: Any, table: Any) -> None:
    for e in range(len(table)):
        h = halfedge_of_edge(t, e)
        is_alive = next_of(t, h) >= 0
        table[e, 0] = face_of(t, h) if is_alive else -1
        table[e, 1] = opposite_face_of(t, h) if is_alive else -1


def _filled(t: Topology, sizes: Ints, fill: Callable[..., Any]) -> Table:
    offsets = np.zeros(len(sizes) + 1, dtype=np.int32)
    np.cumsum(sizes, out=offsets[1:])
    halfedges = np.empty(max(int(offsets[-1]), 1), dtype=np.int32)
    fill.at(len(halfedges))(t, halfedges)  # type: ignore[attr-defined]
    return halfedges[: offsets[-1]], offsets


@kernel
def _fill_rings(t: Any, halfedges: Any) -> None:
    place = 0
    for v in range(vertex_slots(t)):
        for h in outgoing(t, v):
            halfedges[place] = h
            place += 1


@kernel
def _fill_wire(t: Any, table: Any) -> None:
    for e in range(len(table)):
        h = halfedge_of_edge(t, e)
        table[e] = face_of(t, h) < 0 and opposite_face_of(t, h) < 0


def _around_faces(t: Topology, are_vertices: bool) -> Table:
    counts = t.__views__().counts
    n_corners = 2 * (counts[EDGE_SLOTS] - counts[N_DEAD_EDGES]) - counts[N_EXTERIOR]
    corners = np.empty(n_corners, dtype=np.int32)
    offsets = np.empty(counts[FACE_SLOTS] + 1, dtype=np.int32)
    _fill_corners.at(n_corners)(t, corners, offsets, are_vertices)
    return corners, offsets


@kernel
def _fill_corners(t: Any, corners: Any, offsets: Any, are_vertices: bool) -> None:
    place = 0
    offsets[0] = 0
    for f in range(face_slots(t)):
        if halfedge_of_face(t, f) >= 0:
            for h in face_halfedges(t, f):
                if place < len(corners):  # a mesh that breaks its laws may have more
                    corners[place] = origin_of(t, h) if are_vertices else h
                    place += 1
        offsets[f + 1] = place


def _without_gaps(faces: Ints, offsets: Ints) -> Table:
    present = faces >= 0
    counts = np.zeros(len(faces) + 1, dtype=np.int32)
    np.cumsum(present, out=counts[1:])
    return faces[present], counts[offsets]
