"""Dissolving: a vertex or an edge goes and the faces around it become one."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.navigation import ccw_of, halfedge_of_vertex, is_exterior, next_of, origin_of, target_of
from halfmesh.core.notes import EDGES, note_union
from halfmesh.core.operators.asking import halfedge_status, is_joined, vertex_status
from halfmesh.core.operators.splits import join_faces, join_faces_status
from halfmesh.core.operators.vertices import join_vertices, join_vertices_status
from halfmesh.core.statuses import (
    ISOLATED_VERTEX,
    LOOP_EDGE,
    OK,
    SAME_FACE,
    SEVERAL_GAPS,
    SMALL_FACE,
    WOULD_BE_LOOP,
    WOULD_BE_PARALLEL,
)

__all__ = [
    "dissolve_edge",
    "dissolve_edge_status",
    "dissolve_vertex",
    "dissolve_vertex_status",
    "try_dissolve_edge",
    "try_dissolve_vertex",
]


# -- a vertex ------------------------------------------------------------------------------------------------------


@operation
def dissolve_vertex_status(t: Any, v: int) -> int:
    """Whether the vertex may be dissolved: ``OK`` or a code. Cost: the number of sides of the faces around it."""
    s = halfedge_of_vertex(t, v)
    if s < 0:
        return ISOLATED_VERTEX
    n, n_gaps, x = 0, 0, s
    while True:
        if target_of(t, x) == v:
            return LOOP_EDGE
        n += 1
        n_gaps += int(is_exterior(t, x))
        x = ccw_of(t, x)
        if x == s:
            break
    if n <= 2:
        return join_vertices_status(t, ccw_of(t, s))
    if n_gaps > 1:
        return SEVERAL_GAPS
    status = _faces_status(t, s, n_gaps)
    if status == OK and n_gaps == 1:
        q = target_of(t, ccw_of(t, s))
        if target_of(t, s) == q:
            return WOULD_BE_LOOP
        if is_joined(t, s ^ 1, q):
            return WOULD_BE_PARALLEL
    return status


@kernel
def _faces_status(t: Any, s: int, n_gaps: int) -> int:
    """Whether the faces around the origin of `s` are different ones, and leave a polygon."""
    v, x = origin_of(t, s), s
    n_sides = n_gaps  # what a gap adds to two sides less for each edge at the vertex: the boundary closes up there
    while True:
        if not is_exterior(t, x):
            y = next_of(t, x)
            while y != x:
                if origin_of(t, y) == v:
                    return SAME_FACE
                n_sides += 1
                y = next_of(t, y)
            n_sides -= 1
        x = ccw_of(t, x)
        if x == s:
            return OK if n_sides >= 3 else SMALL_FACE


@kernel
def dissolve_vertex(t: Any, v: int) -> None:
    r"""Remove the vertex; the faces around it become one, that of its halfedge if there is no gap. Undoes `split_face`.

    Of two edges one remains, and both faces beside stay. At a boundary the two outer edges become one.
    Cost: the number of sides of the faces around the vertex.

    ::

           .-----.                .-----.             .-----.-----.            .-----.-----.
          / \   / \              /       \            |    / \    |            |           |
         .---(v)---.    -->     .    f    .           |  /     \  |    -->     |     f     |
          \ /   \ /              \       /            |/         \|            |           |
           .-----.                .-----.             .----(v)----.            .-----------.
    """
    s = halfedge_of_vertex(t, v)
    k = ccw_of(t, s)
    if ccw_of(t, k) == s:  # one edge or two
        _make_one(t, k)
        return
    closed = not is_exterior(t, s)
    x = k if closed else ccw_of(t, k)
    while x != s:
        after = ccw_of(t, x)
        join_faces(t, x ^ 1)
        x = after
    _make_one(t, s if closed else k)


@kernel
def _make_one(t: Any, h: int) -> None:
    """Take the origin of `h` away, with its only edge, or so that its two edges become one, that of the other."""
    x = ccw_of(t, h)
    if x != h:
        note_union(t, EDGES, x >> 1, h >> 1, 0.5)
    join_vertices(t, h)


@operation
def try_dissolve_vertex(t: Any, v: int) -> int:
    """Dissolve the vertex if that may be: 0, or the negative code."""
    status = vertex_status(t, v)
    if status == OK:
        status = dissolve_vertex_status(t, v)
    if status == OK:
        dissolve_vertex(t, v)
    return -status


# -- an edge -------------------------------------------------------------------------------------------------------


@operation
def dissolve_edge_status(t: Any, h: int) -> int:
    """Whether the edge of `h` may be dissolved: ``OK`` or a code. Cost: O(1)."""
    return join_faces_status(t, h)


@kernel
def dissolve_edge(t: Any, h: int) -> int:
    """Remove the edge between two faces, and its ends where they are left with two edges; returns the face of `h`.

    Cost: the number of sides of the face on the right, and the degrees of the neighbors of the ends.
    """
    a, b = origin_of(t, h), target_of(t, h)
    f = join_faces(t, h)
    _dissolve_between(t, a)
    if b != a:
        _dissolve_between(t, b)
    return f


@kernel
def _dissolve_between(t: Any, v: int) -> None:
    """Unite the two edges of a vertex that has no others, where that may be."""
    s = halfedge_of_vertex(t, v)
    k = ccw_of(t, s)
    if k != s and ccw_of(t, k) == s and join_vertices_status(t, k) == OK:
        _make_one(t, k)


@operation
def try_dissolve_edge(t: Any, h: int) -> int:
    """Dissolve the edge of `h` if that may be: the face that stays, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = dissolve_edge_status(t, h)
    return -status if status != OK else dissolve_edge(t, h)
