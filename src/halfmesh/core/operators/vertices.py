"""Splitting a vertex into two that an edge joins, and joining two again: the duals of `connect` and `join_faces`."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.navigation import (
    ccw_of,
    face_of,
    halfedge_of_face,
    halfedge_of_vertex,
    is_exterior,
    next_of,
    origin_of,
    prev_of,
    target_of,
)
from halfmesh.core.notes import CORNERS, VERTICES, is_noting, note_copy, note_part, note_union, note_wedge
from halfmesh.core.operators.asking import both_status, halfedge_status, is_joined
from halfmesh.core.operators.gaps import show_gap
from halfmesh.core.pens import changed, link, set_face, set_halfedge_of_face, set_halfedge_of_vertex, set_origin
from halfmesh.core.slots import delete_edge, delete_vertex, is_full, new_edge, new_vertex
from halfmesh.core.statuses import (
    DIFFERENT_VERTICES,
    LOOP_EDGE,
    OK,
    SMALL_FACE,
    TOO_LARGE,
    WOULD_BE_LOOP,
    WOULD_BE_PARALLEL,
)

__all__ = [
    "contract",
    "join_vertices",
    "join_vertices_status",
    "note_contraction",
    "split_vertex",
    "split_vertex_status",
    "try_join_vertices",
    "try_split_vertex",
    "union_status",
]


# -- one vertex into two -------------------------------------------------------------------------------------------


@operation
def split_vertex_status(t: Any, h: int, g: int) -> int:
    """Whether the vertex may be split at the corners of `h` and `g`: ``OK`` or a code. Cost: O(1)."""
    if origin_of(t, h) != origin_of(t, g):
        return DIFFERENT_VERTICES
    return TOO_LARGE if is_full(t, 1, 1, 0) else OK


@kernel
def split_vertex(t: Any, h: int, g: int) -> int:
    r"""Split the vertex that `h` and `g` leave; returns the new halfedge from the old vertex to the new one.

    The halfedges counter-clockwise after `h` up to `g` move to the new vertex, none if both are the same: the new
    vertex is a leaf then. The faces of the corners of `h` and `g` gain a side. Cost: the degree.

    ::

                                          g ^
              g ^                            \ |
        H        \ |                          \|
         ------>  v ------    -->     H        w        G      x: v -> w, the last edge's first halfedge;
                 /|                            ^
                / |     G                      | x             H, G: the faces of h and g
             h v                               v ------
                                              /
                                           h v
    """
    v, p, q, start = origin_of(t, h), prev_of(t, h), prev_of(t, g), halfedge_of_vertex(t, origin_of(t, h))
    w = new_vertex(t)
    x = new_edge(t, v, w)
    o = x ^ 1
    set_face(t, x, face_of(t, g))
    set_face(t, o, face_of(t, h))
    gap = o
    y = h
    while y != g:
        y = ccw_of(t, y)
        set_origin(t, y, w)
        if is_exterior(t, y):
            gap = y
    if h == g:
        link(t, x, o)
        link(t, p, x)
    else:
        link(t, p, o)
        link(t, q, x)
        link(t, x, g)
    link(t, o, h)
    set_halfedge_of_vertex(t, w, gap)
    if origin_of(t, start) == w:
        set_halfedge_of_vertex(t, v, x)
        if is_exterior(t, start):
            show_gap(t, v)
    note_part(t, VERTICES, w, v, 0.5)
    note_part(t, VERTICES, v, v, 0.5)
    note_copy(t, CORNERS, o, h)
    note_copy(t, CORNERS, x, g)
    changed(t)
    return x


@operation
def try_split_vertex(t: Any, h: int, g: int) -> int:
    """Split the vertex that both leave: the new halfedge, or the negative code."""
    status = both_status(t, h, g)
    if status == OK:
        status = split_vertex_status(t, h, g)
    return -status if status != OK else split_vertex(t, h, g)


# -- two vertices into one -----------------------------------------------------------------------------------------


@operation
def join_vertices_status(t: Any, h: int, allow_parallel: bool = False) -> int:
    """Whether the ends of `h` may be united: ``OK`` or a code.

    Cost: the sum of the degrees around the origin, times the degree of the target at worst.
    """
    a, b = origin_of(t, h), target_of(t, h)
    if a == b:
        return LOOP_EDGE
    if next_of(t, h) == h ^ 1 and prev_of(t, h) == h ^ 1 and face_of(t, h) >= 0:  # the face has no other side
        return SMALL_FACE
    return OK if allow_parallel else union_status(t, h, b, h >> 1)


@kernel
def union_status(t: Any, h: int, b: int, without: int) -> int:
    """Whether edges become loops or parallel when the origin of `h` becomes the vertex `b`, one edge left out."""
    a = origin_of(t, h)
    x = h
    while True:
        y = target_of(t, x)
        if x >> 1 != without and y != a:
            if y == b:
                return WOULD_BE_LOOP
            if is_joined(t, x ^ 1, b):
                return WOULD_BE_PARALLEL
        x = ccw_of(t, x)
        if x == h:
            return OK


@kernel
def join_vertices(t: Any, h: int, weight: float = 1.0) -> int:
    r"""Contract `h`; returns the vertex that stays, its target. Cost: the degree of the origin.

    The faces on both sides lose a side and nothing else goes: a triangle is left with two. :func:`collapse` closes
    those. `weight` says where the vertex comes to lie, from the origin (0) to the target (1).

    ::

          \ | /                 \ | /
           \|/                   \|/
            b                     b
            ^ h        -->       / \
            a
           / \
    """
    note_contraction(t, h, weight)
    b = contract(t, h)
    changed(t)
    return b


@operation
def try_join_vertices(t: Any, h: int, weight: float, allow_parallel: bool) -> int:
    """Contract `h` if it may be: the vertex that stays, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = join_vertices_status(t, h, allow_parallel)
    return -status if status != OK else join_vertices(t, h, weight)


@kernel
def contract(t: Any, h: int) -> int:
    """Take the edge out and let its target have what left its origin; returns the target."""
    o = h ^ 1
    a, b = origin_of(t, h), origin_of(t, o)
    n, p, on, op = next_of(t, h), prev_of(t, h), next_of(t, o), prev_of(t, o)
    gap = _gap_after(t, h)
    x = ccw_of(t, h)
    while x != h:
        set_origin(t, x, b)
        x = ccw_of(t, x)
    if face_of(t, h) >= 0 and halfedge_of_face(t, face_of(t, h)) == h:
        set_halfedge_of_face(t, face_of(t, h), n if n != o else on)
    if face_of(t, o) >= 0 and halfedge_of_face(t, face_of(t, o)) == o:
        set_halfedge_of_face(t, face_of(t, o), on if on != h else n)
    if p == o:  # a is a leaf
        link(t, op, n)
    elif n == o:  # b is a leaf
        link(t, p, on)
    else:
        link(t, p, n)
        link(t, op, on)
    set_halfedge_of_vertex(t, b, gap)
    delete_edge(t, h)
    delete_vertex(t, a)
    return b


@kernel
def _gap_after(t: Any, h: int) -> int:
    """The halfedge that the vertex that stays will have: exterior, if either end touches a gap; -1 if none is left."""
    o = h ^ 1
    va, vb = halfedge_of_vertex(t, origin_of(t, h)), halfedge_of_vertex(t, origin_of(t, o))
    n, on = next_of(t, h), next_of(t, o)
    if vb != o and face_of(t, vb) < 0:
        return vb
    if va != h and face_of(t, va) < 0:
        return va
    if n != o and (face_of(t, n) < 0 or on == h):
        return n
    if on != h and (face_of(t, on) < 0 or n == o):
        return on
    return n if n != o else -1


@kernel
def note_contraction(t: Any, h: int, weight: float) -> None:
    """What attributes need to know before an edge is contracted."""
    note_union(t, VERTICES, target_of(t, h), origin_of(t, h), 1.0 - weight)
    if is_noting(t, CORNERS):
        _note_wedges(t, h, weight)


@kernel
def _note_wedges(t: Any, h: int, weight: float) -> None:
    """The corners at both ends follow the side of the edge that they share their value with; the sides' own last."""
    o = h ^ 1
    n, on = next_of(t, h), next_of(t, o)
    x = ccw_of(t, h)
    while x != h:
        if x != on:
            note_wedge(t, x, h, n, on, o, weight)
        x = ccw_of(t, x)
    x = ccw_of(t, o)
    while x != o:
        if x != n:
            note_wedge(t, x, n, h, o, on, 1.0 - weight)
        x = ccw_of(t, x)
    if n != o and on != h:
        note_union(t, CORNERS, n, h, 1.0 - weight)
        note_union(t, CORNERS, on, o, weight)
