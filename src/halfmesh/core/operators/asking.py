"""What the status functions ask of the mesh."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel
from halfmesh.core.navigation import (
    ccw_of,
    edge_slots,
    face_of,
    face_slots,
    halfedge_of_face,
    halfedge_of_vertex,
    halfedge_slots,
    is_exterior,
    next_of,
    prev_of,
    target_of,
    vertex_slots,
)
from halfmesh.core.statuses import DELETED_ELEMENT, MISSING_ELEMENT, OK
from halfmesh.core.topology import DELETED

__all__ = [
    "both_status",
    "edge_status",
    "face_status",
    "halfedge_status",
    "is_face_triangle",
    "is_joined",
    "is_triangle",
    "sides_of",
    "touches_gap",
    "vertex_status",
]

_NEAR = 12  # steps around one vertex before both rings are walked in turn: few vertices have a larger degree


@kernel
def vertex_status(t: Any, v: int) -> int:
    """OK, if `v` is a living vertex."""
    if v < 0 or v >= vertex_slots(t):
        return MISSING_ELEMENT
    return DELETED_ELEMENT if halfedge_of_vertex(t, v) == DELETED else OK


@kernel
def halfedge_status(t: Any, h: int) -> int:
    """OK, if `h` is a living halfedge."""
    if h < 0 or h >= halfedge_slots(t):
        return MISSING_ELEMENT
    return DELETED_ELEMENT if next_of(t, h) == DELETED else OK


@kernel
def both_status(t: Any, h: int, g: int) -> int:
    """OK, if both are living halfedges."""
    status = halfedge_status(t, h)
    return halfedge_status(t, g) if status == OK else status


@kernel
def edge_status(t: Any, e: int) -> int:
    """OK, if `e` is a living edge."""
    if e < 0 or e >= edge_slots(t):
        return MISSING_ELEMENT
    return DELETED_ELEMENT if next_of(t, 2 * e) == DELETED else OK


@kernel
def face_status(t: Any, f: int) -> int:
    """OK, if `f` is a living face."""
    if f < 0 or f >= face_slots(t):
        return MISSING_ELEMENT
    return DELETED_ELEMENT if halfedge_of_face(t, f) == DELETED else OK


@kernel
def touches_gap(t: Any, v: int) -> bool:
    """Whether the vertex, which is not isolated, touches a gap."""
    return is_exterior(t, halfedge_of_vertex(t, v))


@kernel
def is_triangle(t: Any, h: int) -> bool:
    """Whether the loop of `h`, around a face or a hole, has three sides."""
    n = next_of(t, h)
    return n != h and next_of(t, next_of(t, n)) == h  # a loop of one side comes back after three steps, too


@kernel
def is_face_triangle(t: Any, h: int) -> bool:
    """Whether the face of `h` is a triangle of three edges: not one that passes the edge of `h` twice."""
    leaf = next_of(t, h) == h ^ 1 or prev_of(t, h) == h ^ 1
    return face_of(t, h) >= 0 and not leaf and is_triangle(t, h)


@kernel
def sides_of(t: Any, h: int) -> int:
    """The number of sides of the face or hole on the left of `h`."""
    n, x = 1, next_of(t, h)
    while x != h:
        n += 1
        x = next_of(t, x)
    return n


@kernel
def is_joined(t: Any, h: int, v: int) -> bool:
    """Whether an edge joins the origin of `h` to the vertex `v`.

    Walks the ring of the origin, and if that is long both rings in turn: the cost is the smaller of the two degrees.
    """
    g = h
    for _ in range(_NEAR):
        if target_of(t, g) == v:
            return True
        g = ccw_of(t, g)
        if g == h:
            return False
    start = halfedge_of_vertex(t, v)
    if start < 0:
        return False
    u, x = target_of(t, h ^ 1), start
    while True:
        if target_of(t, g) == v or target_of(t, x) == u:
            return True
        g, x = ccw_of(t, g), ccw_of(t, x)
        if g == h or x == start:
            return False
