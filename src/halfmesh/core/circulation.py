"""Circulators: the elements around a vertex, a face, a hole, for use in ``for`` loops in any gear.

A *ring* turns counter-clockwise around a vertex; a *loop* runs along ``next`` around a face or a hole. A ring starts
at ``ccw(vertex_halfedge)``: at a boundary vertex that is the first edge of the wedge of faces, so the wedge is
contiguous and the exterior halfedge comes last.

The successor is read before the loop's body runs. Walks are not bounded: a corrupt mesh can make one endless, so
check meshes of unknown origin first (``mesh.check()``).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from halfmesh._jit import circulator, declared, kernel
from halfmesh.core.navigation import (
    ccw_of,
    edge_of,
    face_of,
    halfedge_of_face,
    halfedge_of_vertex,
    next_of,
    opposite_face_of,
    origin_of,
    target_of,
    twin_of,
)

__all__ = [
    "edges_around",
    "face_edges",
    "face_halfedges",
    "face_neighbors",
    "face_vertices",
    "faces_around",
    "incoming",
    "loop",
    "neighbors",
    "outgoing",
]


@kernel
def ring_start(t: Any, v: int) -> int:
    h = halfedge_of_vertex(t, v)
    if h < 0:
        return -1
    return ccw_of(t, h)  # type: ignore[no-any-return]


@kernel
def loop_start(t: Any, h: int) -> int:
    return h


@kernel
def face_start(t: Any, f: int) -> int:
    return halfedge_of_face(t, f)  # type: ignore[no-any-return]


# -- around a vertex ---------------------------------------------------------------------------------------------


@circulator(start=ring_start, step=ccw_of)
def outgoing(t: Any, v: int) -> Iterator[int]:
    """The halfedges that leave `v`, counter-clockwise."""
    declared()


@circulator(start=ring_start, step=ccw_of, value=twin_of)
def incoming(t: Any, v: int) -> Iterator[int]:
    """The halfedges that arrive at `v`, counter-clockwise."""
    declared()


@circulator(start=ring_start, step=ccw_of, value=target_of)
def neighbors(t: Any, v: int) -> Iterator[int]:
    """The vertices at the other ends of the edges of `v`, counter-clockwise; twice where an edge is double."""
    declared()


@circulator(start=ring_start, step=ccw_of, value=edge_of)
def edges_around(t: Any, v: int) -> Iterator[int]:
    """The edges of `v`, counter-clockwise."""
    declared()


@circulator(start=ring_start, step=ccw_of, value=face_of, skips=True)
def faces_around(t: Any, v: int) -> Iterator[int]:
    """The faces that have a corner at `v`, counter-clockwise; gaps are left out."""
    declared()


# -- along a loop ------------------------------------------------------------------------------------------------


@circulator(start=loop_start, step=next_of)
def loop(t: Any, h: int) -> Iterator[int]:
    """The halfedges of the face or the boundary loop that `h` belongs to, from `h` along next."""
    declared()


@circulator(start=face_start, step=next_of)
def face_halfedges(t: Any, f: int) -> Iterator[int]:
    """The halfedges of face `f`, counter-clockwise from its first corner."""
    declared()


@circulator(start=face_start, step=next_of, value=origin_of)
def face_vertices(t: Any, f: int) -> Iterator[int]:
    """The vertices of face `f`, as they were listed."""
    declared()


@circulator(start=face_start, step=next_of, value=edge_of)
def face_edges(t: Any, f: int) -> Iterator[int]:
    """The edges of face `f`."""
    declared()


@circulator(start=face_start, step=next_of, value=opposite_face_of, skips=True)
def face_neighbors(t: Any, f: int) -> Iterator[int]:
    """The faces across the edges of face `f`; boundary edges are left out."""
    declared()
