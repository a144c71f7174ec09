"""Building by hand: vertices and edges are added one by one, and taken away again as faces are.

An edge is hung into gaps, without a face. What is taken away leaves what it stood on: faces leave wire, edges leave
isolated vertices. How faces are added: see `faces`.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.navigation import (
    face_of,
    halfedge_of_face,
    halfedge_of_vertex,
    is_exterior,
    next_of,
    origin_of,
    prev_of,
    target_of,
    vertex_slots,
)
from halfmesh.core.operators.asking import both_status, edge_status, face_status, halfedge_status, vertex_status
from halfmesh.core.pens import changed, link, set_face, set_halfedge_of_vertex, set_next, set_prev
from halfmesh.core.slots import delete_edge, delete_face, delete_vertex, is_full, new_edge, new_vertex, reserve
from halfmesh.core.statuses import (
    CLOSED_VERTEX,
    DIFFERENT_VERTICES,
    NO_GAP,
    NOT_A_CHAIN,
    NOT_EXTERIOR,
    OK,
    TAKEN_HALFEDGE,
    TOO_LARGE,
)

__all__ = [
    "add_edge",
    "add_edge_in",
    "add_edge_in_status",
    "add_edge_status",
    "add_vertex",
    "find_free_between",
    "find_free_incident",
    "hung_edge",
    "is_closed",
    "make_adjacent",
    "make_adjacent_status",
    "make_follow",
    "remove_edge",
    "remove_face",
    "remove_vertex",
    "try_add_edge",
    "try_add_edge_in",
    "try_add_vertex",
    "try_add_vertices",
    "try_make_adjacent",
    "try_remove_edge",
    "try_remove_face",
    "try_remove_vertex",
]


# -- a vertex ------------------------------------------------------------------------------------------------------


@kernel
def add_vertex(t: Any) -> int:
    """Add an isolated vertex; returns it. Cost: O(1), amortised."""
    v = new_vertex(t)
    changed(t)
    return v


@operation
def try_add_vertex(t: Any) -> int:
    """Add an isolated vertex: its index, or the negative code."""
    if is_full(t, 1, 0, 0):
        return -TOO_LARGE
    return add_vertex(t)


@kernel
def try_add_vertices(t: Any, n: int) -> int:
    """Add so many isolated vertices: the first, or the negative code. Cost: O(n), amortised."""
    if is_full(t, n, 0, 0):
        return -TOO_LARGE
    first = vertex_slots(t)
    if first + n > len(t.vertex_halfedge):
        reserve(t, max(n, first // 2), 0, 0)
    for _ in range(n):
        new_vertex(t)
    changed(t)
    return first


# -- an edge -------------------------------------------------------------------------------------------------------


@operation
def add_edge_status(t: Any, u: int, v: int) -> int:
    """Whether an edge may be added from `u` to `v`: ``OK`` or a code. A loop or a parallel edge may. Cost: O(1)."""
    if is_closed(t, u, -1) or is_closed(t, v, -1):
        return CLOSED_VERTEX
    if is_full(t, 0, 1, 0):
        return TOO_LARGE
    return OK


@kernel
def add_edge(t: Any, u: int, v: int) -> int:
    r"""Add an edge without faces; returns its halfedge from `u` to `v`, which is even. Cost: O(1), amortised.

    Each end is hung into the gap before ``halfedge_of_vertex``; that halfedge stays what it was.

    ::

        before \      / gap           before \   h    / gap
                v    ^          -->           v ^  | ^
                  (u)                          (u) v          and likewise at v; `gap` and `before` are exterior
    """
    h = hung_edge(t, u, v)
    changed(t)
    return h


@kernel
def add_edge_in(t: Any, gap_u: int, gap_v: int) -> int:
    """Add an edge between the origins of two exterior halfedges, in the gaps before them; returns the halfedge.

    This says which gap, where a vertex has several. Twice the same gap gives a loop edge. Cost: O(1), amortised.
    """
    h = new_edge(t, origin_of(t, gap_u), origin_of(t, gap_v))
    _hang(t, h, gap_u)
    _hang(t, h ^ 1, gap_v)
    changed(t)
    return h


@operation
def try_add_edge(t: Any, u: int, v: int) -> int:
    """Add an edge if it may be: its halfedge from `u` to `v`, or the negative code."""
    status = vertex_status(t, u)
    if status == OK:
        status = vertex_status(t, v)
    if status == OK:
        status = add_edge_status(t, u, v)
    if status != OK:
        return -status
    return add_edge(t, u, v)


@operation
def add_edge_in_status(t: Any, u: int, gap_u: int, v: int, gap_v: int) -> int:
    """Whether an edge may be added from `u` to `v` in the gaps before these halfedges: ``OK`` or a code. Cost: O(1)."""
    status = _end_status(t, u, gap_u)
    if status == OK:
        status = _end_status(t, v, gap_v)
    return TOO_LARGE if status == OK and is_full(t, 0, 1, 0) else status


@operation
def try_add_edge_in(t: Any, u: int, gap_u: int, v: int, gap_v: int) -> int:
    """Add an edge from `u` to `v` in the gaps before these halfedges: its halfedge, or the negative code.

    A gap of -1 is that of the vertex's own halfedge, if it has one.
    """
    status = add_edge_in_status(t, u, gap_u, v, gap_v)
    if status != OK:
        return -status
    h = new_edge(t, u, v)
    _hang(t, h, gap_u if gap_u >= 0 else halfedge_of_vertex(t, u))
    _hang(t, h ^ 1, gap_v if gap_v >= 0 else halfedge_of_vertex(t, v))
    changed(t)
    return h


@kernel
def _end_status(t: Any, v: int, gap: int) -> int:
    """Whether an edge may be hung to `v` before `gap`, which leaves it."""
    status = vertex_status(t, v)
    if status == OK and gap >= 0:
        status = halfedge_status(t, gap)
        if status == OK and not is_exterior(t, gap):
            status = NOT_EXTERIOR
        if status == OK and origin_of(t, gap) != v:
            status = DIFFERENT_VERTICES
    elif status == OK and is_closed(t, v, -1):
        status = CLOSED_VERTEX
    return status


@kernel
def is_closed(t: Any, v: int, planned: int) -> bool:
    """Whether faces close all around the vertex; what has the face `planned` counts as a gap still."""
    h = halfedge_of_vertex(t, v)
    return h >= 0 and not is_exterior(t, h) and face_of(t, h) != planned


@kernel
def hung_edge(t: Any, u: int, v: int) -> int:
    """What `add_edge` does, as a part of something larger."""
    h = new_edge(t, u, v)
    _hang(t, h, halfedge_of_vertex(t, u))
    _hang(t, h ^ 1, halfedge_of_vertex(t, v))  # for a loop at an isolated vertex this is `h` by now
    return h


@kernel
def _hang(t: Any, h: int, gap: int) -> None:
    """Hang the origin of the new halfedge `h` before `gap`; -1 if the vertex is isolated."""
    if gap >= 0:
        before = prev_of(t, gap)
        t.next[h ^ 1] = gap  # nobody has to know what a new slot held before: no pen
        t.prev[h] = before
        set_prev(t, gap, h ^ 1)
        set_next(t, before, h)
    else:
        t.next[h ^ 1] = h
        t.prev[h] = h ^ 1
        set_halfedge_of_vertex(t, origin_of(t, h), h)


# -- two halfedges, one after the other ----------------------------------------------------------------------------


@kernel
def find_free_incident(t: Any, v: int) -> int:
    """An exterior halfedge that arrives at `v`, or -1 if there is none. Cost: O(1)."""
    h = halfedge_of_vertex(t, v)
    if h < 0 or not is_exterior(t, h):
        return -1
    return prev_of(t, h)


@kernel
def find_free_between(t: Any, v: int, starting: int, before: int) -> int:
    """The first exterior one of the halfedges that arrive at `v`, clockwise from `starting` to short of `before`.

    -1 if there is none, and so if the two are the same. Cost: the number of halfedges between.
    """
    x = starting
    while x != before:
        if is_exterior(t, x):
            return x
        x = next_of(t, x) ^ 1
    return -1


@operation
def make_adjacent_status(t: Any, h_in: int, h_out: int) -> int:
    """Whether `h_out` may be made the next of `h_in`: ``OK`` or a code. Cost: the degree of their vertex."""
    v = origin_of(t, h_out)
    if target_of(t, h_in) != v:
        return NOT_A_CHAIN
    if not is_exterior(t, h_in) or not is_exterior(t, h_out):
        return TAKEN_HALFEDGE
    if next_of(t, h_in) != h_out and find_free_between(t, v, h_out ^ 1, h_in) < 0:
        return NO_GAP
    return OK


@kernel
def make_adjacent(t: Any, h_in: int, h_out: int) -> None:
    r"""Make the exterior `h_out` the next of the exterior `h_in`, which arrives where it leaves.

    What leaves the vertex from `h_out` clockwise to the gap after `g` is moved into the gap after `h_in`; if it
    follows `h_in` already, nothing is done. Cost: the degree of the vertex.

    ::

        clockwise around v:

        ... d | h_out A g | h B h_in | b ...    -->    ... d | h B h_in | h_out A g | b ...

        | is a gap; d and b may be the same fan; A, B: faces and edges
    """
    if next_of(t, h_in) != h_out:
        make_follow(t, h_in, h_out, find_free_between(t, origin_of(t, h_out), h_out ^ 1, h_in))
        changed(t)


@operation
def try_make_adjacent(t: Any, h_in: int, h_out: int) -> int:
    """Make `h_out` the next of `h_in` if it may be: 0, or the negative code."""
    status = both_status(t, h_in, h_out)
    if status == OK:
        status = make_adjacent_status(t, h_in, h_out)
    if status == OK:
        make_adjacent(t, h_in, h_out)
    return -status


@kernel
def make_follow(t: Any, h_in: int, h_out: int, g: int) -> None:
    """What `make_adjacent` does, where `g` is known to be a free halfedge between."""
    b, d, h = next_of(t, h_in), prev_of(t, h_out), next_of(t, g)
    link(t, h_in, h_out)
    link(t, g, b)
    link(t, d, h)


# -- taking away ---------------------------------------------------------------------------------------------------


@kernel
def remove_face(t: Any, f: int) -> None:
    """Remove the face; its edges and vertices stay. Cost: the number of its sides."""
    start = halfedge_of_face(t, f)
    h = start
    while True:
        set_face(t, h, -1)
        set_halfedge_of_vertex(t, origin_of(t, h), h)
        h = next_of(t, h)
        if h == start:
            break
    delete_face(t, f)
    changed(t)


@operation
def try_remove_face(t: Any, f: int) -> int:
    """Remove the face if there is one: 0, or the negative code."""
    status = face_status(t, f)
    if status == OK:
        remove_face(t, f)
    return -status


@kernel
def remove_edge(t: Any, e: int) -> None:
    r"""Remove the edge and the faces beside it; its ends stay. Cost: the number of sides of these faces.

    ::

        p \   h    / x             p \        / x
           v ^  | ^        -->        v      ^         at both ends, when there are gaps on both sides
            (u) v                       (u)
    """
    h = 2 * e
    for side in (h, h ^ 1):
        if not is_exterior(t, side):
            remove_face(t, face_of(t, side))
    _unhang(t, h)
    _unhang(t, h ^ 1)
    delete_edge(t, h)
    changed(t)


@operation
def try_remove_edge(t: Any, e: int) -> int:
    """Remove the edge if there is one: 0, or the negative code."""
    status = edge_status(t, e)
    if status == OK:
        remove_edge(t, e)
    return -status


@kernel
def remove_vertex(t: Any, v: int) -> None:
    """Remove the vertex, its edges and the faces around it. Cost: the number of sides of these faces."""
    while halfedge_of_vertex(t, v) >= 0:
        remove_edge(t, halfedge_of_vertex(t, v) >> 1)
    delete_vertex(t, v)
    changed(t)


@operation
def try_remove_vertex(t: Any, v: int) -> int:
    """Remove the vertex if there is one: 0, or the negative code."""
    status = vertex_status(t, v)
    if status == OK:
        remove_vertex(t, v)
    return -status


@kernel
def _unhang(t: Any, h: int) -> None:
    """Take the origin of `h`, whose edge has no faces, from its vertex."""
    u, p, x = origin_of(t, h), prev_of(t, h), next_of(t, h ^ 1)
    if p == h ^ 1:  # nothing else is there
        set_halfedge_of_vertex(t, u, -1)
        return
    link(t, p, x)
    if halfedge_of_vertex(t, u) == h:
        set_halfedge_of_vertex(t, u, x)
