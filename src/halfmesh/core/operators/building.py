"""Building by hand: vertices, edges and faces are added one by one, and taken away again.

An edge is hung into gaps, without a face. A face is laid along halfedges that have none; where two that should follow
each other do not yet, what lies between them around their vertex is moved into another gap. So faces can be added in
any order, two may touch at a vertex only, and no order of adding leads into a dead end that the result would not be.
What is taken away leaves what it stood on: faces leave wire, edges leave isolated vertices.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import kernel, operation
from halfmesh.core.attempts import begin_attempt, end_attempt
from halfmesh.core.navigation import (
    ccw_of,
    face_of,
    face_slots,
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
from halfmesh.core.operators.gaps import show_gap
from halfmesh.core.pens import changed, link, set_face, set_halfedge_of_vertex, set_next, set_prev
from halfmesh.core.slots import delete_edge, delete_face, delete_vertex, is_full, new_edge, new_face, new_vertex
from halfmesh.core.statuses import (
    CLOSED_VERTEX,
    DELETED_ELEMENT,
    EMPTY_FACE,
    FEW_VERTICES,
    MISSING_ELEMENT,
    NO_GAP,
    NOT_A_CHAIN,
    OK,
    REPEATED_HALFEDGE,
    REPEATED_VERTEX,
    TAKEN_HALFEDGE,
    TOO_LARGE,
)
from halfmesh.core.topology import DELETED

__all__ = [
    "add_edge",
    "add_edge_in",
    "add_edge_status",
    "add_vertex",
    "find_free_between",
    "find_free_incident",
    "make_adjacent",
    "make_adjacent_status",
    "remove_edge",
    "remove_face",
    "remove_vertex",
    "try_add_edge",
    "try_add_face",
    "try_add_face_of_vertices",
    "try_add_vertex",
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


# -- an edge -------------------------------------------------------------------------------------------------------


@operation
def add_edge_status(t: Any, u: int, v: int) -> int:
    """Whether an edge may be added from `u` to `v`: ``OK`` or a code. A loop or a parallel edge may. Cost: O(1)."""
    if _is_closed(t, u, -1) or _is_closed(t, v, -1):
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
    h = _hung_edge(t, u, v)
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


@kernel
def _is_closed(t: Any, v: int, planned: int) -> bool:
    """Whether faces close all around the vertex; what has the face `planned` counts as a gap still."""
    h = halfedge_of_vertex(t, v)
    return h >= 0 and not is_exterior(t, h) and face_of(t, h) != planned


@kernel
def _hung_edge(t: Any, u: int, v: int) -> int:
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
        _make_follow(t, h_in, h_out, find_free_between(t, origin_of(t, h_out), h_out ^ 1, h_in))
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
def _make_follow(t: Any, h_in: int, h_out: int, g: int) -> None:
    b, d, h = next_of(t, h_in), prev_of(t, h_out), next_of(t, g)
    link(t, h_in, h_out)
    link(t, g, b)
    link(t, d, h)


# -- a face --------------------------------------------------------------------------------------------------------


@operation
def try_add_face(t: Any, halfedges: Any) -> int:
    """Add a face with these halfedges, in this order: the face, or the negative code, and nothing changed.

    They are made adjacent where they are not. The face may have one side or two, run along both sides of an edge, and
    pass a vertex several times. ``NO_GAP`` says that there is no way to have it. Cost: the degrees of its corners.
    """
    status = _face_status(t, halfedges)
    if status != OK:
        return -status
    before = begin_attempt(t)
    f = _lay_face(t, halfedges)
    end_attempt(t, before, f >= 0)
    return f


@operation
def try_add_face_of_vertices(t: Any, vertices: Any) -> int:
    """Add a face with these corners, in this order: the face, or the negative code, and nothing changed.

    Its sides are the first free halfedges found, and new edges between vertices that no edge joins yet. Where parallel
    edges are to choose from, add the face by its halfedges. Cost: the degrees of its corners.
    """
    status = _corners_status(t, vertices)
    if status != OK:
        return -status
    sides = np.empty(len(vertices), np.int64)
    if not _are_distinct(vertices):
        return _try_add_intricate_face(t, vertices, sides)
    status = _choose_sides(t, vertices, sides)
    return -status if status != OK else _lay_along(t, vertices, sides)


@kernel
def _are_distinct(vertices: Any) -> bool:
    n = len(vertices)
    if n > 16:  # it takes n^2; the other way is right for all faces, only slower
        return False
    for i in range(n):
        for j in range(i):
            if vertices[i] == vertices[j]:
                return False
    return True


@kernel
def _choose_sides(t: Any, vertices: Any, sides: Any) -> int:
    """The free halfedges that the face is to run along, -1 for an edge to be made: ``OK``, or why it can't be.

    Where all vertices are distinct no corner has to do with another, so all can be asked before anything is moved.
    """
    n = len(vertices)
    u = int(vertices[0])
    for i in range(n):
        v = int(vertices[i + 1 if i + 1 < n else 0])
        found, start, gap = -1, halfedge_of_vertex(t, u), halfedge_of_vertex(t, v)
        x = start
        while x >= 0:
            if target_of(t, x) == v:
                if is_exterior(t, x):
                    found = x
                    break
                found = -2
            x = ccw_of(t, x)
            if x == start:
                break
        if found == -2:
            return TAKEN_HALFEDGE
        if found == -1 and ((start >= 0 and not is_exterior(t, start)) or (gap >= 0 and not is_exterior(t, gap))):
            return CLOSED_VERTEX
        sides[i] = found
        u = v
    for i in range(n):
        h_in, h_out = sides[i - 1 if i > 0 else n - 1], sides[i]
        apart = h_in >= 0 and h_out >= 0 and next_of(t, h_in) != h_out
        if apart and find_free_between(t, int(vertices[i]), h_out ^ 1, h_in) < 0:
            return NO_GAP
    return OK


@kernel
def _lay_along(t: Any, vertices: Any, sides: Any) -> int:
    """Make the edges that are missing and lay the face, which `_choose_sides` has said may be."""
    n, f = len(sides), face_slots(t)
    for i in range(n):
        if sides[i] < 0:
            sides[i] = _hung_edge(t, int(vertices[i]), int(vertices[i + 1 if i + 1 < n else 0]))
    h_in = sides[n - 1]
    for i in range(n):
        h_out = sides[i]
        set_face(t, h_out, f)
        if next_of(t, h_in) != h_out:
            _make_follow(t, h_in, h_out, find_free_between(t, origin_of(t, h_out), h_out ^ 1, h_in))
        h_in = h_out
    new_face(t, sides[0])
    for i in range(n):
        start = halfedge_of_vertex(t, int(vertices[i]))
        if not is_exterior(t, start):
            x = ccw_of(t, start)
            while x != start and not is_exterior(t, x):
                x = ccw_of(t, x)
            if x != start:
                set_halfedge_of_vertex(t, int(vertices[i]), x)
    changed(t)
    return f


@kernel
def _try_add_intricate_face(t: Any, vertices: Any, halfedges: Any) -> int:
    """A face that may pass a vertex or an edge twice, so that its corners have to do with each other: by trying."""
    n, status = len(vertices), OK
    before = begin_attempt(t)
    f = face_slots(t)  # marks what the face has chosen already, until all are chosen
    for i in range(n):
        h = _side(t, int(vertices[i]), int(vertices[i + 1 if i + 1 < n else 0]), f)
        if h < 0:
            status = -h
            break
        halfedges[i] = h
        set_face(t, h, f)
    if status == OK:
        for i in range(n):
            set_face(t, int(halfedges[i]), -1)
        f = _lay_face(t, halfedges)
    else:
        f = -status
    end_attempt(t, before, f >= 0)
    return f


@kernel
def _face_status(t: Any, halfedges: Any) -> int:
    """What can be said before anything is moved. Cost: the number of sides."""
    n = len(halfedges)
    if n == 0:
        return EMPTY_FACE
    for i in range(n):
        status = halfedge_status(t, int(halfedges[i]))
        if status != OK:
            return status
    for i in range(n):
        if not is_exterior(t, int(halfedges[i])):
            return TAKEN_HALFEDGE
        if target_of(t, int(halfedges[i])) != origin_of(t, int(halfedges[i + 1 if i + 1 < n else 0])):
            return NOT_A_CHAIN
    return TOO_LARGE if is_full(t, 0, 0, 1) else OK


@kernel
def _corners_status(t: Any, vertices: Any) -> int:
    n = len(vertices)
    if n == 0:
        return EMPTY_FACE
    for i in range(n):
        v = int(vertices[i])
        if v < 0 or v >= vertex_slots(t):
            return MISSING_ELEMENT
        if halfedge_of_vertex(t, v) == DELETED:
            return DELETED_ELEMENT
    if n < 3:
        return FEW_VERTICES
    for i in range(n):
        if int(vertices[i]) == int(vertices[i + 1 if i + 1 < n else 0]):
            return REPEATED_VERTEX
    return TOO_LARGE if is_full(t, 0, n, 1) else OK


@kernel
def _side(t: Any, u: int, v: int, planned: int) -> int:
    """A free halfedge from `u` to `v`, made if no edge joins them; or the negative code."""
    start = halfedge_of_vertex(t, u)
    if start >= 0:
        joined, x = False, start
        while True:
            if target_of(t, x) == v:
                if is_exterior(t, x):
                    return x
                joined = True
            x = ccw_of(t, x)
            if x == start:
                break
        if joined:
            return -TAKEN_HALFEDGE
    if _is_closed(t, u, planned) or _is_closed(t, v, planned):
        return -CLOSED_VERTEX
    return _hung_edge(t, u, v)


@kernel
def _lay_face(t: Any, halfedges: Any) -> int:
    """Make the halfedges adjacent and a face: it, or the negative code; the caller undoes what was half done.

    A halfedge gets the face as soon as its next is settled, so it is no gap for the rest of the search. That is enough:
    around a vertex what is settled is a set of fans, each with one free end, and two of them can be joined as long as
    they are not the same fan. So the search fails only if the halfedges themselves ask for a ring that leaves
    something out, whatever the order.
    """
    n, f = len(halfedges), face_slots(t)
    for i in range(n):
        h_in, h_out = int(halfedges[i]), int(halfedges[i + 1 if i + 1 < n else 0])
        set_face(t, h_in, f)
        if i + 1 < n and not is_exterior(t, h_out):
            return -REPEATED_HALFEDGE
        if next_of(t, h_in) != h_out:
            g = find_free_between(t, origin_of(t, h_out), h_out ^ 1, h_in)
            if g < 0:
                return -NO_GAP
            _make_follow(t, h_in, h_out, g)
    f = new_face(t, int(halfedges[0]))
    for i in range(n):
        show_gap(t, origin_of(t, int(halfedges[i])))
    changed(t)
    return f


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
