"""Welding two vertices at their gaps, and taking a vertex apart at two gaps."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.navigation import ccw_of, halfedge_of_vertex, is_exterior, origin_of
from halfmesh.core.notes import VERTICES, note_part, note_union
from halfmesh.core.operators.asking import both_status, vertex_status
from halfmesh.core.operators.gaps import splice
from halfmesh.core.operators.vertices import union_status
from halfmesh.core.pens import changed, set_halfedge_of_vertex, set_origin
from halfmesh.core.slots import delete_vertex, is_full, new_vertex
from halfmesh.core.statuses import (
    CLOSED_VERTEX,
    DIFFERENT_VERTICES,
    NOT_EXTERIOR,
    OK,
    SAME_CORNER,
    SAME_VERTEX,
    TOO_LARGE,
)

__all__ = [
    "try_unweld",
    "try_weld",
    "try_weld_vertices",
    "unweld",
    "unweld_status",
    "weld",
    "weld_status",
    "weld_vertices_status",
]


@operation
def weld_status(t: Any, a: int, b: int, allow_parallel: bool = False) -> int:
    """Whether the origins of `a` and `b` may be welded: ``OK`` or a code.

    Cost: the degree of one origin times that of the other at worst.
    """
    if not is_exterior(t, a) or not is_exterior(t, b):
        return NOT_EXTERIOR
    if origin_of(t, a) == origin_of(t, b):
        return SAME_VERTEX
    return OK if allow_parallel else union_status(t, b, origin_of(t, a), -1)


@kernel
def weld(t: Any, a: int, b: int) -> int:
    """Make one vertex of the origins of two exterior halfedges; that of `a` stays, and is returned.

    The gaps before both are exchanged, see :func:`~halfmesh.core.operators.gaps.splice`: so two holes become one, or
    one becomes two, or two pieces hang together. Cost: the degree of the origin of `b`.
    """
    u, v = origin_of(t, a), origin_of(t, b)
    _turn_over(t, b, u)
    splice(t, a, b)
    delete_vertex(t, v)
    note_union(t, VERTICES, u, v, 0.5)
    changed(t)
    return u


@operation
def try_weld(t: Any, a: int, b: int, allow_parallel: bool) -> int:
    """Weld the origins of `a` and `b` if that may be: the vertex that stays, or the negative code."""
    status = both_status(t, a, b)
    if status == OK:
        status = weld_status(t, a, b, allow_parallel)
    return -status if status != OK else weld(t, a, b)


@operation
def weld_vertices_status(t: Any, u: int, v: int, allow_parallel: bool = False) -> int:
    """Whether two vertices may be welded, at the gaps of their halfedges or isolated: ``OK`` or a code.

    Cost: the degree of one times that of the other at worst.
    """
    if u == v:
        return SAME_VERTEX
    a, b = halfedge_of_vertex(t, u), halfedge_of_vertex(t, v)
    if a < 0 or b < 0:
        return OK
    if not is_exterior(t, a) or not is_exterior(t, b):
        return CLOSED_VERTEX
    return weld_status(t, a, b, allow_parallel)


@operation
def try_weld_vertices(t: Any, u: int, v: int, allow_parallel: bool) -> int:
    """Weld two vertices, at the gaps of their halfedges or isolated: `u`, which stays, or the negative code."""
    status = vertex_status(t, u)
    if status == OK:
        status = vertex_status(t, v)
    if status == OK:
        status = weld_vertices_status(t, u, v, allow_parallel)
    if status != OK:
        return -status
    a, b = halfedge_of_vertex(t, u), halfedge_of_vertex(t, v)
    if a >= 0 and b >= 0:
        return weld(t, a, b)
    if b >= 0:
        _turn_over(t, b, u)
        set_halfedge_of_vertex(t, u, b)
    delete_vertex(t, v)
    note_union(t, VERTICES, u, v, 0.5)
    changed(t)
    return u


@operation
def unweld_status(t: Any, a: int, b: int) -> int:
    """Whether the vertex of `a` and `b` may be taken apart at their gaps: ``OK`` or a code. Cost: O(1)."""
    if not is_exterior(t, a) or not is_exterior(t, b):
        return NOT_EXTERIOR
    if a == b:
        return SAME_CORNER
    if origin_of(t, a) != origin_of(t, b):
        return DIFFERENT_VERTICES
    return TOO_LARGE if is_full(t, 1, 0, 0) else OK


@kernel
def unweld(t: Any, a: int, b: int) -> int:
    """Take a vertex apart at two gaps: what lies counter-clockwise after `a` up to `b` gets a new one, returned.

    Undoes :func:`weld`. Cost: the number of halfedges that move.
    """
    v = origin_of(t, a)
    w = new_vertex(t)
    splice(t, a, b)
    _turn_over(t, b, w)
    set_halfedge_of_vertex(t, w, b)
    if origin_of(t, halfedge_of_vertex(t, v)) == w:
        set_halfedge_of_vertex(t, v, a)
    note_part(t, VERTICES, w, v, 0.5)
    note_part(t, VERTICES, v, v, 0.5)
    changed(t)
    return w


@operation
def try_unweld(t: Any, a: int, b: int) -> int:
    """Take the vertex of `a` and `b` apart if that may be: the new one, or the negative code."""
    status = both_status(t, a, b)
    if status == OK:
        status = unweld_status(t, a, b)
    return -status if status != OK else unweld(t, a, b)


@kernel
def _turn_over(t: Any, h: int, v: int) -> None:
    """Let all that leaves the origin of `h` leave `v`."""
    x = h
    while True:
        set_origin(t, x, v)
        x = ccw_of(t, x)
        if x == h:
            break
