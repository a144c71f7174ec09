"""Slots: making and unmaking elements, and the growth of the columns from inside a kernel.

A column that is full is replaced by one of twice the size, so adding is O(1) amortised, and an operator called in a
user's loop can add a million edges without anyone having known. Nothing here links: a new vertex is isolated, the two
halfedges of a new edge and a new face are left to the operator. And an element that is deleted is only marked, after
the operator has taken it out of all links.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import apart, grown, kernel
from halfmesh.core.pens import set_face, set_halfedge_of_face, set_halfedge_of_vertex, set_next, set_origin, set_prev
from halfmesh.core.topology import (
    DELETED,
    EDGE_SLOTS,
    FACE_SLOTS,
    LIMIT,
    N_DEAD_EDGES,
    N_DEAD_FACES,
    N_DEAD_VERTICES,
    N_EXTERIOR,
    NEWS,
    REPLACED,
    VERTEX_SLOTS,
)

__all__ = ["delete_edge", "delete_face", "delete_vertex", "is_full", "new_edge", "new_face", "new_vertex", "reserve"]


@kernel
def new_vertex(t: Any) -> int:
    """The next vertex, isolated."""
    v = t.counts[VERTEX_SLOTS]
    if v >= len(t.vertex_halfedge):
        _grow_vertices(t, 2 * v + 16)
    t.counts[VERTEX_SLOTS] = v + 1
    t.vertex_halfedge[v] = -1
    return v  # type: ignore[no-any-return]


@kernel
def new_edge(t: Any, origin: int, target: int) -> int:
    """The first halfedge of the next edge; both leave their vertices, are exterior and unlinked."""
    e = t.counts[EDGE_SLOTS]
    h = 2 * e
    if h + 2 > len(t.next):
        _grow_halfedges(t, 2 * h + 32)
    t.counts[EDGE_SLOTS] = e + 1
    t.origin[h] = origin
    t.origin[h + 1] = target
    t.face[h] = -1
    t.face[h + 1] = -1
    t.counts[N_EXTERIOR] += 2
    return h  # type: ignore[no-any-return]


@kernel
def new_face(t: Any, h: int) -> int:
    """The next face, with this halfedge; the halfedges of its loop are not told."""
    f = t.counts[FACE_SLOTS]
    if f >= len(t.face_halfedge):
        _grow_faces(t, 2 * f + 16)
    t.counts[FACE_SLOTS] = f + 1
    t.face_halfedge[f] = h
    return f  # type: ignore[no-any-return]


@kernel
def delete_vertex(t: Any, v: int) -> None:
    """Mark a vertex that no halfedge leaves."""
    set_halfedge_of_vertex(t, v, DELETED)
    t.counts[N_DEAD_VERTICES] += 1


@kernel
def delete_edge(t: Any, h: int) -> None:
    """Mark both halfedges of an edge that nothing refers to."""
    for side in range(2):
        x = h ^ side
        set_next(t, x, DELETED)
        set_prev(t, x, DELETED)
        set_origin(t, x, DELETED)
        set_face(t, x, DELETED)
    t.counts[N_DEAD_EDGES] += 1


@kernel
def delete_face(t: Any, f: int) -> None:
    """Mark a face that no halfedge names."""
    set_halfedge_of_face(t, f, DELETED)
    t.counts[N_DEAD_FACES] += 1


@kernel
def is_full(t: Any, n_vertices: int, n_edges: int, n_faces: int) -> bool:
    """Whether so many more elements can't be numbered: indices are int32."""
    return (  # type: ignore[no-any-return]
        t.counts[VERTEX_SLOTS] + n_vertices > LIMIT
        or 2 * (t.counts[EDGE_SLOTS] + n_edges) > LIMIT
        or t.counts[FACE_SLOTS] + n_faces > LIMIT
    )


@kernel
def reserve(t: Any, n_vertices: int, n_edges: int, n_faces: int) -> None:
    """Make room for so many more elements at once: what saves the copies of growing step by step."""
    if t.counts[VERTEX_SLOTS] + n_vertices > len(t.vertex_halfedge):
        _grow_vertices(t, t.counts[VERTEX_SLOTS] + n_vertices)
    if 2 * (t.counts[EDGE_SLOTS] + n_edges) > len(t.next):
        _grow_halfedges(t, 2 * (t.counts[EDGE_SLOTS] + n_edges))
    if t.counts[FACE_SLOTS] + n_faces > len(t.face_halfedge):
        _grow_faces(t, t.counts[FACE_SLOTS] + n_faces)


@kernel
def _grow_vertices(t: Any, n: int) -> None:
    apart()
    t.vertex_halfedge = grown(t.vertex_halfedge, n)
    t.counts[NEWS] |= REPLACED


@kernel
def _grow_halfedges(t: Any, n: int) -> None:
    apart()
    t.next = grown(t.next, n)
    t.prev = grown(t.prev, n)
    t.origin = grown(t.origin, n)
    t.face = grown(t.face, n)
    t.counts[NEWS] |= REPLACED


@kernel
def _grow_faces(t: Any, n: int) -> None:
    apart()
    t.face_halfedge = grown(t.face_halfedge, n)
    t.counts[NEWS] |= REPLACED
